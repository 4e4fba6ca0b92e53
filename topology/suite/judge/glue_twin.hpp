// SPDX-License-Identifier: MIT
// The slow twin of the kernel: tetrahedra, a set of glued faces, and union-find. It knows no dart,
// no star walk and no row: corners of different tetrahedra are one vertex exactly when a chain of
// glued faces that contain that point joins them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "topology/base/ids.hpp"
#include "topology/base/tet_mesh.hpp"

namespace sunder::suite {

/// Classes counted by union-find.
struct TwinCounts {
  std::size_t vertices = 0, edges = 0, faces = 0, tetrahedra = 0, components = 0;
  std::size_t boundary_faces = 0, boundary_sheets = 0;
  bool operator==(const TwinCounts&) const = default;
};

/// The effect of removing one glue on the three points and edges of the face, found before and
/// after by union-find over the tetrahedra around them.
struct LocalTruth {
  std::array<std::uint32_t, 3> points;
  std::array<bool, 3> vertex_split;
  /// Edge from points[i] to points[(i + 1) % 3].
  std::array<bool, 3> edge_split;
  bool separated = false;
};

/// Half-faces as everywhere: 4 t + place of the opposite corner.
struct GlueTwin {
  std::vector<std::array<std::uint32_t, 4>> tetrahedra;
  /// The other half-face of each glued one; none() elsewhere.
  std::vector<HalfFaceId> glued;
  /// Tetrahedra at each point.
  std::vector<std::vector<std::uint32_t>> around;
  /// Working memory of `reaches`.
  std::vector<std::uint32_t> stamp;
  std::uint32_t now = 0;
};

/// Glues every pair of half-faces with the same three points. Needs: at most two of each.
GlueTwin glue_twin(const std::vector<std::array<std::uint32_t, 4>>& tetrahedra, std::size_t points);

/// Counts everything from nothing, by union-find over all corners, edges and tetrahedra.
TwinCounts union_find_counts(const GlueTwin& twin);

/// For each corner 4 t + place the number of its vertex class; equal exactly within a class.
std::vector<std::uint32_t> corner_classes(const GlueTwin& twin);

/// Likewise the component of each tetrahedron.
std::vector<std::uint32_t> component_classes(const GlueTwin& twin);

/// Takes the glue of a half-face away; `separated` by a walk over glued faces. Needs: it is glued.
LocalTruth unglue(GlueTwin& twin, HalfFaceId face);

/// Puts it back.
void glue_again(GlueTwin& twin, HalfFaceId a, HalfFaceId b);

}  // namespace sunder::suite
