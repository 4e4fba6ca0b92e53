// SPDX-License-Identifier: MIT
// Bodies of split_face.hpp, for the sources that instantiate them for a kernel.
#pragma once

#include <algorithm>
#include <memory_resource>
#include <utility>
#include <vector>

#include "topology/base/assert.hpp"
#include "topology/kernel/split_face.hpp"

namespace sunder::detail {

/// The star of one vertex seen from two sides: a list of corners each, and which side met which
/// tetrahedron. Lives on the stack for stars of up to 128 tetrahedra, on the heap beyond.
class TwoSidedStar {
 public:
  TwoSidedStar() {
    slots_.assign(256, empty);
    for (auto& list : corners_) list.reserve(64);
  }

  /// -1: not met yet.
  int side_of(TetId t) const {
    const std::uint32_t held = slots_[slot_of(t)];
    return held == empty ? -1 : static_cast<int>(held & 1);
  }

  void add(int side, CornerId c) {
    if (2 * (corners_[0].size() + corners_[1].size()) >= slots_.size()) grow();
    put(side, tetrahedron_of(c));
    corners_[side].push_back(c);
  }

  const std::pmr::vector<CornerId>& corners(int side) const { return corners_[side]; }

 private:
  static constexpr std::uint32_t empty = 0xffffffffU;

  // Open addressing; a slot holds 2 t + side, so |T| < 2^31 (a map ends at 2^32 / 12 before).
  std::size_t slot_of(TetId t) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t i = (t.index() * 0x9e3779b1U >> 7) & mask;
    while (slots_[i] != empty && slots_[i] >> 1 != t.index()) i = (i + 1) & mask;
    return i;
  }

  void put(int side, TetId t) {
    slots_[slot_of(t)] = static_cast<std::uint32_t>(2 * t.index() + static_cast<unsigned>(side));
  }

  void grow() {
    slots_.assign(4 * slots_.size(), empty);
    for (const int side : {0, 1}) {
      for (const CornerId c : corners_[side]) put(side, tetrahedron_of(c));
    }
  }

  std::array<std::byte, 4096> stack_;
  std::pmr::monotonic_buffer_resource memory_{stack_.data(), stack_.size()};
  std::pmr::vector<std::uint32_t> slots_{&memory_};
  std::array<std::pmr::vector<CornerId>, 2> corners_{std::pmr::vector<CornerId>(&memory_),
                                                     std::pmr::vector<CornerId>(&memory_)};
};

/// Adds the neighbours of corner `c` (of row `v`) to its side; false when one belongs to the other.
template <Kernel K>
bool grow_star(const K& map, VertexId v, CornerId c, int side, TwoSidedStar& star) {
  for (int p = 0; p < 4; ++p) {
    if (p == place_of(c)) continue;  // the face opposite to v is not at v
    const HalfFaceId across = map.neighbour(half_face(tetrahedron_of(c), p));
    if (across.is_none()) continue;
    const TetId u = tetrahedron_of(across);
    const int met = star.side_of(u);
    if (met == 1 - side) return false;
    if (met < 0) star.add(side, corner(u, place_of_vertex(map.corners(u), v)));
  }
  return true;
}

/// A walk round an edge.
struct EdgeWalk {
  /// It ended at the boundary.
  bool is_open = false;
  std::uint32_t visited = 0;
};

/// Walks round the edge between rows `a` and `b`, from the tetrahedron of `face` away from `face`,
/// until the boundary or until it comes back to `face` from its other side.
template <Kernel K>
EdgeWalk walk_round_edge(const K& map, HalfFaceId face, VertexId a, VertexId b) {
  HalfFaceId entered = face;
  EdgeWalk walk;
  do {
    ++walk.visited;
    const TetId t = tetrahedron_of(entered);
    const auto corners = map.corners(t);
    const int leave =
        6 - place_of(entered) - place_of_vertex(corners, a) - place_of_vertex(corners, b);
    entered = map.neighbour(half_face(t, leave));
  } while (!entered.is_none() && entered != face);
  walk.is_open = entered.is_none();
  return walk;
}

/// A search of a star from two sides.
struct StarSearch {
  /// The new row of the other side; none() when the sides met.
  VertexId copy;
  std::uint32_t visited = 0;
};

/// Searches the star of `v` from corners `kept` and `other` in lockstep. When the two sides do not
/// meet, gives the other side's corners a new row.
template <Kernel K>
StarSearch split_vertex_if_apart(K& map, VertexId v, CornerId kept, CornerId other) {
  TwoSidedStar star;
  star.add(0, kept);
  star.add(1, other);
  std::array<std::size_t, 2> next = {0, 0};
  const auto visited = [&star] {
    return static_cast<std::uint32_t>(star.corners(0).size() + star.corners(1).size());
  };
  int side = 0;
  while (next[side] < star.corners(side).size()) {
    const CornerId c = star.corners(side)[next[side]++];
    if (!grow_star(map, v, c, side, star)) return {VertexId::none(), visited()};
    side = 1 - side;
  }
  // `side` is walked out. The leaving side has to be known whole, to be given its row.
  while (next[1] < star.corners(1).size()) {
    const CornerId c = star.corners(1)[next[1]++];
    grow_star(map, v, c, 1, star);
  }
  // The staying side goes first, so where it is not walked out it is longer than the other.
  return {map.split_vertex({v, star.corners(1), star.corners(0)}), visited()};
}

