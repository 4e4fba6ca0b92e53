// SPDX-License-Identifier: MIT
// The passes of a frame: shadow map, normals and depth, visibility, then the picture.
#include "apps/render/pipeline.hpp"

#include <cmath>

namespace sunder::render {
namespace {

void use_camera(GLuint program, const Targets& targets, const FrameView& view) {
  glUseProgram(program);
  set_uniform(program, "world_to_clip", view.world_to_clip);
  set_uniform(program, "eye", view.eye);
  set_uniform(program, "forward", view.forward);
  set_uniform(program, "ray_right", view.ray_right);
  set_uniform(program, "ray_up", view.ray_up);
  set_uniform(
      program, "pixels",
      Eigen::Vector2f(static_cast<float>(targets.width), static_cast<float>(targets.height)));
}

void use_light(GLuint program, const Lighting& light) {
  set_uniform(program, "to_light", Eigen::Vector3f(light.to_key.normalized()));
  set_uniform(program, "sky_up", Eigen::Vector3f(light.up.normalized()));
  set_uniform(program, "key_light", light.key, light.key_strength);
  set_uniform(program, "sky_light", light.sky, light.ambient_strength);
  set_uniform(program, "below_light", light.below, 0.7f * light.ambient_strength);
  set_uniform(program, "fill_light", light.fill_strength);
  set_uniform(program, "occlusion", light.occlusion);
  set_uniform(program, "neighbors", 5);
}

void bind_texture(int unit, GLuint texture, GLuint sampler) {
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(GL_TEXTURE_2D, texture);
  glBindSampler(static_cast<GLuint>(unit), sampler);
}

void upload(const Programs& programs, const SceneGeometry& geometry) {
  const auto fill = [](GLuint buffer, const auto& rows) {
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(rows.size() * sizeof(rows[0])),
                 rows.data(), GL_STREAM_DRAW);
  };
  fill(programs.triangle_buffer, geometry.triangles);
  fill(programs.edge_buffer, geometry.edges);
  fill(programs.wire_buffer, geometry.wires);
}

void draw_triangles(const Programs& programs, const SceneGeometry& geometry) {
  glBindVertexArray(programs.triangles);
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(geometry.triangles.size()));
}

void draw_fullscreen(const Programs& programs) {
  glBindVertexArray(programs.no_vertices);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

/// Draws every plane with `program`, which is in use.
void draw_planes(const Programs& programs, GLuint program, const Frame& frame) {
  glBindVertexArray(programs.no_vertices);
  glEnable(GL_CULL_FACE);  // a wall between the eye and the scene is not drawn
  for (const Plane& plane : frame.scene.planes) {
    const Eigen::Vector3f n = plane.normal.normalized();
    const auto [u, v] = axes_across(n);
    const float height = n.dot(frame.view.center - plane.point);
    set_uniform(program, "plane_center", Eigen::Vector3f(frame.view.center - height * n));
    set_uniform(program, "plane_u", u);
    set_uniform(program, "plane_v", v);
    set_uniform(program, "plane_normal", n);
    set_uniform(program, "plane_radius", 9 * frame.view.radius);
    set_uniform(program, "plane_color", plane.color);
    set_uniform(program, "grid_spacing", frame.view.grid_spacing);
    set_uniform(program, "grid_strength", plane.grid);
    glDrawArrays(GL_TRIANGLES, 0, 6);
  }
  glDisable(GL_CULL_FACE);
}

void begin_pass(GLuint framebuffer, const Targets& targets) {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, targets.width, targets.height);
}

void shadow_pass(const Programs& programs, const Frame& frame) {
  GLint size = 0;
  glBindTexture(GL_TEXTURE_2D, programs.shadow_map);
  glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &size);
  glBindFramebuffer(GL_FRAMEBUFFER, programs.shadow_frame);
  glViewport(0, 0, size, size);
  glClear(GL_DEPTH_BUFFER_BIT);
  glUseProgram(programs.shadow);
  set_uniform(programs.shadow, "world_to_clip", frame.view.world_to_light);
  draw_triangles(programs, frame.geometry);
}

void normals_pass(const Programs& programs, const Targets& targets, const Frame& frame) {
  begin_pass(targets.normals_frame, targets);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  use_camera(programs.mesh_normals, targets, frame.view);
  draw_triangles(programs, frame.geometry);
  use_camera(programs.plane_normals, targets, frame.view);
  draw_planes(programs, programs.plane_normals, frame);
}

/// Twelve points spread evenly over the unit disc, along a spiral by the golden angle.
void set_disc(GLuint program) {
  constexpr int taps = 12;
  std::array<float, 2 * taps> disc;
  for (std::size_t i = 0; i < taps; ++i) {
    const double r = std::sqrt((static_cast<double>(i) + 0.5) / taps);
    const double angle = 2.399963229728653 * static_cast<double>(i);
    disc[2 * i] = static_cast<float>(r * std::cos(angle));
    disc[2 * i + 1] = static_cast<float>(r * std::sin(angle));
  }
  glUniform2fv(glGetUniformLocation(program, "disc"), taps, disc.data());
  set_uniform(program, "taps", taps);
}

