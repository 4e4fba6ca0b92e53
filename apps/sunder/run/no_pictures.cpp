// SPDX-License-Identifier: MIT
// In place of pictures.cpp where the program is built without the renderer.
#include "apps/sunder/run/pictures.hpp"

namespace sunder {

struct Pictures::Parts {};

Pictures::Pictures(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Pictures::Pictures(Pictures&&) noexcept = default;
Pictures& Pictures::operator=(Pictures&&) noexcept = default;
Pictures::~Pictures() = default;

std::optional<Finding> cannot_draw() {
  return Finding{
      .code = "no_renderer",
      .text = "this sunder was built without the renderer",
      .remedy = "build with the renderer: cmake --preset release -DSUNDER_BUILD_RENDERER=ON"};
}

Result<Pictures> Pictures::open(const Simulation&, const OutputSettings&) {
  Finding reason = *cannot_draw();
  reason.text = "pictures are requested, but " + reason.text;
  reason.remedy = "leave out --png and the scene's output.pictures, or " + reason.remedy;
  return reason;
}

std::vector<Finding> Pictures::draw(const std::filesystem::path&, const Simulation&) { return {}; }

}  // namespace sunder
