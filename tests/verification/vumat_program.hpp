// SPDX-License-Identifier: BSD-3-Clause
// The program, run by a test in a folder of its own.
#pragma once
#include <H5Cpp.h>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>
#include <sys/wait.h>
#include <vector>

namespace tests {

struct Outcome {
  int status;
  std::string out, err;
};

inline std::string content(const std::filesystem::path& path) {
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// The folder of the running test.
inline std::filesystem::path folder() {
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  const auto path = std::filesystem::absolute("any_vumat_results") / test->test_suite_name() / test->name();
  std::filesystem::create_directories(path);
  return path;
}

inline Outcome simsand(const std::string& arguments, const std::string& program = "simsand") {
  const auto at = folder();
  const int status = std::system(fmt::format("cd '{}' && exec timeout 100 '{}/{}' {} >out 2>err", at.string(),
                                             SIMSAND_BINARY_DIR, program, arguments)
                                     .c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(at / "out"), content(at / "err")};
}

/// A `[material]` table of a test library; `extra`: further lines.
inline std::string material(const std::string& library, const std::string& properties, int states,
                            const std::string& extra = "") {
  return fmt::format("[material]\nlibrary = \"{}/test_vumats/{}.so\"\nname = \"{}\"\nproperties = {}\n"
                     "state_variables = {}\ndensity = 1500.0\n{}\n",
                     SIMSAND_BINARY_DIR, library, library, properties, states, extra);
}

/// Runs a collapse of a few milliseconds of a block of 10 x 10 particles, or more; a quarter of one in three
/// dimensions.
inline Outcome run_scene(const std::string& material, const std::string& geometry = "plane_strain",
                         int threads = 1, int across = 10) {
  std::filesystem::remove_all(folder() / "results");
  std::ofstream(folder() / "scene.toml") << fmt::format(
      "[scene]\ngeometry = \"{}\"\n{}spacing = {}\n[column]\nradius = 0.05\nheight = 0.05\n{}"
      "[initial_stress]\nK0 = 0.5\n[floor]\nfriction = 0.5\n[gate]\nmotion = \"lift\"\nspeed = 1.6\n"
      "[end]\ntime = 0.02\n[output]\nfolder = \"results\"\nsample_interval = 0.002\n"
      "snapshot_interval = 0.01\ngrain_diameter = 0.003\n",
      geometry, geometry == "three_dimensional" ? "sector = \"quarter\"\n" : "", 0.05 / across, material);
  return simsand(fmt::format("run --quiet --threads {} scene.toml", threads));
}

/// All values of a field in the last snapshot of the scene's result.
inline std::vector<double> last(const std::string& field) {
  const H5::H5File file((folder() / "results/result.h5").string(), H5F_ACC_RDONLY);
  const auto snapshots = file.openGroup("/snapshots").getNumObjs();
  const auto data = file.openDataSet(fmt::format("/snapshots/{:04}/{}", snapshots - 1, field));
  std::vector<double> values(data.getSpace().getSimpleExtentNpoints());
  data.read(values.data(), H5::PredType::NATIVE_DOUBLE);
  return values;
}

/// Leads a point from an isotropic pressure along `stages`.
inline Outcome run_path(const std::string& material, const std::string& stages, double pressure = 0) {
  std::ofstream(folder() / "path.toml")
      << material << fmt::format("[initial]\nmean_stress = {:.3f}\n", pressure) << stages;
  return simsand("element path.toml");
}

} // namespace tests