void visibility_pass(const Programs& programs, const Targets& targets, const Frame& frame) {
  const FrameView& view = frame.view;
  const GLuint program = programs.visibility;
  begin_pass(targets.visibility_frame[0], targets);
  use_camera(program, targets, view);
  bind_texture(0, targets.normals, programs.plain_sampler);
  bind_texture(1, programs.shadow_map, programs.plain_sampler);
  bind_texture(2, programs.shadow_map, programs.shadow_sampler);
  set_uniform(program, "normal_and_depth", 0);
  set_uniform(program, "shadow_depth", 1);
  set_uniform(program, "shadow_test", 2);
  set_uniform(program, "to_light", view.to_light);
  set_uniform(program, "light_u", view.light_u);
  set_uniform(program, "light_v", view.light_v);
  set_uniform(program, "light_center", view.light_center);
  set_uniform(program, "light_radius", view.light_radius);
  set_uniform(program, "light_tangent", std::tan(frame.scene.light.key_angle));
  set_uniform(program, "occlusion_radius", 0.22f * view.radius);
  set_uniform(program, "pixels_per_ray",
              static_cast<float>(targets.height) / (2 * view.ray_up.norm()));
  set_disc(program);
  draw_fullscreen(programs);
}

/// Averages over the 4 x 4 pixels between which the sample patterns turn: along x, then along y.
void smoothing_passes(const Programs& programs, const Targets& targets, const Frame& frame) {
  const GLuint program = programs.smoothing;
  for (int from = 0; from < 2; ++from) {
    const auto source = static_cast<std::size_t>(from);
    begin_pass(targets.visibility_frame[1 - source], targets);
    use_camera(program, targets, frame.view);
    bind_texture(0, targets.normals, programs.plain_sampler);
    bind_texture(1, targets.visibility[source], programs.plain_sampler);
    set_uniform(program, "normal_and_depth", 0);
    set_uniform(program, "seen", 1);
    set_uniform(program, "along", Eigen::Vector2f(Eigen::Vector2f::Unit(from)));
    draw_fullscreen(programs);
  }
}

void use_shading(GLuint program, const Programs& programs, const Targets& targets,
                 const Frame& frame) {
  use_camera(program, targets, frame.view);
  use_light(program, frame.scene.light);
  bind_texture(0, targets.visibility[0], programs.plain_sampler);
  set_uniform(program, "seen", 0);
}

void draw_lines(const Programs& programs, GLuint vertices, const std::vector<EdgeInstance>& lines,
                float opacity) {
  set_uniform(programs.edge, "opacity", opacity);
  glBindVertexArray(vertices);
  glDrawArraysInstanced(GL_TRIANGLES, 0, 6, static_cast<GLsizei>(lines.size()));
}

/// Wires behind faces are drawn faintly, so that figure 1's can be followed.
void draw_edges(const Programs& programs, const Targets& targets, const Frame& frame) {
  use_camera(programs.edge, targets, frame.view);
  set_uniform(programs.edge, "near", frame.view.near);
  set_uniform(programs.edge, "half_width", static_cast<float>(targets.height) / 1300);
  glDepthMask(GL_FALSE);
  draw_lines(programs, programs.edges, frame.geometry.edges, 0.4f);
  glDepthFunc(GL_GREATER);
  draw_lines(programs, programs.wires, frame.geometry.wires, 0.12f);
  glDepthFunc(GL_LEQUAL);
  draw_lines(programs, programs.wires, frame.geometry.wires, 1.0f);
  glDepthMask(GL_TRUE);
}

void picture_pass(const Programs& programs, const Targets& targets, const Frame& frame) {
  begin_pass(targets.samples_frame, targets);
  glClear(GL_DEPTH_BUFFER_BIT);
  glEnable(GL_FRAMEBUFFER_SRGB);
  glDisable(GL_DEPTH_TEST);
  use_camera(programs.background, targets, frame.view);
  set_uniform(programs.background, "top", frame.scene.background.top);
  set_uniform(programs.background, "bottom", frame.scene.background.bottom);
  draw_fullscreen(programs);
  glEnable(GL_DEPTH_TEST);
  use_shading(programs.mesh, programs, targets, frame);
  draw_triangles(programs, frame.geometry);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  use_shading(programs.plane, programs, targets, frame);
  draw_planes(programs, programs.plane, frame);
  draw_edges(programs, targets, frame);
  glDisable(GL_BLEND);
}

void resolve(const Targets& targets) {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, targets.samples_frame);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, targets.color_frame);
  glBlitFramebuffer(0, 0, targets.width, targets.height, 0, 0, targets.width, targets.height,
                    GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

}  // namespace

void draw_frame(const Programs& programs, const Targets& targets, const Frame& frame) {
  glDisable(GL_FRAMEBUFFER_SRGB);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glDisable(GL_SCISSOR_TEST);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LEQUAL);
  upload(programs, frame.geometry);
  shadow_pass(programs, frame);
  normals_pass(programs, targets, frame);
  glDisable(GL_DEPTH_TEST);
  visibility_pass(programs, targets, frame);
  smoothing_passes(programs, targets, frame);
  picture_pass(programs, targets, frame);
  resolve(targets);
  glDisable(GL_FRAMEBUFFER_SRGB);
  glDisable(GL_DEPTH_TEST);
  glBindVertexArray(0);
  for (int unit = 0; unit < 3; ++unit) bind_texture(unit, 0, 0);
  glActiveTexture(GL_TEXTURE0);
}

}  // namespace sunder::render
