// SPDX-License-Identifier: MIT
// Which vertices a set of faces would part, without splitting one.
#pragma once

#include <span>
#include <vector>

#include "topology/kernel/edge_nodes.hpp"

namespace sunder {

/// A vertex, or the node of an edge, that would come apart if some faces were split.
struct PartedVertex {
  VertexId vertex;
  /// The tetrahedra of each part of its star (of the ring round the edge), rising; the parts by
  /// their lowest tetrahedron. Two or more.
  std::vector<std::vector<TetId>> sides;
};

/// The vertices that splitting `faces` would part, in rising order of row. Their stars fall apart
/// when tetrahedra are no longer connected across these faces. Nothing is split. O(stars).
std::vector<PartedVertex> parted_vertices(const VolumeMap& map, std::span<const HalfFaceId> faces);

/// The same for the nodes of edges (`nodes`: |T|, none() where a tetrahedron has none; empty:
/// nowhere).
std::vector<PartedVertex> parted_edges(const EdgeNodeRows& nodes, const VolumeMap& map,
                                       std::span<const HalfFaceId> faces);

}  // namespace sunder
