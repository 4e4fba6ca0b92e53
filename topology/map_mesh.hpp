// SPDX-License-Identifier: MIT
// From a map back to a mesh as files hold it.
#pragma once

#include "topology/tet_mesh.hpp"
#include "topology/volume_map.hpp"

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
/// An inner crack with no split vertex (fixture 12) has no trace in any mesh: files hold it not.
TetMesh mesh_of_map(const VolumeMap& map, const TetMesh& source, MeshPoints points);

}  // namespace sunder
