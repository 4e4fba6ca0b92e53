// SPDX-License-Identifier: MIT
// The folder of a run: its lock, the files of an earlier run, the names of its own.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "topology/base/finding.hpp"

namespace sunder {

/// Holds a folder for one run at a time, by the system's lock on `run.lock` in it: that goes with
/// the process, however it ends. Movable; letting go removes the file.
class FolderLock {
 public:
  /// Makes the folder if there is none. Errors: `folder_in_use`, naming the holder; cannot_write.
  static Result<FolderLock> take(const std::filesystem::path& folder);
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&& other) noexcept;
  ~FolderLock();

 private:
  FolderLock(std::filesystem::path path, int file) : path_(std::move(path)), file_(file) {}
  void let_go();
  std::filesystem::path path_;
  int file_ = -1;
};

/// The first link among the files that a run writes or removes in a folder: if it were followed,
/// it could replace files elsewhere. Findings: link_in_folder.
std::optional<Finding> link_among_files(const std::filesystem::path& folder);

/// Whether files of an earlier run lie there.
bool holds_a_run(const std::filesystem::path& folder);

/// Removes the files of an earlier run: frames of two runs must not mix.
std::error_code empty_run_folder(const std::filesystem::path& folder);

/// Frames and pictures of a run that are numbered from `frames` and `pictures` on are removed.
std::error_code remove_later(const std::filesystem::path& folder, std::uint64_t frames,
                             std::uint64_t pictures);

/// frames/frame_000012.vtu, relative to the folder; picture_003.png.
std::string frame_name(std::uint64_t number);
std::string picture_name(std::uint64_t number);

}  // namespace sunder
