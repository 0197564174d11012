// SPDX-License-Identifier: BSD-3-Clause
// Chains on disk: killed, stopped, extended, damaged, mistaken.
#include "calibration/chain_file.hpp"
#include "host/files/hdf5_write.hpp"
#include "tests/unit/sampler_targets.hpp"
#include <csignal>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace {

using calibration::Chain;
using calibration::Checkpoint;
using calibration::SamplerOptions;

class ChainFileTest : public testing::Test {
protected:
  void SetUp() override {
    folder = std::filesystem::temp_directory_path() /
             ("simsand_chain_" + std::to_string(::getpid()) + "_" +
              testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder);
    checkpoint.file = folder / "chain.h5";
    checkpoint.names = {"a", "b", "c", "d", "e", "f"};
    checkpoint.fingerprint = "three tests";
    checkpoint.interval = 1e9; // at the end
    options.walkers = 12;
    options.burn_in = 150;
    options.steps = 100;
    options.lower = targets::all(6, -1000);
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  Chain run(const Checkpoint& where, const calibration::ProgressReport& report = {}) const {
    return calibration::sample(density, target.start(60, 1), options, where, report);
  }
  std::string failure() const {
    try {
      run(checkpoint);
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return "";
  }
  std::string bytes() const {
    std::ifstream file(checkpoint.file, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void overwrite(const std::string& content) const {
    std::ofstream(checkpoint.file, std::ios::binary) << content;
  }
  /// An error that names the file and says `what`; the file stays as it is.
  void expect_refused(const std::string& what) const {
    const std::string before = bytes(), said = failure();
    EXPECT_NE(said.find(what), std::string::npos) << said;
    EXPECT_EQ(said.find(checkpoint.file.string()), 0u) << said;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    EXPECT_EQ(bytes(), before);
  }

  targets::Target target = targets::banana();
  calibration::LogDensity density = target.batch();
  std::filesystem::path folder;
  Checkpoint checkpoint;
  SamplerOptions options;
};

void expect_equal(const Chain& one, const Chain& other) {
  EXPECT_TRUE(one.complete && other.complete);
  EXPECT_EQ(one.steps, other.steps);
  EXPECT_EQ(one.samples, other.samples);
  EXPECT_EQ(one.log_density, other.log_density);
  EXPECT_EQ(one.acceptance, other.acceptance);
}

/// Number by which the system knows the file of this moment, 0 without one.
ino_t identity(const std::filesystem::path& file) {
  struct stat about {};
  return ::stat(file.c_str(), &about) == 0 ? about.st_ino : 0;
}

/// Waits until the file has been replaced so many times, or the child has ended, and then a random moment more.
void wait_for_writings(const std::filesystem::path& file, int writings, pid_t child, std::mt19937& random) {
  for (ino_t before = identity(file); writings > 0;) {
    siginfo_t ended{};
    ::waitid(P_PID, id_t(child), &ended, WEXITED | WNOHANG | WNOWAIT);
    if (ended.si_pid == child) return;
    if (const ino_t now = identity(file); now != before) {
      before = now;
      --writings;
    }
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  }
  std::this_thread::sleep_for(std::chrono::microseconds(std::uniform_int_distribution(0, 20000)(random)));
}

/// A child process, which writes after every step, is killed at random moments until one ends by itself.
TEST_F(ChainFileTest, KilledAtAnyMomentItEndsInTheSameChain) {
  const Chain whole = run({});
  checkpoint.interval = 0;
  std::mt19937 random(5);
  int killed = 0, killed_in_burn_in = 0, killed_in_chain = 0;
  while (true) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) ::_exit(failure().empty() ? 0 : 1);
    wait_for_writings(checkpoint.file, std::uniform_int_distribution(0, 20)(random), child, random);
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    if (WIFEXITED(status)) {
      EXPECT_EQ(WEXITSTATUS(status), 0);
      break;
    }
    ++killed;
    if (!std::filesystem::exists(checkpoint.file)) continue;
    ++(calibration::read_chain(checkpoint.file).chain.steps > 0 ? killed_in_chain : killed_in_burn_in);
  }
  RecordProperty("killed", killed);
  EXPECT_GE(killed_in_burn_in, 3);
  EXPECT_GE(killed_in_chain, 3);
  const auto stored = calibration::read_chain(checkpoint.file);
  expect_equal(stored.chain, whole);
  EXPECT_EQ(stored.names, checkpoint.names);
  EXPECT_EQ(stored.fingerprint, checkpoint.fingerprint);
}

TEST_F(ChainFileTest, StoppedInBurnInAndLaterItGoesOn) {
  const Chain whole = run({});
  options.steps = 100;
  for (const int stop_at : {3, 150, 200}) {
    int calls = 0;
    // Without the clock: the density counts steps and the report stops the run at the given one.
    const auto counting = [&](const Eigen::Ref<const Eigen::MatrixXd>& points) {
      if (++calls == stop_at) std::this_thread::sleep_for(std::chrono::milliseconds(1010));
      return density(points);
    };
    const Chain part = calibration::sample(counting, target.start(60, 1), options, checkpoint,
                                           [](const auto&) { return false; });
    EXPECT_FALSE(part.complete);
    expect_equal(run(checkpoint), whole);
    std::filesystem::remove(checkpoint.file);
  }
}

TEST_F(ChainFileTest, LongerChainGoesOnFromTheShorter) {
  options.thinning = 3;
  run(checkpoint);
  options.steps = 250;
  expect_equal(run(checkpoint), run({}));
}

TEST_F(ChainFileTest, OtherProblemIsRefused) {
  run(checkpoint);
  const auto refused = [&](const std::string& what, const auto& change) {
    const auto kept = std::pair(checkpoint, options);
    change();
    expect_refused(what);
    std::tie(checkpoint, options) = kept;
  };
  refused("fingerprint of the problem is three tests there and four tests here",
          [&] { checkpoint.fingerprint = "four tests"; });
  refused("other parameters", [&] { checkpoint.names[2] = "z"; });
  refused("walkers is 12 there and 13 here", [&] { options.walkers = 13; });
  refused("burn_in is 150", [&] { options.burn_in = 151; });
  refused("thinning is 1 there and 2 here", [&] { options.thinning = 2; });
  refused("seed is 1 there and 18446744073709551615 here", [&] { options.seed = ~std::uint64_t(0); });
  refused("other lower bounds", [&] { options.lower(3) = -999; });
  refused("other upper bounds", [&] { options.upper = targets::all(6, 999); });
  refused("100 steps, more than the 50", [&] { options.steps = 50; });
  refused("exists already", [&] { checkpoint.resume = false; });
  EXPECT_EQ(failure(), "");
}

TEST_F(ChainFileTest, ForeignAndDamagedFilesAreRefusedAndKept) {
  overwrite("");
  expect_refused("not a chain");
  overwrite("time,q\n1,2\n");
  expect_refused("not a chain");
  H5::H5File(checkpoint.file.string(), H5F_ACC_TRUNC).close();
  expect_refused("not a chain");
  std::filesystem::remove(checkpoint.file);
  run(checkpoint);
  const std::string good = bytes();
  for (const double part : {0.1, 0.5, 0.9, 0.999}) {
    overwrite(good.substr(0, std::size_t(part * double(good.size()))));
    expect_refused("damaged");
  }
  // One bit of the samples.
  std::string flipped = good;
  const Chain chain = run({});
  const std::string needle(reinterpret_cast<const char*>(chain.samples.data()), 64);
  const auto place = flipped.find(needle);
  ASSERT_NE(place, std::string::npos);
  flipped[place + 3] ^= 4;
  overwrite(flipped);
  expect_refused("damaged");
  overwrite(good);
  EXPECT_EQ(failure(), "");
}

/// What a process left that died while it wrote aside is no obstacle.
TEST_F(ChainFileTest, HalfWrittenFileBesideIsIgnored) {
  std::ofstream(checkpoint.file.string() + ".part") << "half";
  expect_equal(run(checkpoint), run({}));
  EXPECT_FALSE(std::filesystem::exists(checkpoint.file.string() + ".part"));
}

TEST_F(ChainFileTest, SecondRunOnTheSameFileIsRefused) {
  const calibration::ChainFile first(checkpoint, options);
  expect_refused("another run is writing this file");
}

TEST_F(ChainFileTest, FolderThatCannotBeIsNamed) {
  overwrite("a file");
  checkpoint.file /= "chain.h5";
  EXPECT_NE(failure().find("cannot create its folder"), std::string::npos) << failure();
}

/// A disk that is full, here a limit of the size of files: an error, and the state before is still good.
TEST_F(ChainFileTest, FullDiskLeavesTheStateBefore) {
  const Chain whole = run({});
  options.steps = 20;
  run(checkpoint);
  const std::string before = bytes();
  options.steps = 100;
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{before.size() / 2, before.size() / 2};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const std::string said = failure();
    ::_exit(said.find("cannot write the chain (File too large)") != std::string::npos ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  EXPECT_EQ(bytes(), before);
  EXPECT_FALSE(std::filesystem::exists(checkpoint.file.string() + ".part"));
  expect_equal(run(checkpoint), whole);
}

} // namespace
