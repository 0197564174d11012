// SPDX-License-Identifier: BSD-3-Clause
// Runs that are stopped, killed, or out of disk, and go on: to the last bit as if nothing had been. And
// what the program says when it cannot.
#include "tests/verification/program.hpp"
#include <H5Cpp.h>
#include <cmath>
#include <csignal>
#include <map>
#include <random>

namespace {

namespace fs = std::filesystem;
using tests::Outcome, tests::Program;
using Values = std::map<std::string, std::vector<double>>;

/// A column of 169 particles, some 5000 steps, that writes often.
std::string scene() {
  return fmt::format(R"([scene]
geometry = "axisymmetric"
spacing = 0.004
[column]
radius = 0.05
height = 0.05
[material]
file = "{}/data/materials/TS.toml"
void_ratio = 0.4451
[floor]
friction = 0.5
[gate]
motion = "remove"
[end]
time = 0.4
[output]
folder = "whole"
sample_interval = 0.001
snapshot_interval = 0.02
checkpoint_interval = 0.02
grain_diameter = 0.003
)",
                     SIMSAND_SOURCE_DIR);
}

/// What depends on the machine and not on the sand.
bool is_timing(const std::string& name) {
  return name == "wall_clock" || name == "rate" || name == "threads" || name.starts_with("time_");
}

/// Every number below `group`, the times of snapshots included, by path.
void collect(const H5::Group& group, const std::string& at, Values& values) {
  if (group.attrExists("time")) {
    double time = 0;
    group.openAttribute("time").read(H5::PredType::NATIVE_DOUBLE, &time);
    values[at + "/@time"] = {time};
  }
  for (hsize_t k = 0; k < group.getNumObjs(); ++k) {
    const auto name = group.getObjnameByIdx(k), path = at + "/" + name;
    if (at == "/summary" && is_timing(name) && name != "time_to_rest") continue;
    if (name == "scene") continue;
    if (group.childObjType(name) == H5O_TYPE_GROUP) {
      collect(group.openGroup(name), path, values);
      continue;
    }
    const auto dataset = group.openDataSet(name);
    auto& all = values[path];
    all.resize(std::size_t(dataset.getSpace().getSimpleExtentNpoints()));
    if (!all.empty()) dataset.read(all.data(), H5::PredType::NATIVE_DOUBLE);
  }
}

/// Throws H5::Exception if anything in the file cannot be read.
Values content_of(const fs::path& file) {
  H5::Exception::dontPrint();
  Values values;
  collect(H5::H5File(file.string(), H5F_ACC_RDONLY).openGroup("/"), "", values);
  return values;
}

void expect_same(const fs::path& result, const Values& wanted) {
  const auto found = content_of(result);
  EXPECT_GT(found.size(), 50);
  for (const auto& [name, values] : wanted) {
    ASSERT_TRUE(found.contains(name)) << name;
    const auto& other = found.at(name);
    ASSERT_EQ(values.size(), other.size()) << name;
    for (std::size_t k = 0; k < values.size(); ++k)
      ASSERT_TRUE(values[k] == other[k] || (std::isnan(values[k]) && std::isnan(other[k])))
          << name << " [" << k << "]: " << values[k] << " and " << other[k];
  }
  EXPECT_EQ(found.size(), wanted.size());
}

/// The uninterrupted run, once for all tests.
const Values& whole() {
  static const Values values = [] {
    const Program program("restart_whole");
    program.write("scene.toml", scene());
    EXPECT_EQ(program.run("run -q -t 1 scene.toml").status, 0);
    return content_of(program.folder / "whole/result.h5");
  }();
  return values;
}

/// A run in `cut` that is told to stop as soon as it has a checkpoint and a snapshot after that.
void interrupt(const Program& program, int signal, const std::string& options = "-q -t 1",
               const std::string& text = scene()) {
  program.write("scene.toml", text);
  fs::remove_all(program.folder / "cut");
  const auto child = program.start("run " + options + " scene.toml -o cut");
  for (int wait = 0; wait < 2000 && !fs::exists(program.folder / "cut/checkpoint_previous.h5"); ++wait)
    usleep(5000);
  kill(child, signal);
  const int status = tests::wait_for(child);
  if (signal == SIGKILL)
    EXPECT_EQ(status, -SIGKILL);
  else
    EXPECT_EQ(status, 128 + signal) << program.content("err");
}

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

