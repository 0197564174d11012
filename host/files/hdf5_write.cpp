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

H5::H5File open_to_read(const std::filesystem::path& path) {
  H5::FileAccPropList access;
  H5Pset_file_locking(access.getId(), false, true);
  return {path.string(), H5F_ACC_RDONLY, H5::FileCreatPropList::DEFAULT, access};
}

const H5::PredType& real() {
  return H5::PredType::NATIVE_DOUBLE;
}

H5::StrType text_type(const std::string& text) {
  H5::StrType type(H5::PredType::C_S1, std::max<std::size_t>(text.size(), 1));
  type.setCset(H5T_CSET_UTF8);
  return type;
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

void write_dataset(const H5::Group& group, const std::string& name, const std::string& unit,
                   const std::vector<double>& values, int components) {
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

void write_column(const H5::Group& group, const std::string& name, const std::string& unit,
                  const std::vector<double>& values) {
  constexpr hsize_t rows_per_chunk = 512;
  const hsize_t rows = values.size(), unlimited = H5S_UNLIMITED;
  H5::DSetCreatPropList properties;
  properties.setChunk(1, &rows_per_chunk);
  const auto dataset = group.createDataSet(name, real(), H5::DataSpace(1, &rows, &unlimited), properties);
  attribute(dataset, "unit", unit);
  if (rows > 0) dataset.write(values.data(), real());
}

bool is_whole(const std::filesystem::path& file, const std::string& name, const std::string& last) {
  try {
    const auto group = open_to_read(file).openGroup(name);
    for (hsize_t k = 0; k < group.getNumObjs(); ++k) group.openDataSet(group.getObjnameByIdx(k));
    return group.attrExists(last);
  } catch (const H5::Exception&) {
    return false;
  }
}

} // namespace host
