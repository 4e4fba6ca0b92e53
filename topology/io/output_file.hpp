// SPDX-License-Identifier: MIT
// A file that is there whole or not at all: written beside its place, then renamed into it.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string_view>

#include "topology/base/finding.hpp"

namespace sunder {

/// Writes `parts`, one after the other, as the file `path`.
/// Leaves: the new file complete, or on an error the old one (or none) as it was; nothing beside.
/// A symbolic link is followed. The disk is not asked to flush: a power cut may lose the file.
/// Errors: cannot_write, with the system's reason and the remedy; none when it is written.
std::optional<Finding> write_file(const std::filesystem::path& path,
                                  std::span<const std::string_view> parts);

/// The same for a single piece of text.
std::optional<Finding> write_file(const std::filesystem::path& path, std::string_view text);

/// Whether there is a file of that name; false where that cannot be known.
bool file_exists(const std::filesystem::path& path);

}  // namespace sunder
