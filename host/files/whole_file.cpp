// SPDX-License-Identifier: BSD-3-Clause
#include "host/files/whole_file.hpp"
#include <cerrno>
#include <fcntl.h>
#include <fmt/format.h>
#include <stdexcept>
#include <sys/file.h>
#include <system_error>
#include <unistd.h>

namespace host {
namespace {

/// A file descriptor that is closed whatever happens.
struct Descriptor {
  int number;
  ~Descriptor() {
    if (number >= 0) close(number);
  }
};

/// Removes the unfinished file and throws the system's error.
[[noreturn]] void give_up(const std::filesystem::path& path, int error) {
  std::error_code ignored;
  std::filesystem::remove(aside(path), ignored);
  throw std::system_error(error, std::generic_category(), path.string());
}

bool write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const auto written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes.remove_prefix(std::size_t(written));
  }
  return true;
}

/// fsync; EINVAL and ENOTSUP mean that the file system does not offer it, which is no failure of the disk.
bool bring_to_disk(int descriptor) {
  return fsync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP;
}

} // namespace

std::filesystem::path aside(const std::filesystem::path& path) {
  return path.string() + ".part";
}

void write_beside(const std::filesystem::path& path, std::string_view bytes) {
  const Descriptor file{open(aside(path).c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)};
  if (file.number < 0 || !write_all(file.number, bytes) || !bring_to_disk(file.number)) give_up(path, errno);
}

void write_whole(const std::filesystem::path& path, std::string_view bytes) {
  write_beside(path, bytes);
  take_place(path);
}

void require_room(const std::filesystem::path& path, std::uintmax_t bytes) {
  const Descriptor file{open(aside(path).c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)};
  if (file.number < 0) give_up(path, errno);
  if (const int error = posix_fallocate(file.number, 0, off_t(bytes)); error != 0) give_up(path, error);
}

void take_place(const std::filesystem::path& path) {
  const Descriptor file{open(aside(path).c_str(), O_RDONLY | O_CLOEXEC)};
  if (file.number < 0 || !bring_to_disk(file.number)) give_up(path, errno);
  if (std::rename(aside(path).c_str(), path.c_str()) != 0) give_up(path, errno);
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  const Descriptor entries{open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
  if (entries.number >= 0) bring_to_disk(entries.number); // the name; the file itself is safe
}

FolderLock::FolderLock(const std::filesystem::path& folder, const std::filesystem::path& path)
    : descriptor(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor < 0 || flock(descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  close(descriptor);
  throw std::runtime_error(fmt::format("{}: another run is writing this file", path.string()));
}

FolderLock::~FolderLock() {
  if (descriptor >= 0) close(descriptor);
}

} // namespace host