TEST(Restart, AfterKillsAtRandomMomentsNothingIsLostBeforeTheCheckpoint) {
  const Program program("restart_kill");
  program.write("scene.toml", scene());
  fs::remove_all(program.folder / "cut");
  std::random_device seed;
  const auto number = seed();
  std::mt19937 random(number);
  std::uniform_int_distribution<int> delay(20'000, 500'000); // microseconds
  int kills = 0, resumed = 0, attempts = 0;
  for (int status = -1; status != 0 && kills < 60 && attempts < 60; ++attempts) {
    const bool resume = fs::exists(program.folder / "cut/checkpoint.h5");
    resumed += resume;
    const auto child = program.start(resume ? "run -q -t 1 --resume cut" : "run -q -t 1 scene.toml -o cut");
    if (kills < 8) {
      usleep(delay(random));
      kill(child, SIGKILL);
    }
    status = tests::wait_for(child);
    ASSERT_TRUE(status == 0 || status == -SIGKILL) << program.content("err") << " seed " << number;
    kills += status != 0;
    if (status == 0 && kills < 4) { // a machine too fast for the delays: from the start
      fs::remove_all(program.folder / "cut");
      status = -1;
    }
    if (fs::exists(program.folder / "cut/result.h5")) {
      ASSERT_NO_THROW(content_of(program.folder / "cut/result.h5")) << "seed " << number;
    }
  }
  EXPECT_GE(kills, 4);
  EXPECT_GE(resumed, 1);
  expect_same(program.folder / "cut/result.h5", whole());
  std::printf("%d kills, %d times gone on from a checkpoint\n", kills, resumed);
}

TEST(Restart, AfterAFullDiskItGoesOn) {
  const Program program("restart_full");
  program.write("scene.toml", scene());
  fs::remove_all(program.folder / "cut");
  // No file may pass 400 blocks of 512 bytes: the snapshots fit, the checkpoints do not.
  const auto stopped = program.run("run -q -t 1 scene.toml -o cut", "ulimit -f 400;");
  EXPECT_EQ(stopped.status, 1);
  EXPECT_NE(stopped.err.find("cut/checkpoint.h5: cannot write the checkpoint (File too large; "),
            std::string::npos)
      << stopped.err;
  EXPECT_EQ(std::count(stopped.err.begin(), stopped.err.end(), '\n'), 1) << stopped.err;
  EXPECT_NO_THROW(content_of(program.folder / "cut/result.h5"));

  interrupt(program, SIGINT);
  const auto full = program.run("run -q -t 1 --resume cut", "ulimit -f 400;");
  EXPECT_EQ(full.status, 1);
  EXPECT_NO_THROW(content_of(program.folder / "cut/result.h5"));
  EXPECT_EQ(program.run("run -q -t 1 --resume cut").status, 0);
  expect_same(program.folder / "cut/result.h5", whole());
}

TEST(Restart, OnASmallDiskItGoesOn) {
  const Program program("restart_disk");
  interrupt(program, SIGTERM);
  // A file system of 4 MB, filled by another file but for 150 kB. Needs user namespaces.
  const std::string mount = "unshare --user --map-root-user --mount sh -c 'mount -t tmpfs -o size=4M none "
                            "disk && {}'";
  fs::create_directories(program.folder / "disk");
  if (program.shell(fmt::format(fmt::runtime(mount), "true")).status != 0)
    GTEST_SKIP() << "no file system can be mounted here";
  const auto outcome = program.shell(fmt::format(
      fmt::runtime(mount),
      fmt::format("cp -r cut disk/cut && {{ head -c 4M /dev/zero > disk/fill 2>/dev/null; truncate -s -150K "
                  "disk/fill; "
                  "{0} run -q -t 1 --resume disk/cut; echo status $?; cp -r disk/cut stopped; rm disk/fill; "
                  "{0} run -q -t 1 --resume disk/cut >/dev/null; echo status $?; cp -r disk/cut ended; }}",
                  tests::program_path())));
  EXPECT_NE(outcome.out.find("status 1\nstatus 0\n"), std::string::npos) << outcome.out << outcome.err;
  EXPECT_NE(outcome.err.find("No space left on device; "), std::string::npos) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_NO_THROW(content_of(program.folder / "stopped/result.h5"));
  expect_same(program.folder / "ended/result.h5", whole());
}

