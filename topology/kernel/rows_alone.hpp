// SPDX-License-Identifier: MIT
// What stands for the darts in a build without CGAL (SUNDER_ROWS_ALONE, as for WebAssembly): dense
// rows answer every query of a `VolumeMap` anyway, so such a build keeps nothing beside them, needs a
// twentieth of the memory and has no `check(const VolumeMap&)`, which compares the two.
#pragma once

#include <span>

#include "topology/kernel/volume_map.hpp"

namespace sunder {

class DartMap {
 public:
  explicit DartMap(const MapRows&) {}
  void prefetch(TetId) const {}
  void unsew(HalfFaceId) {}
  int dart_at(TetId, int) const { return 0; }
  void sew(int, int) {}
  VertexId split_vertex(const VertexSplit&) { return VertexId::none(); }
  void merge_vertices(VertexId, VertexId, std::span<const CornerId>) {}
  MapBytes bytes() const { return {}; }
};

}  // namespace sunder
