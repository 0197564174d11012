// SPDX-License-Identifier: BSD-3-Clause
#include "host/files/result_read.hpp"
#include "host/files/checkpoint.hpp"
#include "host/files/hdf5_write.hpp"
#include <fmt/format.h>

namespace host {
namespace {

std::string text_of(const H5::H5Object& object, const std::string& name) {
  std::string text;
  const auto a = object.openAttribute(name);
  a.read(a.getStrType(), text);
  return text;
}

std::vector<double> values_of(const H5::Group& group, const std::string& name) {
  const auto dataset = group.openDataSet(name);
  std::vector<double> values(std::size_t(dataset.getSpace().getSimpleExtentNpoints()));
  if (!values.empty()) dataset.read(values.data(), real());
  return values;
}

std::vector<std::string> names_in(const H5::Group& group) {
  std::vector<std::string> names;
  for (hsize_t k = 0; k < group.getNumObjs(); ++k) names.push_back(group.getObjnameByIdx(k));
  return names;
}

/// Times of the snapshots that can be read; of an incomplete result they are in files of their own.
std::vector<double> times_of(const H5::Group& snapshots) {
  std::vector<double> times;
  for (const auto& name : names_in(snapshots)) try {
      double time = 0;
      snapshots.openGroup(name).openAttribute("time").read(real(), &time);
      times.push_back(time);
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
  int complete = 0;
  file.openAttribute("complete").read(H5::PredType::NATIVE_INT, &complete);
  run.complete = complete == 1;
  run.version = text_of(file, "simsand_version");
  run.compiler = text_of(file, "compiler");
  run.geometry = text_of(file, "geometry");
  const auto scene = file.openDataSet("scene");
  scene.read(run.scene, scene.getStrType());
  run.particles = particles_of(file);
  run.snapshot_times = times_of(file.openGroup("snapshots"));
  run.snapshots = int(run.snapshot_times.size());
  const auto series = file.openGroup("series"), summary = file.openGroup("summary");
  for (const auto& name : names_in(series))
    run.series.push_back({{name, text_of(series.openDataSet(name), "unit")}, values_of(series, name)});
  for (const auto& name : names_in(summary)) {
    const auto value = values_of(summary, name).at(0);
    run.summary.push_back({{name, text_of(summary.openDataSet(name), "unit")}, value});
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
  try {
    const auto file = open_to_read(path);
    return file.attrExists("checkpoint_version") ? read_checkpoint_run(path) : read_result(file);
  } catch (const H5::Exception&) {
    throw std::runtime_error(
        fmt::format("{}: neither a readable result nor a readable checkpoint", path.string()));
  }
}

bool is_complete_result(const std::filesystem::path& path) {
  H5::Exception::dontPrint();
  try {
    int complete = 0;
    open_to_read(path).openAttribute("complete").read(H5::PredType::NATIVE_INT, &complete);
    return complete == 1;
  } catch (const H5::Exception&) {
    return false;
  }
}

std::string stored_build(const std::filesystem::path& path) {
  H5::Exception::dontPrint();
  try {
    return text_of(open_to_read(path), "build");
  } catch (const H5::Exception&) {
    return "";
  }
}

std::string stored_scene(const std::filesystem::path& path) {
  H5::Exception::dontPrint();
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw std::runtime_error(fmt::format("{}: no such file", path.string()));
  try {
    std::string scene;
    const auto dataset = open_to_read(path).openDataSet("scene");
    dataset.read(scene, dataset.getStrType());
    return scene;
  } catch (const H5::Exception&) {
    throw std::runtime_error(
        fmt::format("{}: not a readable result file with a stored scene", path.string()));
  }
}

} // namespace host
