// SPDX-License-Identifier: BSD-3-Clause
#include "host/output.hpp"
#include <H5Cpp.h>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <fmt/format.h>
#include <fstream>
#include <iostream>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <system_error>

namespace host {
namespace {

constexpr int format_version = 1;
constexpr hsize_t rows_per_chunk = 16384; ///< 128 KiB per component, within HDF5's chunk cache
constexpr hsize_t samples_per_chunk = 512;

const H5::PredType& real() {
  return H5::PredType::NATIVE_DOUBLE;
}

H5::StrType text_type(const std::string& text) {
  H5::StrType type(H5::PredType::C_S1, std::max<std::size_t>(text.size(), 1));
  type.setCset(H5T_CSET_UTF8);
  return type;
}

/// Keeps the destructors of HDF5's handles from printing when a full disk makes them fail: the error
/// that led there has been thrown.
class QuietDestructors {
public:
  QuietDestructors() : kept(std::cerr.rdbuf(nullptr)) {}
  ~QuietDestructors() { std::cerr.rdbuf(kept); }
  QuietDestructors(const QuietDestructors&) = delete;
  QuietDestructors& operator=(const QuietDestructors&) = delete;

private:
  std::streambuf* kept;
};

/// Makes folder and file writable or says why they are not: HDF5's own text does not.
void require_writable(const std::filesystem::path& path) {
  std::error_code error;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), error);
  if (error)
    throw std::runtime_error(fmt::format("{}: cannot create the output folder ({})",
                                         path.parent_path().string(), error.message()));
  std::FILE* file = std::fopen(path.c_str(), "ab");
  if (!file)
    throw std::runtime_error(fmt::format("{}: cannot create the result file ({})", path.string(),
                                         std::generic_category().message(errno)));
  std::fclose(file);
}

void attribute(const H5::H5Object& object, const std::string& name, const std::string& text) {
  const auto type = text_type(text);
  object.createAttribute(name, type, H5::DataSpace(H5S_SCALAR)).write(type, text);
}

void attribute(const H5::H5Object& object, const std::string& name, int value) {
  object.createAttribute(name, H5::PredType::NATIVE_INT, H5::DataSpace(H5S_SCALAR))
      .write(H5::PredType::NATIVE_INT, &value);
}

void attribute(const H5::H5Object& object, const std::string& name, double value) {
  object.createAttribute(name, real(), H5::DataSpace(H5S_SCALAR)).write(real(), &value);
}

/// A dataset of n rows, (n) or (n, components).
void write_dataset(const H5::Group& group, const std::string& name, const std::string& unit,
                   const std::vector<double>& values, int components = 1) {
  const hsize_t rows = values.size() / components, columns = components;
  const hsize_t size[2] = {rows, columns}, chunk[2] = {std::clamp<hsize_t>(rows, 1, rows_per_chunk), columns};
  const int rank = components > 1 ? 2 : 1;
  H5::DSetCreatPropList properties;
  properties.setChunk(rank, chunk);
  properties.setShuffle();
  properties.setDeflate(1);
  const auto dataset = group.createDataSet(name, real(), H5::DataSpace(rank, size), properties);
  attribute(dataset, "unit", unit);
  if (!values.empty()) dataset.write(values.data(), real());
}

/// The field as rows in the order of creation, components interleaved.
std::vector<double> in_original_order(const Field& field, std::span<const std::int32_t> original,
                                      std::size_t particles) {
  const std::size_t components = field.components.size();
  if (components == 0) throw std::invalid_argument(fmt::format("field {} has no component", field.name));
  const std::size_t rows = field.components[0].size();
  if (std::any_of(field.components.begin(), field.components.end(),
                  [=](auto c) { return c.size() != rows; }) ||
      (original.empty() ? rows != particles : rows != original.size()))
    throw std::invalid_argument(fmt::format("field {} does not fit {} particles", field.name, particles));
  std::vector<double> values(particles * components);
  std::vector<bool> seen(particles);
  std::size_t written = 0;
  for (std::size_t i = 0; i < rows; ++i) {
    const std::int64_t to = original.empty() ? std::int64_t(i) : original[i];
    if (to < 0) continue;
    if (std::size_t(to) >= particles || seen[to])
      throw std::invalid_argument(fmt::format("field {}: particle number {} out of place", field.name, to));
    seen[to] = true;
    ++written;
    for (std::size_t c = 0; c < components; ++c) values[to * components + c] = field.components[c][i];
  }
  if (written != particles)
    throw std::invalid_argument(
        fmt::format("field {} covers {} of {} particles", field.name, written, particles));
  return values;
}

