// SPDX-License-Identifier: MIT
// A file that is there whole or not at all: written next to its place, then renamed into it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "topology/base/finding.hpp"

namespace sunder {

/// Whether a file must be on the disk when the call returns, for a power cut.
enum class Durable : bool { no, yes };

/// Writes `parts`, one after the other, as the file `path`.
/// Leaves: the new file complete, or on an error the old one (or none) as it was; no other file.
/// Makes the folder of the file as make_folder_of does.
/// A symbolic link is followed and stays; a file that is replaced leaves its mode, and its owner
/// where the system permits it. Files named *.gz are packed. `-` is standard output, where a failed
/// write leaves its first part.
/// Errors: cannot_write, with the system's reason and the remedy; none when it is written.
std::optional<Finding> write_file(const std::filesystem::path& path,
                                  std::span<const std::string_view> parts,
                                  Durable durable = Durable::no);

/// The same for a single piece of text.
std::optional<Finding> write_file(const std::filesystem::path& path, std::string_view text);

/// Makes the folder that `path` lies in, where only the last part of that folder is missing. This
/// is the rule for all files that a user names as a place for results. Errors: cannot_write, with
/// `mkdir -p FOLDER` as the remedy where more than the last part is missing.
std::optional<Finding> make_folder_of(const std::filesystem::path& path);

/// Makes the folder `path` itself, for the results of a run, and all folders around it. Errors:
/// cannot_write.
std::optional<Finding> make_folder(const std::filesystem::path& path);

/// A file that grows at its end as a program goes.
class AppendedFile {
 public:
  /// Opens or makes it, and cuts it to its first `bytes`.
  static Result<AppendedFile> open(const std::filesystem::path& path, std::uint64_t bytes);
  AppendedFile(AppendedFile&& other) noexcept;
  AppendedFile& operator=(AppendedFile&& other) noexcept;
  ~AppendedFile();
  /// Errors: cannot_write; nothing of the text stands there then, as far as the system lets it.
  std::optional<Finding> append(std::string_view text);

 private:
  AppendedFile(std::filesystem::path path, int file) : path_(std::move(path)), file_(file) {}
  std::filesystem::path path_;
  int file_ = -1;
};

/// Waits until a file, or the names in a folder, are on the disk. Errors: cannot_write.
std::optional<Finding> sync_file(const std::filesystem::path& path);

/// Whether there is a file of that name; false where that cannot be known.
bool file_exists(const std::filesystem::path& path);

}  // namespace sunder
