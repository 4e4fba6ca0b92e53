// SPDX-License-Identifier: MIT
// Files in one .tar. Its bytes follow from the files alone.
#pragma once

#include <span>
#include <string>

namespace sunder {

struct PackedFile {
  /// Path in the archive, folders parted by '/'. At most 100 bytes after the last of them.
  std::string name;
  std::string bytes;
  bool executable = false;
};

/// A POSIX ustar archive (IEEE Std 1003.1, pax). Owners and times are all 0: the same files give
/// the same bytes. Throws std::length_error for a name that is too long.
std::string tar_of(std::span<const PackedFile> files);

}  // namespace sunder
