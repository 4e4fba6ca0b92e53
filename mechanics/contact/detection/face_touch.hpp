// SPDX-License-Identifier: MIT
// A vertex against one face of another piece, on their ways through a step.
#pragma once

#include <array>
#include <optional>

#include "mechanics/contact/detection/contact_detect.hpp"

namespace sunder {

/// Share of a tetrahedron, or of a face, within which a vertex next to it counts as on it:
/// rounding.
inline constexpr double on_face = 1e-9;

/// A vertex, or corner of an obstacle, against a face.
struct FaceTouch {
  VertexId vertex;
  ComponentId component;              ///< of the face
  HalfFaceId face;                    ///< none(): says only that the vertex begins inside
  double gap_start = 0, gap_end = 0;  ///< m, from the plane of the face
  double part = 0;                    ///< when they meet or are nearest; 0 to 1
  Vec3 normal{0, 0, 1};               ///< then
  std::array<double, 3> foot{};       ///< then
  double size = 0;                    ///< m, of an edge of the face
  bool is_swept = false;              ///< met on the way; else as the step begins
  bool over_face = false;             ///< whether the foot lies in the face
  bool are_partners = false;          ///< the contact of this pair is found elsewhere
};

/// The three corners of a face, by rows of vertices, from outside counter-clockwise.
inline std::array<VertexId, 3> corners_of(const StepPaths& paths, HalfFaceId face) {
  const Corners& c = paths.corners[tetrahedron_of(face).index()];
  const auto& places = outward_face[static_cast<std::size_t>(place_of(face))];
  return {c[places[0]], c[places[1]], c[places[2]]};
}

/// Unit; not numbers where the three are in line.
inline Vec3 normal_of(const std::array<Vec3, 3>& x) {
  return (x[1] - x[0]).cross(x[2] - x[0]).normalized();
}

/// Where three vertices are when they have gone a part of their ways, m.
inline std::array<Vec3, 3> places_at(const StepPaths& paths,
                                     const std::array<VertexId, 3>& vertices, double part) {
  return {paths.at(vertices[0], part), paths.at(vertices[1], part), paths.at(vertices[2], part)};
}

/// Whether the vertex ends nearer to the face than they move against each other.
bool is_near(const StepPaths& paths, const FaceTouch& touch);

/// On the way, from outside: where the vertex comes to the face itself.
std::optional<FaceTouch> swept_touch(const StepPaths& paths, VertexId v, HalfFaceId face);

/// A vertex that begins on the surface or inside against the point of a face that it is nearest to:
/// within `band` (m) of its border still the face itself, of one that is inside then its border, an
/// edge where the surface turns inwards.
std::optional<FaceTouch> resting_touch(const StepPaths& paths, VertexId v, HalfFaceId face,
                                       double band, bool is_inside);

}  // namespace sunder
