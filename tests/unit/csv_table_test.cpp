// SPDX-License-Identifier: BSD-3-Clause
// Tables of laboratories: all layouts give the same numbers to the last bit; what a file leaves open is refused.
#include "drivers/files/csv_table.hpp"
#include "tests/unit/lab_layouts.hpp"
#include <cstdlib>
#include <gtest/gtest.h>
#include <random>

using namespace drivers;

namespace {

std::filesystem::path folder() {
  const auto path = std::filesystem::path(testing::TempDir()) / "csv_table";
  std::filesystem::create_directories(path);
  return path;
}

std::string file_with(const std::string& bytes) {
  return lab::write(folder(), {testing::UnitTest::GetInstance()->current_test_info()->name(), bytes, {}, {}});
}

CsvTable table_of(const std::string& bytes, const std::string& keys = "") {
  const auto document = parse_toml(keys, "keys.toml");
  const auto format = read_table_format(document);
  document.finish();
  return CsvTable(file_with(bytes), format);
}

/// The message without the path of the file; empty if there is none.
std::string error_of(const std::string& bytes, const std::string& keys = "") {
  try {
    auto table = table_of(bytes, keys);
    for (std::size_t c = 0; c < table.columns(); ++c)
      if (!table.heading(c).unit.empty()) table.numbers(c);
  } catch (const std::runtime_error& error) {
    const std::string text = error.what();
    return text.substr(text.find(".csv") + 4);
  }
  return "";
}

void expect_the_test(CsvTable& table, const std::vector<std::string>& names) {
  std::vector<std::size_t> columns{0, 1, 2};
  if (!names.empty())
    for (std::size_t k = 0; k < 3; ++k) columns[k] = table.column(names[k]);
  table.drop_gaps(columns);
  const auto expected = lab::rows();
  ASSERT_EQ(table.rows(), expected.size());
  const auto strain = table.numbers(columns[0]), volume = table.numbers(columns[1]),
             q = table.numbers(columns[2]);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(strain[i], expected[i].strain) << i;
    EXPECT_EQ(volume[i], expected[i].volume) << i;
    EXPECT_EQ(q[i], expected[i].q) << i;
  }
  if (names.empty() || names[0].starts_with("eps1 ")) return;
  for (const auto c : columns)
    EXPECT_TRUE(table.heading(c).unit == (c == columns[2] ? "kPa" : "%") || table.heading(c).unit.empty());
}

TEST(CsvTable, AllLayoutsGiveTheSameNumbers) {
  for (const auto& layout : lab::text_layouts()) {
    SCOPED_TRACE(layout.name);
    CsvTable table(lab::write(folder(), layout), layout.format);
    expect_the_test(table, layout.columns);
  }
}

TEST(CsvTable, UnitsComeFromTheNamesOrFromALine) {
  for (const auto& layout : lab::text_layouts()) {
    if (layout.name == "no_names" || layout.name == "blanks_decimal_commas") continue;
    SCOPED_TRACE(layout.name);
    const CsvTable table(lab::write(folder(), layout), layout.format);
    const std::size_t first = layout.name == "logger" ? 2 : 0;
    EXPECT_EQ(table.heading(first).unit, "%");
    EXPECT_EQ(table.heading(first + 2).unit, "kPa");
  }
  EXPECT_EQ(heading_of("sigma_radial_Pa").unit, "Pa");
  EXPECT_EQ(heading_of("q / kPa").name, "q");
  EXPECT_EQ(heading_of("stress in MPa").unit, "MPa");
  EXPECT_EQ(heading_of("eta = q/p").unit, "");
  EXPECT_EQ(heading_of("n_s").unit, "");
  EXPECT_EQ(heading_of("p [mPa]").unit, ""); // milli or mega
}

/// Makes a workbook; its path.
std::string workbook(const std::string& extra = "") {
  const auto table = lab::write(folder(), lab::text_layouts().front());
  const auto book = (folder() / ("book" + extra + ".xlsx")).string();
  const auto script = std::string(SIMSAND_SOURCE_DIR) + "/tests/unit/make_workbook.py";
  EXPECT_EQ(
      std::system(fmt::format("/usr/bin/python3 '{}' '{}' '{}' {}", script, table, book, extra).c_str()), 0);
  return book;
}

std::string workbook_error(const std::string& extra) {
  const auto book = workbook(extra);
  try {
    CsvTable table(book);
  } catch (const std::runtime_error& error) {
    const std::string text = error.what();
    EXPECT_TRUE(text.starts_with(book)) << text;
    return text.substr(std::min(text.size(), book.size()));
  }
  return "";
}

