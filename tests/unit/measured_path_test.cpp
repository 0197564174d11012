// SPDX-License-Identifier: BSD-3-Clause
// Tables of measurements: units, signs, bad rows by line, resampling.
#include "drivers/element/measured_path.hpp"
#include "drivers/files/csv_table.hpp"
#include <fstream>
#include <gtest/gtest.h>

using namespace drivers;

namespace {

std::string file_with(const std::string& text) {
  const auto name =
      testing::TempDir() + "/" + testing::UnitTest::GetInstance()->current_test_info()->name() + ".csv";
  std::ofstream(name) << text;
  return name;
}

MeasuredPath replay_of(const std::string& csv, const std::string& keys) {
  const auto document = parse_toml("file = '" + file_with(csv) + "'\n" + keys, "path.toml", "/");
  const auto replay = read_measured_path(document);
  document.finish();
  return replay;
}

/// The message without the folder of the table.
std::string error_of(const std::string& csv, const std::string& keys) {
  try {
    replay_of(csv, keys);
  } catch (const std::runtime_error& error) {
    const std::string text = error.what();
    return text.substr(text.starts_with('/') ? text.find_last_of('/', text.find(".csv")) + 1 : 0);
  }
  return "";
}

const std::string axial = "{column = 'e', quantity = 'axial_strain', unit = 'percent'}";
const std::string cell = "{column = 's', quantity = 'radial_stress', unit = 'kPa'}";
const std::string both = "columns = [" + axial + "," + cell + "]\n";

TEST(MeasuredPath, UnitsAndSignsAreDeclaredPerColumn) {
  const std::string csv = "# a comment\ne;s;other\n\n1;-10;x\n3;-20;y\n";
  const auto r = replay_of(csv, "compression = 'negative'\ncolumns = [" + cell +
                                    ", {column = 'e', quantity = 'axial_strain', unit = 'percent', "
                                    "compression = 'positive'}]");
  ASSERT_EQ(r.rows.size(), 2u);
  EXPECT_EQ(r.rows[0].line, 4);
  EXPECT_DOUBLE_EQ(r.rows[0].targets[0], 10e3);
  EXPECT_DOUBLE_EQ(r.rows[1].targets[0], 20e3);
  EXPECT_DOUBLE_EQ(r.rows[0].targets[1], 0); // from the first row
  EXPECT_DOUBLE_EQ(r.rows[1].targets[1], 0.02);
  EXPECT_DOUBLE_EQ(replay_of(csv, both + "zero_strain = 'file'").rows[0].targets[0], 0.01);
}

TEST(MeasuredPath, BadRowsAreNamedByLine) {
  EXPECT_EQ(error_of("e,s\n1,2\n2,nan\n", both),
            "BadRowsAreNamedByLine.csv:3: column \"s\": expected a finite number, found \"nan\" "
            "(missing = \"skip\" drops such rows)");
  EXPECT_EQ(error_of("e,s\n1,2\n2,\n", both),
            "BadRowsAreNamedByLine.csv:3: column \"s\": expected a finite number, found \"\" "
            "(missing = \"skip\" drops such rows)");
  EXPECT_EQ(error_of("e,s\n1,2\n2,3 kPa\n", both),
            "BadRowsAreNamedByLine.csv:3: column \"s\": expected a finite number, found \"3 kPa\" "
            "(last_line ends the table above)");
  EXPECT_EQ(error_of("e,s\n#\n1,2,3\n", both),
            "BadRowsAreNamedByLine.csv:3: expected 2 cells, as many as line 1 has names, found 3: check "
            "separator and "
            "decimal, or state the line of the names (names_line; 0: there is none)");
  EXPECT_EQ(error_of("e,s\n", both), "BadRowsAreNamedByLine.csv:1: expected rows of numbers between tabs, "
                                     "semicolons, commas or blanks, found none");
  EXPECT_EQ(error_of("e,p\n1,2\n", both), "BadRowsAreNamedByLine.csv: expected a column \"s\", found e, p");
  EXPECT_EQ(error_of("e,s\n1,2\n500,3\n", both), "BadRowsAreNamedByLine.csv:3: axial_strain: expected a "
                                                 "strain of at most 3, found 5: is its unit right?");
  EXPECT_EQ(error_of("e,s\n1,2\n2,3\n2,3\n",
                     "columns = [" + axial + ", {column = 's', quantity = 'time', unit = 'min'}]")
                .substr(0, 65),
            "BadRowsAreNamedByLine.csv:4: expected a time after 180 s, found 1");
}

TEST(MeasuredPath, KeysAreChecked) {
  EXPECT_NE(error_of("e,s\n1,2\n", "columns = [{column = 'e', quantity = 'axial_strain', unit = 'kPa'}]")
                .find("key 'columns.unit': expected one of \"1\", \"percent\", \"permille\", found \"kPa\""),
            std::string::npos);
  EXPECT_NE(
      error_of("e,s\n1,2\n", "columns = [{column = 'e', quantity = 'axial_strain'}]").find("columns.unit"),
      std::string::npos);
  EXPECT_NE(error_of("e,s\n1,2\n", "columns = [{column = 'e', quantity = 'time', unit = 's'}]")
                .find("expected a column that drives the stage, found none"),
            std::string::npos);
  EXPECT_NE(error_of("e,s\n1,2\n", both + "points = 5").find("a file of two rows or more"),
            std::string::npos);
}

TEST(MeasuredPath, SubstepsByNumberOrByStrain) {
  const auto r = replay_of("e,s\n0,10\n1,10\n", both + "substeps = 4\nstrain_increment = 1e-3");
  EXPECT_EQ(r.increments({0, 0}, {0.01, 0}), 10);
  EXPECT_EQ(r.increments({0, 0}, {0.001, 5e3}), 4);
}

TEST(MeasuredPath, ResamplingDividesThePathEqually) {
  // An L of two legs, each the range of its column.
  const auto r = replay_of("e s t\n0 10 0\n1 10 1\n2 10 2\n2 11 3\n2 14 4\n",
                           "columns = [" + axial + "," + cell +
                               ", {column = 't', quantity = 'time', unit = 's'}]\npoints = 5");
  ASSERT_EQ(r.rows.size(), 5u);
  EXPECT_NEAR(r.rows[1].targets[0], 0.01, 1e-15);
  EXPECT_NEAR(r.rows[2].targets[0], 0.02, 1e-15);
  EXPECT_NEAR(r.rows[2].targets[1], 10e3, 1e-9);
  EXPECT_NEAR(r.rows[3].targets[1], 12e3, 1e-9);
  EXPECT_NEAR(r.rows[3].time, 3 + 1. / 3, 1e-12);
  EXPECT_NEAR(r.rows[4].targets[1], 14e3, 1e-9);
}

} // namespace