/// All corners of the orbit that `start` (of row `v`) belongs to.
template <Kernel K>
std::vector<CornerId> orbit_corners(const K& map, VertexId v, CornerId start) {
  TwoSidedStar star;
  star.add(0, start);
  for (std::size_t i = 0; i < star.corners(0).size(); ++i) {
    const CornerId c = star.corners(0)[i];
    grow_star(map, v, c, 0, star);
  }
  return {star.corners(0).begin(), star.corners(0).end()};
}

/// Corner of tetrahedron `t` at the file's point `point`; none() when it has none there.
template <Kernel K>
CornerId corner_at_point(const K& map, TetId t, std::uint32_t point) {
  const auto corners = map.corners(t);
  for (int i = 0; i < 4; ++i) {
    if (map.point_of_vertex(corners[i]) == point) return corner(t, i);
  }
  return CornerId::none();
}

}  // namespace sunder::detail

namespace sunder {

template <Kernel K>
FaceSplit split_face(K& map, HalfFaceId face) {
  if constexpr (HasAnswers<K>) {
    return answer(map, [&](auto& kernel) { return split_face(kernel, face); });
  }
  SUNDER_ASSERT(face.index() < 4 * map.tetrahedra(), "half-face out of range");
  FaceSplit split;
  split.face = face;
  split.opposite = map.neighbour(face);
  if (split.opposite.is_none()) return split;
  split.did = true;
  const auto corners = map.corners(tetrahedron_of(face));
  const auto opposite_corners = map.corners(tetrahedron_of(split.opposite));
  const auto& places = dart_order::face_corners[place_of(face)];
  split.vertices = corners_of_face(corners, face);
  for (int i = 0; i < 3; ++i) {
    const detail::EdgeWalk walk =
        detail::walk_round_edge(map, face, split.vertices[i], split.vertices[(i + 1) % 3]);
    if (walk.is_open) split.split_edges |= static_cast<std::uint8_t>(1U << i);
    split.visited += walk.visited;
  }
  map.unsew(face);
  for (int i = 0; i < 3; ++i) {
    const unsigned edges_at = 1U << i | 1U << (i + 2) % 3;
    if ((split.split_edges & edges_at) != edges_at) continue;
    const VertexId v = split.vertices[i];
    const CornerId kept = corner(tetrahedron_of(face), places[i]);
    const CornerId other =
        corner(tetrahedron_of(split.opposite), place_of_vertex(opposite_corners, v));
    const auto [copy, visited] = detail::split_vertex_if_apart(map, v, kept, other);
    split.visited += visited;
    if (!copy.is_none()) split.split_vertices[split.vertex_count++] = {v, copy};
  }
  return split;
}

template <Kernel K>
FaceGlue glue_face(K& map, HalfFaceId a, HalfFaceId b) {
  if constexpr (HasAnswers<K>) {
    return answer(map, [&](auto& kernel) { return glue_face(kernel, a, b); });
  }
  SUNDER_ASSERT(a.index() < 4 * map.tetrahedra() && b.index() < 4 * map.tetrahedra(),
                "half-face out of range");
  FaceGlue glue;
  const auto refuse = [&glue](GlueRefusal why) { return glue.refusal = why, glue; };
  if (a == b) return refuse(GlueRefusal::same_half_face);
  if (!map.neighbour(a).is_none() || !map.neighbour(b).is_none()) {
    return refuse(GlueRefusal::not_boundary);
  }
  const TetId t = tetrahedron_of(a), u = tetrahedron_of(b);
  std::array<CornerId, 3> mine, theirs;
  for (int i = 0; i < 3; ++i) {
    mine[i] = corner(t, dart_order::face_corners[place_of(a)][i]);
    const VertexId v = map.corners(t)[place_of(mine[i])];
    theirs[i] = detail::corner_at_point(map, u, map.point_of_vertex(v));
    if (theirs[i].is_none() || place_of(theirs[i]) == place_of(b)) {
      return refuse(GlueRefusal::different_points);
    }
  }
  for (int i = 0; i < 3; ++i) {
    VertexId kept = map.corners(t)[place_of(mine[i])];
    VertexId retired = map.corners(u)[place_of(theirs[i])];
    if (kept == retired) continue;
    CornerId start = theirs[i];
    if (retired < kept) std::swap(kept, retired), start = mine[i];
    const std::vector<CornerId> renamed = detail::orbit_corners(map, retired, start);
    map.merge_vertices(kept, retired, renamed);
    glue.merged[glue.vertex_count++] = {kept, retired};
  }
  map.sew(map.dart(a, mine[0]), map.dart(b, theirs[1]));
  return glue;
}

}  // namespace sunder
