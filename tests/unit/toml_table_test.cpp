// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/files/toml_table.hpp"
#include <cmath>
#include <functional>
#include <gtest/gtest.h>

using namespace drivers;

namespace {

TomlTable scene(const std::string& text) {
  return parse_toml(text, "scene.toml", "/data/scenes");
}

/// The error line of a reading, empty if there was none.
template <class Action> std::string error_of(Action action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

std::string error_in(const std::string& text, const std::function<void(const TomlTable&)>& read) {
  return error_of([&] { read(scene(text)); });
}

TEST(Toml, NumbersMayBeIntegersOrFloats) {
  const auto t = scene("a = 3\nb = 2.5e-3\n");
  EXPECT_EQ(t.number("a"), 3.0);
  EXPECT_EQ(t.number("b", {0, 1}), 2.5e-3);
  EXPECT_EQ(t.number("c", {0, 1}, 0.5), 0.5);
}

TEST(Toml, ErrorsNameFileLineKeyExpectedAndFound) {
  const std::string text = "[column]\nheight = -1.0\nname = 'x'\n";
  const auto column = [](auto read) { return [read](const TomlTable& t) { read(t.table("column")); }; };
  EXPECT_EQ(error_in(text, column([](const TomlTable& c) { c.number("height", positive); })),
            "scene.toml:2: key 'column.height': expected a number above 0, found -1");
  EXPECT_EQ(error_in(text, column([](const TomlTable& c) {
                       c.number("name", {0, 2});
                     })),
            "scene.toml:3: key 'column.name': expected a number from 0 to 2, found \"x\"");
  EXPECT_EQ(error_in(text, column([](const TomlTable& c) {
                       c.text("name", {"y", "z"});
                     })),
            "scene.toml:3: key 'column.name': expected one of \"y\", \"z\", found \"x\"");
  EXPECT_EQ(
      error_in(text, column([](const TomlTable& c) { c.number("width"); })),
      "scene.toml:1: key 'column.width': expected a number, found no such key in table 'column' of line 1");
  EXPECT_EQ(error_in(text, [](const TomlTable& t) { t.table("wall"); }),
            "scene.toml:1: key 'wall': expected a table, found no such table");
}

TEST(Toml, RefusesUndefinedInfiniteAndFractional) {
  EXPECT_EQ(error_in("a = nan", [](const TomlTable& t) { t.number("a"); }),
            "scene.toml:1: key 'a': expected a number, found nan");
  EXPECT_NE(error_in("a = inf", [](const TomlTable& t) { t.number("a"); }), "");
  EXPECT_EQ(error_in("a = 1.0",
                     [](const TomlTable& t) {
                       t.integer("a", {1, 9});
                     }),
            "scene.toml:1: key 'a': expected an integer from 1 to 9, found 1");
  EXPECT_NE(error_in("a = 1", [](const TomlTable& t) { t.flag("a"); }), "");
}

TEST(Toml, UnknownKeysAreReportedAtEveryLevelWithTheNearestKnownOne) {
  const auto read = [](const TomlTable& t) {
    t.number("gravity", {}, 9.81);
    t.table_or_empty("column").number("height", {}, 1);
    for (const auto& s : t.tables("stage")) s.number("axial", {}, 0.1);
    t.finish();
  };
  EXPECT_EQ(error_in("gravity = 1", read), "");
  EXPECT_EQ(error_in("gravty = 1", read),
            "scene.toml:1: key 'gravty': expected a known key such as 'gravity', found an unknown one");
  EXPECT_EQ(error_in("[column]\nhieght = 1", read),
            "scene.toml:2: key 'column.hieght': expected a known key such as 'height', found an unknown one");
  EXPECT_EQ(error_in("[[stage]]\n[[stage]]\nanything = 1", read),
            "scene.toml:3: key 'stage.anything': expected a known key, found an unknown one");
  EXPECT_EQ(error_in("[collumn]", read),
            "scene.toml:1: key 'collumn': expected a known key such as 'column', found an unknown one");
}

TEST(Toml, DuplicatesAndSyntaxErrorsAreOneLine) {
  const auto none = [](const TomlTable&) {};
  EXPECT_EQ(error_in("a = 1\n\na = 2\n", none),
            "scene.toml:3: key 'a': expected one definition, found a second");
  EXPECT_EQ(error_in("[x]\n[y]\n[x]\n", none),
            "scene.toml:3: table 'x': expected one definition, found a second");
  const auto syntax = error_in("a = 1\nb = \n", none);
  EXPECT_EQ(syntax.rfind("scene.toml:2: expected valid TOML, found ", 0), 0u);
  EXPECT_EQ(syntax.find('\n'), syntax.npos);
}

TEST(Toml, NumberOrWord) {
  const auto friction = [](const TomlTable& t) {
    return t.number_or_word("friction", {0, 2}, {"no-slip"}, 0.3);
  };
  EXPECT_EQ(std::get<double>(friction(scene("friction = 0.5"))), 0.5);
  EXPECT_EQ(std::get<std::string>(friction(scene("friction = \"no-slip\""))), "no-slip");
  EXPECT_EQ(std::get<double>(friction(scene(""))), 0.3);
  EXPECT_EQ(error_in("friction = 'slip'", [&](const TomlTable& t) { friction(t); }),
            "scene.toml:1: key 'friction': expected a number from 0 to 2 or \"no-slip\", found \"slip\"");
}

TEST(Toml, ArraysCheckLengthAndElements) {
  const auto t = scene("v = [1, 2.5]\nw = ['p', 'q']\n");
  EXPECT_EQ(t.numbers("v", 2), (std::vector<double>{1, 2.5}));
  EXPECT_EQ(t.texts("w"), (Words{"p", "q"}));
  EXPECT_EQ(error_of([&] { t.numbers("v", 3); }),
            "scene.toml:1: key 'v': expected an array of 3 numbers, found an array of 2");
  EXPECT_EQ(error_of([&] {
              t.numbers("v", 2, {0, 2});
            }),
            "scene.toml:1: key 'v': expected an array of 2 numbers, each from 0 to 2, found element 2: 2.5");
  EXPECT_NE(error_of([&] { t.texts("w", {"p"}); }), "");
  EXPECT_EQ(error_of([&] { t.tables("stage", 1); }),
            "scene.toml:1: key 'stage': expected tables [[stage]], found no such key");
}

TEST(Toml, PathsStartAtTheFolderOfTheDocument) {
  EXPECT_EQ(scene("file = '../materials/TS.toml'").path("file"), "/data/materials/TS.toml");
  EXPECT_EQ(scene("file = '/a/b'").path("file"), "/a/b");
}

/// Reads everything the way a program would; returns the numbers.
std::vector<double> read_all(const TomlTable& t) {
  std::vector<double> out{t.number("third"), double(t.integer("count", {}, 7)), double(t.flag("on", true))};
  t.text("title", {}, "a \"quoted\"\ttitle \\ of two\nlines");
  t.path("file");
  t.number_or_word("friction", {}, {"no-slip"}, NumberOrWord("no-slip"));
  const auto sub = t.table("a b").table_or_empty("deep");
  for (double v : sub.numbers("v", 0, {}, std::vector<double>{1e-300, -0.0, 5e22, 0.1})) out.push_back(v);
  for (const auto& s : t.tables("stage", 1)) {
    out.push_back(s.number("x", {}, std::nextafter(1.0, 2.0)));
    out.push_back(s.table_or_empty("stop").number("p", {}, 1.0));
  }
  t.finish();
  return out;
}

TEST(Toml, TheResolvedDocumentReadsIdentically) {
  const auto first = scene("third = 0.3333333333333333\nfile = 'x'\n['a b']\n"
                           "[[stage]]\nx = 3\n[[stage]]\nstop = {p = 100}\n");
  const auto numbers = read_all(first);
  const auto again = parse_toml(first.resolved(), "resolved.toml", "/elsewhere");
  EXPECT_EQ(read_all(again), numbers);
  EXPECT_EQ(again.resolved(), first.resolved());
  EXPECT_EQ(again.path("file"), "/data/scenes/x");
}

TEST(TomlSettings, ReplaceAndAddValuesAndNameThemselvesInErrors) {
  const auto root = parse_toml("[scene]\nspacing = 1.0\n", "file", ".",
                               {"scene.spacing=2.5", "floor.friction=no-slip", "scene.gravity=x"});
  EXPECT_EQ(root.table("scene").number("spacing"), 2.5);
  EXPECT_EQ(root.table("floor").text("friction"), "no-slip");
  try {
    root.table("scene").number("gravity");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()),
              "file (as set by the command): key 'scene.gravity': expected a number, found \"x\"");
  }
  EXPECT_THROW(parse_toml("", "file", ".", {"no value"}), std::runtime_error);
  EXPECT_THROW(parse_toml("", "file", ".", {"=1"}), std::runtime_error);
}

TEST(Toml, AFileThatCannotBeReadIsNamed) {
  EXPECT_EQ(error_of([] { read_toml("/no/such.toml"); }),
            "/no/such.toml: expected a readable TOML file with content, found none");
  EXPECT_NE(error_of([] { read_toml("/tmp"); }), "");
}

} // namespace
