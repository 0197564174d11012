// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/compile/compiler_advice.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <regex>
#include <sstream>

namespace drivers {
namespace {

struct Advice {
  const char *message, *source; ///< regular expressions
  const char* text;
};

constexpr const char* relation = "(<|>|\\.[lg][te]\\.)[^()]*(<|>|\\.[lg][te]\\.)";

const std::vector<Advice>& known() {
  static const std::vector<Advice> list{
      {"IF clause .* requires a scalar LOGICAL|DO WHILE loop .* must be a scalar LOGICAL", "",
       "a number stands for a condition. The compiler of ABAQUS takes an odd integer as true; write a "
       "comparison, as in `if (i /= 0)`"},
      {"Syntax error in IF-expression|cannot be used as a defined operator|Operands of comparison operator",
       relation,
       "`a < x < b` compares the truth of `a < x` with b in the compiler of ABAQUS, which is hardly meant; "
       "write "
       "`a < x .and. x < b`"},
      {"Operands of comparison operator .* LOGICAL|Operands of logical operator", "",
       "a truth value is mixed with a number. In the compiler of ABAQUS .true. is -1 and .false. is 0; write "
       "a "
       "comparison"},
      {"Logicals at .* must be compared with", "", "two truth values are compared; write .eqv. or .neqv."},
      {"Cannot open module file .*(ifport|ifcore|ifposix|dfport|ifwin|iflport)", "",
       "the module comes with Intel's compiler alone; remove the line and replace what is used of it"},
      {"Cannot open module file", "",
       "the source of the module must be named before this file: simsand compile MODULE.f90 THIS.f"},
      {"Cannot open included file|No such file or directory", "",
       "the included file is needed too: put it beside the source, or give its folder with -I"},
      {"Invalid character in name|Non-numeric character in statement label|Unclassifiable statement",
       "&[ \t]*$|^[^cC*!]{0,5}[a-zA-Z]",
       "this looks like free form in a file whose suffix says fixed form: simsand compile --form free"},
  };
  return list;
}

std::optional<CompilerError> location(const std::string& line) {
  static const std::regex form("^(.+):(\\d+):(\\d+)(-\\d+)?:$");
  std::smatch found;
  if (!std::regex_match(line, found, form)) return std::nullopt;
  return CompilerError{found[1], std::stoi(found[2]), "", ""};
}

} // namespace

std::vector<CompilerError> read_errors(const std::string& output) {
  static const std::regex shown("^ *\\d+ \\|(.*)$"), error("^(Fatal )?Error: (.*)$"),
      warning("^Warning: .*$");
  std::vector<CompilerError> errors;
  std::optional<CompilerError> at;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    std::smatch found;
    if (const auto next = location(line); next && !at)
      at = next;
    else if (at && at->source.empty() && std::regex_match(line, found, shown))
      at->source = found[1];
    else if (std::regex_match(line, found, error)) {
      errors.push_back(at.value_or(CompilerError{}));
      errors.back().message = found[2];
      at.reset();
    } else if (std::regex_match(line, warning))
      at.reset();
  }
  return errors;
}

std::string advice_on(const CompilerError& error) {
  const auto has = [](const std::string& text, const char* pattern) {
    return std::regex_search(text, std::regex(pattern, std::regex::icase));
  };
  for (const auto& advice : known())
    if (has(error.message, advice.message) && has(error.source, advice.source)) return advice.text;
  return {};
}

std::vector<std::string> advice_on(const std::string& output) {
  std::vector<std::string> lines;
  for (const auto& error : read_errors(output)) {
    const auto advice = advice_on(error);
    if (advice.empty()) continue;
    auto line = fmt::format("{}:{}: {}", error.file, error.line, advice);
    const bool form = advice.find("--form") != advice.npos; // one for the whole file
    const auto is_same = [&](const std::string& other) {
      return form ? other.find(advice) != other.npos : other == line;
    };
    if (std::none_of(lines.begin(), lines.end(), is_same)) lines.push_back(std::move(line));
  }
  return lines;
}

} // namespace drivers
