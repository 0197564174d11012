// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/compile/source_file.hpp"
#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <regex>
#include <stdexcept>

namespace drivers {
namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

std::optional<Language> language_by_suffix(const std::string& path) {
  const std::string own = std::filesystem::path(path).extension().string(), suffix = lower(own);
  const auto is_one_of = [&](auto... known) { return ((suffix == known) || ...); };
  if (is_one_of(".f", ".for", ".ftn", ".f77", ".fpp")) return Language::fixed_fortran;
  if (is_one_of(".f90", ".f95", ".f03", ".f08")) return Language::free_fortran;
  if (own == ".C" || is_one_of(".cpp", ".cc", ".cxx", ".c++")) return Language::cxx;
  if (suffix == ".c") return Language::c;
  if (suffix == ".o") return Language::object;
  return std::nullopt;
}

/// Form by a directive of Intel's compiler, such as `!DEC$ FREEFORM`.
std::optional<Language> form_by_directive(const std::string& text) {
  static const std::regex directive("(^|\n)[!cC*](DEC|DIR)\\$[ \t]*(NO)?FREEFORM", std::regex::icase);
  std::smatch found;
  if (!std::regex_search(text, found, directive)) return std::nullopt;
  return found[3].matched ? Language::fixed_fortran : Language::free_fortran;
}

} // namespace

std::string file_content(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in || std::filesystem::is_directory(path))
    throw std::runtime_error(fmt::format("{}: cannot be read", path));
  return {std::istreambuf_iterator<char>(in), {}};
}

bool needs_preprocessor(const std::string& text) {
  static const std::regex directive("(^|\n)#[ \t]*(include|if|ifdef|ifndef|else|endif|define|undef)\\b");
  return std::regex_search(text, directive);
}

std::optional<Language> language_of(const std::string& path, const std::string& text) {
  auto language = language_by_suffix(path);
  if (language == Language::fixed_fortran || language == Language::free_fortran)
    language = form_by_directive(text).value_or(*language);
  return language;
}

std::vector<std::string> included_names(const std::string& text) {
  static const std::regex statement("(^|\n)[ \t]*#?[ \t]*include[ \t]*['\"<]([^'\">\n]+)['\">]",
                                    std::regex::icase);
  std::vector<std::string> names;
  for (auto at = std::sregex_iterator(text.begin(), text.end(), statement); at != std::sregex_iterator();
       ++at)
    names.push_back(std::filesystem::path((*at)[2].str()).filename().string());
  return names;
}

SourceFile read_source(const std::string& path) {
  const auto text = file_content(path);
  const auto language = language_of(path, text);
  if (!language)
    throw std::runtime_error(fmt::format(
        "{}: expected a source in Fortran (.f .for .f90), C (.c) or C++ (.cpp), or an object (.o)", path));
  SourceFile source{path, *language};
  source.preprocessed = is_fortran(source) && needs_preprocessor(text);
  return source;
}

} // namespace drivers
