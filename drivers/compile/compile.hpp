// SPDX-License-Identifier: BSD-3-Clause
// From the sources of a user's subroutine to a library that the hosts load, as `abaqus user=FILE` does it.
#pragma once
#include "drivers/compile/compiler_command.hpp"

namespace drivers {

/// Compiles and links, shows what the compilers say on standard error, with advice on what Intel's compiler takes
/// and gfortran does not, and loads the library once, as a run would. Returns its path. Throws std::runtime_error
/// naming the file if a source cannot be read or compiled, or the library cannot be loaded; none is left then.
std::string compile_library(const CompileOptions& options);

} // namespace drivers
