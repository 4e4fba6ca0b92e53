// SPDX-License-Identifier: MIT
// EGL on Mesa's surfaceless platform: works on a server, in a container, in CI.
#include "apps/render/headless_context.hpp"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <fmt/format.h>

#include <string>
#include <string_view>

namespace sunder::render {

struct HeadlessContext::Handles {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;

  Handles() = default;
  Handles(const Handles&) = delete;
  Handles& operator=(const Handles&) = delete;
  ~Handles() {
    if (context == EGL_NO_CONTEXT) return;
    if (eglGetCurrentContext() == context) {
      eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    eglDestroyContext(display, context);
    // No eglTerminate: the display is one for the whole process, and others may be using it.
  }
};

namespace {

// libepoxy ends the program when a library or function is missing, so both are asked for first.
bool can_load(const char* library) {
  void* handle = dlopen(library, RTLD_LAZY | RTLD_LOCAL);
  if (handle == nullptr) return false;
  dlclose(handle);
  return true;
}

std::string last_egl_error() { return fmt::format("EGL error 0x{:04x}", eglGetError()); }

Finding no_library(const char* library, const char* package) {
  return {.code = "no_gl_library",
          .text = fmt::format("cannot draw: {} cannot be loaded", library),
          .remedy = fmt::format("install it: apt-get install {}", package)};
}

Finding no_display(const std::string& reason) {
  return {.code = "no_headless_display",
          .text = "cannot draw without a display: " + reason,
          .remedy = "install Mesa's drivers: apt-get install libegl-mesa0 libgl1-mesa-dri"};
}

/// The whole words of a list parted by blanks.
bool has_word(const char* list, std::string_view word) {
  const std::string padded = fmt::format(" {} ", list == nullptr ? "" : list);
  return padded.find(fmt::format(" {} ", word)) != std::string::npos;
}

EGLContext create_core_context(EGLDisplay display) {
  if (!eglBindAPI(EGL_OPENGL_API)) return EGL_NO_CONTEXT;
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                               3,
                               EGL_CONTEXT_MINOR_VERSION,
                               3,
                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                               EGL_NONE};
  return eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
}

}  // namespace

HeadlessContext::HeadlessContext(std::unique_ptr<Handles> handles) : handles_(std::move(handles)) {}
HeadlessContext::HeadlessContext(HeadlessContext&&) noexcept = default;
HeadlessContext& HeadlessContext::operator=(HeadlessContext&&) noexcept = default;
HeadlessContext::~HeadlessContext() = default;

Result<HeadlessContext> HeadlessContext::create() {
  if (!can_load("libEGL.so.1")) return no_library("libEGL.so.1", "libegl1 libegl-mesa0");
  if (!can_load("libOpenGL.so.0") && !can_load("libGL.so.1")) {
    return no_library("libGL.so.1", "libgl1 libgl1-mesa-dri");
  }
  const char* offered = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (!has_word(offered, "EGL_EXT_platform_base") ||
      !has_word(offered, "EGL_MESA_platform_surfaceless")) {
    return no_display("no driver offers EGL_MESA_platform_surfaceless");
  }
  auto handles = std::make_unique<Handles>();
  handles->display =
      eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (handles->display == EGL_NO_DISPLAY) return no_display(last_egl_error());
  EGLint major = 0, minor = 0;
  if (!eglInitialize(handles->display, &major, &minor)) return no_display(last_egl_error());
  const char* features = eglQueryString(handles->display, EGL_EXTENSIONS);
  if (!has_word(features, "EGL_KHR_surfaceless_context") ||
      !has_word(features, "EGL_KHR_no_config_context") ||
      !has_word(features, "EGL_KHR_create_context")) {
    return no_display("the driver has no context without a surface");
  }
  handles->context = create_core_context(handles->display);
  if (handles->context == EGL_NO_CONTEXT) {
    return Finding{.code = "no_gl_context",
                   .text = "cannot draw: the driver has no OpenGL 3.3 core, " + last_egl_error(),
                   .remedy = "install Mesa's software rasterizer: apt-get install libgl1-mesa-dri"};
  }
  return HeadlessContext(std::move(handles));
}

bool HeadlessContext::make_current() const {
  return eglMakeCurrent(handles_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, handles_->context);
}

}  // namespace sunder::render