TEST(CsvTable, AWorkbookGivesTheSameNumbers) {
  CsvTable table(workbook());
  expect_the_test(table, {"eps1", "epsv", "q"});
  EXPECT_EQ(table.line(0), 3); // the row of the sheet
  TableFormat format;
  format.sheet = "data";
  CsvTable chosen(workbook("second"), format);
  expect_the_test(chosen, {"eps1", "epsv", "q"});
}

TEST(CsvTable, AWorkbookIsNotGuessed) {
  EXPECT_EQ(workbook_error("second"),
            ": expected one sheet that is not empty, found 2 (data, notes): choose one, key 'sheet'");
  EXPECT_EQ(workbook_error("percent"),
            ": cell A5 is shown as a percentage but stored as 0.8: give it the format of a plain number");
  EXPECT_EQ(workbook_error("formula"),
            ": cell A5 holds a formula without a stored value: open and save the file in "
            "the spreadsheet program");
  const auto broken = folder() / "broken.xlsx";
  std::ofstream(broken) << "PK\x03\x04 and no archive";
  EXPECT_THROW(CsvTable table(broken.string()), std::runtime_error);
  std::ofstream(broken) << "\xD0\xCF\x11\xE0 old";
  EXPECT_THROW(CsvTable table(broken.string()), std::runtime_error);
}

TEST(CsvTable, WhatAFileLeavesOpenIsRefused) {
  EXPECT_EQ(
      error_of("1,5\n2,6\n"),
      ":1: two layouts are possible: separated by commas with a decimal point (\"1 | 5\"), or separated by "
      "blanks with a decimal comma (\"1,5\"): set the keys separator and decimal");
  EXPECT_EQ(table_of("1,5\n2,6\n", "separator = 'blank'\ndecimal = 'comma'").numbers(std::size_t(0)),
            (std::vector<double>{1.5, 2.6}));
  EXPECT_EQ(error_of("a;b\n1,234;5,678\n2,345;6,789\n"),
            ":3: \"6,789\" may be a number with a decimal comma or one with its thousands parted: remove "
            "such commas "
            "from the file, or set decimal = \"comma\"");
  EXPECT_EQ(table_of("a;b\n1,234;5,678\n", "decimal = 'comma'").numbers("b"), std::vector<double>{5.678});
  EXPECT_EQ(table_of("a;b\n1,234;5,678\n2,345;6,7\n").numbers("b"), (std::vector<double>{5.678, 6.7}));
  EXPECT_EQ(
      error_of("a,b\n1,5,2,5\n3,5,4,5\n"),
      ":2: expected 2 cells, as many as line 1 has names, found 4: check separator and decimal, or state the "
      "line of the names (names_line; 0: there is none)");
  EXPECT_EQ(error_of("x,y\n1,2\n3,4\n\nStage 2\nx,y\n5,6\n7,8\n"),
            ":7: numbers again after other lines: choose the table by first_line and last_line");
  EXPECT_EQ(table_of("x,y\n1,2\n3,4\n\nStage 2\nx,y\n5,6\n7,8\n", "first_line = 7").numbers("y"),
            (std::vector<double>{6, 8}));
  EXPECT_EQ(error_of("a,b\n1,2\n3,4\n5,6\n\nc,d,e\n1,2,3\n3,4,5\n5,6,7\n6,7,8\n"),
            ":2: numbers in lines 2 to 4 and in lines 7 to 10: choose the table by first_line and last_line");
  EXPECT_THROW(table_of("a,a\n1,2\n").column("a"), std::runtime_error);
  EXPECT_EQ(table_of("a,a\n1,2\n").numbers(table_of("a,a\n1,2\n").column(2)), std::vector<double>{2});
}

TEST(CsvTable, NamesMayLookLikeUnits) {
  EXPECT_EQ(table_of("s\n10\n-20\n").numbers("s"), (std::vector<double>{10, -20}));
  EXPECT_EQ(table_of("s;h\n%;kPa\n1;2\n").heading(1).unit, "kPa");
}

