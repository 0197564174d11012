// SPDX-License-Identifier: BSD-3-Clause
#include "host/files/output.hpp"
#include "host/files/field_rows.hpp"
#include "host/files/hdf5_read.hpp"
#include "host/files/hdf5_write.hpp"
#include "host/files/seal.hpp"
#include "host/files/whole_file.hpp"
#include "host/files/xdmf.hpp"
#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <map>
#include <numeric>
#include <optional>
#include <stdexcept>

namespace host {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int format_version = 1;
constexpr auto snapshot_name = "{:04d}";
constexpr auto constants = "particles"; ///< group and part of what never changes

void write_fields(const H5::Group& group, std::span<const Field> fields,
                  const std::vector<std::vector<double>>& values) {
  for (std::size_t f = 0; f < fields.size(); ++f)
    write_dataset(group, fields[f].name, fields[f].unit, values[f], int(fields[f].components.size()));
}

} // namespace

struct ResultFile::Impl {
  std::filesystem::path path, parts;
  ResultHeader header;
  std::vector<Quantity> columns;
  std::vector<double> radii;
  std::map<std::string, std::pair<std::string, double>> summary; ///< unit and value by name
  ResultProgress done;
  std::optional<FolderLock> lock;
  std::vector<std::filesystem::path> left_out;
  bool closed = false, pending = false; ///< pending: samples that are not on disk
  Clock::time_point written;
  Clock::duration cost{};

  Impl(const std::filesystem::path& result, const ResultHeader& head, const std::vector<Quantity>& series)
      : path(result), parts(parts_folder(result)), header(head), columns(series) {
    H5::Exception::dontPrint();
    require_writable(path);
    std::error_code error;
    std::filesystem::create_directory(parts, error);
    if (error)
      throw std::runtime_error(
          fmt::format("{}: cannot create the folder of its snapshots ({})", path.string(), error.message()));
    lock.emplace(parts, path);
    done.columns = columns;
    done.series.resize(columns.size());
  }

  void guarded(const std::string& what, const std::function<void()>& write) const {
    guarded_write(path, what, [&] {
      if (closed) throw std::invalid_argument("the file is closed");
      write();
    });
  }

  std::string name_of(int snapshot) const { return fmt::format(snapshot_name, snapshot); }
  std::filesystem::path part(const std::string& name) const { return parts / (name + ".h5"); }

  /// Numbers of the snapshots that are there.
  std::vector<int> kept() const {
    std::vector<int> numbers;
    for (int s = 0; s < done.snapshots; ++s)
      if (std::ranges::find(done.lost, s) == done.lost.end()) numbers.push_back(s);
    return numbers;
  }

  /// Writes one group, `name`, as a file of its own.
  void write_part(const std::string& name, const std::function<void(const H5::Group&)>& fill) const {
    const auto file = memory_file();
    fill(file.createGroup(name));
    write_whole(part(name), sealed(file_image(file)));
  }

  /// All but snapshots and constants.
  void write_head(const H5::H5File& file, bool complete) const {
    attribute(file, "format_version", format_version);
    attribute(file, "simsand_version", header.version);
    attribute(file, "compiler", header.compiler);
    attribute(file, "build", header.build);
    attribute(file, "geometry", header.geometry);
    attribute(file, "dimension", header.dimension);
    attribute(file, "complete", int(complete));
    write_text(file, "scene", header.scene);
    const auto series = file.createGroup("series"), totals = file.createGroup("summary");
    for (std::size_t c = 0; c < columns.size(); ++c)
      write_column(series, columns[c].name, columns[c].unit, done.series[c]);
    for (const auto& [name, entry] : summary) write_scalar(totals, name, entry.first, entry.second);
    const auto outline = file.createGroup("outline");
    if (!radii.empty()) write_dataset(outline, "r", "m", radii);
    file.createGroup("snapshots");
  }

  /// Replaces the result by one that links to the parts.
  void write_links() {
    const auto start = Clock::now();
    const auto file = memory_file();
    write_head(file, false);
    const auto link = [&](const std::string& name, const std::string& at) {
      const auto target = (parts.filename() / (name + ".h5")).string();
      if (H5Lcreate_external(target.c_str(), ("/" + name).c_str(), file.getId(), at.c_str(), H5P_DEFAULT,
                             H5P_DEFAULT) < 0)
        throw H5::FileIException("H5Lcreate_external", "no link to " + target);
    };
    link(constants, constants);
    for (const int s : kept()) link(name_of(s), "snapshots/" + name_of(s));
    write_whole(path, sealed(file_image(file)));
    pending = false;
    written = Clock::now();
    cost = written - start;
  }

  /// Bytes of the joined file, at most.
  std::uintmax_t joined_size() const {
    std::uintmax_t size = std::filesystem::file_size(path) + (1 << 16);
    for (const auto& file : std::filesystem::directory_iterator(parts)) size += file.file_size();
    return size;
  }

  /// Replaces the result by one that holds the parts.
  void join() const {
    require_room(path, joined_size()); // HDF5 crashes if the disk is full when it closes a file
    {
      H5::FileAccPropList access;
      H5Pset_file_locking(access.getId(), true, true); // no error on file systems without locks
      const H5::H5File file(aside(path).string(), H5F_ACC_TRUNC, H5::FileCreatPropList::DEFAULT, access);
      write_head(file, true);
      const auto copy = [&](const std::string& name, const std::string& at) {
        if (H5Ocopy(open_to_read(part(name)).getId(), name.c_str(), file.getId(), at.c_str(), H5P_DEFAULT,
                    H5P_DEFAULT) < 0)
          throw H5::FileIException("H5Ocopy", "no copy of " + part(name).string());
      };
      copy(constants, constants);
      for (const int s : kept()) copy(name_of(s), "snapshots/" + name_of(s));
      file.flush(H5F_SCOPE_GLOBAL);
    }
    append_seal(aside(path));
    take_place(path);
  }

