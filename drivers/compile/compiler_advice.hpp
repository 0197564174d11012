// SPDX-License-Identifier: BSD-3-Clause
// Advice on what Intel's compiler, which ABAQUS uses, takes and gfortran refuses.
#pragma once
#include <string>
#include <vector>

namespace drivers {

/// One error of gfortran.
struct CompilerError {
  std::string file;
  int line = 0;
  std::string source;  ///< the line as the compiler shows it; may be empty
  std::string message; ///< without "Error: "
};

/// The errors in what gfortran wrote.
std::vector<CompilerError> read_errors(const std::string& output);

/// How to mend it; empty where nothing better than the message is known.
std::string advice_on(const CompilerError& error);

/// "FILE:LINE: ADVICE" for each error of which something is known, each advice on a line once.
std::vector<std::string> advice_on(const std::string& output);

} // namespace drivers
