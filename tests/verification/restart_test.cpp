// SPDX-License-Identifier: BSD-3-Clause
// Runs that are stopped go on to the last bit as if nothing had been. And what the program says when it cannot.
#include "host/files/seal.hpp"
#include "tests/verification/restart_fixture.hpp"

namespace {

namespace fs = std::filesystem;
using tests::content_of, tests::expect_same, tests::interrupt, tests::Program, tests::scene, tests::whole;

TEST(Restart, AfterASignalOnOneAndTwoThreadsEveryBitIsTheSame) {
  const Program program("restart_signal");
  interrupt(program, SIGTERM);
  EXPECT_NE(program.content("err").find("to go on: simsand run --resume cut\n"), std::string::npos);
  fs::copy(program.folder / "cut", program.folder / "two", fs::copy_options::recursive);
  EXPECT_NO_THROW(content_of(program.folder / "cut/result.h5")) << "readable before it is complete";
  EXPECT_NE(program.run("info cut/checkpoint.h5").out.find("checkpoint of a run that is not complete"),
            std::string::npos);
  EXPECT_NE(program.run("info cut/result.h5").out.find("not complete; a checkpoint of 0."),
            std::string::npos);
  EXPECT_EQ(program.run("run -q -t 1 --resume cut").status, 0);
  EXPECT_EQ(program.run("run -q -t 2 --resume two/checkpoint.h5").status, 0) << program.content("err");
  for (const auto* folder : {"cut", "two"}) {
    expect_same(program.folder / folder / "result.h5", whole());
    EXPECT_FALSE(fs::exists(program.folder / folder / "checkpoint.h5"));
    EXPECT_FALSE(fs::exists(program.folder / folder / "result.parts"));
  }
  EXPECT_EQ(program.content("cut/result.xdmf"), program.content("two/result.xdmf"));
  const auto again = program.run("run -q --resume cut");
  EXPECT_EQ(again.status, 0);
  EXPECT_EQ(again.out, "cut: the run is complete\n");
}

/// The same column on a rough plane, in a tube that lifts, with a block that comes down.
std::string scene_with_walls() {
  auto text = scene();
  const auto from = text.find("[floor]"), to = text.find("[end]");
  return text.replace(from, to - from, R"([[wall]]
name = "ground"
shape = "plane"
point = [0, 0]
normal = [0, 1]
friction = "no-slip"
[[wall]]
name = "tube"
shape = "cylinder"
side = "inside"
radius = 0.05
lower = 0
friction = 0.2
velocity = [0, 0.8]
[[wall]]
name = "ring"
shape = "box"
side = "outside"
lower = [0.075, 0.03]
upper = [0.1, 0.06]
friction = 0.4
times = [0, 0.05, 0.1]
velocity_z = [0, -0.2, 0]
)");
}

TEST(Restart, AmongMovingWallsEveryBitIsTheSame) {
  const Program program("restart_walls");
  program.write("scene.toml", scene_with_walls());
  ASSERT_EQ(program.run("run -q -t 1 scene.toml").status, 0) << program.content("err");
  const auto wanted = content_of(program.folder / "whole/result.h5");
  EXPECT_TRUE(wanted.contains("/series/wall_ring_force_z"));
  interrupt(program, SIGTERM, "-q -t 2", scene_with_walls());
  fs::copy(program.folder / "cut", program.folder / "two", fs::copy_options::recursive);
  EXPECT_EQ(program.run("run -q -t 1 --resume cut").status, 0) << program.content("err");
  EXPECT_EQ(program.run("run -q -t 2 --resume two").status, 0) << program.content("err");
  for (const auto* folder : {"cut", "two"}) expect_same(program.folder / folder / "result.h5", wanted);
  EXPECT_NE(program.run("info two/result.h5").out.find("wall ring"), std::string::npos);
}

/// Alters a file that ends with a checksum, and renews the checksum.
template <class F> void alter_sealed(const fs::path& path, F&& alter) {
  constexpr int seal_size = 16;
  fs::resize_file(path, fs::file_size(path) - seal_size);
  {
    H5::H5File file(path.string(), H5F_ACC_RDWR);
    alter(file);
  }
  host::append_seal(path);
}

TEST(Restart, RefusesWhatItCannotGoOnWith) {
  const Program program("restart_refused");
  interrupt(program, SIGKILL);
  const auto refuses = [&](const std::string& arguments, const std::string& part) {
    const auto outcome = program.run("run -q --resume " + arguments);
    EXPECT_EQ(outcome.status, 1) << arguments;
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  };
  auto changed = scene();
  changed.replace(changed.find("friction = 0.5"), 14, "friction = 0.4");
  program.write("changed.toml", changed);
  refuses("changed.toml -o cut", "simsand: changed.toml: key 'floor.friction': expected 0.5 as in the "
                                 "checkpoint, found 0.4; a run goes on only with the scene it began with");
  refuses("nowhere", "nowhere: no such file or folder");
  fs::create_directories(program.folder / "empty");
  refuses("empty", "empty: no checkpoint to resume from");

  const auto copy = [&](const std::string& name) {
    fs::remove_all(program.folder / name);
    fs::copy(program.folder / "cut", program.folder / name, fs::copy_options::recursive);
    return program.folder / name;
  };
  const auto old = copy("old");
  for (const auto* name : {"checkpoint.h5", "checkpoint_previous.h5"})
    alter_sealed(old / name, [](H5::H5File& file) {
      const int layout = 2;
      file.openAttribute("checkpoint_version").write(H5::PredType::NATIVE_INT, &layout);
    });
  refuses("old", "a checkpoint of layout 2, this program reads 6");
  EXPECT_TRUE(fs::exists(old / "checkpoint.h5")) << "for the program that wrote it";
  program.write("cut/scene.toml", changed);
  refuses("cut", "cut/scene.toml: key 'floor.friction'");
  fs::remove(program.folder / "cut/scene.toml");
  alter_sealed(copy("version") / "checkpoint.h5", [](H5::H5File& file) {
    file.removeAttr("simsand_version");
    const H5::StrType text(H5::PredType::C_S1, 5);
    file.createAttribute("simsand_version", text, H5::DataSpace(H5S_SCALAR))
        .write(text, std::string("0.0.1"));
  });
  refuses("version", "checkpoint.h5: written by simsand 0.0.1, this is ");
  refuses("scene.toml -o cut --set floor.friction=0.4",
          "key 'floor.friction': expected 0.5 as in the checkpoint");
  refuses("cut --set floor.friction=0.5",
          "--set floor.friction=0.5: expected a scene file beside it, found cut");
  EXPECT_EQ(program.run("run -q -t 1 --resume changed.toml -o cut --set floor.friction=0.5").status, 0)
      << "the scene that it began with";
  expect_same(program.folder / "cut/result.h5", whole());
}

double number_in(const fs::path& file, const std::string& name) {
  double value = 0;
  H5::H5File(file.string(), H5F_ACC_RDONLY).openDataSet(name).read(&value, H5::PredType::NATIVE_DOUBLE);
  return value;
}

TEST(Restart, TheTimeOfProcessorsIsThatOfAllParts) {
  const Program program("restart_processor");
  interrupt(program, SIGTERM);
  const double before = number_in(program.folder / "cut/checkpoint.h5", "run/processor_seconds");
  EXPECT_GT(before, 0);
  ASSERT_EQ(program.run("run -q -t 1 --resume cut").status, 0);
  const auto result = program.folder / "cut/result.h5";
  const double all = number_in(result, "summary/time_processor");
  EXPECT_GT(all, before);
  EXPECT_LT(all, number_in(result, "summary/wall_clock") + 0.1) << "one thread";
}

/// The column as a quarter in three dimensions.
std::string quarter_scene() {
  auto text = scene();
  const auto put = [&](const std::string& old, const std::string& now) {
    text.replace(text.find(old), old.size(), now);
  };
  put("\"axisymmetric\"\nspacing = 0.004", "\"three_dimensional\"\nsector = \"quarter\"\nspacing = 0.00625");
  put("time = 0.4", "time = 0.1");
  return text;
}

/// The column of an elastic material whose stress is turned by the rotation from the polar decomposition.
std::string green_naghdi_scene() {
  auto text = scene();
  const auto from = text.find("file ="), to = text.find("[floor]");
  text.replace(
      from, to - from,
      fmt::format("library = \"{}/test_vumats/libelastic.so\"\nname = \"elastic\"\nproperties = [1e5, "
                  "0.3]\nstate_variables = 1\ndensity = 1500.0\nkinematics = \"green-naghdi\"\n"
                  "[initial_stress]\nK0 = 0.5\n",
                  SIMSAND_BINARY_DIR));
  text.replace(text.find("time = 0.4"), 10, "time = 0.4\nkinetic_energy_fraction = 0");
  return text;
}

using NamedScene = std::pair<std::string, std::string (*)()>;
class OtherRuns : public testing::TestWithParam<NamedScene> {};

TEST_P(OtherRuns, GoOnBitForBit) {
  const auto [name, text] = GetParam();
  const Program program("restart_" + name);
  program.write("scene.toml", text());
  ASSERT_EQ(program.run("run -q -t 1 scene.toml").status, 0) << program.content("err");
  interrupt(program, SIGTERM, "-q -t 2", text());
  ASSERT_EQ(program.run("run -q -t 1 --resume cut").status, 0) << program.content("err");
  expect_same(program.folder / "cut/result.h5", content_of(program.folder / "whole/result.h5"));
}

INSTANTIATE_TEST_SUITE_P(Restart, OtherRuns,
                         testing::Values(NamedScene{"quarter", quarter_scene},
                                         NamedScene{"green_naghdi", green_naghdi_scene}));

TEST(Restart, WarnsOfAnotherMaterialLibrary) {
  const Program program("restart_library");
  fs::copy_file(std::string(SIMSAND_BINARY_DIR) + "/test_vumats/libelastic.so",
                program.folder / "material.so", fs::copy_options::overwrite_existing);
  auto elastic = scene();
  const auto from = elastic.find("file ="), to = elastic.find("[floor]");
  elastic.replace(from, to - from,
                  "library = \"material.so\"\nname = \"elastic\"\nproperties = [1e5, 0.3]\n"
                  "state_variables = 1\ndensity = 1500.0\n[initial_stress]\nK0 = 0.5\n");
  elastic.replace(elastic.find("time = 0.4"), 10,
                  "time = 1e9\nkinetic_energy_fraction = 0"); // never at rest
  program.write("scene.toml", elastic);
  fs::remove_all(program.folder / "whole");
  const auto child = program.start("run -q -t 1 scene.toml");
  for (int wait = 0; wait < 2000 && !fs::exists(program.folder / "whole/checkpoint.h5"); ++wait) usleep(5000);
  const auto second = program.run("run -q scene.toml");
  EXPECT_EQ(second.err, "simsand: whole/result.h5: another run is writing this file\n");
  kill(child, SIGKILL);
  tests::wait_for(child);
  std::ofstream(program.folder / "material.so", std::ios::app) << "another build";
  const auto again = program.start("run -q -t 1 --resume whole");
  sleep(1);
  kill(again, SIGINT);
  EXPECT_EQ(tests::wait_for(again), 128 + SIGINT);
  EXPECT_NE(program.content("err").find("material.so: the material library has changed since"),
            std::string::npos)
      << program.content("err");
}

} // namespace
