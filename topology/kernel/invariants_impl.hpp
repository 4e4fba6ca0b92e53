// SPDX-License-Identifier: MIT
// Bodies of invariants.hpp, for the sources that instantiate them for a kernel.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "topology/base/point_math.hpp"
#include "topology/base/sort_unique.hpp"
#include "topology/base/union_find.hpp"
#include "topology/kernel/invariants.hpp"

namespace sunder::detail {

/// A dart of half-face `f`, starting at its first corner.
template <Kernel K>
typename K::Dart first_dart(const K& map, HalfFaceId f) {
  const TetId t = tetrahedron_of(f);
  return map.dart(f, corner(t, dart_order::face_corners[place_of(f)][0]));
}

/// The boundary half-face next to that of the free dart `d`, across its edge.
template <Kernel K>
HalfFaceId next_on_boundary(const K& map, typename K::Dart d) {
  d = map.beta2(d);
  while (!map.is_free(d)) d = map.beta2(map.beta3(d));
  return HalfFaceId{map.id(d).index() / 3};
}

/// Sheets that these half-faces make: all of the boundary.
template <Kernel K>
std::size_t count_sheets(const K& map, std::span<const HalfFaceId> boundary) {
  std::vector<char> met(4 * map.tetrahedra(), 0);
  std::vector<HalfFaceId> stack;
  std::size_t sheets = 0;
  for (const HalfFaceId first : boundary) {
    if (met[first.index()]) continue;
    ++sheets;
    met[first.index()] = 1;
    stack.push_back(first);
    while (!stack.empty()) {
      auto d = first_dart(map, stack.back());
      stack.pop_back();
      for (int j = 0; j < 3; ++j, d = map.beta1(d)) {
        const HalfFaceId f = next_on_boundary(map, d);
        if (met[f.index()]) continue;
        met[f.index()] = 1;
        stack.push_back(f);
      }
    }
  }
  return sheets;
}

/// Euler characteristic and Betti numbers from the counts; `closed`: components without boundary.
inline void derive_invariants(Counts& counts, std::size_t closed) {
  const auto number = [](std::size_t n) { return static_cast<std::ptrdiff_t>(n); };
  counts.euler_characteristic = number(counts.vertices) - number(counts.edges) +
                                number(counts.faces) - number(counts.tetrahedra);
  if (closed > 0) return;
  const std::ptrdiff_t b0 = number(counts.components);
  const std::ptrdiff_t b2 = number(counts.boundary_sheets) - b0;
  counts.betti = {b0, b0 + b2 - counts.euler_characteristic, b2};
}

}  // namespace sunder::detail

namespace sunder {

template <Kernel K>
std::size_t count_boundary_sheets(const K& map) {
  if constexpr (HasAnswers<K>) {
    return answer(map, [&](auto& kernel) { return count_boundary_sheets(kernel); });
  }
  std::vector<HalfFaceId> boundary;
  for (std::size_t f = 0; f < 4 * map.tetrahedra(); ++f) {
    if (map.neighbour(HalfFaceId{f}).is_none()) boundary.emplace_back(f);
  }
  return detail::count_sheets(map, boundary);
}

template <Kernel K>
Counts count_cells(const K& map) {
  if constexpr (HasAnswers<K>) {
    return answer(map, [&](auto& kernel) { return count_cells(kernel); });
  }
  // Corners, edges and tetrahedra that beta3 joins: orbits of vertices, of edges, components.
  // Within a tetrahedron a corner stands for the three darts that begin there, and of the two darts
  // along an edge the one with the lower row for both.
  const std::size_t n = map.tetrahedra();
  UnionFind corners(4 * n), edges(12 * n), bodies(n);
  std::vector<HalfFaceId> boundary;
  const auto corner_of = [](std::size_t dart) {
    const int k = static_cast<int>(dart % 12);
    return corner(TetId{dart / 12}, dart_order::origin(k)).value;
  };
  const auto edge_of = [](std::size_t dart) {
    const int k = static_cast<int>(dart % 12);
    return static_cast<std::uint32_t>(dart - k + std::min(k, dart_order::beta2(k)));
  };
  Counts counts;
  counts.tetrahedra = counts.components = n;
  counts.vertices = 4 * n;
  counts.edges = 6 * n;
  for (std::size_t t = 0; t < n; ++t) {
    const auto v = map.corners(TetId{t});
    counts.volume +=
        detail::six_volumes(map.point(v[0]), map.point(v[1]), map.point(v[2]), map.point(v[3])) / 6;
    for (int p = 0; p < 4; ++p) {
      const HalfFaceId f = half_face(TetId{t}, p);
      auto d = detail::first_dart(map, f);
      if (map.is_free(d)) {
        boundary.push_back(f);
        continue;
      }
      for (int j = 0; j < 3; ++j, d = map.beta1(d)) {
        const auto across = map.beta3(d);
        const std::size_t here = map.id(d).index(), there = map.id(across).index();
        if (there < here) break;  // joined from the other side
        counts.components -= bodies.join(here / 12, there / 12) ? 1 : 0;
        counts.edges -= edges.join(edge_of(here), edge_of(there)) ? 1 : 0;
        const std::size_t there_too = map.id(map.beta1(across)).index();
        counts.vertices -= corners.join(corner_of(here), corner_of(there_too)) ? 1 : 0;
      }
    }
  }
  counts.boundary_faces = boundary.size();
  counts.faces = (4 * n + boundary.size()) / 2;
  counts.boundary_sheets = detail::count_sheets(map, boundary);
  std::vector<std::uint32_t> open;
  for (const HalfFaceId f : boundary) open.push_back(bodies.root(tetrahedron_of(f).value));
  sort_unique(open);
  detail::derive_invariants(counts, counts.components - open.size());
  return counts;
}

}  // namespace sunder
