// SPDX-License-Identifier: BSD-3-Clause
// One drained triaxial test, made up, in the layouts that laboratories, loggers and spreadsheets write.
#pragma once
#include "drivers/files/table_format.hpp"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

namespace lab {

/// Axial strain, volumetric strain (contraction positive), %, and deviatoric stress, kPa: what each file holds.
struct Row {
  double strain, volume, q;
};

/// Numbers are rounded to the digits that are written, so that each file holds the same doubles.
inline std::vector<Row> rows() {
  const auto rounded = [](double x) { return std::stod(fmt::format("{:.5f}", x)); };
  std::vector<Row> out;
  for (int i = 0; i <= 40; ++i) {
    const double e = 0.4 * i;
    const double peak = 1 + 0.25 * std::exp(-std::pow((e - 5) / 4, 2));
    out.push_back({rounded(e), rounded(1.2 * e / (1 + e * e) - 0.3 * e / (1 + 0.08 * e)),
                   rounded(240 * e / (0.7 + e) * peak)});
  }
  return out;
}

struct Layout {
  std::string name;
  std::string bytes;
  std::vector<std::string> columns; ///< names of the three; empty: they are the first three and have no names
  drivers::TableFormat format;
};

/// Rows as text; `cell` writes a number, `line` joins three of them.
inline std::string table(const std::function<std::string(double)>& cell,
                         const std::function<std::string(std::string, std::string, std::string)>& line,
                         const std::string& end = "\n") {
  std::string out;
  for (const auto& r : rows()) out += line(cell(r.strain), cell(r.volume), cell(r.q)) + end;
  return out;
}

inline std::string point(double x) {
  return fmt::format("{:.5f}", x);
}
inline std::string comma(double x) {
  auto text = point(x);
  std::replace(text.begin(), text.end(), '.', ',');
  return text;
}

/// Three cells with a separator between, and one at the end if `ends`.
inline auto between(const std::string& separator, const std::string& quote = "",
                    const std::string& ends = "") {
  return [=](const std::string& a, const std::string& b, const std::string& c) {
    return quote + a + quote + separator + quote + b + quote + separator + quote + c + quote + ends;
  };
}

/// ASCII text as UTF-16.
inline std::string wide(const std::string& text, bool little) {
  std::string out;
  for (const char c : text) out += little ? std::string{c, '\0'} : std::string{'\0', c};
  return out;
}

inline std::vector<Layout> text_layouts() {
  const std::string names = "eps1 [%],epsv [%],q [kPa]\n", plain = names + table(point, between(","));
  const std::vector<std::string> usual{"eps1", "epsv", "q"};
  std::string logger = "\"Height (mm)\",\"100.0\"\n\"Diameter (mm)\",\"50.0\"\n";
  for (int k = 0; k < 20; ++k) logger += fmt::format("\"Field {}\",\"value {}\"\n", k, k);
  logger += "\"Stage\",\"Date\",\"Axial Strain (%)\",\"Volumetric Strain (%)\",\"Deviator Stress (kPa)\"\n";
  const auto with_date = [](const std::string& a, const std::string& b, const std::string& c) {
    return fmt::format("\"3\",\"04.03.2021 10:11:12\",\"{}\",\"{}\",\"{}\"", a, b, c);
  };
  std::string returns = plain, line_feeds = plain;
  std::replace(returns.begin(), returns.end(), '\n', '\r');
  for (std::size_t at = 0; (at = line_feeds.find('\n', at)) != std::string::npos; at += 2)
    line_feeds.insert(at, "\r");
  drivers::TableFormat skip;
  skip.skip_gaps = true;
  return {
      {"commas", plain, usual, {}},
      {"byte_order_mark", "\xEF\xBB\xBF" + plain, usual, {}},
      {"utf16_little", "\xFF\xFE" + wide(plain, true), usual, {}},
      {"utf16_big", "\xFE\xFF" + wide(plain, false), usual, {}},
      {"utf16_without_mark", wide(plain, true), usual, {}},
      {"returns", returns, usual, {}},
      {"returns_and_line_feeds", line_feeds, usual, {}},
      {"latin1",
       "Dehnung axial [%],Volumendehnung [%],Spannung f\xFCr CD [kPa]\n" + table(point, between(",")),
       {"Dehnung axial", "Volumendehnung", "Spannung f\xC3\xBCr CD"},
       {}},
      {"footer", plain + "\nEnd of test\nOperator, room,\n", usual, {}},
      {"titles_and_empty_column",
       "Test;CD-07;;\nSand;medium;;\n;;;\neps1 [%];epsv [%];q [kPa];\n" +
           table(comma, between(";", "", ";"), "\r\n"),
       usual,
       {}},
      {"separator_line", "sep=;\neps1 [%];epsv [%];q [kPa]\n" + table(comma, between(";")), usual, {}},
      {"logger",
       logger + table(point, with_date),
       {"Axial Strain", "Volumetric Strain", "Deviator Stress"},
       {}},
      {"quoted_names",
       "\"strain, axial [%]\",\"strain,\nvolumetric [%]\",\"\"\"q\"\" [kPa]\"\n" +
           table(point, between(",", "\"")),
       {"strain, axial", "strain, volumetric", "\"q\""},
       {}},
      {"quoted_decimal_commas", names + table(comma, between(",", "\"")), usual, {}},
      {"blanks_decimal_commas", "eps1 epsv q\n" + table(comma, between("  ")), usual, {}},
      {"tabs", "eps1, %\tepsv, %\tq, kPa\n" + table(point, between("\t")), usual, {}},
      {"names_by_blanks", "eps1 epsv q = s1-s3\n[%] [%] [kPa]\n" + table(point, between("\t")), {}, {}},
      {"names_in_comment",
       "# drained test, dense\n# eps1 [%]   epsv [%]   q [kPa]\n" + table(point, between("   ")),
       usual,
       {}},
      {"units_in_comment", "# eps1 epsv q\n# [%] [%] [kPa]\n" + table(point, between(" ")), usual, {}},
      {"units_below", "eps1;epsv;q\n%;%;kPa\n" + table(point, between(";")), usual, {}},
      {"units_above", "(%),(%),(kPa)\neps1,epsv,q\n" + table(point, between(",")), usual, {}},
      {"no_names", table(point, between(" ")), {}, {}},
      {"gaps", plain + "17.0,,300.0\n18.0,0.1,NaN\n#N/A,0.1,300.0\n", usual, skip},
  };
}

/// Writes the file and gives its path.
inline std::string write(const std::filesystem::path& folder, const Layout& layout,
                         const std::string& end = ".csv") {
  std::filesystem::create_directories(folder);
  const auto path = (folder / (layout.name + end)).string();
  std::ofstream(path, std::ios::binary) << layout.bytes;
  return path;
}

} // namespace lab
