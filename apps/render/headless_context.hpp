// SPDX-License-Identifier: MIT
// An OpenGL context without window, display server or screen (EGL surfaceless). No drawing here.
#pragma once

#include <memory>

#include "topology/base/finding.hpp"

namespace sunder::render {

/// Owns an OpenGL 3.3 core context that draws into framebuffer objects only.
class HeadlessContext {
 public:
  /// Creates one; it is not current yet. Errors, each with the package to install:
  /// `no_gl_library` (libEGL or libGL cannot be loaded), `no_headless_display` (no driver offers
  /// EGL_MESA_platform_surfaceless), `no_gl_context` (the driver has no OpenGL 3.3 core).
  static Result<HeadlessContext> create();

  HeadlessContext(HeadlessContext&&) noexcept;
  HeadlessContext& operator=(HeadlessContext&&) noexcept;
  /// Releases the context if it is current on this thread.
  ~HeadlessContext();

  /// Makes it current on the calling thread, in place of any other. False when EGL refuses, which
  /// it does while the context is current on another thread.
  [[nodiscard]] bool make_current() const;

 private:
  struct Handles;
  explicit HeadlessContext(std::unique_ptr<Handles> handles);
  std::unique_ptr<Handles> handles_;
};

}  // namespace sunder::render
