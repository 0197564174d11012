// SPDX-License-Identifier: BSD-3-Clause
#include "host/files/hdf5_write.hpp"
#include <algorithm>
#include <cerrno>
#include <fmt/format.h>
#include <stdexcept>
#include <system_error>
#include <unistd.h>

namespace host {
namespace {

constexpr hsize_t rows_per_chunk = 16384; ///< 128 KiB per component, within HDF5's chunk cache
constexpr hsize_t rows_per_piece = 512;   ///< of a growing array

H5::StrType text_type(const std::string& text) {
  H5::StrType type(H5::PredType::C_S1, std::max<std::size_t>(text.size(), 1));
  type.setCset(H5T_CSET_UTF8);
  return type;
}

template <class T> void number(const H5::H5Object& object, const std::string& name, T value) {
  object.createAttribute(name, number_type<T>(), H5::DataSpace(H5S_SCALAR)).write(number_type<T>(), &value);
}

void write_unit(const H5::Group& group, const std::string& name, const std::string& unit) {
  attribute(group.openDataSet(name), "unit", unit);
}

} // namespace

void guarded_write(const std::filesystem::path& path, const std::string& what,
                   const std::function<void()>& write) {
  const QuietDestructors quiet;
  const auto fail = [&](const std::string& reason) {
    std::error_code error;
    const auto space = std::filesystem::space(path.parent_path().empty() ? "." : path.parent_path(), error);
    const std::string free =
        error ? "" : fmt::format("; {:.1f} MB free on its disk", double(space.available) / 1e6);
    throw std::runtime_error(fmt::format("{}: cannot write {} ({}{})", path.string(), what, reason, free));
  };
  try {
    write();
  } catch (const H5::Exception& e) {
    fail(e.getDetailMsg());
  } catch (const std::system_error& e) {
    fail(e.code().message());
  } catch (const std::invalid_argument& e) {
    throw std::runtime_error(fmt::format("{}: cannot write {} ({})", path.string(), what, e.what()));
  }
}

void require_writable(const std::filesystem::path& path) {
  std::error_code error;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), error);
  if (error)
    throw std::runtime_error(fmt::format("{}: cannot create the output folder ({})",
                                         path.parent_path().string(), error.message()));
  const auto refuse = [&](int reason) {
    throw std::runtime_error(fmt::format("{}: cannot create the result file ({})", path.string(),
                                         std::generic_category().message(reason)));
  };
  if (std::filesystem::is_directory(path, error)) refuse(EISDIR);
  if (access(path.has_parent_path() ? path.parent_path().c_str() : ".", W_OK) != 0) refuse(errno);
}

H5::H5File memory_file() {
  constexpr std::size_t growth = 1 << 20; // bytes
  H5::FileAccPropList access;
  access.setCore(growth, false);
  return {"in memory", H5F_ACC_TRUNC, H5::FileCreatPropList::DEFAULT, access};
}

std::string file_image(const H5::H5File& file) {
  file.flush(H5F_SCOPE_GLOBAL);
  const auto size = H5Fget_file_image(file.getId(), nullptr, 0);
  std::string bytes(std::size_t(std::max<ssize_t>(size, 0)), 0);
  if (size <= 0 || H5Fget_file_image(file.getId(), bytes.data(), bytes.size()) != size)
    throw H5::FileIException("file_image", "no image of the file in memory");
  return bytes;
}

void write_array(const H5::Group& group, const std::string& name, const H5::PredType& type,
                 const void* values, const Extents& extents, Storage storage) {
  const int rank = int(extents.size());
  const Extents unlimited(extents.size(), H5S_UNLIMITED);
  const H5::DataSpace space(rank, extents.data(), storage == Storage::growing ? unlimited.data() : nullptr);
  H5::DSetCreatPropList properties;
  if (storage != Storage::plain) {
    Extents chunk = extents;
    chunk.front() = storage == Storage::growing ? rows_per_piece
                                                : std::clamp<hsize_t>(extents.front(), 1, rows_per_chunk);
    properties.setChunk(rank, chunk.data());
  }
  if (storage == Storage::compressed) {
    properties.setShuffle();
    properties.setDeflate(1);
  }
  const auto dataset = group.createDataSet(name, type, space, properties);
  if (space.getSimpleExtentNpoints() > 0) dataset.write(values, type);
}

void write_text(const H5::Group& group, const std::string& name, const std::string& text) {
  const auto type = text_type(text);
  group.createDataSet(name, type, H5::DataSpace(H5S_SCALAR)).write(text, type);
}

void attribute(const H5::H5Object& object, const std::string& name, const std::string& text) {
  const auto type = text_type(text);
  object.createAttribute(name, type, H5::DataSpace(H5S_SCALAR)).write(type, text);
}

void attribute(const H5::H5Object& object, const std::string& name, int value) {
  number(object, name, value);
}

void attribute(const H5::H5Object& object, const std::string& name, std::int64_t value) {
  number(object, name, value);
}

void attribute(const H5::H5Object& object, const std::string& name, double value) {
  number(object, name, value);
}

void write_dataset(const H5::Group& group, const std::string& name, const std::string& unit,
                   const std::vector<double>& values, int components) {
  const hsize_t columns = hsize_t(components), rows = values.size() / columns;
  write_array(group, name, values.data(), components > 1 ? Extents{rows, columns} : Extents{rows},
              Storage::compressed);
  write_unit(group, name, unit);
}

void write_scalar(const H5::Group& group, const std::string& name, const std::string& unit, double value) {
  const auto dataset = group.createDataSet(name, number_type<double>(), H5::DataSpace(H5S_SCALAR));
  dataset.write(&value, number_type<double>());
  attribute(dataset, "unit", unit);
}

void write_column(const H5::Group& group, const std::string& name, const std::string& unit,
                  const std::vector<double>& values) {
  write_array(group, name, values.data(), {values.size()}, Storage::growing);
  write_unit(group, name, unit);
}

} // namespace host
