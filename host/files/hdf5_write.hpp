// SPDX-License-Identifier: BSD-3-Clause
// What the result file asks of HDF5: errors in one line, attributes, datasets with a unit.
#pragma once
#include <H5Cpp.h>
#include <filesystem>
#include <functional>
#include <iostream>
#include <string>
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

/// Opens for reading. Takes no lock, for files here never change in place. Throws H5::Exception.
H5::H5File open_to_read(const std::filesystem::path& path);

const H5::PredType& real();
H5::StrType text_type(const std::string& text);

void attribute(const H5::H5Object& object, const std::string& name, const std::string& text);
void attribute(const H5::H5Object& object, const std::string& name, int value);
void attribute(const H5::H5Object& object, const std::string& name, double value);

/// A dataset of n rows, (n) or (n, components).
void write_dataset(const H5::Group& group, const std::string& name, const std::string& unit,
                   const std::vector<double>& values, int components = 1);

/// A column of numbers that may be empty.
void write_column(const H5::Group& group, const std::string& name, const std::string& unit,
                  const std::vector<double>& values);

/// True if the file can be read and its group `name` has all of its datasets and the attribute `last`, which was
/// written last.
bool is_whole(const std::filesystem::path& file, const std::string& name, const std::string& last);

} // namespace host