TEST(CsvTable, ARowThatDoesNotFitIsNamed) {
  EXPECT_EQ(
      error_of("a,b,c\n1,2,3\n0.1,err,3\n4,5,6\n7,8,9\n"),
      ":3: expected a row of numbers or a line of names, found \"0.1,err,3\": state the line of the names "
      "(names_line; 0: there is none)");
  EXPECT_EQ(
      error_of("a,b\n1,2\n3,4,5\n6,7\n8,9\n"),
      ":3: expected 2 cells, as the lines below, or names, found \"3,4,5\": state the line of the names "
      "(names_line; 0: there is none)");
  EXPECT_EQ(error_of("a,b\n1,2\n3,4\n5\n6,7\n"),
            ":4: expected 2 cells, found 1 (last_line ends the table above)");
  EXPECT_EQ(error_of("a,b,c\n1,2,3\nPeak,5.5,\n"),
            ":3: column \"a\": expected a finite number, found \"Peak\" (last_line ends the table above)");
  EXPECT_EQ(table_of("a,b,c\n1,2,3\nPeak,5.5,\n", "last_line = 2").numbers("b"), std::vector<double>{2});
  EXPECT_EQ(
      error_of("a [%],b\n1,2\n,4\n"),
      ":3: column \"a [%]\": expected a finite number, found \"\" (missing = \"skip\" drops such rows)");
  EXPECT_EQ(error_of("a [%],b\n1,2\ninf,4\n"),
            ":3: column \"a [%]\": expected a finite number, found \"inf\"");
  EXPECT_EQ(error_of("a,b\n1,2\n3,\"4\n"),
            ":3: a cell in this line begins with a quote and never ends: delete the quote, or close it");
  EXPECT_EQ(error_of("a|b\n1|2\n3|4\n"),
            ":3: expected rows of numbers between tabs, semicolons, commas or blanks, found none");
  EXPECT_EQ(error_of(std::string("a,b\n1,2\n\0", 9)),
            ": expected text, found bytes that are zero: state the encoding of the file, key 'encoding'");
}

TEST(CsvTable, KeysWinOverTheFile) {
  const std::string text = "1,2,3\n4,5,6\n7,8,9\n";
  EXPECT_EQ(table_of(text, "names_line = 1").numbers("2"), (std::vector<double>{5, 8}));
  EXPECT_EQ(table_of("a,b,c\n%,kPa,1\n" + text, "names_line = 1\nfirst_line = 4").numbers("a"),
            (std::vector<double>{4, 7}));
  EXPECT_EQ(table_of("a;b\n1;2\n", "names_line = 1").numbers("a"), std::vector<double>{1});
  EXPECT_EQ(table_of("Sand 7\n# a b\n1 2\n", "names_line = 2").numbers("b"), std::vector<double>{2});
  EXPECT_EQ(table_of("a,b\n1,2\nx,4\n5,6\n", "names_line = 1").numbers("b"), (std::vector<double>{2, 4, 6}));
  EXPECT_EQ(error_of("a,b\n1,2\n", "encoding = 'nothing'"),
            ": expected an encoding that `iconv -l` lists, found \"nothing\"");
}

TEST(CsvTable, NotesAndWhatWasUnderstood) {
  const auto table = table_of("# void_ratio: 0.61\nTest 7\neps [%];q [kPa]\n1,5;+10\n2,5;-\n3,5;30\nEnd\n",
                              "missing = 'skip'");
  EXPECT_EQ(table.note("void_ratio"), 0.61);
  EXPECT_THROW(table.note("porosity"), std::runtime_error);
  auto used = table;
  used.drop_gaps({0, 1});
  const auto text = used.summary();
  EXPECT_EQ(text.substr(text.find(".csv") + 4),
            ": 2 rows, lines 4 to 6, separated by semicolons, decimal comma, UTF-8\n"
            "  columns: 1 \"eps\" [%], 2 \"q\" [kPa]\n"
            "  dropped: line 2 (above the table)\n"
            "  dropped: line 7 (below the table)\n"
            "  skipped: 1 rows with gaps (line 5)\n");
}

/// Random changes of bytes end in a table or in one line that names the file; none in a crash or an endless loop.
TEST(CsvTable, DamagedFilesAreReadOrRefused) {
  std::mt19937 random(7);
  const auto pick = [&](std::size_t n) { return std::size_t(random() % n); };
  const auto layouts = lab::text_layouts();
  const std::string likely = "\",;\t \n\r#.-eE0\xFF\xC2[%";
  int read = 0;
  for (int k = 0; k < 300; ++k) {
    auto layout = layouts[pick(layouts.size())];
    layout.name = "damaged";
    for (std::size_t n = 1 + pick(2); n > 0; --n) {
      const auto at = pick(layout.bytes.size());
      if (pick(3) == 0)
        layout.bytes.erase(at, 1 + pick(30));
      else
        layout.bytes[at] = likely[pick(likely.size())];
    }
    const auto file = lab::write(folder(), layout);
    try {
      CsvTable table(file, layout.format);
      EXPECT_GT(table.rows(), 0u);
      ++read;
    } catch (const std::runtime_error& error) {
      const std::string text = error.what();
      EXPECT_TRUE(text.starts_with(file) && text.find('\n') == text.npos && text.size() < 500) << text;
    }
  }
  EXPECT_GT(read, 30);
}

} // namespace
