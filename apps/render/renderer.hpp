// SPDX-License-Identifier: MIT
// Draws a scene to a picture in memory, or into a window's framebuffer.
#pragma once

#include <memory>
#include <vector>

#include "apps/render/camera.hpp"
#include "apps/render/frame_scene.hpp"
#include "apps/render/image.hpp"
#include "topology/base/finding.hpp"

namespace sunder::render {

/// A framebuffer of the current context: 0 is the window's own.
struct DrawTarget {
  unsigned framebuffer = 0;
  int width = 0;
  int height = 0;
};

/// Owns the OpenGL programs and buffers that drawing needs. Not for use from two threads at once.
class Renderer {
 public:
  /// A renderer with a context of its own and no window; needs no display server.
  /// Errors: those of HeadlessContext::create, and `shader_rejected`.
  static Result<Renderer> offscreen();
  /// A renderer in the context that is current now (OpenGL 3.3 core, say a window's), which must
  /// be current again whenever it is used or destroyed. Errors: `shader_rejected`.
  static Result<Renderer> in_current_context();

  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;
  ~Renderer();

  /// The picture of a scene. The same input gives the same bytes on the same driver.
  /// Errors: those of `check` for scene and camera, `image_size` (a side below 1),
  /// `image_too_large`, `drawing_failed`. Warnings come with the picture.
  /// Leaves the renderer's own context, if it has one, current on this thread.
  Result<Image> render(const FrameScene& scene, const Camera& camera, int width, int height);

  /// Draws into a framebuffer of the current context, as `render` does but without the copy to
  /// memory. Leaves that framebuffer bound. Findings as those of `render`.
  std::vector<Finding> draw(const FrameScene& scene, const Camera& camera,
                            const DrawTarget& target);

 private:
  struct Parts;
  explicit Renderer(std::unique_ptr<Parts> parts);
  std::vector<Finding> draw_inside(const FrameScene& scene, const Camera& camera, int width,
                                   int height);
  std::unique_ptr<Parts> parts_;
};

}  // namespace sunder::render
