// SPDX-License-Identifier: BSD-3-Clause
// Files that are whole or not there: written beside their place, brought to disk, then renamed. Whatever
// ends the program, a reader finds the old file or the new one, never half of either.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace host {

/// Where a file is written before it is renamed.
std::filesystem::path aside(const std::filesystem::path& path);

/// Replaces `path` by a file of these bytes. Throws std::system_error and leaves the old file where it was.
void write_whole(const std::filesystem::path& path, std::string_view bytes);

/// The first half of it: the bytes at `aside(path)`.
void write_beside(const std::filesystem::path& path, std::string_view bytes);

/// Makes sure that the disk has room for a file of `bytes` beside `path`; throws std::system_error if not. For
/// writers that do not survive a full disk.
void require_room(const std::filesystem::path& path, std::uintmax_t bytes);

/// Brings the finished file `aside(path)` to disk and renames it. Errors as write_whole's.
void take_place(const std::filesystem::path& path);

/// An exclusive hold on a folder, for as long as this lives; the system ends it with the process.
class FolderLock {
public:
  /// Throws std::runtime_error, "PATH: another run is writing this file", if another process holds it.
  FolderLock(const std::filesystem::path& folder, const std::filesystem::path& path);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

private:
  int descriptor;
};

} // namespace host
