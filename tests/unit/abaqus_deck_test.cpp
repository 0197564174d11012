// SPDX-License-Identifier: BSD-3-Clause
// Decks of `simsand abaqus`, read back by a checker that knows nothing of their writer.
#include "tests/unit/abaqus_fixture.hpp"
#include <cstdlib>
#include <sstream>

namespace {

using namespace abaqus;

TEST(AbaqusDeck, IsInOrderForEveryKindOfScene) {
  const std::vector<Case> cases{
      {},
      {.spacing = 0.007, .height = 0.2},
      {.motion = "fixed"},
      {.motion = "remove"},
      {.friction = "\"no-slip\""},
      {.friction = "0.0"},
      {.spacing = 0.05},
      {.speed = 0.03},
      {.spacing = 0.005, .radius = 0.02, .height = 0.3},
      {.geometry = "plane_strain"},
      {.geometry = "plane_strain", .motion = "remove"},
      {.geometry = "plane_strain", .motion = "fixed", .friction = "\"no-slip\"", .height = 0.1},
      {.geometry = "three_dimensional\"\nsector = \"full"},
      {.geometry = "three_dimensional\"\nsector = \"half", .motion = "remove"},
      {.geometry = "three_dimensional\"\nsector = \"quarter", .spacing = 0.007, .height = 0.1},
  };
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto deck = written(cases[i], fmt::format("kind_{}", i));
    EXPECT_EQ(deck::described(deck::check(deck.text, deck.expected)), "") << "case " << i;
  }
}

TEST(AbaqusDeck, IsInOrderForTheDefaultSceneAtItsOwnSpacing) {
  const auto scene = drivers::read_scene(std::string(SIMSAND_SOURCE_DIR) + "/data/scenes/default.toml");
  const auto model = drivers::make_abaqus_model(scene, scene.spacing);
  EXPECT_EQ(model.particles.size(), 49400u);
  const auto found = deck::check(drivers::abaqus_deck(scene, model), expected({}, scene));
  EXPECT_EQ(deck::described(found), "");
}

TEST(AbaqusDeck, ManyStateVariablesTakeSeveralLines) {
  const auto path = folder("other_material") / "scene.toml";
  const Case c;
  std::string states;
  for (int i = 1; i <= 16; ++i) states += fmt::format("{}{}.5", i > 1 ? ", " : "", i);
  std::ofstream(path) << scene_text(
      c, fmt::format(
             "name = \"clay-1\"\nlibrary = \"{}/libsimsand_vumat.so\"\nproperties = [1.0, 2.0, 3.0]\n"
             "state_variables = 16\ninitial_state = [{}]\ndensity = 1600.0\n[initial_stress]\nK0 = 0.5\n",
             SIMSAND_BINARY_DIR, states));
  const auto scene = drivers::read_scene(path.string());
  auto wanted = expected(c, scene);
  wanted.density = 1600;
  wanted.pressure_ratio = 0.5;
  wanted.first_state = 1.5;
  const auto text = drivers::abaqus_deck(scene, drivers::make_abaqus_model(scene, scene.spacing));
  EXPECT_EQ(deck::described(deck::check(text, wanted)), "");
  EXPECT_NE(
      text.find(
          "LAYER_1, 1.5, 2.5, 3.5, 4.5, 5.5, 6.5, 7.5\n8.5, 9.5, 10.5, 11.5, 12.5, 13.5, 14.5, 15.5\n16.5\n"),
      text.npos);
  EXPECT_NE(text.find("*MATERIAL, NAME=CLAY-1\n"), text.npos);
}

