// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/files/csv_write.hpp"
#include "host/files/whole_file.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace drivers {

CsvWriter::CsvWriter(std::string_view header, const Words& comments)
    : columns(std::size_t(std::count(header.begin(), header.end(), ',')) + 1) {
  for (const auto& comment : comments) written += "# " + comment + '\n';
  written += header;
  written += '\n';
}

void CsvWriter::separate() {
  if (cells++ > 0) written += ',';
}

void CsvWriter::cell(std::string_view text) {
  separate();
  if (text.find_first_of(",\"\r\n") == text.npos) {
    written += text;
    return;
  }
  written += '"';
  for (const char c : text) {
    if (c == '"') written += '"'; // a quote within quotes is written twice
    written += c;
  }
  written += '"';
}

void CsvWriter::cell(Rounded number) {
  separate();
  if (std::isfinite(number.value))
    fmt::format_to(std::back_inserter(written), "{:.{}g}", number.value + 0.0, number.digits); // 0, not -0
}

void CsvWriter::whole(long long number) {
  separate();
  fmt::format_to(std::back_inserter(written), "{}", number);
}

void CsvWriter::end_row() {
  if (cells != columns)
    throw std::logic_error(
        fmt::format("a table of {} columns: expected as many cells, found {}", columns, cells));
  written += '\n';
  cells = 0;
}

std::string CsvWriter::take() {
  return std::exchange(written, {});
}

void CsvWriter::write(const std::filesystem::path& file) const {
  host::write_whole(file, written);
}

} // namespace drivers
