// SPDX-License-Identifier: MIT
// Which vertices a set of faces would part, without splitting one.
#include "fracture/algorithms/parted_vertices.hpp"

#include <algorithm>

#include "topology/base/sort_unique.hpp"
#include "topology/base/star_parts.hpp"
#include "topology/kernel/fan.hpp"

namespace sunder {
namespace {

/// Parts of a star whose tetrahedra do not meet across `cut` (half-faces of both sides, sorted).
std::vector<std::vector<TetId>> parts_of_star(const VolumeMap& map, VertexId vertex,
                                              std::span<const HalfFaceId> cut) {
  const std::vector<TetId> tets = star(map, vertex);
  const std::vector<std::uint32_t> first =
      star_parts(tets, [&](TetId t, int p) -> std::optional<TetId> {
        const HalfFaceId face = half_face(t, p), other = map.neighbour(face);
        if (other.is_none() || std::ranges::binary_search(cut, face)) return std::nullopt;
        return tetrahedron_of(other);
      });
  std::vector<std::vector<TetId>> parts;
  std::vector<std::size_t> part(tets.size());
  for (std::uint32_t i = 0; i < tets.size(); ++i) {
    if (first[i] == i) {
      part[i] = parts.size();
      parts.emplace_back();
    }
    parts[part[first[i]]].push_back(tets[i]);
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
