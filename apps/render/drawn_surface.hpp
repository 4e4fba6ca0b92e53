// SPDX-License-Identifier: MIT
// The surface to draw of a tetrahedral body: its boundary faces, skin smoothed, cracks sharp.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <span>

#include "apps/render/frame_scene.hpp"
#include "topology/base/ids.hpp"

namespace sunder::render {

/// A body as columns, and those of its faces that are to be drawn.
struct BoundaryFaces {
  /// |V| points, m: deformed, or of the rigid reference.
  std::span<const Eigen::Vector3d> positions;
  /// |T| times four rows of `positions`, positively oriented.
  std::span<const std::array<VertexId, 4>> corners;
  /// Faces without a neighbour, each seen from its tetrahedron.
  std::span<const HalfFaceId> half_faces;
  /// Skin or crack, one for each of `half_faces`; empty means all skin.
  std::span<const FaceClass> face_class;
  /// Component of each of |T| tetrahedra; empty means one piece.
  std::span<const ComponentId> component;
  /// Largest angle between two faces of the skin that are shaded as one smooth surface, rad.
  double crease_angle = 0.7;
};

/// Triangles counterclockwise from outside, in the order of `half_faces`, with the piece numbers of
/// the components and a normal at each corner. A skin corner has the mean normal, weighed by angle
/// (Thuermer and Wuethrich 1998), of the skin faces of the same piece at the same vertex row that
/// lie within the crease angle of its own; a crack corner has its face's own.
/// `Surface::positions` are the rows in use, in ascending order, no others.
/// Needs: ids in range (asserted), lengths as said. Faces without area get the zero normal.
/// O(|half_faces| + |V|), and the square of the faces around one vertex.
Surface drawn_surface(const BoundaryFaces& faces);

/// The rows of a half-face's three corners, counterclockwise from outside its tetrahedron.
std::array<VertexId, 3> outward_corners(const std::array<VertexId, 4>& corners, HalfFaceId face);

}  // namespace sunder::render
