// SPDX-License-Identifier: MIT
// Text files that list faces by their points.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "topology/base/finding.hpp"

namespace sunder {

/// Reads three rows of points (counted from 0) a line, between blanks or commas; # begins a
/// comment. Whether there are such faces is not asked. Errors: cannot_open, bad_face (with line).
Result<std::vector<std::array<std::uint32_t, 3>>> read_face_list(const std::filesystem::path& path);

/// The same for a file's bytes already in memory; `name` stands in the findings.
Result<std::vector<std::array<std::uint32_t, 3>>> read_face_list(std::string_view bytes,
                                                                 std::string_view name);

}  // namespace sunder
