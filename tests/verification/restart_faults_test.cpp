// SPDX-License-Identifier: BSD-3-Clause
// Runs that are killed, or out of disk, or whose files are damaged: what is lost, and that the rest goes on to the last
// bit.
#include "drivers/run/resume.hpp"
#include "host/files/result_read.hpp"
#include "tests/verification/restart_fixture.hpp"
#include <fstream>
#include <random>

namespace {

namespace fs = std::filesystem;
using tests::content_of, tests::expect_same, tests::interrupt, tests::Program, tests::scene, tests::whole;

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
  // No file may pass 160 blocks of 512 bytes: neither the result nor a checkpoint fits. Which is written first, the
  // clock decides.
  const auto stopped = program.run("run -q -t 1 scene.toml -o cut", "ulimit -f 160;");
  EXPECT_EQ(stopped.status, 1);
  EXPECT_TRUE(stopped.err.starts_with("simsand: cut/checkpoint.h5: cannot write ") ||
              stopped.err.starts_with("simsand: cut/result.h5: cannot write "))
      << stopped.err;
  EXPECT_NE(stopped.err.find(" (File too large; "), std::string::npos) << stopped.err;
  EXPECT_EQ(std::count(stopped.err.begin(), stopped.err.end(), '\n'), 1) << stopped.err;
  EXPECT_NO_THROW(content_of(program.folder / "cut/result.h5"));

  interrupt(program, SIGINT);
  const auto full = program.run("run -q -t 1 --resume cut", "ulimit -f 160;");
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

TEST(Restart, AnyFlippedBitOfACheckpointIsNoticedAndTheOneBeforeIsTaken) {
  const Program program("restart_bits");
  interrupt(program, SIGTERM);
  const auto newest = program.folder / "cut/checkpoint.h5",
             previous = program.folder / "cut/checkpoint_previous.h5";
  const auto good = program.content("cut/checkpoint.h5");
  EXPECT_EQ(drivers::find_resumption((program.folder / "cut").string(), "")->checkpoint, newest);
  std::mt19937 random(20);
  for (int flip = 0; flip < 200; ++flip) {
    // The first and last bytes too: what HDF5 reads first, and the checksum itself.
    const auto last = good.size() - 1;
    const auto place = flip < 20   ? std::size_t(flip)
                       : flip < 40 ? last - std::size_t(flip - 20)
                                   : random() % good.size();
    auto bytes = good;
    bytes[place] = char(bytes[place] ^ (1 << random() % 8));
    std::ofstream(newest, std::ios::binary) << bytes;
    testing::internal::CaptureStdout(); // where the default logger of this process writes
    const auto found = drivers::find_resumption((program.folder / "cut").string(), "");
    const auto warning = testing::internal::GetCapturedStdout();
    ASSERT_EQ(found->checkpoint, previous) << "byte " << place;
    ASSERT_NE(warning.find("checkpoint.h5: not a readable checkpoint"), std::string::npos) << warning;
    ASSERT_NE(warning.find("going on from the one before"), std::string::npos) << warning;
  }
  EXPECT_EQ(program.run("run -q -t 1 --resume cut").status, 0) << program.content("err");
  expect_same(program.folder / "cut/result.h5", whole());
}

TEST(Restart, ADamagedResultIsNotTakenForACompleteOne) {
  const Program program("restart_result_bits");
  program.write("scene.toml", scene());
  fs::remove_all(program.folder / "cut");
  auto shorter = scene();
  shorter.replace(shorter.find("time = 0.4"), 10, "time = 0.02");
  program.write("scene.toml", shorter);
  ASSERT_EQ(program.run("run -q -t 1 scene.toml -o cut").status, 0) << program.content("err");
  const auto result = program.folder / "cut/result.h5";
  const auto good = program.content("cut/result.h5");
  EXPECT_TRUE(host::is_complete_result(result));
  std::mt19937 random(21);
  for (int flip = 0; flip < 200; ++flip) {
    auto bytes = good;
    const auto place = random() % good.size();
    bytes[place] = char(bytes[place] ^ (1 << random() % 8));
    std::ofstream(result, std::ios::binary) << bytes;
    ASSERT_FALSE(host::is_complete_result(result)) << "byte " << place;
    ASSERT_THROW(host::stored_scene(result), std::runtime_error) << "byte " << place;
    ASSERT_THROW(host::read_stored_run(result), std::runtime_error) << "byte " << place;
  }
}

TEST(Restart, AResultThatIsCutShortIsWrittenAgain) {
  const Program program("restart_result");
  interrupt(program, SIGTERM);
  const auto result = program.folder / "cut/result.h5";
  fs::resize_file(result, fs::file_size(result) / 2);
  const auto read = program.run("info cut/result.h5");
  EXPECT_EQ(read.status, 1);
  EXPECT_NE(read.err.find("cut/result.h5: neither a readable result nor a readable checkpoint"),
            std::string::npos)
      << read.err;
  EXPECT_EQ(program.run("run -q -t 1 --resume cut").status, 0) << program.content("err");
  expect_same(result, whole());
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

} // namespace
