// SPDX-License-Identifier: BSD-3-Clause
#include "host/material/library.hpp"
#include <dlfcn.h>
#include <filesystem>
#include <fmt/format.h>
#include <link.h>
#include <stdexcept>

namespace host {
namespace {

/// The file of a loaded library: where the loader found it if it was given a bare name.
std::string file_of(void* handle) {
  const link_map* entry = nullptr;
  dlinfo(handle, RTLD_DI_LINKMAP, &entry);
  return entry->l_name;
}

} // namespace

VumatLibrary load_vumat(const std::string& path) {
  void* handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle) throw std::runtime_error(fmt::format("material library {}: {}", path, dlerror()));
  VumatLibrary library{file_of(handle), {handle, dlclose}, nullptr};
  library.call = reinterpret_cast<vumat::Subroutine<double>*>(dlsym(handle, "vumat_"));
  if (!library.call) throw std::runtime_error(fmt::format("material library {}: exports no vumat_", path));
  return library;
}

std::string beside_program(const std::string& name) {
  return (std::filesystem::read_symlink("/proc/self/exe").parent_path() / name).string();
}

} // namespace host
