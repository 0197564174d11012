// SPDX-License-Identifier: BSD-3-Clause
// A run that is stopped, and its numbers beside those of a run that was not.
#pragma once
#include "tests/verification/program.hpp"
#include <H5Cpp.h>
#include <cmath>
#include <csignal>
#include <map>

namespace tests {

namespace fs = std::filesystem;
using Values = std::map<std::string, std::vector<double>>;

/// A column of 169 particles, some 5000 steps, that writes often.
inline std::string scene() {
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
inline bool is_timing(const std::string& name) {
  return name == "wall_clock" || name == "rate" || name == "threads" || name.starts_with("time_");
}

/// Every number below `group`, the times of snapshots included, by path.
inline void collect(const H5::Group& group, const std::string& at, Values& values) {
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
inline Values content_of(const fs::path& file) {
  H5::Exception::dontPrint();
  Values values;
  collect(H5::H5File(file.string(), H5F_ACC_RDONLY).openGroup("/"), "", values);
  return values;
}

inline void expect_same(const fs::path& result, const Values& wanted) {
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
inline const Values& whole() {
  static const Values values = [] {
    const Program program("restart_whole");
    program.write("scene.toml", scene());
    EXPECT_EQ(program.run("run -q -t 1 scene.toml").status, 0);
    return content_of(program.folder / "whole/result.h5");
  }();
  return values;
}

/// A run in `cut` that is told to stop as soon as it has a checkpoint and a snapshot after that.
inline void interrupt(const Program& program, int signal, const std::string& options = "-q -t 1",
                      const std::string& text = scene()) {
  program.write("scene.toml", text);
  fs::remove_all(program.folder / "cut");
  const auto child = program.start("run " + options + " scene.toml -o cut");
  for (int wait = 0; wait < 2000 && !fs::exists(program.folder / "cut/checkpoint_previous.h5"); ++wait)
    usleep(5000);
  kill(child, signal);
  const int status = wait_for(child);
  if (signal == SIGKILL)
    EXPECT_EQ(status, -SIGKILL);
  else
    EXPECT_EQ(status, 128 + signal) << program.content("err");
}

} // namespace tests
