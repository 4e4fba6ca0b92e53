// SPDX-License-Identifier: MIT
// Pictures by gnuplot, run as a process of its own.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "topology/base/finding.hpp"

namespace sunder {

/// Draws the picture of `script` (it sets a terminal that writes PNG to stdout) as the file `png`,
/// whole or not at all. Errors: gnuplot_missing, gnuplot_failed, cannot_write.
std::optional<Finding> draw_png(std::string_view script, const std::filesystem::path& png);

}  // namespace sunder
