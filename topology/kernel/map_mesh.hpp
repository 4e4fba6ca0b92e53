// SPDX-License-Identifier: MIT
// From a map back to a mesh as files hold it.
#pragma once

#include <vector>

#include "topology/base/ids.hpp"
#include "topology/base/tet_mesh.hpp"
#include "topology/kernel/volume_map.hpp"

namespace sunder {

/// The points with which a map is written.
enum class MeshPoints {
  /// One point per vertex. Splits and pinches become separate points, and reading the file gives
  /// the same map again. Retired rows are left out.
  vertices,
  /// The points of the source. Pinches stay as they were, and splits are lost.
  source
};

/// The mesh of a map: its tetrahedra in their rows, oriented as the map has them; regions, their
/// names and source numbers of tetrahedra from `source`. Source numbers of points are kept only
/// with `MeshPoints::source`, since several vertices can share one. Requires: a map built from
/// `source`, possibly split or glued since. O(|T|). A cut that splits no vertex leaves no trace in
/// a mesh: see `unexpressed_cuts`.
TetMesh mesh_of_map(const VolumeMap& map, const TetMesh& source, MeshPoints points);

/// Cut faces that no mesh of the map can express: both sides have the same three vertices, so a
/// reader sews them again. Each face appears once, by its lower half-face, in rising order.
///
/// Splitting exactly these, in any order, in the map built from such a mesh gives the same rows and
/// neighbours again. Their vertices are single orbits at the end, so none of them splits.
/// O(boundary log boundary) after a pass over the faces. Requires: a map built from a mesh,
/// possibly split or glued since. In a body with inverted tetrahedra, reading may turn a separate
/// piece over, and its tetrahedra then have two corners exchanged.
std::vector<HalfFaceId> unexpressed_cuts(const VolumeMap& map);

}  // namespace sunder
