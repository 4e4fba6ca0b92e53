// SPDX-License-Identifier: MIT
// PNG files read back as they were written, and never stand half written.
#include "apps/render/image.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include "tests/support/folder.hpp"

using namespace sunder;
using sunder::test::Folder;
using namespace sunder::render;
namespace fs = std::filesystem;

namespace {

Image noise(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  Image image{.width = width, .height = height};
  image.rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (auto& byte : image.rgb) byte = static_cast<std::uint8_t>(random());
  return image;
}

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator{}));
}

}  // namespace

TEST_CASE("a picture reads back from PNG byte for byte", "[render][image]") {
  const Folder folder;
  for (const auto& [width, height] : {std::pair{1, 1}, {7, 3}, {64, 33}}) {
    const Image image = noise(width, height, 7);
    REQUIRE(write_png(folder.path() / "a.png", image).empty());
    const Result<Image> back = read_png(folder.path() / "a.png");
    REQUIRE(back);
    CHECK(*back == image);
    CHECK(files_in(folder.path()) == 1);
  }
}

TEST_CASE("a picture that cannot be written leaves nothing behind", "[render][image]") {
  const Folder folder;
  const Image image = noise(4, 4, 1);
  const auto no_folder = write_png(folder.path() / "missing" / "a.png", image);
  REQUIRE(no_folder.size() == 1);
  CHECK(no_folder[0].code == "not_written");
  CHECK(no_folder[0].file == (folder.path() / "missing" / "a.png").string());

  fs::create_directories(folder.path() / "a.png" / "full");
  const auto taken = write_png(folder.path() / "a.png", image);
  REQUIRE(taken.size() == 1);
  CHECK(taken[0].code == "not_written");
  CHECK(files_in(folder.path()) == 1);
}

TEST_CASE("a picture whose bytes do not fit its size is refused", "[render][image]") {
  const Folder folder;
  Image image = noise(4, 4, 1);
  image.rgb.pop_back();
  for (const Image& bad : {image, Image{}, Image{.width = -1, .height = -1}}) {
    const auto findings = write_png(folder.path() / "a.png", bad);
    REQUIRE(findings.size() == 1);
    CHECK(findings[0].code == "empty_image");
  }
  CHECK(files_in(folder.path()) == 0);
}

TEST_CASE("a file that is no PNG, is cut short or is missing is a finding", "[render][image]") {
  const Folder folder;
  const fs::path path = folder.path() / "a.png";
  REQUIRE(write_png(path, noise(40, 40, 3)).empty());
  fs::resize_file(path, fs::file_size(path) / 2);
  std::ofstream(folder.path() / "text.png") << "this is not a picture";
  for (const fs::path& bad : {path, folder.path() / "text.png", folder.path() / "none.png"}) {
    const Result<Image> read = read_png(bad);
    CHECK_FALSE(read);
    REQUIRE(read.findings.size() == 1);
    CHECK(read.findings[0].code == "not_read");
    CHECK(read.findings[0].file == bad.string());
  }
}

TEST_CASE("pixels count from the top left", "[render][image]") {
  const Image image{.width = 2, .height = 2, .rgb = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}};
  CHECK(pixel(image, 1, 0) == std::array<std::uint8_t, 3>{4, 5, 6});
  CHECK(pixel(image, 0, 1) == std::array<std::uint8_t, 3>{7, 8, 9});
}
