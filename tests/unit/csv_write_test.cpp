// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/files/csv_table.hpp"
#include "drivers/files/csv_write.hpp"
#include <array>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>
#include <system_error>

using drivers::CsvWriter;
using drivers::Rounded;

TEST(CsvWrite, CommentsHeaderAndRowsOfEveryKindOfCell) {
  CsvWriter table("name,count,flag,value,a,b", {"tolerance: 0.05", "second"});
  table.row("ss_dense", 3L, true, Rounded{1.0 / 3, 4}, std::array{Rounded{-0.0}, Rounded{1e-9, 2}});
  EXPECT_EQ(table.text(),
            "# tolerance: 0.05\n# second\nname,count,flag,value,a,b\nss_dense,3,1,0.3333,0,1e-09\n");
}

TEST(CsvWrite, NumbersThatAreNotFiniteAreEmptyCells) {
  CsvWriter table("a,b,c");
  table.row(Rounded{std::nan("")}, Rounded{-std::numeric_limits<double>::infinity()}, Rounded{2});
  EXPECT_EQ(table.text(), "a,b,c\n,,2\n");
}

TEST(CsvWrite, TextsThatHoldSeparatorsStandInQuotes) {
  CsvWriter table("a,b,c");
  table.row("cutting plane, 1 step", "5\" pipe", "plain");
  EXPECT_EQ(table.text(), "a,b,c\n\"cutting plane, 1 step\",\"5\"\" pipe\",plain\n");
}

TEST(CsvWrite, ARowOfTooFewOrTooManyCellsIsRefused) {
  CsvWriter few("a,b"), many("a,b");
  EXPECT_THROW(few.row(1), std::logic_error);
  EXPECT_THROW(many.row(1, 2, 3), std::logic_error);
}

TEST(CsvWrite, TakenPiecesMakeTheWholeTable) {
  CsvWriter whole("a,b"), pieces("a,b");
  std::string text = pieces.take();
  for (int i = 0; i < 3; ++i) {
    whole.row(i, Rounded{0.1 * i});
    pieces.row(i, Rounded{0.1 * i});
    text += pieces.take();
  }
  EXPECT_EQ(text, whole.text());
}

TEST(CsvWrite, WhatIsWrittenReadsBackToTheSameBits) {
  const auto file = std::filesystem::temp_directory_path() / "simsand_csv_write.csv";
  CsvWriter table("angle_deg,stress_Pa", {"height: 0.25"});
  const double angle = 0.1 + 0.2, stress = -1.0 / 3e5;
  table.row(Rounded{angle, 17}, Rounded{stress, 17});
  table.write(file);
  const drivers::CsvTable read(file.string());
  EXPECT_EQ(read.numbers("angle_deg").at(0), angle);
  EXPECT_EQ(read.numbers("stress_Pa").at(0), stress);
  EXPECT_EQ(read.note("height"), 0.25);
  std::filesystem::remove(file);
  EXPECT_THROW(table.write("/nowhere/table.csv"), std::system_error);
}
