// SPDX-License-Identifier: MIT
// Body of journal.hpp, for the source that instantiates it for a kernel.
#pragma once

#include "topology/base/sort_unique.hpp"
#include "topology/cells/journal.hpp"
#include "topology/kernel/fan_impl.hpp"

namespace sunder {

template <CellKernel K>
FaceSplit split_face(K& map, HalfFaceId face, Journal& journal) {
  if constexpr (HasAnswers<K>) {
    return answer(map, [&](auto& kernel) { return split_face(kernel, face, journal); });
  } else {
    // All that a split can change: the stars of three vertices, and where walks round them begin.
    CellChange before{map.points().size(), map.vertices(), map.tetrahedra(), {}, {}, {}, {}};
    std::vector<TetId> rows;
    for (const VertexId v : corners_of_face(map.corners(tetrahedron_of(face)), face)) {
      before.begins.push_back({v, map.incident_tetrahedron(v)});
      const std::vector<TetId> around = star(map, v);
      rows.insert(rows.end(), around.begin(), around.end());
    }
    sort_unique(rows);
    for (const TetId t : rows) {
      CellChange::Cell cell{t, map.corners(t), {}};
      for (int p = 0; p < 4; ++p) {
        cell.neighbours[static_cast<std::size_t>(p)] = map.neighbour(half_face(t, p));
      }
      before.cells.push_back(cell);
    }
    const FaceSplit split = split_face(map, face);
    if (split.did) enter(journal, std::move(before));
    return split;
  }
}

}  // namespace sunder
