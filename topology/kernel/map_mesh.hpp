// SPDX-License-Identifier: MIT
// From a map back to a mesh as files hold it.
#pragma once

#include <vector>

#include "topology/base/ids.hpp"
#include "topology/base/tet_mesh.hpp"
#include "topology/kernel/volume_map.hpp"

namespace sunder {

/// Which points a map is written with.
enum class MeshPoints {
  /// One for each vertex: splits and pinches become visible as points of their own, and reading the
  /// file again gives the same map from then on. Retired rows are left out.
  vertices,
  /// Those of the source: pinches are as they were, splits are gone.
  source
};

/// The mesh of a map: its tetrahedra in their rows, oriented as the map has them; regions, their
/// names and source numbers of tetrahedra from `source`. Source numbers of points are kept only
/// with `MeshPoints::source`, since several vertices can share one.
/// Needs: a map built from `source`, split or glued since or not. O(|T|).
/// A cut that splits no vertex (fixture 12) has no trace in any mesh: see `unexpressed_cuts`.
TetMesh mesh_of_map(const VolumeMap& map, const TetMesh& source, MeshPoints points);

/// Cut faces that no mesh of the map can express: both sides have the same three vertices, so that
/// a reader sews them again. Each once, from its lower half-face, in rising order.
///
/// Splitting exactly these, in any order, in the map built from such a mesh gives the same rows and
/// neighbours again: their vertices are single orbits at the end, so none of them splits on the
/// way. O(boundary log boundary) after a pass over the faces.
/// Needs: a map built from a mesh, split or glued since or not. Trap: in a body with inverted
/// tetrahedra a piece by itself may be turned over on reading, and has two corners exchanged then.
std::vector<HalfFaceId> unexpressed_cuts(const VolumeMap& map);

}  // namespace sunder
