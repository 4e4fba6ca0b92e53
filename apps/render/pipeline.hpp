// SPDX-License-Identifier: MIT
// Internal: the passes that draw a frame, with the programs and targets they own.
#pragma once

#include <array>

#include "apps/render/frame_scene.hpp"
#include "apps/render/frame_view.hpp"
#include "apps/render/gl_objects.hpp"
#include "apps/render/scene_geometry.hpp"

namespace sunder::render {

/// Programs, buffers and the shadow map, which serve frames of every size.
struct Programs {
  Program shadow, mesh_normals, plane_normals, visibility, smoothing;
  Program background, plane, mesh, edge;
  VertexArray no_vertices, triangles, edges, wires;
  Buffer triangle_buffer, edge_buffer, wire_buffer;
  Sampler plain_sampler, shadow_sampler;
  Texture shadow_map;
  Framebuffer shadow_frame;
};

/// Needs: a current OpenGL 3.3 core context. Errors: `shader_rejected`.
Result<Programs> make_programs();

/// Textures and buffers to draw into, of one size.
struct Targets {
  int width = 0;
  int height = 0;
  /// Unit normal and depth of the nearest surface, in the world; depth 0 where there is none.
  Texture normals, normals_depth;
  Framebuffer normals_frame;
  /// Parts of the sky and of the key light that are seen, and the depth again; two to smooth.
  std::array<Texture, 2> visibility;
  std::array<Framebuffer, 2> visibility_frame;
  /// The picture, four samples a pixel, and resolved.
  Renderbuffer color_samples, depth_samples;
  Framebuffer samples_frame;
  Texture color;
  Framebuffer color_frame;
};

/// Errors: `image_too_large` when the driver cannot hold it.
Result<Targets> make_targets(int width, int height);

/// One frame to draw.
struct Frame {
  const FrameScene& scene;
  const SceneGeometry& geometry;
  const FrameView& view;
};

/// Draws the frame and leaves the picture in `targets.color_frame`, rows from the bottom, sRGB.
/// Leaves depth test and blending off and sRGB encoding off.
void draw_frame(const Programs& programs, const Targets& targets, const Frame& frame);

}  // namespace sunder::render
