// SPDX-License-Identifier: MIT
// The bytes of files, and of those that lie next to a file.
#pragma once

#include <filesystem>
#include <string>

#include "topology/base/finding.hpp"

namespace sunder::io {

/// The file's bytes; `-` is standard input. Errors: cannot_open, with the system's
/// reason; too_large, beyond `Limits::file_bytes`.
Result<std::string> bytes_of_file(const std::filesystem::path& path);

/// The unpacked bytes of `name` (or `name`.gz) in `folder` or below it; links are followed first.
/// Errors: missing_file, cannot_open, outside_folder, bad_gzip, truncated_file, too_large.
Result<std::string> bytes_beside(const std::filesystem::path& folder, const std::string& name);

}  // namespace sunder::io
