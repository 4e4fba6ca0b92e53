// SPDX-License-Identifier: MIT
// Which vertices a set of faces would part, without splitting one.
#include "fracture/algorithms/parted_vertices.hpp"

#include <algorithm>

#include "topology/kernel/fan.hpp"
#include "topology/kernel/sort_unique.hpp"

namespace sunder {
namespace {

/// Parts of a star whose tetrahedra do not meet across `cut` (half-faces of both sides, sorted).
std::vector<std::vector<TetId>> parts_of_star(const VolumeMap& map, VertexId vertex,
                                              std::span<const HalfFaceId> cut) {
  const std::vector<TetId> tets = star(map, vertex);
  const auto place = [&](TetId t) {
    return static_cast<std::size_t>(std::lower_bound(tets.begin(), tets.end(), t) - tets.begin());
  };
  std::vector<char> seen(tets.size(), 0);
  std::vector<std::vector<TetId>> parts;
  for (std::size_t first = 0; first < tets.size(); ++first) {
    if (seen[first]) continue;
    seen[first] = 1;
    std::vector<TetId> part = {tets[first]};
    for (std::size_t next = 0; next < part.size(); ++next) {
      const TetId t = part[next];
      for (int p = 0; p < 4; ++p) {
        const HalfFaceId face = half_face(t, p), other = map.neighbour(face);
        if (map.corners(t)[static_cast<std::size_t>(p)] == vertex || other.is_none()) continue;
        if (std::binary_search(cut.begin(), cut.end(), face)) continue;
        const std::size_t row = place(tetrahedron_of(other));
        if (seen[row]) continue;
        seen[row] = 1;
        part.push_back(tetrahedron_of(other));
      }
    }
    std::sort(part.begin(), part.end());
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace

std::vector<PartedVertex> parted_vertices(const VolumeMap& map, std::span<const HalfFaceId> faces) {
  std::vector<HalfFaceId> cut;
  std::vector<VertexId> touched;
  for (const HalfFaceId face : faces) {
    const HalfFaceId other = map.neighbour(face);
    if (other.is_none()) continue;
    cut.push_back(face);
    cut.push_back(other);
    for (int p = 0; p < 4; ++p) {
      if (p == place_of(face)) continue;
      touched.push_back(map.corners(tetrahedron_of(face))[static_cast<std::size_t>(p)]);
    }
  }
  std::sort(cut.begin(), cut.end());
  sort_unique(touched);
  std::vector<PartedVertex> parted;
  for (const VertexId v : touched) {
    std::vector<std::vector<TetId>> sides = parts_of_star(map, v, cut);
    if (sides.size() > 1) parted.push_back({v, std::move(sides)});
  }
  return parted;
}

}  // namespace sunder
