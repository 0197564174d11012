// SPDX-License-Identifier: BSD-3-Clause
// Reading of HDF5: arrays, texts and attributes. All functions throw H5::Exception if an object is missing or of another
// kind.
#pragma once
#include "host/files/hdf5_write.hpp"

namespace host {

/// Opens for reading. Takes no lock, for files here never change in place.
H5::H5File open_to_read(const std::filesystem::path& path);

std::string text_attribute(const H5::H5Object& object, const std::string& name);
template <class T> T number_attribute(const H5::H5Object& object, const std::string& name) {
  T value{};
  object.openAttribute(name).read(number_type<T>(), &value);
  return value;
}

std::string read_text(const H5::Group& group, const std::string& name);
Extents extents_of(const H5::Group& group, const std::string& name);

/// All values of an array, the last extent fastest.
template <class T> std::vector<T> read_array(const H5::Group& group, const std::string& name) {
  const auto dataset = group.openDataSet(name);
  std::vector<T> values(std::size_t(dataset.getSpace().getSimpleExtentNpoints()));
  if (!values.empty()) dataset.read(values.data(), number_type<T>());
  return values;
}

/// Names of the objects in a group, sorted.
std::vector<std::string> names_in(const H5::Group& group);

} // namespace host
