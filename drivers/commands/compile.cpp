// SPDX-License-Identifier: BSD-3-Clause
// `simsand compile`: a user's subroutine from its sources to a library.
#include "drivers/compile/compile.hpp"
#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>

namespace commands {

void add_compile(CLI::App& app) {
  const auto options = std::make_shared<drivers::CompileOptions>();
  auto* command =
      app.add_subcommand("compile", "Compile a VUMAT, in Fortran, C or C++, as ABAQUS does, into a library");
  command
      ->add_option("FILES", options->files, "sources (.f .for .f90 .c .cpp) and objects (.o), modules first")
      ->required();
  command->add_option("-o,--output", options->output,
                      "the library, default: lib + name of the first file + .so");
  command->add_flag("--debug", options->debug,
                    "check indices, trap invalid numbers, give lines in traces; slow");
  command->add_option("--form", options->form, "fixed or free, in place of what the suffix says")
      ->check(CLI::IsMember({"fixed", "free"}));
  command->add_option("-I", options->include_folders, "folder with files to include")
      ->allow_extra_args(false);
  command->add_option("-D", options->definitions, "NAME or NAME=VALUE for the preprocessor")
      ->allow_extra_args(false);
  command->add_option("-l", options->libraries, "library to link, such as lapack")->allow_extra_args(false);
  command->add_flag("-v,--verbose", options->shows_commands, "show the commands of the compilers");
  command->callback([options] { fmt::print("{}\n", drivers::compile_library(*options)); });
}

} // namespace commands
