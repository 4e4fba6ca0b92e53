// SPDX-License-Identifier: MIT
// PNG through libpng's simplified interface, which needs no setjmp.
#include "apps/render/image.hpp"

#include <fmt/format.h>
#include <png.h>

#include <cstring>
#include <string>
#include <system_error>

#include "topology/base/assert.hpp"

namespace sunder::render {
namespace {

std::size_t byte_count(int width, int height) {
  return 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

png_image described(int width, int height) {
  png_image png;
  std::memset(&png, 0, sizeof png);
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(width);
  png.height = static_cast<png_uint_32>(height);
  png.format = PNG_FORMAT_RGB;
  return png;
}

Finding not_written(const std::filesystem::path& path, const std::string& reason) {
  return {.code = "not_written",
          .text = fmt::format("cannot write {}: {}", path.string(), reason),
          .remedy = "check that the folder exists, may be written to and has room",
          .file = path.string()};
}

Finding not_read(const std::filesystem::path& path, const char* reason) {
  return {.code = "not_read",
          .text = fmt::format("cannot read {}: {}", path.string(), reason),
          .remedy = "give the path of a PNG file",
          .file = path.string()};
}

}  // namespace

std::array<std::uint8_t, 3> pixel(const Image& image, int x, int y) {
  SUNDER_ASSERT(x >= 0 && x < image.width && y >= 0 && y < image.height, "pixel out of range");
  const std::size_t at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                              static_cast<std::size_t>(x));
  return {image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]};
}

std::vector<Finding> write_png(const std::filesystem::path& path, const Image& image) {
  if (image.width <= 0 || image.height <= 0 ||
      image.rgb.size() != byte_count(image.width, image.height)) {
    return {{.code = "empty_image",
             .text = fmt::format("an image of {} x {} with {} bytes", image.width, image.height,
                                 image.rgb.size()),
             .remedy = "give 3 bytes for each of at least one pixel",
             .file = path.string()}};
  }
  std::filesystem::path beside = path;
  beside += ".tmp";
  png_image png = described(image.width, image.height);
  std::error_code ignored, failed;
  if (!png_image_write_to_file(&png, beside.c_str(), 0, image.rgb.data(), 0, nullptr)) {
    std::filesystem::remove(beside, ignored);
    return {not_written(path, png.message)};
  }
  std::filesystem::rename(beside, path, failed);
  if (failed) {
    std::filesystem::remove(beside, ignored);
    return {not_written(path, failed.message())};
  }
  return {};
}

Result<Image> read_png(const std::filesystem::path& path) {
  png_image png = described(0, 0);
  if (!png_image_begin_read_from_file(&png, path.c_str())) return not_read(path, png.message);
  png.format = PNG_FORMAT_RGB;
  Image image{.width = static_cast<int>(png.width), .height = static_cast<int>(png.height)};
  // A forged header may promise 2^31 x 2^31 pixels; 1 GB is far beyond any picture of ours.
  if (png.width > 65536 || png.height > 65536 ||
      byte_count(image.width, image.height) > (std::size_t{1} << 30)) {
    png_image_free(&png);
    return not_read(path, "it is larger than 1 GB");
  }
  image.rgb.resize(byte_count(image.width, image.height));
  const png_color black{0, 0, 0};
  if (!png_image_finish_read(&png, &black, image.rgb.data(), 0, nullptr)) {
    return not_read(path, png.message);
  }
  return image;
}

}  // namespace sunder::render
