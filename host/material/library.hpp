// SPDX-License-Identifier: BSD-3-Clause
// A VUMAT in a shared library.
#pragma once
#include "vumat/abi.hpp"
#include <memory>
#include <string>

namespace host {

/// A loaded library and its double-precision `vumat_`; the library stays loaded while any copy lives.
struct VumatLibrary {
  std::string path; ///< of the file that was loaded
  std::shared_ptr<void> handle;
  vumat::Subroutine<double>* call = nullptr;
};

/// Loads `path` and finds `vumat_` in it. A name without a slash is looked for as the system's loader does (RUNPATH of the
/// program, LD_LIBRARY_PATH). Throws std::runtime_error, naming the path, if the library
/// cannot be loaded or does not export the symbol.
VumatLibrary load_vumat(const std::string& path);

/// Path of `name` in the folder of the running program, where the build puts the libraries of the materials.
std::string beside_program(const std::string& name);

} // namespace host
