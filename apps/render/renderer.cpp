// SPDX-License-Identifier: MIT
// Checks the scene asked for, draws it, and copies the picture to memory or to a window.
#include "apps/render/renderer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "apps/render/headless_context.hpp"
#include "apps/render/pipeline.hpp"

namespace sunder::render {

struct Renderer::Parts {
  // The order matters: OpenGL's objects are destroyed before their context.
  std::optional<HeadlessContext> context;
  Programs programs;
  Targets targets;

  bool make_current() const { return !context || context->make_current(); }
  ~Parts() {
    if (!make_current()) return;  // the context goes, and its objects with it
  }
};

namespace {

void append(std::vector<Finding>& findings, std::vector<Finding> more) {
  std::ranges::move(more, std::back_inserter(findings));
}

Finding drawing_failed(const std::string& reason) {
  return {.code = "drawing_failed",
          .text = "the OpenGL driver could not draw: " + reason,
          .remedy = "ask for fewer pixels; use the renderer on one thread only"};
}

/// Rows from the top, three bytes a pixel.
Image read_back(const Targets& targets) {
  Image image{.width = targets.width, .height = targets.height};
  const std::size_t row = 3 * static_cast<std::size_t>(image.width);
  image.rgb.resize(row * static_cast<std::size_t>(image.height));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, targets.color_frame);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, image.width, image.height, GL_RGB, GL_UNSIGNED_BYTE, image.rgb.data());
  auto low = image.rgb.begin(), high = image.rgb.end();
  for (; high - low >= 2 * static_cast<std::ptrdiff_t>(row); low += row) {
    high -= static_cast<std::ptrdiff_t>(row);
    std::swap_ranges(low, low + static_cast<std::ptrdiff_t>(row), high);
  }
  return image;
}

}  // namespace

Renderer::Renderer(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

Result<Renderer> Renderer::offscreen() {
  Result<HeadlessContext> context = HeadlessContext::create();
  if (!context) return context.findings.front();
  if (!context->make_current()) return drawing_failed("EGL refuses to make the context current");
  Result<Renderer> renderer = in_current_context();
  if (renderer) renderer->parts_->context = std::move(*context);
  return renderer;
}

Result<Renderer> Renderer::in_current_context() {
  Result<Programs> programs = make_programs();
  if (!programs) return programs.findings.front();
  auto parts = std::make_unique<Parts>();
  parts->programs = std::move(*programs);
  return Renderer(std::move(parts));
}

std::vector<Finding> Renderer::draw_inside(const FrameScene& scene, const Camera& camera, int width,
                                           int height) {
  std::vector<Finding> findings = check(scene);
  append(findings, check(camera));
  if (width < 1 || height < 1) {
    findings.push_back({.code = "image_size",
                        .text = fmt::format("a picture of {} x {} pixels", width, height),
                        .remedy = "give at least one pixel each way"});
  }
  if (has_error(findings)) return findings;
  if (!parts_->make_current()) {
    findings.push_back(drawing_failed("its context is in use on another thread"));
    return findings;
  }
  if (parts_->targets.width != width || parts_->targets.height != height) {
    parts_->targets = {};  // the old ones go first: memory for both may be lacking
    Result<Targets> targets = make_targets(width, height);
    append(findings, targets.findings);
    if (!targets) return findings;
    parts_->targets = std::move(*targets);
  }
  SceneGeometry geometry = scene_geometry(scene);
  sort_front_to_back(geometry, camera.eye);
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  const FrameView view = frame_view(scene, geometry.casters, camera, aspect);
  draw_frame(parts_->programs, parts_->targets, {scene, geometry, view});
  if (const GLenum error = glGetError(); error != GL_NO_ERROR) {
    findings.push_back(drawing_failed(fmt::format("OpenGL error 0x{:04x}", error)));
  }
  return findings;
}

Result<Image> Renderer::render(const FrameScene& scene, const Camera& camera, int width,
                               int height) {
  Result<Image> result;
  result.findings = draw_inside(scene, camera, width, height);
  if (!has_error(result.findings)) result.value = read_back(parts_->targets);
  return result;
}

std::vector<Finding> Renderer::draw(const FrameScene& scene, const Camera& camera,
                                    const DrawTarget& target) {
  std::vector<Finding> findings = draw_inside(scene, camera, target.width, target.height);
  if (has_error(findings)) return findings;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, parts_->targets.color_frame);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target.framebuffer);
  glBlitFramebuffer(0, 0, target.width, target.height, 0, 0, target.width, target.height,
                    GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
  return findings;
}

}  // namespace sunder::render
