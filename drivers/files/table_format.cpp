// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/files/table_format.hpp"

namespace drivers {
namespace {

std::optional<int> read_line(const TomlTable& table, const char* key, int lower) {
  if (!table.has(key)) return std::nullopt;
  return int(table.integer(key, {double(lower), 1e9}));
}

} // namespace

TableFormat read_table_format(const TomlTable& table) {
  TableFormat format;
  format.encoding = table.text("encoding", {}, "");
  format.sheet = table.text("sheet", {}, "");
  if (table.has("separator")) {
    const auto word = table.text("separator", {"comma", "semicolon", "tab", "blank"});
    format.separator = word == "comma" ? ',' : word == "semicolon" ? ';' : word == "tab" ? '\t' : ' ';
  }
  if (table.has("decimal")) format.decimal = table.text("decimal", {"point", "comma"}) == "point" ? '.' : ',';
  format.names_line = read_line(table, "names_line", 0);
  format.units_line = read_line(table, "units_line", 1);
  format.first_line = read_line(table, "first_line", 1);
  format.last_line = read_line(table, "last_line", 1);
  format.skip_gaps = table.text("missing", {"error", "skip"}, "error") == "skip";
  return format;
}

std::string separator_name(char separator) {
  return separator == ','    ? "commas"
         : separator == ';'  ? "semicolons"
         : separator == '\t' ? "tabs"
                             : "blanks";
}

std::string decimal_name(char decimal) {
  return decimal == ',' ? "decimal comma" : "decimal point";
}

} // namespace drivers
