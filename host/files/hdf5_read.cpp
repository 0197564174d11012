// SPDX-License-Identifier: BSD-3-Clause
#include "host/files/hdf5_read.hpp"

namespace host {

H5::H5File open_to_read(const std::filesystem::path& path) {
  H5::FileAccPropList access;
  H5Pset_file_locking(access.getId(), false, true);
  return {path.string(), H5F_ACC_RDONLY, H5::FileCreatPropList::DEFAULT, access};
}

std::string text_attribute(const H5::H5Object& object, const std::string& name) {
  std::string text;
  const auto attribute = object.openAttribute(name);
  attribute.read(attribute.getStrType(), text);
  return text.c_str(); // without the zeros that pad it
}

std::string read_text(const H5::Group& group, const std::string& name) {
  std::string text;
  const auto dataset = group.openDataSet(name);
  dataset.read(text, dataset.getStrType());
  return text;
}

Extents extents_of(const H5::Group& group, const std::string& name) {
  const auto space = group.openDataSet(name).getSpace();
  Extents extents(std::size_t(space.getSimpleExtentNdims()));
  space.getSimpleExtentDims(extents.data());
  return extents;
}

std::vector<std::string> names_in(const H5::Group& group) {
  std::vector<std::string> names;
  for (hsize_t k = 0; k < group.getNumObjs(); ++k) names.push_back(group.getObjnameByIdx(k));
  return names;
}

} // namespace host