TEST(AbaqusDeck, ParticlesTogetherAreTheColumnExactly) {
  for (const double spacing : {0.01, 0.004, 0.0031}) {
    const auto scene = drivers::read_scene(scene_file({.spacing = spacing}, "volume").string());
    const auto model = drivers::make_abaqus_model(scene, spacing);
    EXPECT_NEAR(double(model.particles.size()) * std::pow(model.edge, 3) /
                    (std::numbers::pi * 0.05 * 0.05 * 0.05),
                1, 1e-12);
    EXPECT_NEAR(model.edge / model.pitch, 1, 0.03) << "the lattice's disc is nearly the column's";
    EXPECT_NEAR(drivers::abaqus_particle_count(scene, spacing) / double(model.particles.size()), 1, 0.1);
  }
}

/// SIMSAND's hardening variable starts under the stress of its layer, as in the product's own host.
TEST(AbaqusDeck, StartsFromTheStateThatTheMaterialFinds) {
  const auto scene = drivers::read_scene(scene_file({}, "state").string());
  for (const auto& layer : drivers::make_abaqus_model(scene, scene.spacing).layers) {
    EXPECT_EQ(layer.state[0], 0.4451);
    EXPECT_GT(layer.state[1], 1e-5);
    EXPECT_LT(layer.state[1], 1e-2);
    EXPECT_EQ(layer.state[2], 0);
  }
}

TEST(AbaqusDeck, RefusesWhatAbaqusWouldRefuse) {
  auto scene = drivers::read_scene(scene_file({}, "refused").string());
  const auto error_of = [](auto action) -> std::string {
    try {
      action();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  const auto model = drivers::make_abaqus_model(scene, scene.spacing);
  for (const auto* name : {"my sand", "sand.1", "1-sand", "-sand", ""}) {
    scene.material.name = name;
    const auto error = error_of([&] { drivers::abaqus_deck(scene, model); });
    EXPECT_NE(error.find(fmt::format("'{}': ABAQUS takes a letter", name)), std::string::npos) << error;
  }
  EXPECT_EQ(error_of([&] { drivers::make_abaqus_model(scene, 1); }),
            "scene without particles: a column of 0.05 m x 0.05 m holds none at a spacing of 1 m");
  EXPECT_EQ(error_of([&] {
              drivers::write_abaqus(scene, {"x", 0.001});
            }),
            "--spacing 0.001: expected the scene's 0.01 m or coarser");
  scene.spacing = 1e-5;
  EXPECT_NE(error_of([&] {
              drivers::write_abaqus(scene, {"x", {}});
            }).find("coarser --spacing"),
            std::string::npos);
}

/// The program itself: deck and page in the folder, the deck in order; errors in one line.
TEST(AbaqusDeck, TheCommandWritesDeckAndPage) {
  const Case c{.spacing = 0.005};
  const auto scene = scene_file(c, "command");
  const auto out = scene.parent_path() / "deck";
  const auto run = [&](const std::string& arguments) {
    return std::system(fmt::format("'{}/simsand' abaqus {} > '{}/log' 2>&1", SIMSAND_BINARY_DIR, arguments,
                                   scene.parent_path().string())
                           .c_str());
  };
  const auto content = [](const fs::path& path) {
    std::stringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
  };
  ASSERT_EQ(run(fmt::format("'{}' -o '{}' --spacing 0.008", scene.string(), out.string())), 0);
  const auto found =
      deck::check(content(out / "column.inp"), expected(c, drivers::read_scene(scene.string())));
  EXPECT_EQ(deck::described(found), "");
  const auto page = content(out / "README.md");
  EXPECT_NE(page.find("abaqus job=column user=simsand_vumat.cpp double=both"), page.npos);
  const bool has_source = fs::exists(fs::path(SIMSAND_BINARY_DIR) / "simsand_vumat.cpp");
  EXPECT_EQ(fs::exists(out / "simsand_vumat.cpp"), has_source);
  EXPECT_EQ(page.find("is missing here") == page.npos, has_source);

  EXPECT_NE(run(fmt::format("'{}' -o /proc/no/folder", scene.string())), 0);
  const auto error = content(scene.parent_path() / "log");
  EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 1) << error;
}

} // namespace
