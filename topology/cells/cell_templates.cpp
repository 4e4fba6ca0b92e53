// SPDX-License-Identifier: MIT
// The parts of a divided tetrahedron.
#include "topology/cells/cell_templates.hpp"

#include <algorithm>

#include "topology/base/assert.hpp"
#include "topology/cells/subdivide.hpp"
#include "topology/kernel/kernel.hpp"

namespace sunder {
namespace {

constexpr unsigned all_edges = 63;

// Bey's T1 to T8; where his order of corners is a negative one, corners 1 and 3 are exchanged,
// which keeps the pairs 0 2 and 1 3 and so the edge inside at the next time.
constexpr std::array<CellPart, 8> red = {{{0, 4, 5, 6},
                                          {4, 1, 7, 8},
                                          {5, 7, 2, 9},
                                          {6, 8, 9, 3},
                                          {4, 5, 6, 8},
                                          {4, 8, 7, 5},
                                          {5, 6, 8, 9},
                                          {5, 9, 8, 7}}};

/// Even orders of the corners: Bey's edge inside joins the middles of the first and third, and of
/// the second and fourth.
constexpr std::array<std::array<int, 4>, 3> turns_of_corners = {
    {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}}};

consteval std::array<CellPart, 8> turned(const std::array<int, 4>& corners) {
  std::array<CellPart, 8> parts = red;
  for (CellPart& part : parts) {
    for (int& node : part) {
      node = node < 4 ? corners[node]
                      : 4 + edge_between(corners[edge_ends[node - 4][0]],
                                         corners[edge_ends[node - 4][1]]);
    }
  }
  return parts;
}

/// The face with three divided edges; 4 where there is none.
int full_face(unsigned edges) {
  for (int p = 0; p < 4; ++p) {
    if ((edges & edges_of_face(p)) == edges_of_face(p)) return p;
  }
  return 4;
}

/// The corner opposite to face p over each of the four triangles of that face.
std::vector<CellPart> face_parts(int p) {
  const auto& [a, b, c] = dart_order::face_corners[static_cast<std::size_t>(p)];
  const int ab = 4 + edge_between(a, b), bc = 4 + edge_between(b, c), ca = 4 + edge_between(c, a);
  std::vector<CellPart> parts;
  // The face's darts run so that its normal points out: with the corner in front they are negative.
  for (const auto& [u, v, w] :
       std::array<std::array<int, 3>, 4>{{{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}}) {
    parts.push_back({u, w, v, p});
  }
  return parts;
}

/// Each edge in its turn: parts that have it whole are bisected.
std::vector<CellPart> edge_parts(unsigned edges, const std::array<std::uint32_t, 6>& order) {
  std::vector<int> turns;
  for (int e = 0; e < 6; ++e) {
    if ((edges >> e & 1) != 0) turns.push_back(e);
  }
  std::ranges::sort(turns, {}, [&](int e) { return order[static_cast<std::size_t>(e)]; });
  std::vector<CellPart> parts{{0, 1, 2, 3}};
  for (const int e : turns) {
    const auto [a, b] = edge_ends[static_cast<std::size_t>(e)];
    for (std::size_t i = 0, n = parts.size(); i < n; ++i) {
      const auto at_a = std::ranges::find(parts[i], a), at_b = std::ranges::find(parts[i], b);
      if (at_a == parts[i].end() || at_b == parts[i].end()) continue;
      CellPart other = parts[i];
      other[static_cast<std::size_t>(at_a - parts[i].begin())] = 4 + e;
      *at_b = 4 + e;
      parts.push_back(other);
    }
  }
  return parts;
}

}  // namespace

bool is_divisible(unsigned edges) {
  const int face = full_face(edges);
  return face == 4 || edges == all_edges || edges == edges_of_face(face);
}

const std::array<CellPart, 8>& parts_by_eight(int turn) {
  static constexpr std::array<std::array<CellPart, 8>, 3> all = {
      turned(turns_of_corners[0]), turned(turns_of_corners[1]), turned(turns_of_corners[2])};
  return all[static_cast<std::size_t>(turn)];
}

std::vector<CellPart> parts_of_cell(unsigned edges, const std::array<std::uint32_t, 6>& order) {
  SUNDER_ASSERT(is_divisible(edges), "a set of edges that a tetrahedron can be divided at");
  if (edges == all_edges) return {red.begin(), red.end()};
  const int face = full_face(edges);
  return face < 4 ? face_parts(face) : edge_parts(edges, order);
}

}  // namespace sunder