/// All fields before the first is written: a misfit leaves nothing behind.
std::vector<std::vector<double>> in_original_order(std::span<const Field> fields,
                                                   std::span<const std::int32_t> original,
                                                   std::size_t particles) {
  std::vector<std::vector<double>> values;
  for (const Field& f : fields) values.push_back(in_original_order(f, original, particles));
  return values;
}

void write_fields(const H5::Group& group, std::span<const Field> fields,
                  const std::vector<std::vector<double>>& values) {
  for (std::size_t f = 0; f < fields.size(); ++f)
    write_dataset(group, fields[f].name, fields[f].unit, values[f], int(fields[f].components.size()));
}

/// One time of the ParaView collection. The points of a Polyvertex are numbered outright: ParaView's
/// Xdmf3 readers show nothing without it.
std::string xdmf_grid(const std::string& file, const std::string& group, double time, std::size_t particles,
                      std::span<const Field> fields) {
  const auto item = [&](const Field& f) {
    const std::size_t components = f.components.size();
    const auto size =
        components > 1 ? fmt::format("{} {}", particles, components) : fmt::to_string(particles);
    return fmt::format("<DataItem Dimensions=\"{}\" NumberType=\"Float\" Precision=\"8\" "
                       "Format=\"HDF\">{}:{}/{}</DataItem>",
                       size, file, group, f.name);
  };
  std::string text =
      fmt::format("   <Grid Name=\"particles\">\n    <Time Value=\"{}\"/>\n"
                  "    <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\" NodesPerElement=\"1\">"
                  "<DataItem Dimensions=\"{}\" NumberType=\"Int\" Precision=\"8\" Format=\"HDF\">"
                  "{}:/particles/number</DataItem></Topology>\n",
                  time, particles, particles, file);
  for (const Field& f : fields) {
    if (f.name == "position")
      text += fmt::format("    <Geometry GeometryType=\"{}\">{}</Geometry>\n",
                          f.components.size() == 2 ? "XY" : "XYZ", item(f));
    else
      text += fmt::format("    <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Node\">{}</Attribute>\n",
                          f.name,
                          f.components.size() == 1   ? "Scalar"
                          : f.components.size() <= 3 ? "Vector"
                                                     : "Matrix",
                          item(f));
  }
  return text + "   </Grid>\n";
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

  /// Runs `write` and turns HDF5's exceptions into one line that names file and object.
  template <class Write> void guarded(const std::string& what, const Write& write) const {
    const QuietDestructors quiet;
    try {
      write();
    } catch (const H5::Exception& e) {
      std::error_code error;
      const auto space = std::filesystem::space(path.parent_path().empty() ? "." : path.parent_path(), error);
      const std::string free =
          error ? "" : fmt::format("; {:.1f} MB free on its disk", double(space.available) / 1e6);
      throw std::runtime_error(
          fmt::format("{}: cannot write {} ({}{})", path.string(), what, e.getDetailMsg(), free));
    } catch (const std::invalid_argument& e) {
      throw std::runtime_error(fmt::format("{}: cannot write {} ({})", path.string(), what, e.what()));
    }
  }

  const H5::H5File& h5() const {
    if (!file) throw std::invalid_argument("the file is closed");
    return *file;
  }

  void flush() const { h5().flush(H5F_SCOPE_GLOBAL); }

  /// Written beside and renamed, so that a reader never meets half a file.
  void write_xdmf(const std::filesystem::path& to) const {
    const std::filesystem::path part = to.string() + ".part";
    std::ofstream out(part);
    out << "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n <Domain>\n"
           "  <Grid Name=\"run\" GridType=\"Collection\" CollectionType=\"Temporal\">\n"
        << xdmf_grids << "  </Grid>\n </Domain>\n</Xdmf>\n";
    out.close();
    std::error_code error;
    if (out) std::filesystem::rename(part, to, error);
    if (!out || error) throw std::runtime_error(fmt::format("{}: cannot write the XDMF file", to.string()));
  }
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
  impl->write_xdmf(xdmf_path());
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
  impl->write_xdmf(xdmf_path());
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
