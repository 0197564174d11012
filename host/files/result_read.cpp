// SPDX-License-Identifier: BSD-3-Clause
#include "host/files/result_read.hpp"
#include "host/files/checkpoint.hpp"
#include "host/files/hdf5_read.hpp"
#include "host/files/seal.hpp"
#include <fmt/format.h>

namespace host {
namespace {

/// Times of the snapshots that can be read; of an incomplete result they are in files of their own.
std::vector<double> times_of(const H5::Group& snapshots) {
  std::vector<double> times;
  for (const auto& name : names_in(snapshots)) try {
      times.push_back(number_attribute<double>(snapshots.openGroup(name), "time"));
    } catch (const H5::Exception&) {}
  return times;
}

double particles_of(const H5::H5File& file) {
  try {
    return double(file.openDataSet("particles/number").getSpace().getSimpleExtentNpoints());
  } catch (const H5::Exception&) {
    return 0; // the part that holds them is gone
  }
}

StoredRun read_result(const H5::H5File& file) {
  StoredRun run;
  run.complete = number_attribute<int>(file, "complete") == 1;
  run.version = text_attribute(file, "simsand_version");
  run.compiler = text_attribute(file, "compiler");
  run.geometry = text_attribute(file, "geometry");
  run.scene = read_text(file, "scene");
  run.particles = particles_of(file);
  run.snapshot_times = times_of(file.openGroup("snapshots"));
  run.snapshots = int(run.snapshot_times.size());
  const auto series = file.openGroup("series"), summary = file.openGroup("summary");
  for (const auto& name : names_in(series))
    run.series.push_back(
        {{name, text_attribute(series.openDataSet(name), "unit")}, read_array<double>(series, name)});
  for (const auto& name : names_in(summary)) {
    const auto value = read_array<double>(summary, name).at(0);
    run.summary.push_back({{name, text_attribute(summary.openDataSet(name), "unit")}, value});
    if (name == "steps") run.steps = value;
  }
  for (const auto& [column, values] : run.series)
    if (column.name == "time" && !values.empty()) run.time = values.back();
  return run;
}

StoredRun read_checkpoint_run(const std::filesystem::path& path) {
  const auto header = verified_checkpoint(path);
  const auto progress = read_run_progress(path);
  StoredRun run;
  run.checkpoint = true;
  run.scene = header.scene;
  run.version = header.version;
  run.compiler = header.compiler;
  run.geometry = header.geometry;
  run.particles = header.particles;
  run.time = header.time;
  run.steps = header.steps;
  run.snapshots = progress.result.snapshots - int(progress.result.lost.size());
  for (std::size_t c = 0; c < progress.result.columns.size(); ++c)
    run.series.push_back({progress.result.columns[c], progress.result.series[c]});
  run.summary.push_back({{"wall_clock", "s"}, progress.spent.wall});
  return run;
}

} // namespace

StoredRun read_stored_run(const std::filesystem::path& path) {
  H5::Exception::dontPrint();
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw std::runtime_error(fmt::format("{}: no such file", path.string()));
  if (has_intact_seal(path)) try {
      const auto file = open_to_read(path);
      return file.attrExists("checkpoint_version") ? read_checkpoint_run(path) : read_result(file);
    } catch (const H5::Exception&) {}
  throw std::runtime_error(
      fmt::format("{}: neither a readable result nor a readable checkpoint", path.string()));
}

bool is_complete_result(const std::filesystem::path& path) {
  H5::Exception::dontPrint();
  try {
    return has_intact_seal(path) && number_attribute<int>(open_to_read(path), "complete") == 1;
  } catch (const H5::Exception&) {
    return false;
  }
}

std::string stored_build(const std::filesystem::path& path) {
  H5::Exception::dontPrint();
  try {
    return text_attribute(open_to_read(path), "build");
  } catch (const H5::Exception&) {
    return "";
  }
}

std::string stored_scene(const std::filesystem::path& path) {
  H5::Exception::dontPrint();
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw std::runtime_error(fmt::format("{}: no such file", path.string()));
  if (has_intact_seal(path)) try {
      return read_text(open_to_read(path), "scene");
    } catch (const H5::Exception&) {}
  throw std::runtime_error(
      fmt::format("{}: not a readable result file with a stored scene; it may have been cut short or damaged",
                  path.string()));
}

} // namespace host
