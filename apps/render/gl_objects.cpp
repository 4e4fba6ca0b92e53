// SPDX-License-Identifier: MIT
// Makes OpenGL objects: textures, framebuffers, programs.
#include "apps/render/gl_objects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace sunder::render {
namespace {

GLenum transfer_format(GLenum internal) {
  switch (internal) {
    case GL_DEPTH_COMPONENT32F:
      return GL_DEPTH_COMPONENT;
    default:
      return GL_RGBA;
  }
}

Result<GLuint> compile(GLenum stage, std::string_view source) {
  const GLuint shader = glCreateShader(stage);
  const char* text = source.data();
  const auto length = static_cast<GLint>(source.size());
  glShaderSource(shader, 1, &text, &length);
  glCompileShader(shader);
  GLint good = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good == GL_TRUE) return shader;
  std::string words(4096, '\0');
  GLsizei used = 0;
  glGetShaderInfoLog(shader, static_cast<GLsizei>(words.size()), &used, words.data());
  words.resize(static_cast<std::size_t>(used));
  glDeleteShader(shader);
  return Finding{.code = "shader_rejected",
                 .text = "the OpenGL driver rejects a shader: " + words,
                 .remedy = "report this with the driver's name and version (eglinfo)"};
}

GLint location(GLuint program, const char* name) { return glGetUniformLocation(program, name); }

}  // namespace

Texture make_texture(const TextureFormat& format) {
  GLuint name = 0;
  glGenTextures(1, &name);
  glBindTexture(GL_TEXTURE_2D, name);
  glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format.internal), format.width, format.height,
               0, transfer_format(format.internal), GL_FLOAT, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return Texture(name);
}

Renderbuffer make_renderbuffer(const TextureFormat& format) {
  GLuint name = 0;
  glGenRenderbuffers(1, &name);
  glBindRenderbuffer(GL_RENDERBUFFER, name);
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, format.samples, format.internal, format.width,
                                   format.height);
  return Renderbuffer(name);
}

Buffer make_buffer() {
  GLuint name = 0;
  glGenBuffers(1, &name);
  return Buffer(name);
}

VertexArray make_vertex_array() {
  GLuint name = 0;
  glGenVertexArrays(1, &name);
  return VertexArray(name);
}

Framebuffer make_framebuffer(GLuint color_texture, GLuint depth_texture) {
  GLuint name = 0;
  glGenFramebuffers(1, &name);
  glBindFramebuffer(GL_FRAMEBUFFER, name);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color_texture, 0);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_texture, 0);
  if (color_texture == 0) {
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
  }
  return Framebuffer(name);
}

Sampler make_sampler(bool compare) {
  GLuint name = 0;
  glGenSamplers(1, &name);
  const GLint filter = compare ? GL_LINEAR : GL_NEAREST;
  glSamplerParameteri(name, GL_TEXTURE_MIN_FILTER, filter);
  glSamplerParameteri(name, GL_TEXTURE_MAG_FILTER, filter);
  glSamplerParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glSamplerParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  if (compare) {
    glSamplerParameteri(name, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glSamplerParameteri(name, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  }
  return Sampler(name);
}

Result<Program> link_program(std::string_view vertex, std::string_view fragment) {
  const Result<GLuint> first = compile(GL_VERTEX_SHADER, vertex);
  if (!first) return first.findings.front();
  const Result<GLuint> second = compile(GL_FRAGMENT_SHADER, fragment);
  if (!second) {
    glDeleteShader(*first);
    return second.findings.front();
  }
  Program program(glCreateProgram());
  glAttachShader(program, *first);
  glAttachShader(program, *second);
  glLinkProgram(program);
  glDeleteShader(*first);  // they live on until the program goes
  glDeleteShader(*second);
  GLint good = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &good);
  if (good == GL_TRUE) return program;
  std::string words(4096, '\0');
  GLsizei used = 0;
  glGetProgramInfoLog(program, static_cast<GLsizei>(words.size()), &used, words.data());
  words.resize(static_cast<std::size_t>(used));
  return Finding{.code = "shader_rejected",
                 .text = "the OpenGL driver cannot link a program: " + words,
                 .remedy = "report this with the driver's name and version (eglinfo)"};
}

void set_uniform(GLuint program, const char* name, int value) {
  glUniform1i(location(program, name), value);
}
void set_uniform(GLuint program, const char* name, float value) {
  glUniform1f(location(program, name), value);
}
void set_uniform(GLuint program, const char* name, const Eigen::Vector2f& value) {
  glUniform2fv(location(program, name), 1, value.data());
}
void set_uniform(GLuint program, const char* name, const Eigen::Vector3f& value) {
  glUniform3fv(location(program, name), 1, value.data());
}
void set_uniform(GLuint program, const char* name, const Eigen::Matrix4f& value) {
  glUniformMatrix4fv(location(program, name), 1, GL_FALSE, value.data());
}
void set_uniform(GLuint program, const char* name, Color value, float strength) {
  const Color linear = to_linear(value);
  glUniform3f(location(program, name), strength * linear.r, strength * linear.g,
              strength * linear.b);
}

}  // namespace sunder::render