TEST(Restart, ADamagedCheckpointIsNoticedAndTheOneBeforeIsTaken) {
  const Program program("restart_damage");
  interrupt(program, SIGTERM);
  const auto newest = program.folder / "cut/checkpoint.h5",
             previous = program.folder / "cut/checkpoint_previous.h5";
  fs::copy(program.folder / "cut", program.folder / "bits", fs::copy_options::recursive);
  fs::resize_file(newest, fs::file_size(newest) / 2);
  const auto outcome = program.run("run -q -t 1 --resume cut");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_TRUE(outcome.err.starts_with("cut/checkpoint.h5: not a readable checkpoint")) << outcome.err;
  EXPECT_NE(outcome.err.find("going on from the one before, at 0."), std::string::npos);
  expect_same(program.folder / "cut/result.h5", whole());

  tests::damage(program.folder / "bits/checkpoint.h5");
  EXPECT_EQ(program.run("run -q -t 1 --resume bits").status, 0);
  EXPECT_NE(program.content("err").find("going on from the one before"), std::string::npos);

  interrupt(program, SIGTERM);
  fs::resize_file(newest, 1000);
  // The next checkpoint comes late, so that the kill falls before the second one.
  auto late = scene();
  late.replace(late.find("checkpoint_interval = 0.02"), 26, "checkpoint_interval = 0.06");
  program.write("scene.toml", late);
  const auto child = program.start("run -q -t 1 --resume scene.toml -o cut");
  const auto whole_again = [&] { return fs::exists(newest) && fs::file_size(newest) > 1000; };
  for (int wait = 0; wait < 5000 && !whole_again(); ++wait) usleep(2000);
  kill(child, SIGKILL);
  tests::wait_for(child);
  ASSERT_TRUE(whole_again());
  EXPECT_EQ(program.run("info cut/checkpoint_previous.h5").status, 0) << "a damaged one took its place";
  program.write("scene.toml", scene());

  interrupt(program, SIGTERM);
  for (const auto& file : {newest, previous}) fs::resize_file(file, 1000);
  const auto lost = program.run("run -q --resume cut");
  EXPECT_EQ(lost.status, 1);
  EXPECT_TRUE(lost.err.starts_with("simsand: cut/checkpoint_previous.h5: not a readable checkpoint"))
      << lost.err;
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
  for (const auto* name : {"checkpoint.h5", "checkpoint_previous.h5"}) {
    H5::H5File file((old / name).string(), H5F_ACC_RDWR);
    const int layout = 2;
    file.openAttribute("checkpoint_version").write(H5::PredType::NATIVE_INT, &layout);
  }
  refuses("old", "a checkpoint of layout 2, this program reads 4");
  EXPECT_TRUE(fs::exists(old / "checkpoint.h5")) << "for the program that wrote it";
  program.write("cut/scene.toml", changed);
  refuses("cut", "cut/scene.toml: key 'floor.friction'");
  fs::remove(program.folder / "cut/scene.toml");
  {
    H5::H5File file((copy("version") / "checkpoint.h5").string(), H5F_ACC_RDWR);
    file.removeAttr("simsand_version");
    const H5::StrType text(H5::PredType::C_S1, 5);
    file.createAttribute("simsand_version", text, H5::DataSpace(H5S_SCALAR))
        .write(text, std::string("0.0.1"));
  }
  refuses("version", "checkpoint.h5: written by simsand 0.0.1, this is ");
  refuses("scene.toml -o cut --set floor.friction=0.4",
          "key 'floor.friction': expected 0.5 as in the checkpoint");
  refuses("cut --set floor.friction=0.5",
          "--set floor.friction=0.5: expected a scene file beside it, found cut");
  EXPECT_EQ(program.run("run -q -t 1 --resume changed.toml -o cut --set floor.friction=0.5").status, 0)
      << "the scene that it began with";
  expect_same(program.folder / "cut/result.h5", whole());
}

TEST(Restart, ALostSnapshotIsAllThatIsLost) {
  const Program program("restart_snapshot");
  interrupt(program, SIGTERM);
  const auto copy = [&](const std::string& name) {
    fs::copy(program.folder / "cut", program.folder / name, fs::copy_options::recursive);
    return program.folder / name / "result.parts";
  };
  fs::resize_file(copy("short") / "0000.h5", 1000);
  fs::remove(copy("gone") / "0000.h5");
  fs::remove(copy("constants") / "particles.h5");
  auto rest = whole();
  std::erase_if(rest, [](const auto& entry) { return entry.first.starts_with("/snapshots/0000/"); });
  ASSERT_LT(rest.size(), whole().size());
  for (const std::string folder : {"short", "gone"}) {
    // A second stop: what is lost stays known.
    const auto child = program.start("run -q -t 1 --resume " + folder);
    const auto said = [&] {
      return program.content("err").find(folder + "/result.parts/0000.h5: missing or not readable; the "
                                                  "result goes on without this snapshot\n") !=
             std::string::npos;
    };
    for (int wait = 0; wait < 2000 && !said(); ++wait) usleep(5000);
    kill(child, SIGTERM);
    tests::wait_for(child);
    EXPECT_TRUE(said()) << program.content("err");
    const auto outcome = program.run("run -q -t 1 --resume " + folder);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "") << "said once";
    expect_same(program.folder / folder / "result.h5", rest);
    const auto xdmf = program.content(folder + "/result.xdmf");
    EXPECT_EQ(xdmf.find("/snapshots/0000/"), std::string::npos);
    EXPECT_NE(xdmf.find("/snapshots/0001/"), std::string::npos);
  }
  EXPECT_EQ(program.run("run -q -t 1 --resume constants").status, 0) << program.content("err");
  expect_same(program.folder / "constants/result.h5", whole());
}

TEST(Restart, WithoutAWholeSceneFileTheOneInTheCheckpointIsTaken) {
  const Program program("restart_scene");
  interrupt(program, SIGTERM);
  const auto file = program.folder / "cut/scene.toml";
  const auto text = program.content("cut/scene.toml");
  fs::resize_file(file, fs::file_size(file) / 2);
  const auto outcome = program.run("run -q -t 1 --resume cut");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(outcome.err.starts_with("cut/scene.toml:")) << outcome.err;
  EXPECT_NE(outcome.err.find("; going on with the scene in the checkpoint\n"), std::string::npos);
  EXPECT_EQ(program.content("cut/scene.toml"), text) << "written again";
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
