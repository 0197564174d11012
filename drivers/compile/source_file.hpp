// SPDX-License-Identifier: BSD-3-Clause
// What a source file of a subroutine is written in, as ABAQUS tells it.
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace drivers {

enum class Language { fixed_fortran, free_fortran, c, cxx, object };

struct SourceFile {
  std::string path;
  Language language;
  bool preprocessed = false; ///< Fortran with lines of the C preprocessor (#include, #ifdef, ...)
};

inline bool is_fortran(const SourceFile& source) {
  return source.language == Language::fixed_fortran || source.language == Language::free_fortran;
}

/// Language by suffix: .f .for .ftn .f77 .fpp fixed form, .f90 .f95 .f03 .f08 free form, .c, .cpp .cc .cxx .C, .o
/// already compiled; capital letters mean the same but for .C. A directive `!dir$ freeform` or `nofreeform` of
/// Intel's compiler goes before the suffix. Throws std::runtime_error naming the file if it cannot be read or its
/// suffix is none of these.
SourceFile read_source(const std::string& path);

/// Language of `text` in a file of this name; none for a suffix that is none of those.
std::optional<Language> language_of(const std::string& path, const std::string& text);

/// Whether any line begins with a directive of the C preprocessor.
bool needs_preprocessor(const std::string& text);

/// File names that `text` includes by INCLUDE or #include, without folders in front.
std::vector<std::string> included_names(const std::string& text);

std::string file_content(const std::string& path);

} // namespace drivers
