// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/compile/compiler_command.hpp"
#include "drivers/compile/options.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <sstream>

namespace drivers {
namespace {

void append(Words& command, const Words& more) {
  command.insert(command.end(), more.begin(), more.end());
}

/// The words of a list of CMake.
Words list(const char* text) {
  Words words;
  std::istringstream in(text);
  for (std::string word; std::getline(in, word, ';');)
    if (!word.empty()) words.push_back(word);
  return words;
}

/// Compiler, language and dialect.
Words dialect(const SourceFile& source, bool debug) {
  Words command;
  if (is_fortran(source)) {
    const bool fixed = source.language == Language::fixed_fortran;
    command = {"gfortran", "-x", fixed ? "f77" : "f95", fixed ? "-ffixed-form" : "-ffree-form",
               source.preprocessed ? "-cpp" : "-nocpp"};
    append(command, list(compile_options::fortran));
    if (debug) append(command, list(compile_options::fortran_debug));
  } else if (source.language == Language::c) {
    command = {"gcc"};
    append(command, list(compile_options::c));
  } else {
    command = {"g++", "-x", "c++"};
    append(command, list(compile_options::cxx));
    if (debug) append(command, list(compile_options::cxx_debug));
  }
  append(command, list(debug ? compile_options::debug : compile_options::release));
  return command;
}

bool has(const std::vector<SourceFile>& sources, Language language) {
  return std::any_of(sources.begin(), sources.end(), [=](const auto& s) { return s.language == language; });
}

} // namespace

Words compiler_command(const SourceFile& source, const CompileOptions& options,
                       const std::string& include_folder, const std::string& scratch,
                       const std::string& object) {
  Words command = dialect(source, options.debug);
  if (is_fortran(source)) append(command, {"-J", scratch});
  for (const auto& folder : options.include_folders) command.push_back("-I" + folder);
  command.push_back("-I" + include_folder);
  const bool defines = !is_fortran(source) || source.preprocessed;
  if (defines)
    for (const auto& definition : options.definitions) command.push_back("-D" + definition);
  append(command, {"-c", source.path, "-o", object});
  return command;
}

Words linker_command(const std::vector<SourceFile>& sources, const Words& objects,
                     const CompileOptions& options, const std::string& output) {
  const bool cxx = has(sources, Language::cxx),
             c_alone = std::all_of(sources.begin(), sources.end(),
                                   [](auto&s) { return s.language == Language::c; });
  Words command{c_alone ? "gcc" : "gfortran", "-shared", "-o", output};
  append(command, objects);
  for (const auto& library : options.libraries) command.push_back("-l" + library);
  if (cxx) command.push_back("-lstdc++");
  command.push_back("-lm");
  if (options.debug) command.push_back(fmt::format("-Wl,--defsym={}=1", debug_symbol));
  return command;
}

} // namespace drivers
