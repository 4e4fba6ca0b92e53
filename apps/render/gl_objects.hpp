// SPDX-License-Identifier: MIT
// Internal: OpenGL names that delete themselves, programs and textures. Needs a current context.
#pragma once

#include <epoxy/gl.h>

#include <Eigen/Dense>
#include <string_view>
#include <utility>

#include "apps/render/color.hpp"
#include "topology/base/finding.hpp"

namespace sunder::render {

/// Owns one OpenGL name; 0 is none. Its context must be current when it is destroyed.
template <class Kind>
class GlName {
 public:
  GlName() = default;
  explicit GlName(GLuint name) : name_(name) {}
  GlName(GlName&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GlName& operator=(GlName&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  ~GlName() {
    if (name_ != 0) Kind::destroy(name_);
  }
  operator GLuint() const { return name_; }  // NOLINT: an owned name is used as a name

 private:
  GLuint name_ = 0;
};

struct TextureKind {
  static void destroy(GLuint n) { glDeleteTextures(1, &n); }
};
struct RenderbufferKind {
  static void destroy(GLuint n) { glDeleteRenderbuffers(1, &n); }
};
struct FramebufferKind {
  static void destroy(GLuint n) { glDeleteFramebuffers(1, &n); }
};
struct BufferKind {
  static void destroy(GLuint n) { glDeleteBuffers(1, &n); }
};
struct VertexArrayKind {
  static void destroy(GLuint n) { glDeleteVertexArrays(1, &n); }
};
struct SamplerKind {
  static void destroy(GLuint n) { glDeleteSamplers(1, &n); }
};
struct ProgramKind {
  static void destroy(GLuint n) { glDeleteProgram(n); }
};

using Texture = GlName<TextureKind>;
using Renderbuffer = GlName<RenderbufferKind>;
using Framebuffer = GlName<FramebufferKind>;
using Buffer = GlName<BufferKind>;
using VertexArray = GlName<VertexArrayKind>;
using Sampler = GlName<SamplerKind>;
using Program = GlName<ProgramKind>;

/// The size of a texture or renderbuffer, in pixels, and the content of a pixel.
struct TextureFormat {
  int width = 0;
  int height = 0;
  GLenum internal = GL_RGBA8;
  /// Samples a pixel; textures have one.
  int samples = 1;
};

/// A texture without mipmaps, read by texel or nearest, clamped at its edges.
Texture make_texture(const TextureFormat& format);
Renderbuffer make_renderbuffer(const TextureFormat& format);
Buffer make_buffer();
VertexArray make_vertex_array();
/// A framebuffer of a color texture (0: none) and a depth texture (0: none).
Framebuffer make_framebuffer(GLuint color_texture, GLuint depth_texture);
/// A sampler that clamps; with `compare`, one of shadows: linear, comparing less or equal.
Sampler make_sampler(bool compare);

/// Compiles and links. Errors: `shader_rejected`, with the driver's words.
Result<Program> link_program(std::string_view vertex, std::string_view fragment);

/// Sets a uniform of the program in use; names the compiler has dropped are passed over.
void set_uniform(GLuint program, const char* name, int value);
void set_uniform(GLuint program, const char* name, float value);
void set_uniform(GLuint program, const char* name, const Eigen::Vector2f& value);
void set_uniform(GLuint program, const char* name, const Eigen::Vector3f& value);
void set_uniform(GLuint program, const char* name, const Eigen::Matrix4f& value);
/// Sets it to the light of `value` times `strength`.
void set_uniform(GLuint program, const char* name, Color value, float strength = 1);

}  // namespace sunder::render
