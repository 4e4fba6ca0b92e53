// SPDX-License-Identifier: MIT
// Internal: a scene as the arrays OpenGL is given: colored triangles and edges. No OpenGL here.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "apps/render/frame_scene.hpp"

namespace sunder::render {

/// One corner of a triangle; colors are sRGB bytes.
struct MeshVertex {
  std::array<float, 3> position;
  std::array<float, 3> normal;
  std::array<std::uint8_t, 4> color;
};

/// One edge, widened to a line of constant width on the picture.
struct EdgeInstance {
  std::array<float, 3> from;
  std::array<float, 3> to;
  std::array<std::uint8_t, 4> color;
};

struct SceneGeometry {
  /// Three in a row are a triangle. All cast shadows.
  std::vector<MeshVertex> triangles;
  /// Each edge of a filled surface with edges once; of a filled surface those at which a crack
  /// comes to the skin.
  std::vector<EdgeInstance> edges;
  /// Each edge of a wireframe once.
  std::vector<EdgeInstance> wires;
  /// Bounds of all shadow casters; empty when there are none.
  Bounds casters;
};

/// Filled surfaces, spheres and boxes as triangles; edges where a surface's style asks for them,
/// and lines of cracks.
/// Triangles that cannot be drawn are left out. O(n log n) in the edges.
SceneGeometry scene_geometry(const FrameScene& scene);

/// Puts the triangles nearest to `eye` first, so that hidden ones are not shaded; ties by row.
void sort_front_to_back(SceneGeometry& geometry, const Eigen::Vector3f& eye);

}  // namespace sunder::render
