// SPDX-License-Identifier: MIT
// The kernel concept: the calls of a 3-map that topological algorithms need. No storage
// here.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include "topology/base/cell_change.hpp"
#include "topology/base/ids.hpp"
#include "topology/base/tet_mesh.hpp"

namespace sunder {

/// The 12 darts of a tetrahedron in canonical order: DartId = 12 t + k, k = 3 p + j.
///
/// Dart k runs along the face opposite to corner p, walked so that its normal points out of a
/// positively oriented tetrahedron; j counts the darts of that face.
///
///            3               face p   origins of its darts      k
///           /|\                0         1 -> 2 -> 3         0  1  2
///          / | \               1         0 -> 3 -> 2         3  4  5
///         /  |  \              2         0 -> 1 -> 3         6  7  8
///        0 . | . 2             3         0 -> 2 -> 1         9 10 11
///         \  |  /
///          \ | /       beta1: the next dart of the face; beta0: the one before
///           \|/        beta2: same edge run backwards in the other face, same tetrahedron
///            1         beta3: same edge run backwards in the same face, other tetrahedron
///
/// (Corner 1 lies in front; the edge 0-2 is hidden behind 1-3.)
namespace dart_order {

inline constexpr std::array<std::array<int, 3>, 4> face_corners = {
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

constexpr int origin(int k) { return face_corners[k / 3][k % 3]; }
constexpr int beta1(int k) { return k - k % 3 + (k + 1) % 3; }
constexpr int beta0(int k) { return k - k % 3 + (k + 2) % 3; }
constexpr int target(int k) { return origin(beta1(k)); }

/// The dart of the half-face opposite to corner `p` that starts at corner `from` (from != p).
constexpr int dart_from(int p, int from) {
  const auto& c = face_corners[p];
  return 3 * p + (c[0] == from ? 0 : c[1] == from ? 1 : 2);
}
/// The edge of dart k lies in the faces opposite to its two missing corners: the other one's dart.
constexpr int beta2(int k) {
  const int p = 6 - k / 3 - origin(k) - target(k);
  return dart_from(p, target(k));
}

}  // namespace dart_order

/// Values of the three corners of a face, chosen from the values of a tetrahedron's four corners
/// (rows, points, places), in the order of the face's darts.
template <class T>
constexpr std::array<T, 3> corners_of_face(const std::array<T, 4>& corners, HalfFaceId face) {
  const auto& [a, b, c] = dart_order::face_corners[place_of(face)];
  return {corners[a], corners[b], corners[c]};
}

/// One vertex orbit that has split in two. The kernel gives the second orbit a row.
struct VertexSplit {
  VertexId vertex;
  /// All corners that get the appended row.
  std::span<const CornerId> leaving;
  /// Corners that keep `vertex`: at least one, and all of them if they are fewer than `leaving`.
  std::span<const CornerId> staying;
};

/// A 3-map of tetrahedra with rows. Algorithms are written once for this concept. Its models are
/// `VolumeMap` (map and dense columns), `DenseMap` and `DartMap` (darts alone).
///
/// Rows: tetrahedra 0 to tetrahedra() - 1, vertices 0 to vertices() - 1. A vertex row is one vertex
/// orbit, or retired (no tetrahedron) after a merge. Rows never move. The four corners of one
/// tetrahedron always have four different `point_of_vertex`, so a row identifies a corner.
template <class K>
concept Kernel = requires(const K& k, K& m, TetId t, HalfFaceId f, VertexId v, CornerId c,
                          typename K::Dart d, const VertexSplit& split,
                          std::span<const CornerId> corners) {
  // Rows.
  { k.tetrahedra() } -> std::convertible_to<std::size_t>;
  { k.vertices() } -> std::convertible_to<std::size_t>;
  { k.corners(t) } -> std::convertible_to<std::array<VertexId, 4>>;
  { k.neighbour(f) } -> std::convertible_to<HalfFaceId>;           // none() on the boundary
  { k.incident_tetrahedron(v) } -> std::convertible_to<TetId>;     // none() when v is retired
  { k.point(v) } -> std::convertible_to<Point>;                    // rest position, m
  { k.point_of_vertex(v) } -> std::convertible_to<std::uint32_t>;  // row of the file's point
  // Darts.
  { k.dart(f, c) } -> std::same_as<typename K::Dart>;  // of face f, starting at corner c of it
  { k.id(d) } -> std::same_as<DartId>;
  { k.vertex(d) } -> std::convertible_to<VertexId>;
  { k.tetrahedron(d) } -> std::convertible_to<TetId>;
  { k.beta0(d) } -> std::same_as<typename K::Dart>;
  { k.beta1(d) } -> std::same_as<typename K::Dart>;
  { k.beta2(d) } -> std::same_as<typename K::Dart>;
  { k.is_free(d) } -> std::same_as<bool>;  // its face is on the boundary: no beta3
  { k.beta3(d) } -> std::same_as<typename K::Dart>;
  // Changes. They keep no orbit whole: rows are the caller's care (split_face, glue_face).
  m.unsew(f);   // both sides of an interior face become boundary
  m.sew(d, d);  // two boundary faces, so that beta3 of the first dart is the second
  { m.split_vertex(split) } -> std::same_as<VertexId>;  // appends a row, gives it to `leaving`
  m.merge_vertices(v, v, corners);  // `corners` (all of the second row) get the first row
};

/// A kernel with changeable cells: rows are rewritten, appended and dropped. `apply` returns the
/// inverse change, which restores the same bytes of all rows.
template <class K>
concept CellKernel = Kernel<K> && requires(const K& k, K& m, const CellChange& change) {
  { k.points() } -> std::convertible_to<std::span<const Point>>;  // the file's, m
  { m.apply(change) } -> std::same_as<CellChange>;
};

/// A map that passes queries on to two other maps: algorithms call `answer(map, ...)`
/// (map_answers.hpp).
template <class K>
concept HasAnswers = requires {
  typename K::TwoAnswers;
};

/// Place (0 to 3) of row `v` among the corners of a tetrahedron; 4 if it is none of them.
constexpr int place_of_vertex(const std::array<VertexId, 4>& corners, VertexId v) {
  for (int i = 0; i < 4; ++i) {
    if (corners[i] == v) return i;
  }
  return 4;
}

}  // namespace sunder
