// SPDX-License-Identifier: MIT
// Bodies of invariants.hpp, for the sources that instantiate them for a kernel.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "topology/base/point_math.hpp"
#include "topology/kernel/invariants.hpp"

namespace sunder::detail {

/// Orbits of corners: those of vertices. A corner stands for the three darts that begin there.
template <Kernel K>
std::size_t count_vertices(const K& map) {
  std::vector<char> met(4 * map.tetrahedra(), 0);
  std::vector<typename K::Dart> stack;
  const auto meet = [&](typename K::Dart d) {
    const std::size_t row = map.id(d).index();
    char& mark =
        met[corner(TetId{row / 12}, dart_order::origin(static_cast<int>(row % 12))).index()];
    if (mark) return;
    mark = 1;
    stack.push_back(d);
  };
  std::size_t orbits = 0;
  for (std::size_t c = 0; c < met.size(); ++c) {
    if (met[c]) continue;
    const int place = place_of(CornerId{c});
    ++orbits;
    meet(map.dart(half_face(tetrahedron_of(CornerId{c}), (place + 1) % 4), CornerId{c}));
    while (!stack.empty()) {
      typename K::Dart d = stack.back();
      stack.pop_back();
      // beta2 beta0 turns through the three faces at the corner, beta1 beta3 crosses each of them.
      for (int j = 0; j < 3; ++j, d = map.beta2(map.beta0(d))) {
        if (!map.is_free(d)) meet(map.beta1(map.beta3(d)));
      }
    }
  }
  return orbits;
}

/// Rings of tetrahedra: orbits of edges. Of the two darts of a tetrahedron along an edge the one
/// with the lower row carries the mark.
template <Kernel K>
std::size_t count_edges(const K& map) {
  std::vector<char> met(12 * map.tetrahedra(), 0);
  const auto meet = [&](typename K::Dart d) {
    const std::size_t row = map.id(d).index();
    const int k = static_cast<int>(row % 12);
    char& mark = met[row - k + std::min(k, dart_order::beta2(k))];
    return !std::exchange(mark, 1);
  };
  std::size_t orbits = 0;
  for (std::size_t row = 0; row < met.size(); ++row) {
    const int k = static_cast<int>(row % 12);
    if (k > dart_order::beta2(k) || met[row]) continue;
    ++orbits;
    const TetId t{row / 12};
    const auto start = map.dart(half_face(t, k / 3), corner(t, dart_order::origin(k)));
    meet(start);
    // One way round, to the start again or to the boundary; then the other way.
    bool open = false;
    for (auto d = start; !(open = map.is_free(d));) {
      d = map.beta2(map.beta3(d));
      if (!meet(d)) break;
    }
    for (auto d = map.beta2(start); open && !map.is_free(d);) {
      d = map.beta2(map.beta3(d));
      if (!meet(d)) break;
    }
  }
  return orbits;
}

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

struct ComponentCount {
  std::size_t components = 0, closed = 0;
};

template <Kernel K>
ComponentCount count_components(const K& map) {
  ComponentCount count;
  std::vector<char> met(map.tetrahedra(), 0);
  std::vector<TetId> stack;
  for (std::size_t first = 0; first < met.size(); ++first) {
    if (met[first]) continue;
    met[first] = 1;
    stack.push_back(TetId{first});
    bool has_boundary = false;
    while (!stack.empty()) {
      const TetId t = stack.back();
      stack.pop_back();
      for (int p = 0; p < 4; ++p) {
        const HalfFaceId across = map.neighbour(half_face(t, p));
        if (across.is_none()) {
          has_boundary = true;
        } else if (char& mark = met[tetrahedron_of(across).index()]; !mark) {
          mark = 1;
          stack.push_back(tetrahedron_of(across));
        }
      }
    }
    ++count.components;
    count.closed += has_boundary ? 0 : 1;
  }
  return count;
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
  std::vector<char> met(4 * map.tetrahedra(), 0);
  std::vector<HalfFaceId> stack;
  std::size_t sheets = 0;
  for (std::size_t i = 0; i < met.size(); ++i) {
    if (met[i] || !map.neighbour(HalfFaceId{i}).is_none()) continue;
    ++sheets;
    met[i] = 1;
    stack.push_back(HalfFaceId{i});
    while (!stack.empty()) {
      auto d = detail::first_dart(map, stack.back());
      stack.pop_back();
      for (int j = 0; j < 3; ++j, d = map.beta1(d)) {
        const HalfFaceId f = detail::next_on_boundary(map, d);
        if (met[f.index()]) continue;
        met[f.index()] = 1;
        stack.push_back(f);
      }
    }
  }
  return sheets;
}

template <Kernel K>
Counts count_cells(const K& map) {
  if constexpr (HasAnswers<K>) {
    return answer(map, [&](auto& kernel) { return count_cells(kernel); });
  }
  Counts counts;
  counts.tetrahedra = map.tetrahedra();
  counts.vertices = detail::count_vertices(map);
  counts.edges = detail::count_edges(map);
  for (std::size_t t = 0; t < map.tetrahedra(); ++t) {
    const auto v = map.corners(TetId{t});
    counts.volume += detail::six_volumes(map.point(v[0]), map.point(v[1]), map.point(v[2]),
                                         map.point(v[3])) /
                     6;
    for (int p = 0; p < 4; ++p) {
      const HalfFaceId f = half_face(TetId{t}, p), across = map.neighbour(f);
      counts.boundary_faces += across.is_none() ? 1 : 0;
      counts.faces += across.is_none() || f < across ? 1 : 0;
    }
  }
  counts.boundary_sheets = count_boundary_sheets(map);
  const auto [components, closed] = detail::count_components(map);
  counts.components = components;
  detail::derive_invariants(counts, closed);
  return counts;
}

}  // namespace sunder
