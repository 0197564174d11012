// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/files/workbook.hpp"
#include "drivers/files/decoded_text.hpp"
#include "drivers/files/resource.hpp"
#include "drivers/run/process.hpp"
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <stdexcept>
#include <unistd.h>

namespace drivers {
namespace {

/// Runs the script and gives what it wrote, which is its message if it failed.
std::string output_of(const std::string& script, const Words& arguments, bool& succeeded) {
  auto log = (std::filesystem::temp_directory_path() / "simsand_workbook_XXXXXX").string();
  const int file = mkstemp(log.data());
  if (file < 0) throw std::runtime_error(log + ": no temporary file can be made");
  close(file);
  succeeded = run_program({python_command(script, arguments), log}) == 0;
  auto text = read_bytes(log);
  std::filesystem::remove(log);
  return text;
}

} // namespace

bool is_workbook(std::string_view bytes, const std::string& file) {
  if (bytes.starts_with("\xD0\xCF\x11\xE0"))
    throw std::runtime_error(
        file + ": expected text or .xlsx, found an older Excel workbook (.xls): save it as .xlsx "
               "or CSV");
  return bytes.starts_with("PK\x03\x04");
}

std::string workbook_text(const std::string& file, const std::string& sheet) {
  const auto script = resource("scripts/workbook.py");
  bool succeeded = false;
  auto text = output_of(script, {file, sheet}, succeeded);
  if (succeeded) return text;
  const auto line = text.substr(0, text.find('\n'));
  throw std::runtime_error(line.starts_with(file) ? line
                                                  : fmt::format("{}: {} failed: {}", file, script, line));
}

} // namespace drivers
