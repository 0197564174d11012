// SPDX-License-Identifier: BSD-3-Clause
#include "host/output.hpp"
#include "host/field_rows.hpp"
#include "host/hdf5_write.hpp"
#include "host/xdmf.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <numeric>
#include <optional>
#include <stdexcept>

namespace host {
namespace {

constexpr int format_version = 1;
constexpr hsize_t samples_per_chunk = 512;

void write_fields(const H5::Group& group, std::span<const Field> fields,
                  const std::vector<std::vector<double>>& values) {
  for (std::size_t f = 0; f < fields.size(); ++f)
    write_dataset(group, fields[f].name, fields[f].unit, values[f], int(fields[f].components.size()));
}

} // namespace

struct ResultFile::Impl {
  std::filesystem::path path;
  std::size_t particles;
  std::optional<H5::H5File> file; ///< from construction to close()
  std::vector<H5::DataSet> series;
  hsize_t samples = 0;
  std::size_t radii = 0;
  int snapshots = 0;
  std::string xdmf_grids;

  void guarded(const std::string& what, const std::function<void()>& write) const {
    guarded_write(path, what, write);
  }

  const H5::H5File& h5() const {
    if (!file) throw std::invalid_argument("the file is closed");
    return *file;
  }

  void flush() const { h5().flush(H5F_SCOPE_GLOBAL); }
};

ResultFile::ResultFile(const std::filesystem::path& path, const ResultHeader& header,
                       const std::vector<Quantity>& series)
    : impl(new Impl{path, header.particles, {}, {}, 0, 0, 0, {}}) {
  H5::Exception::dontPrint();
  require_writable(path);
  impl->guarded("the header", [&] {
    H5::FileAccPropList access;
    H5Pset_file_locking(access.getId(), true, true); // where the disk knows no locks, go without
    impl->file.emplace(path.string(), H5F_ACC_TRUNC, H5::FileCreatPropList::DEFAULT, access);
    attribute(impl->h5(), "format_version", format_version);
    attribute(impl->h5(), "simsand_version", header.version);
    attribute(impl->h5(), "compiler", header.compiler);
    attribute(impl->h5(), "geometry", header.geometry);
    attribute(impl->h5(), "dimension", header.dimension);
    attribute(impl->h5(), "complete", 0);
    const auto text = text_type(header.scene);
    impl->h5().createDataSet("scene", text, H5::DataSpace(H5S_SCALAR)).write(header.scene, text);
    for (const char* group : {"particles", "outline", "snapshots", "series", "summary"})
      impl->h5().createGroup(group);

    std::vector<std::int64_t> number(header.particles);
    std::iota(number.begin(), number.end(), 0);
    const hsize_t count = header.particles;
    impl->h5()
        .createDataSet("particles/number", H5::PredType::NATIVE_INT64, H5::DataSpace(1, &count))
        .write(number.data(), H5::PredType::NATIVE_INT64);

    const hsize_t none = 0, unlimited = H5S_UNLIMITED;
    H5::DSetCreatPropList properties;
    properties.setChunk(1, &samples_per_chunk);
    for (const Quantity& column : series) {
      impl->series.push_back(impl->h5().createDataSet("series/" + column.name, real(),
                                                      H5::DataSpace(1, &none, &unlimited), properties));
      attribute(impl->series.back(), "unit", column.unit);
    }
    impl->flush();
  });
  write_xdmf(xdmf_path(), impl->xdmf_grids);
}

ResultFile::~ResultFile() {
  const QuietDestructors quiet;
  impl.reset();
}

void ResultFile::particles(std::span<const Field> fields, std::span<const std::int32_t> original) {
  impl->guarded("/particles", [&] {
    const auto values = in_original_order(fields, original, impl->particles);
    write_fields(impl->h5().openGroup("particles"), fields, values);
    impl->flush();
  });
}

void ResultFile::outline_radii(std::span<const double> radii) {
  impl->guarded("/outline", [&] {
    write_dataset(impl->h5().openGroup("outline"), "r", "m", {radii.begin(), radii.end()});
    impl->radii = radii.size();
    impl->flush();
  });
}

void ResultFile::snapshot(double time, std::span<const Field> fields, std::span<const std::int32_t> original,
                          std::span<const double> outline) {
  const std::string name = fmt::format("/snapshots/{:04d}", impl->snapshots);
  impl->guarded(name, [&] {
    if (std::none_of(fields.begin(), fields.end(), [](const Field& f) { return f.name == "position"; }))
      throw std::invalid_argument("no position among its fields");
    if (!outline.empty() && outline.size() != impl->radii)
      throw std::invalid_argument(
          fmt::format("outline of {} heights for {} radii", outline.size(), impl->radii));
    const auto values = in_original_order(fields, original, impl->particles);
    const auto group = impl->h5().createGroup(name);
    write_fields(group, fields, values);
    if (!outline.empty()) write_dataset(group, "outline", "m", {outline.begin(), outline.end()});
    attribute(group, "time", time); // last: its presence says that the snapshot is whole
    impl->flush();
  });
  ++impl->snapshots;
  impl->xdmf_grids += xdmf_grid(impl->path.filename().string(), name, time, impl->particles, fields);
  write_xdmf(xdmf_path(), impl->xdmf_grids);
}

void ResultFile::sample(std::span<const double> row) {
  impl->guarded("/series", [&] {
    if (row.size() != impl->series.size())
      throw std::invalid_argument(fmt::format("{} values for {} columns", row.size(), impl->series.size()));
    const hsize_t length = impl->samples + 1, one = 1;
    for (std::size_t c = 0; c < row.size(); ++c) {
      impl->series[c].extend(&length);
      auto target = impl->series[c].getSpace();
      target.selectHyperslab(H5S_SELECT_SET, &one, &impl->samples);
      impl->series[c].write(&row[c], real(), H5::DataSpace(1, &one), target);
    }
    impl->flush();
  });
  ++impl->samples;
}

void ResultFile::summary(const Quantity& quantity, double value) {
  impl->guarded("/summary/" + quantity.name, [&] {
    const auto group = impl->h5().openGroup("summary");
    if (group.nameExists(quantity.name)) group.unlink(quantity.name);
    const auto dataset = group.createDataSet(quantity.name, real(), H5::DataSpace(H5S_SCALAR));
    attribute(dataset, "unit", quantity.unit);
    dataset.write(&value, real());
    impl->flush();
  });
}

void ResultFile::close() {
  impl->guarded("the mark of completeness", [&] {
    const int complete = 1;
    impl->h5().openAttribute("complete").write(H5::PredType::NATIVE_INT, &complete);
    impl->flush();
    impl->series.clear();
    impl->file.reset();
  });
}

const std::filesystem::path& ResultFile::path() const {
  return impl->path;
}

std::filesystem::path ResultFile::xdmf_path() const {
  auto path = impl->path;
  return path.replace_extension(".xdmf");
}

std::string stored_scene(const std::filesystem::path& path) {
  H5::Exception::dontPrint();
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw std::runtime_error(fmt::format("{}: no such file", path.string()));
  try {
    std::string scene;
    const auto dataset = H5::H5File(path.string(), H5F_ACC_RDONLY).openDataSet("scene");
    dataset.read(scene, dataset.getStrType());
    return scene;
  } catch (const H5::Exception&) {
    throw std::runtime_error(
        fmt::format("{}: not a readable result file with a stored scene", path.string()));
  }
}

} // namespace host
