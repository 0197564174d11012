// SPDX-License-Identifier: BSD-3-Clause
#include "host/files/checkpoint.hpp"
#include "host/engine/lists.hpp"
#include "host/files/checkpoint_items.hpp"
#include "host/files/hdf5_read.hpp"
#include "host/files/seal.hpp"
#include "host/files/whole_file.hpp"
#include "host/scheme/geometry.hpp"
#include <fmt/format.h>
#include <sstream>

namespace host {
namespace {

constexpr int checkpoint_version = 6;
constexpr auto kind = "checkpoint_version"; ///< attribute that only checkpoints have

/// Writes every item as an array.
struct Writer {
  H5::Group group;

  template <class T, class A> void operator()(const std::string& name, std::vector<T, A>& values) {
    write_array(group, name, values.data(), {values.size()});
  }
  template <class T>
  requires std::is_arithmetic_v<T>
  void operator()(const std::string& name, T& value) { write_array(group, name, &value, {1}); }
};

struct Reader {
  H5::Group group;

  template <class T, class A> void operator()(const std::string& name, std::vector<T, A>& values) {
    const auto read = read_array<T>(group, name);
    values.assign(read.begin(), read.end());
  }
  template <class T>
  requires std::is_arithmetic_v<T>
  void operator()(const std::string& name, T& value) { value = read_array<T>(group, name).at(0); }
};

void write_header(const H5::H5File& file, const CheckpointHeader& header) {
  attribute(file, kind, checkpoint_version);
  attribute(file, "simsand_version", header.version);
  attribute(file, "compiler", header.compiler);
  attribute(file, "geometry", header.geometry);
  attribute(file, "library", header.library);
  attribute(file, "library_hash", header.library_hash);
  attribute(file, "time", header.time);
  attribute(file, "steps", header.steps);
  attribute(file, "particles", header.particles);
  write_text(file, "scene", header.scene);
}

void write_progress(const H5::Group& group, RunProgress progress) {
  each_stored_item(progress, Writer{group});
  write_text(group, "xdmf", progress.result.xdmf);
  std::string columns;
  for (const Quantity& c : progress.result.columns) columns += c.name + " " + c.unit + "\n";
  write_text(group, "column_names", columns);
}

RunProgress read_progress(const H5::Group& group) {
  RunProgress progress;
  each_stored_item(progress, Reader{group});
  progress.result.xdmf = read_text(group, "xdmf");
  std::istringstream columns(read_text(group, "column_names"));
  for (Quantity c; columns >> c.name >> c.unit;) progress.result.columns.push_back(c);
  progress.result.series.resize(progress.result.columns.size());
  return progress;
}

/// The old checkpoint stays under its own name too, so that there is one at any moment.
void keep_previous(const std::filesystem::path& path, const std::filesystem::path& previous) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return;
  std::filesystem::remove(aside(previous), error);
  std::filesystem::create_hard_link(path, aside(previous), error);
  if (error) // no hard links here: for a moment there is only the previous one
    std::filesystem::rename(path, previous, error);
  else
    std::filesystem::rename(aside(previous), previous, error);
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
  throw std::runtime_error(fmt::format("{}: {}", path.string(), why));
}

constexpr auto unreadable = "not a readable checkpoint; it may have been cut short or damaged";

/// Runs `read` if the checksum of the file fits, and turns what HDF5 says into one line.
template <class F> auto guarded_read(const std::filesystem::path& path, F&& read) {
  H5::Exception::dontPrint();
  if (!std::filesystem::is_regular_file(path)) refuse(path, "no such checkpoint");
  if (!has_intact_seal(path)) refuse(path, unreadable);
  try {
    return read();
  } catch (const H5::Exception&) {
    refuse(path, unreadable);
  } catch (const std::out_of_range&) {
    refuse(path, "not a readable checkpoint; a number is missing");
  }
}

/// What must hold of the lengths before a step may run on them.
template <class Geometry>
void check_lengths(const std::filesystem::path& path, Simulation<Geometry>& s, std::size_t padded) {
  bool fits = s.particles.id.size() == padded;
  s.particles.each_persistent([&](const Array& a) { fits = fits && a.size() == padded; });
  const bool listed = s.rebuilds > 0;
  const std::size_t clusters = listed ? std::size_t(s.particles.clusters()) : 0;
  fits = fits && s.outer_lists.interior.size() == clusters && s.outer_lists.total.size() == clusters &&
         s.outer_lists.screened.size() == clusters &&
         (!listed || s.images.clearance.size() == s.surfaces.size()) &&
         s.outer_lists.entries.size() >= clusters * std::size_t(s.outer_lists.capacity);
  const int records = s.particles.padded() + int(s.images.list.size());
  for (std::size_t c = 0; fits && c < clusters; ++c) {
    const int total = s.outer_lists.total[c], *entries = s.outer_lists.begin(int(c));
    fits = s.outer_lists.interior[c] >= 0 && s.outer_lists.interior[c] <= s.outer_lists.common(int(c)) &&
           s.outer_lists.screened[c] >= 0 && total <= s.outer_lists.capacity &&
           std::all_of(entries, entries + total, [&](int j) { return j >= 0 && j < records; });
  }
  const auto listed_before = [&](std::size_t k) {
    const Image& image = s.images.list[k];
    return image.source >= 0 && image.source < s.images.first + int(k) && image.surface >= 0 &&
           image.surface < int(s.surfaces.size());
  };
  for (std::size_t k = 0; fits && k < s.images.list.size(); ++k) fits = listed_before(k);
  if (!fits) refuse(path, "its particles are not those of the scene");
}

} // namespace