  /// Leaves out the snapshots that cannot be read.
  void drop_unreadable() {
    for (const int s : kept()) {
      if (has_intact_seal(part(name_of(s)))) continue;
      done.lost.push_back(s);
      done.xdmf = without_xdmf_grid(done.xdmf, "/snapshots/" + name_of(s) + "/");
      left_out.push_back(part(name_of(s)));
    }
  }
};

ResultFile::ResultFile(const std::filesystem::path& path, const ResultHeader& header,
                       const std::vector<Quantity>& series)
    : impl(new Impl(path, header, series)) {
  std::error_code ignored;
  for (const auto& old : std::filesystem::directory_iterator(impl->parts))
    std::filesystem::remove(old.path(), ignored);
  particles({});
  impl->guarded("the header", [&] { impl->write_links(); });
  write_xdmf(xdmf_path(), impl->done.xdmf);
}

ResultFile::ResultFile(const std::filesystem::path& path, const ResultHeader& header,
                       const std::vector<Quantity>& series, const ResultProgress& progress)
    : impl(new Impl(path, header, series)) {
  impl->done = progress;
  impl->drop_unreadable();
  impl->done.columns = series;
  impl->done.series.resize(series.size());
  impl->pending = true; // with the outline's radii, or later
  write_xdmf(xdmf_path(), impl->done.xdmf);
}

ResultFile::~ResultFile() {
  const QuietDestructors quiet;
  try {
    if (!impl->closed && impl->pending) impl->write_links();
  } catch (...) {} // a destructor must not throw; the error that led here is being handled
  impl.reset();
}

void ResultFile::particles(std::span<const Field> fields, std::span<const std::int32_t> original) {
  impl->guarded("/particles", [&] {
    const auto values = in_original_order(fields, original, impl->header.particles);
    impl->write_part(constants, [&](const H5::Group& group) {
      std::vector<std::int64_t> number(impl->header.particles);
      std::iota(number.begin(), number.end(), 0);
      write_array(group, "number", number.data(), {number.size()});
      write_fields(group, fields, values);
    });
  });
}

void ResultFile::outline_radii(std::span<const double> radii) {
  impl->radii.assign(radii.begin(), radii.end());
  impl->guarded("/outline", [&] { impl->write_links(); });
}

void ResultFile::snapshot(double time, std::span<const Field> fields, std::span<const std::int32_t> original,
                          std::span<const double> outline) {
  const std::string name = impl->name_of(impl->done.snapshots);
  impl->guarded("/snapshots/" + name, [&] {
    if (std::none_of(fields.begin(), fields.end(), [](const Field& f) { return f.name == "position"; }))
      throw std::invalid_argument("no position among its fields");
    if (!outline.empty() && outline.size() != impl->radii.size())
      throw std::invalid_argument(
          fmt::format("outline of {} heights for {} radii", outline.size(), impl->radii.size()));
    const auto values = in_original_order(fields, original, impl->header.particles);
    impl->write_part(name, [&](const H5::Group& group) {
      write_fields(group, fields, values);
      if (!outline.empty()) write_dataset(group, "outline", "m", {outline.begin(), outline.end()});
      attribute(group, "time", time);
    });
    ++impl->done.snapshots;
    impl->write_links();
  });
  impl->done.xdmf +=
      xdmf_grid(impl->path.filename().string(), "/snapshots/" + name, time, impl->header.particles, fields);
  write_xdmf(xdmf_path(), impl->done.xdmf);
}

void ResultFile::sample(std::span<const double> row) {
  impl->guarded("/series", [&] {
    if (row.size() != impl->columns.size())
      throw std::invalid_argument(fmt::format("{} values for {} columns", row.size(), impl->columns.size()));
    for (std::size_t c = 0; c < row.size(); ++c) impl->done.series[c].push_back(row[c]);
    impl->pending = true;
    if (Clock::now() - impl->written > 20 * impl->cost) impl->write_links();
  });
}

void ResultFile::summary(const Quantity& quantity, double value) {
  impl->guarded("/summary/" + quantity.name, [&] { impl->summary[quantity.name] = {quantity.unit, value}; });
}

void ResultFile::flush() {
  impl->guarded("/series", [&] {
    if (impl->pending) impl->write_links();
  });
}

ResultProgress ResultFile::progress() const {
  return impl->done;
}

const std::vector<std::filesystem::path>& ResultFile::left_out() const {
  return impl->left_out;
}

void ResultFile::close() {
  std::error_code ignored;
  try {
    impl->guarded("the joined snapshots", [&] { impl->join(); });
  } catch (...) {
    std::filesystem::remove(aside(impl->path), ignored);
    throw;
  }
  impl->closed = true;
  std::filesystem::remove_all(impl->parts, ignored);
  impl->lock.reset();
}

const std::filesystem::path& ResultFile::path() const {
  return impl->path;
}

std::filesystem::path ResultFile::xdmf_path() const {
  auto path = impl->path;
  return path.replace_extension(".xdmf");
}

std::filesystem::path parts_folder(const std::filesystem::path& result) {
  auto path = result;
  return path.replace_extension(".parts");
}

} // namespace host
