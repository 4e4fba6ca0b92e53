// SPDX-License-Identifier: MIT
// A node in the middle of every edge: rows of edge orbits, numbered with the vertices of the map.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "topology/base/finding.hpp"
#include "topology/kernel/split_face.hpp"
#include "topology/kernel/volume_map.hpp"

namespace sunder {

/// Rows of the six edges (`edge_ends`) of each tetrahedron: attributes of the orbits of beta2 and
/// beta3, one row per orbit (`DenseMap::append_node`). All are none() in tetrahedra without nodes.
using EdgeNodeRows = std::vector<std::array<VertexId, 6>>;

/// Gives every edge of the tetrahedra `first` to `end` a row, at its middle, in the order of
/// `edge_rows`. Requires: no other tetrahedron shares an edge with these. O(|T|).
void append_edge_nodes(EdgeNodeRows& nodes, VolumeMap& map, TetId first, TetId end);

/// Edges that split. As with vertices, the side of the passed half-face keeps the row.
struct EdgeSplits {
  std::array<VertexCopy, 3> copies;
  int count = 0;
};

/// Follows a `split_face`: appends a row for each split edge (`split_edges`), in their order, and
/// gives it to the tetrahedra round the edge on the other side. O(rings of these edges).
EdgeSplits split_edge_nodes(EdgeNodeRows& nodes, VolumeMap& map, const FaceSplit& split);

/// Precedes a `glue_face` of the same half-faces: edges that meet keep the lower row, and the other
/// row is retired. It is the inverse of `split_edge_nodes`, with the same bytes if the last split
/// is glued first. Requires: the conditions of `glue_face`.
void join_edge_nodes(EdgeNodeRows& nodes, VolumeMap& map, HalfFaceId a, HalfFaceId b);

/// Checks rows of edges and returns all faults. A tetrahedron has nodes on all edges or on none.
/// Rows and orbits correspond one to one. Each node is at the middle of the edge's ends. O(|T|).
std::vector<Finding> check(const EdgeNodeRows& nodes, const VolumeMap& map);

}  // namespace sunder
