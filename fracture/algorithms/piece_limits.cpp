// SPDX-License-Identifier: MIT
// The map as it would be without a fan's faces, and the search for parts that would come off.
#include "fracture/algorithms/piece_limits.hpp"

#include <algorithm>
#include <vector>

#include "fracture/algorithms/parted_vertices.hpp"
#include "topology/kernel/part_search.hpp"

namespace sunder {
namespace {

/// Tetrahedra and their neighbours, but across the faces of a fan.
struct MapWithoutFan {
  const VolumeMap& map;
  std::vector<HalfFaceId> cut;  // both sides, ascending

  MapWithoutFan(const VolumeMap& whole, std::span<const HalfFaceId> faces) : map(whole) {
    for (const HalfFaceId f : faces) {
      cut.push_back(f);
      cut.push_back(map.neighbour(f));
    }
    std::ranges::sort(cut);
  }
  std::size_t tetrahedra() const { return map.tetrahedra(); }
  HalfFaceId neighbour(HalfFaceId f) const {
    return std::ranges::binary_search(cut, f) ? HalfFaceId::none() : map.neighbour(f);
  }
};

/// Whether the two sides of `face` would be apart at all three of its vertices (the oracle).
/// `parted`: by row.
bool may_part(const VolumeMap& map, std::span<const PartedVertex> parted, HalfFaceId face) {
  const TetId own = tetrahedron_of(face), other = tetrahedron_of(map.neighbour(face));
  return std::ranges::all_of(corners_of_face(map.corners(own), face), [&](VertexId v) {
    const auto at = std::ranges::lower_bound(parted, v, {}, &PartedVertex::vertex);
    if (at == parted.end() || at->vertex != v) return false;
    return std::ranges::none_of(at->sides, [&](const std::vector<TetId>& side) {
      return std::ranges::binary_search(side, own) && std::ranges::binary_search(side, other);
    });
  });
}

double mass_of(std::uint32_t part, const ComponentScratch& scratch,
               const MechanicsState& mechanics) {
  double mass = 0;
  for_each_tetrahedron(scratch, part, [&](TetId t) { mass += mechanics.elements.mass[t.index()]; });
  return mass;
}

/// Components of the map: with ties there are more of them than pieces.
std::size_t parts_sewn(const Cells& cells) {
  return cells.pieces ? label_components(cells.map).size.size() : cells.labels.size.size();
}

}  // namespace

bool exceeds_limits(const Cells& cells, const MechanicsState& mechanics,
                    std::span<const HalfFaceId> faces, const FractureSettings& settings,
                    ComponentScratch& scratch) {
  if (faces.empty() || !limits_pieces(settings)) return false;
  const MapWithoutFan view(cells.map, faces);
  const std::vector<PartedVertex> parted = parted_vertices(cells.map, faces);
  PartSearch<MapWithoutFan> search(view, scratch);
  for (const HalfFaceId face : faces) {
    if (!may_part(cells.map, parted, face)) continue;
    search.add_source(tetrahedron_of(face));
    search.add_source(tetrahedron_of(cells.map.neighbour(face)));
  }
  search.run(1);
  // One part, still growing or the last to close, is the rest of the piece.
  const std::size_t parts = scratch.closed.size() + search.growing();
  if (parts < 2) return false;
  if (settings.max_pieces > 0 && parts_sewn(cells) + parts - 1 > settings.max_pieces) return true;
  const auto is_light = [&](std::uint32_t part) {
    return mass_of(part, scratch, mechanics) < settings.smallest_piece;
  };
  if (std::ranges::any_of(scratch.closed, is_light)) return true;
  if (scratch.live.empty() || !is_light(scratch.live.front())) return false;
  search.run(0);
  return std::ranges::any_of(scratch.closed, is_light);
}

}  // namespace sunder
