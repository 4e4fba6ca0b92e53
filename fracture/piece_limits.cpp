// SPDX-License-Identifier: MIT
// The map as it would be without a fan's faces, and the search for what would come off.
#include "fracture/piece_limits.hpp"

#include <algorithm>
#include <vector>

#include "topology/components_impl.hpp"

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

/// Whether no chain of faces round `v` joins the two sides of `face`.
bool comes_apart(const MapWithoutFan& view, VertexId v, HalfFaceId face) {
  const TetId goal = tetrahedron_of(view.map.neighbour(face));
  std::vector<TetId> met = {tetrahedron_of(face)};
  for (std::size_t i = 0; i < met.size(); ++i) {
    const auto& corners = view.map.corners(met[i]);
    for (int place = 0; place < 4; ++place) {
      if (corners[place] == v) continue;
      const HalfFaceId across = view.neighbour(half_face(met[i], place));
      if (across.is_none()) continue;
      const TetId t = tetrahedron_of(across);
      if (t == goal) return false;
      if (std::ranges::find(met, t) == met.end()) met.push_back(t);
    }
  }
  return true;
}

bool may_part(const MapWithoutFan& view, HalfFaceId face) {
  const auto& corners = view.map.corners(tetrahedron_of(face));
  return std::ranges::all_of(dart_order::face_corners[place_of(face)], [&](int place) {
    return comes_apart(view, corners[place], face);
  });
}

double mass_of(const ComponentScratch::Part& part, const ComponentScratch& scratch,
               const MechanicsState& mechanics) {
  double mass = 0;
  for (const std::uint32_t head : {part.todo_head, part.done_head}) {
    for (std::uint32_t t = head; t != detail::no_tetrahedron; t = scratch.next[t]) {
      mass += mechanics.elements.mass[t];
    }
  }
  return mass;
}

}  // namespace

bool exceeds_limits(const Cells& cells, const MechanicsState& mechanics,
                    std::span<const HalfFaceId> faces, const FractureSettings& settings,
                    ComponentScratch& scratch) {
  if (faces.empty() || (settings.smallest_piece <= 0 && settings.max_pieces == 0)) return false;
  const MapWithoutFan view(cells.map, faces);
  detail::Lockstep<MapWithoutFan> search(view, scratch);
  for (const HalfFaceId face : faces) {
    if (!may_part(view, face)) continue;
    search.add_source(tetrahedron_of(face));
    search.add_source(tetrahedron_of(cells.map.neighbour(face)));
  }
  search.run(1);
  // One part, still growing or the last to close, is what is left of the piece.
  const std::size_t parts = scratch.closed.size() + search.growing();
  if (parts < 2) return false;
  if (settings.max_pieces > 0 && cells.labels.size.size() + parts - 1 > settings.max_pieces) {
    return true;
  }
  const auto is_light = [&](std::uint32_t part) {
    return mass_of(scratch.parts[part], scratch, mechanics) < settings.smallest_piece;
  };
  if (std::ranges::any_of(scratch.closed, is_light)) return true;
  if (scratch.live.empty() || !is_light(scratch.live.front())) return false;
  search.run(0);
  return std::ranges::any_of(scratch.closed, is_light);
}

}  // namespace sunder
