// SPDX-License-Identifier: MIT
// Walks round edges that came apart or meet, and the rows they get.
#include "topology/kernel/edge_nodes.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "topology/base/assert.hpp"
#include "topology/base/point_math.hpp"
#include "topology/kernel/edges.hpp"

namespace sunder {
namespace {

/// The edge between two of the file's points, seen from a tetrahedron that has it.
CellEdge edge_at(const VolumeMap& map, TetId t, std::uint32_t a, std::uint32_t b) {
  const auto& corners = map.corners(t);
  std::array<int, 2> at{-1, -1};
  for (int i = 0; i < 4; ++i) {
    const std::uint32_t point = map.point_of_vertex(corners[static_cast<std::size_t>(i)]);
    if (point == a) at[0] = i;
    if (point == b) at[1] = i;
  }
  SUNDER_ASSERT(at[0] >= 0 && at[1] >= 0, "a tetrahedron without the edge");
  return {t, edge_between(at[0], at[1])};
}

VertexId& row_of(EdgeNodeRows& nodes, CellEdge edge) {
  return nodes[edge.tetrahedron.index()][static_cast<std::size_t>(edge.place)];
}

void give_row(EdgeNodeRows& nodes, const VolumeMap& map, CellEdge edge, VertexId row) {
  for (const CellEdge& seen : edge_ring(map, edge)) row_of(nodes, seen) = row;
}

Point middle_of(const VolumeMap& map, CellEdge edge) {
  const auto [i, j] = edge_ends[static_cast<std::size_t>(edge.place)];
  const auto& corners = map.corners(edge.tetrahedron);
  return detail::middle(map.point(corners[static_cast<std::size_t>(i)]),
                        map.point(corners[static_cast<std::size_t>(j)]));
}

/// The file's points of a half-face, by its darts.
std::array<std::uint32_t, 3> points_of(const VolumeMap& map, HalfFaceId face) {
  const auto corners = corners_of_face(map.corners(tetrahedron_of(face)), face);
  return {map.point_of_vertex(corners[0]), map.point_of_vertex(corners[1]),
          map.point_of_vertex(corners[2])};
}

}  // namespace

void append_edge_nodes(EdgeNodeRows& nodes, VolumeMap& map, TetId first, TetId end) {
  nodes.resize(map.tetrahedra());
  for (TetId t = first; t < end; t = TetId{t.index() + 1}) {
    for (int e = 0; e < 6; ++e) {
      if (!row_of(nodes, {t, e}).is_none()) continue;
      give_row(nodes, map, {t, e}, map.append_node(middle_of(map, {t, e})));
    }
  }
}

EdgeSplits split_edge_nodes(EdgeNodeRows& nodes, VolumeMap& map, const FaceSplit& split) {
  EdgeSplits splits;
  const TetId other = tetrahedron_of(split.opposite);
  if (split.split_edges == 0 || nodes[other.index()][0].is_none()) return splits;
  const auto points = points_of(map, split.face);
  for (std::size_t i = 0; i < 3; ++i) {
    if ((split.split_edges >> i & 1) == 0) continue;
    const CellEdge edge = edge_at(map, other, points[i], points[(i + 1) % 3]);
    const VertexId old_row = row_of(nodes, edge);
    const VertexId new_row = map.append_node(old_row);
    give_row(nodes, map, edge, new_row);
    splits.copies[static_cast<std::size_t>(splits.count++)] = {old_row, new_row};
  }
  return splits;
}

void join_edge_nodes(EdgeNodeRows& nodes, VolumeMap& map, HalfFaceId a, HalfFaceId b) {
  const TetId t = tetrahedron_of(a), u = tetrahedron_of(b);
  if (nodes[t.index()][0].is_none()) return;
  const auto points = points_of(map, a);
  for (std::size_t i = 3; i-- > 0;) {  // the last that came goes first
    const CellEdge mine = edge_at(map, t, points[i], points[(i + 1) % 3]);
    const CellEdge theirs = edge_at(map, u, points[i], points[(i + 1) % 3]);
    const VertexId one = row_of(nodes, mine), two = row_of(nodes, theirs);
    if (one == two) continue;
    give_row(nodes, map, one < two ? theirs : mine, std::min(one, two));
    map.retire_node(std::max(one, two));
  }
}

std::vector<Finding> check(const EdgeNodeRows& nodes, const VolumeMap& map) {
  std::vector<Finding> findings;
  const auto damaged = [&](std::string text, std::size_t row) {
    findings.push_back(
        {.code = "damaged_edge_rows",
         .ids = {static_cast<std::int64_t>(row)},
         .text = std::move(text),
         .remedy = "report it with what led to it: no call of Sunder leaves this behind"});
  };
  if (nodes.size() != map.tetrahedra()) {
    damaged("there is not one row of edges a tetrahedron", nodes.size());
    return findings;
  }
  std::map<VertexId, CellEdge> orbit;  // the first edge seen of each row
  for (std::size_t t = 0; t < nodes.size(); ++t) {
    const auto none = std::ranges::count_if(nodes[t], &VertexId::is_none);
    if (none == 6) continue;
    if (none > 0) {
      damaged("a tetrahedron has rows for some of its edges only", t);
      return findings;
    }
    for (int e = 0; e < 6; ++e) {
      const VertexId row = nodes[t][static_cast<std::size_t>(e)];
      if (row.index() >= map.vertices() || !map.is_node(row)) {
        damaged("the row of an edge is no node's", t);
        return findings;
      }
      if (map.point(row) != middle_of(map, {TetId{t}, e})) {
        damaged("the row of an edge is not at its middle", t);
      }
    }
  }
  const EdgeRows edges = edge_rows(map);
  for (std::size_t t = 0; t < nodes.size(); ++t) {
    if (nodes[t][0].is_none()) continue;
    for (int e = 0; e < 6; ++e) {
      const CellEdge edge{TetId{t}, e};
      const VertexId row = nodes[t][static_cast<std::size_t>(e)];
      const auto id = [&](CellEdge seen) {
        return edges.of_cell[seen.tetrahedron.index()][static_cast<std::size_t>(seen.place)];
      };
      const CellEdge first = edges.first[id(edge)];
      if (nodes[first.tetrahedron.index()][static_cast<std::size_t>(first.place)] != row) {
        damaged("tetrahedra round one edge have different rows for it", t);
      }
      const auto [seen, fresh] = orbit.try_emplace(row, edge);
      if (!fresh && id(seen->second) != id(edge)) damaged("two edges have one row", t);
    }
  }
  return findings;
}

}  // namespace sunder