template <class Geometry>
std::string checkpoint_image(const CheckpointHeader& header, Simulation<Geometry>& simulation,
                             const RunProgress& progress) {
  const auto file = memory_file();
  write_header(file, header);
  each_stored_item(simulation, Writer{file.createGroup("simulation")});
  write_progress(file.createGroup("run"), progress);
  return sealed(file_image(file));
}

template <class Geometry>
void write_checkpoint(const std::filesystem::path& path, const std::filesystem::path& previous,
                      const CheckpointHeader& header, Simulation<Geometry>& simulation,
                      const RunProgress& progress) {
  guarded_write(path, "the checkpoint", [&] {
    write_beside(path, checkpoint_image(header, simulation, progress));
    keep_previous(path, previous);
    take_place(path);
  });
}

CheckpointHeader verified_checkpoint(const std::filesystem::path& path) {
  return guarded_read(path, [&] {
    const auto file = open_to_read(path);
    const int version = number_attribute<int>(file, kind);
    if (version != checkpoint_version)
      refuse(path,
             fmt::format("a checkpoint of layout {}, this program reads {}", version, checkpoint_version));
    return CheckpointHeader{read_text(file, "scene"),
                            text_attribute(file, "simsand_version"),
                            text_attribute(file, "compiler"),
                            text_attribute(file, "geometry"),
                            text_attribute(file, "library"),
                            text_attribute(file, "library_hash"),
                            number_attribute<double>(file, "time"),
                            number_attribute<double>(file, "steps"),
                            number_attribute<double>(file, "particles")};
  });
}

RunProgress read_run_progress(const std::filesystem::path& path) {
  return guarded_read(path, [&] { return read_progress(open_to_read(path).openGroup("run")); });
}

template <class Geometry>
RunProgress read_checkpoint(const std::filesystem::path& path, Simulation<Geometry>& s) {
  const std::size_t padded = s.particles.id.size();
  auto progress = guarded_read(path, [&] {
    const auto file = open_to_read(path);
    each_stored_item(s, Reader{file.openGroup("simulation")});
    return read_progress(file.openGroup("run"));
  });
  check_lengths(path, s, padded);
  s.moved_when_pruned = -1;
  if (s.rebuilds > 0) {
    complete_images(s.surfaces, list_reach(s), s.images);
    s.records.motion.resize(padded + s.images.list.size());
    s.records.stress.resize(padded + s.images.list.size());
  }
  return progress;
}

template std::string checkpoint_image(const CheckpointHeader&, Simulation<PlaneStrain>&, const RunProgress&);
template std::string checkpoint_image(const CheckpointHeader&, Simulation<Axisymmetric>&, const RunProgress&);
template void write_checkpoint(const std::filesystem::path&, const std::filesystem::path&,
                               const CheckpointHeader&, Simulation<PlaneStrain>&, const RunProgress&);
template void write_checkpoint(const std::filesystem::path&, const std::filesystem::path&,
                               const CheckpointHeader&, Simulation<Axisymmetric>&, const RunProgress&);
template RunProgress read_checkpoint(const std::filesystem::path&, Simulation<PlaneStrain>&);
template RunProgress read_checkpoint(const std::filesystem::path&, Simulation<Axisymmetric>&);
template std::string checkpoint_image(const CheckpointHeader&, Simulation<ThreeDimensional>&,
                                      const RunProgress&);
template void write_checkpoint(const std::filesystem::path&, const std::filesystem::path&,
                               const CheckpointHeader&, Simulation<ThreeDimensional>&, const RunProgress&);
template RunProgress read_checkpoint(const std::filesystem::path&, Simulation<ThreeDimensional>&);

} // namespace host
