// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/compile/compile.hpp"
#include "drivers/compile/compiler_advice.hpp"
#include "drivers/files/resource.hpp"
#include "drivers/run/process.hpp"
#include "host/material/library.hpp"
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <set>
#include <stdexcept>

namespace drivers {
namespace {

namespace fs = std::filesystem;

/// A folder for objects and module files, removed with all it holds.
struct ScratchFolder {
  ScratchFolder() : path((fs::temp_directory_path() / "simsand_compile_XXXXXX").string()) {
    if (!mkdtemp(path.data())) throw std::runtime_error(fmt::format("{}: cannot be made", path));
  }
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  std::string path;
};

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

/// Names by which a source and what it includes from folders beside it include files.
void collect_included(const fs::path& file, std::set<std::string>& names) {
  for (const auto& name : included_names(file_content(file.string()))) {
    if (!names.insert(name).second) continue;
    if (const auto beside = file.parent_path() / name; fs::is_regular_file(beside))
      collect_included(beside, names);
  }
}

/// Copies what ABAQUS provides for INCLUDE into `folder`, also by the spellings that occur in the sources.
void provide_includes(const std::vector<SourceFile>& sources, const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& source : sources)
    if (source.language != Language::object) collect_included(source.path, names);
  fs::create_directories(folder);
  for (const auto& entry : fs::directory_iterator(resource("include"))) {
    const auto own = entry.path().filename().string();
    fs::copy_file(entry.path(), folder / own);
    for (const auto& name : names)
      if (name != own && lower(name) == lower(own)) fs::copy_file(entry.path(), folder / name);
  }
}

/// Runs a compiler, shows what it writes and, if it fails, advice.
void run_compiler(const Words& command, const std::string& what, const CompileOptions& options,
                  const std::string& scratch) {
  if (options.shows_commands) fmt::print(stderr, "{}\n", shell_text(command));
  const auto log = scratch + "/log";
  const int status = run_program({command, log});
  const auto output = file_content(log);
  fmt::print(stderr, "{}", output);
  if (status == 0) return;
  const auto advice = advice_on(output);
  for (const auto& line : advice) fmt::print(stderr, "{}\n", line);
  throw std::runtime_error(fmt::format("{}: {} refused it; see above", what, command.front()));
}

std::vector<SourceFile> read_sources(const CompileOptions& options) {
  std::vector<SourceFile> sources;
  for (const auto& path : options.files) {
    sources.push_back(read_source(path));
    if (!options.form.empty() && is_fortran(sources.back()))
      sources.back().language = options.form == "free" ? Language::free_fortran : Language::fixed_fortran;
  }
  return sources;
}

Words compile_objects(const std::vector<SourceFile>& sources, const CompileOptions& options,
                      const std::string& scratch) {
  const auto include_folder = scratch + "/include";
  provide_includes(sources, include_folder);
  Words objects;
  for (const auto& source : sources) {
    if (source.language == Language::object) {
      objects.push_back(source.path);
      continue;
    }
    objects.push_back(fmt::format("{}/{}.o", scratch, objects.size()));
    run_compiler(compiler_command(source, options, include_folder, scratch, objects.back()), source.path,
                 options, scratch);
  }
  return objects;
}

} // namespace

std::string compile_library(const CompileOptions& options) {
  setenv("LC_ALL", "C", 1); // messages in English, as the advice expects them
  const auto sources = read_sources(options);
  const auto output = options.output.empty()
                          ? fmt::format("lib{}.so", fs::path(options.files.front()).stem().string())
                          : options.output;
  const ScratchFolder scratch;
  const auto objects = compile_objects(sources, options, scratch.path);
  const auto made = scratch.path + "/library.so";
  run_compiler(linker_command(sources, objects, options, made), output, options, scratch.path);
  try {
    host::load_vumat(made);
  } catch (const std::runtime_error& error) {
    auto text = std::string(error.what());
    for (auto at = text.find(made); at != text.npos; at = text.find(made))
      text.replace(at, made.size(), output);
    throw std::runtime_error(text);
  }
  // A run that has the old library open keeps it: the file is replaced, not overwritten.
  const auto beside = output + ".new";
  fs::copy_file(made, beside, fs::copy_options::overwrite_existing);
  fs::rename(beside, output);
  return output;
}

} // namespace drivers
