// SPDX-License-Identifier: MIT
// Makes the programs and the targets of the pipeline.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "apps/render/pipeline.hpp"
#include "apps/render/shaders.hpp"

namespace sunder::render {
namespace {

constexpr int shadow_size = 2048;
constexpr int samples_a_pixel = 4;

/// One attribute of a vertex layout: `components` floats, or 4 bytes when `components` is 0.
void describe(GLuint index, int components, std::size_t stride, std::size_t offset) {
  const auto* at = reinterpret_cast<const void*>(offset);  // NOLINT: OpenGL's offsets are pointers
  glEnableVertexAttribArray(index);
  glVertexAttribPointer(index, components == 0 ? 4 : components,
                        components == 0 ? GL_UNSIGNED_BYTE : GL_FLOAT,
                        components == 0 ? GL_TRUE : GL_FALSE, static_cast<GLsizei>(stride), at);
}

/// One line an instance.
void describe_lines(GLuint vertices, GLuint buffer) {
  glBindVertexArray(vertices);
  glBindBuffer(GL_ARRAY_BUFFER, buffer);
  describe(0, 3, sizeof(EdgeInstance), offsetof(EdgeInstance, from));
  describe(1, 3, sizeof(EdgeInstance), offsetof(EdgeInstance, to));
  describe(2, 0, sizeof(EdgeInstance), offsetof(EdgeInstance, color));
  for (GLuint index = 0; index < 3; ++index) glVertexAttribDivisor(index, 1);
}

void make_buffers(Programs& p) {
  p.no_vertices = make_vertex_array();
  p.triangles = make_vertex_array();
  p.triangle_buffer = make_buffer();
  glBindVertexArray(p.triangles);
  glBindBuffer(GL_ARRAY_BUFFER, p.triangle_buffer);
  describe(0, 3, sizeof(MeshVertex), offsetof(MeshVertex, position));
  describe(1, 3, sizeof(MeshVertex), offsetof(MeshVertex, normal));
  describe(2, 0, sizeof(MeshVertex), offsetof(MeshVertex, color));
  p.edges = make_vertex_array();
  p.edge_buffer = make_buffer();
  describe_lines(p.edges, p.edge_buffer);
  p.wires = make_vertex_array();
  p.wire_buffer = make_buffer();
  describe_lines(p.wires, p.wire_buffer);
  glBindVertexArray(0);
}

void make_shadow_map(Programs& p) {
  p.shadow_map = make_texture({shadow_size, shadow_size, GL_DEPTH_COMPONENT32F});
  p.shadow_frame = make_framebuffer(0, p.shadow_map);
  p.plain_sampler = make_sampler(false);
  p.shadow_sampler = make_sampler(true);
}

void make_sample_buffers(Targets& t) {
  GLint most = 1;
  glGetIntegerv(GL_MAX_SAMPLES, &most);
  const int samples = std::min(samples_a_pixel, most);
  t.color_samples = make_renderbuffer({t.width, t.height, GL_SRGB8_ALPHA8, samples});
  t.depth_samples = make_renderbuffer({t.width, t.height, GL_DEPTH_COMPONENT32F, samples});
  t.samples_frame = make_framebuffer(0, 0);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, t.color_samples);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, t.depth_samples);
  glDrawBuffer(GL_COLOR_ATTACHMENT0);
  glReadBuffer(GL_COLOR_ATTACHMENT0);
}

bool is_complete(GLuint framebuffer) {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

Finding too_large(int width, int height) {
  return {.code = "image_too_large",
          .text = fmt::format("the OpenGL driver cannot hold a picture of {} x {}", width, height),
          .remedy = "ask for fewer pixels"};
}

}  // namespace

Result<Programs> make_programs() {
  Programs p;
  const std::pair<Program*, ShaderSource> wanted[] = {{&p.shadow, shadow_source()},
                                                      {&p.mesh_normals, mesh_normals_source()},
                                                      {&p.plane_normals, plane_normals_source()},
                                                      {&p.visibility, visibility_source()},
                                                      {&p.smoothing, smoothing_source()},
                                                      {&p.background, background_source()},
                                                      {&p.plane, plane_source()},
                                                      {&p.mesh, mesh_source()},
                                                      {&p.edge, edge_source()}};
  for (const auto& [program, source] : wanted) {
    Result<Program> linked = link_program(source.vertex, source.fragment);
    if (!linked) return linked.findings.front();
    *program = std::move(*linked);
  }
  make_buffers(p);
  make_shadow_map(p);
  return p;
}

Result<Targets> make_targets(int width, int height) {
  GLint most_texture = 0, most_buffer = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most_texture);
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &most_buffer);
  if (std::max(width, height) > std::min(most_texture, most_buffer)) {
    return too_large(width, height);
  }
  while (glGetError() != GL_NO_ERROR) {
  }
  Targets t{.width = width, .height = height};
  t.normals = make_texture({width, height, GL_RGBA32F});
  t.normals_depth = make_texture({width, height, GL_DEPTH_COMPONENT32F});
  t.normals_frame = make_framebuffer(t.normals, t.normals_depth);
  for (std::size_t i = 0; i < 2; ++i) {
    t.visibility[i] = make_texture({width, height, GL_RGBA32F});
    t.visibility_frame[i] = make_framebuffer(t.visibility[i], 0);
  }
  make_sample_buffers(t);
  t.color = make_texture({width, height, GL_SRGB8_ALPHA8});
  t.color_frame = make_framebuffer(t.color, 0);
  const bool complete = is_complete(t.normals_frame) && is_complete(t.visibility_frame[0]) &&
                        is_complete(t.visibility_frame[1]) && is_complete(t.samples_frame) &&
                        is_complete(t.color_frame);
  if (!complete || glGetError() != GL_NO_ERROR) return too_large(width, height);
  return t;
}

}  // namespace sunder::render
