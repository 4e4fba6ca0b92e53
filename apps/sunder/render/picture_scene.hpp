// SPDX-License-Identifier: MIT
// The content of a picture of bodies, from a state at hand or from a finished run: surfaces,
// obstacles, ground, camera.
#pragma once

#include <span>
#include <vector>

#include "apps/render/camera.hpp"
#include "apps/render/frame_scene.hpp"
#include "apps/scene/output_settings.hpp"
#include "mechanics/contact/shapes/obstacle.hpp"
#include "topology/base/ids.hpp"

namespace sunder {

/// Bodies as columns, and those of their faces that are seen.
struct PictureBodies {
  std::vector<Vec3> reference, deformed;  ///< |V| points, m
  std::span<const std::array<VertexId, 4>> corners;
  std::vector<HalfFaceId> half_faces;  ///< without a neighbour
  std::vector<render::FaceClass> face_class;
  std::span<const ComponentId> component;  ///< row = tetrahedron
};

/// The camera and the extent, which are the same in all pictures of a run.
struct RunView {
  render::Camera camera;
  /// The bodies as they start, static obstacles, and the ground below.
  render::Bounds extent;
};

/// Skin and crack faces of the shape asked for (of `both` the deformed mesh as wires over the
/// filled reference), obstacles. `extent`: that of all pictures of the run. O(|V| + |T|).
render::FrameScene picture_scene(const PictureBodies& bodies, std::span<const Obstacle> obstacles,
                                 ShownShape show, const render::Bounds& extent);

/// The camera asked for, or one that sees the bodies at the start, static obstacles, and the shadow
/// on the ground; up is against gravity (z without any). `later`: a box that it sees too, m.
RunView run_view(const PictureBodies& start, std::span<const Obstacle> obstacles,
                 const PictureSettings& settings, const Vec3& gravity,
                 const render::Bounds& later = {});

}  // namespace sunder
