// SPDX-License-Identifier: MIT
// A picture in memory, and PNG files of it (libpng).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "topology/base/finding.hpp"

namespace sunder::render {

/// A picture: rows from the top, pixels from the left, sRGB-encoded red, green, blue.
struct Image {
  int width = 0;
  int height = 0;
  /// 3 * width * height bytes.
  std::vector<std::uint8_t> rgb;

  friend bool operator==(const Image&, const Image&) = default;
};

/// The color of a pixel. Needs: 0 <= x < width, 0 <= y < height, y counted from the top.
std::array<std::uint8_t, 3> pixel(const Image& image, int x, int y);

/// Writes a PNG of 8 bits per channel: next to `path` first, then renamed, so that no reader ever
/// sees half a file. Empty when written. Errors: `empty_image`, `not_written` (the folder does not
/// exist, is read-only or full); the file that stood there is then untouched.
[[nodiscard]] std::vector<Finding> write_png(const std::filesystem::path& path, const Image& image);

/// Reads any PNG; transparency is laid over black, and 16 bits become 8.
/// Errors: `not_read`, with libpng's reason.
Result<Image> read_png(const std::filesystem::path& path);

}  // namespace sunder::render
