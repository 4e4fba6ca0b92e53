// SPDX-License-Identifier: MIT
// Which vertices a set of faces would part, without splitting one.
#include "fracture/algorithms/parted_vertices.hpp"

#include <algorithm>
#include <map>

#include "topology/base/sort_unique.hpp"
#include "topology/base/star_parts.hpp"
#include "topology/kernel/fan.hpp"

namespace sunder {
namespace {

/// Parts of a star or a ring, rising: sets of tetrahedra that are not connected across `cut`
/// (half-faces of both sides, sorted).
std::vector<std::vector<TetId>> parts_of(const VolumeMap& map, std::span<const TetId> tets,
                                         std::span<const HalfFaceId> cut) {
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

/// Those of some faces that are sewn, with both sides, sorted.
std::vector<HalfFaceId> cut_of(const VolumeMap& map, std::span<const HalfFaceId> faces) {
  std::vector<HalfFaceId> cut;
  for (const HalfFaceId face : faces) {
    const HalfFaceId other = map.neighbour(face);
    if (other.is_none()) continue;
    cut.push_back(face);
    cut.push_back(other);
  }
  sort_unique(cut);
  return cut;
}

}  // namespace

std::vector<PartedVertex> parted_vertices(const VolumeMap& map, std::span<const HalfFaceId> faces) {
  const std::vector<HalfFaceId> cut = cut_of(map, faces);
  std::vector<VertexId> touched;
  for (const HalfFaceId face : cut) {
    const auto corners = corners_of_face(map.corners(tetrahedron_of(face)), face);
    touched.insert(touched.end(), corners.begin(), corners.end());
  }
  sort_unique(touched);
  std::vector<PartedVertex> parted;
  for (const VertexId v : touched) {
    std::vector<std::vector<TetId>> sides = parts_of(map, star(map, v), cut);
    if (sides.size() > 1) parted.push_back({v, std::move(sides)});
  }
  return parted;
}

std::vector<PartedVertex> parted_edges(const EdgeNodeRows& nodes, const VolumeMap& map,
                                       std::span<const HalfFaceId> faces) {
  if (nodes.empty()) return {};
  const std::vector<HalfFaceId> cut = cut_of(map, faces);
  std::map<VertexId, VertexId> touched;  // node, and an end of its edge
  for (const HalfFaceId face : cut) {
    const TetId t = tetrahedron_of(face);
    for (std::size_t e = 0; e < 6; ++e) {
      const auto [i, j] = edge_ends[e];
      if (i == place_of(face) || j == place_of(face)) continue;
      const VertexId node = nodes[t.index()][e];
      if (!node.is_none()) touched.try_emplace(node, map.corners(t)[static_cast<std::size_t>(i)]);
    }
  }
  std::vector<PartedVertex> parted;
  for (const auto& [node, end] : touched) {
    std::vector<TetId> ring = star(map, end);
    std::erase_if(ring, [&](TetId t) { return std::ranges::count(nodes[t.index()], node) == 0; });
    std::vector<std::vector<TetId>> sides = parts_of(map, ring, cut);
    if (sides.size() > 1) parted.push_back({node, std::move(sides)});
  }
  return parted;
}

}  // namespace sunder
