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

/// Of each tetrahedron the rows of its six edges (`edge_ends`), attributes of the orbits of beta2 and
/// beta3: one row an orbit (`DenseMap::append_node`). All none() in tetrahedra without.
using EdgeNodeRows = std::vector<std::array<VertexId, 6>>;

/// Gives every edge of the tetrahedra `first` to `end` a row, at its middle, in the order of
/// `edge_rows`. Needs: no tetrahedron beyond shares an edge with one of them. O(|T|).
void append_edge_nodes(EdgeNodeRows& nodes, VolumeMap& map, TetId first, TetId end);

/// Edges that came apart: as vertices do, the side of the half-face that was passed keeps the row.
struct EdgeSplits {
  std::array<VertexCopy, 3> copies;
  int count = 0;
};

/// Follows a `split_face`: appends a row for each edge that it parted (`split_edges`), in their order,
/// and gives it to the tetrahedra round the edge on the other side. O(their rings).
EdgeSplits split_edge_nodes(EdgeNodeRows& nodes, VolumeMap& map, const FaceSplit& split);

/// Before a `glue_face` of the same half-faces: edges that meet have the lower of their rows, the
/// other is retired. The inverse of `split_edge_nodes`, to the same bytes where the last split is
/// glued first. Needs: what `glue_face` needs.
void join_edge_nodes(EdgeNodeRows& nodes, VolumeMap& map, HalfFaceId a, HalfFaceId b);

/// Everything that is wrong with rows of edges: those of a tetrahedron are nodes, all or none; one row
/// an orbit, and one orbit a row; at the middle of the edge's ends. O(|T|).
std::vector<Finding> check(const EdgeNodeRows& nodes, const VolumeMap& map);

}  // namespace sunder
