// SPDX-License-Identifier: BSD-3-Clause
// Writing of HDF5: errors in one line, files that are built in memory, arrays, texts and attributes. Everything that the
// project writes as HDF5 goes through here.
#pragma once
#include <H5Cpp.h>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iostream>
#include <string>
#include <type_traits>
#include <vector>

namespace host {

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

/// Runs `write` and turns HDF5's exceptions, those of the system and std::invalid_argument into one std::runtime_error that
/// names the file and `what` was being written.
void guarded_write(const std::filesystem::path& path, const std::string& what,
                   const std::function<void()>& write);

/// Makes the folder of `path`, or says why the file cannot be written there.
void require_writable(const std::filesystem::path& path);

/// An HDF5 file that is built in memory: no disk can fail before it is whole.
H5::H5File memory_file();
/// The bytes of such a file, as they belong on disk.
std::string file_image(const H5::H5File& file);

/// The HDF5 type of a number.
template <class T> const H5::PredType& number_type() {
  if constexpr (std::is_same_v<T, double>)
    return H5::PredType::NATIVE_DOUBLE;
  else if constexpr (std::is_same_v<T, unsigned char>)
    return H5::PredType::NATIVE_UCHAR;
  else if constexpr (sizeof(T) == 4)
    return H5::PredType::NATIVE_INT32;
  else
    return H5::PredType::NATIVE_INT64;
}

/// Lengths of an array, the last extent fastest.
using Extents = std::vector<hsize_t>;

/// How an array lies in the file: as it is, compressed, or in pieces so that it could grow.
enum class Storage { plain, compressed, growing };

void write_array(const H5::Group& group, const std::string& name, const H5::PredType& type,
                 const void* values, const Extents& extents, Storage storage);
template <class T>
void write_array(const H5::Group& group, const std::string& name, const T* values, const Extents& extents,
                 Storage storage = Storage::plain) {
  write_array(group, name, number_type<T>(), values, extents, storage);
}

void write_text(const H5::Group& group, const std::string& name, const std::string& text);

void attribute(const H5::H5Object& object, const std::string& name, const std::string& text);
void attribute(const H5::H5Object& object, const std::string& name, int value);
void attribute(const H5::H5Object& object, const std::string& name, std::int64_t value);
void attribute(const H5::H5Object& object, const std::string& name, double value);

/// Numbers with a unit: n rows, (n) or (n, components), compressed.
void write_dataset(const H5::Group& group, const std::string& name, const std::string& unit,
                   const std::vector<double>& values, int components = 1);

/// A scalar with a unit.
void write_scalar(const H5::Group& group, const std::string& name, const std::string& unit, double value);

/// A column of numbers with a unit; it may be empty.
void write_column(const H5::Group& group, const std::string& name, const std::string& unit,
                  const std::vector<double>& values);

} // namespace host
