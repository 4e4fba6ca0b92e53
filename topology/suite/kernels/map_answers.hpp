// SPDX-License-Identifier: MIT
// Answers of maps in the file's numbers, for all of the library's kernels under judgement.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "topology/kernel/invariants.hpp"
#include "topology/kernel/split_face.hpp"
#include "topology/suite/kernels/judged_kernel.hpp"

namespace sunder::suite {

/// The row of a point among a tetrahedron's; none() where it has no such point.
template <Kernel K>
VertexId row_at(const K& map, TetId t, std::uint32_t point) {
  for (const VertexId v : map.corners(t)) {
    if (map.point_of_vertex(v) == point) return v;
  }
  return VertexId::none();
}

/// Needs: a side of a face of the body.
template <Kernel K>
HalfFaceId half_face_at(const K& map, FaceSide side) {
  const auto& rows = map.corners(TetId{side.tetrahedron});
  int place = 0;
  while (map.point_of_vertex(rows[place]) != side.opposite) ++place;
  return half_face(TetId{side.tetrahedron}, place);
}

/// The answer of a split, except whether it separated.
template <Kernel K>
SplitAnswer in_file_points(const K& map, const FaceSplit& split) {
  SplitAnswer answer;
  answer.did = split.did;
  const auto point = [&map](VertexId v) { return map.point_of_vertex(v); };
  for (int i = 0; i < split.vertex_count; ++i) {
    answer.vertices.push_back(point(split.split_vertices[i].old_row));
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if ((split.split_edges >> i & 1) == 0) continue;
    const std::uint32_t a = point(split.vertices[i]), b = point(split.vertices[(i + 1) % 3]);
    answer.edges.push_back({std::min(a, b), std::max(a, b)});
  }
  std::sort(answer.vertices.begin(), answer.vertices.end());
  std::sort(answer.edges.begin(), answer.edges.end());
  return answer;
}

template <Kernel K>
CellCounts cell_counts(const K& map) {
  const Counts c = count_cells(map);
  return {c.vertices,   c.edges,          c.faces,          c.tetrahedra,
          c.components, c.boundary_faces, c.boundary_sheets};
}

/// `JudgedKernel::vertex_of_corner`, by the corners of the file's tetrahedra.
template <Kernel K>
std::vector<std::uint32_t> vertex_of_corner(const K& map,
                                            std::span<const std::array<std::uint32_t, 4>> file) {
  std::vector<std::uint32_t> rows;
  for (std::size_t t = 0; t < file.size(); ++t) {
    for (const std::uint32_t point : file[t]) rows.push_back(row_at(map, TetId{t}, point).value);
  }
  return rows;
}

}  // namespace sunder::suite
