// SPDX-License-Identifier: BSD-3-Clause
// The commands by which sources become a library.
#pragma once
#include "drivers/compile/source_file.hpp"
#include "drivers/files/toml_text.hpp"

namespace drivers {

/// What `simsand compile` was asked for.
struct CompileOptions {
  Words files;
  std::string output;    ///< the library; empty: lib + name of the first file + .so in this folder
  bool debug = false;    ///< indices checked, traps for invalid numbers, lines in traces
  std::string form;      ///< "fixed" or "free" in place of what suffixes say; empty: by suffix
  Words include_folders; ///< -I
  Words definitions;     ///< -D
  Words libraries;       ///< -l
  bool shows_commands = false;
};

/// The compiler's command for one source. `include_folder` holds vaba_param.inc and the like,
/// `scratch` takes Fortran's module files.
Words compiler_command(const SourceFile& source, const CompileOptions& options,
                       const std::string& include_folder, const std::string& scratch,
                       const std::string& object);

/// The command that links objects.
Words linker_command(const std::vector<SourceFile>& sources, const Words& objects,
                     const CompileOptions& options, const std::string& output);

/// Symbol that marks a library compiled for debugging: the host then traps invalid numbers in its calls.
inline constexpr char debug_symbol[] = "simsand_traps_invalid_numbers";

} // namespace drivers
