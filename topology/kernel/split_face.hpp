// SPDX-License-Identifier: MIT
// Splitting one face of a 3-map, and gluing it again. Which faces to split is decided elsewhere.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "topology/base/ids.hpp"
#include "topology/kernel/kernel.hpp"

namespace sunder {

/// A vertex that split: the side of the passed half-face keeps `old_row`, the other side gets
/// `new_row`.
struct VertexCopy {
  VertexId old_row;
  VertexId new_row;
};

/// Result of one `split_face`.
struct FaceSplit {
  /// False if the face was on the boundary. Then nothing changed, and only `face` below is valid.
  bool did = false;
  /// The half-face of the call. Its side keeps the rows.
  HalfFaceId face;
  /// The half-face that lay on the other side.
  HalfFaceId opposite;
  /// Rows of the face before the split, in the order of the darts of `face` (dart_order).
  std::array<VertexId, 3> vertices;
  /// The first `vertex_count` entries are valid, in the order of `vertices`.
  std::array<VertexCopy, 3> split_vertices;
  int vertex_count = 0;
  /// Bit i: the edge from vertices[i] to vertices[(i + 1) % 3] came apart.
  std::uint8_t split_edges = 0;
  /// Tetrahedra visited by walks round edges and searches of stars, counted at each visit: a
  /// measure of the cost that is the same on every machine.
  std::uint32_t visited = 0;
};

inline int edge_count(const FaceSplit& s) { return std::popcount(s.split_edges); }

/// The oracle of the paper's section 4.2. A face can be the last connection of two components only
/// if all three of its vertices split. The answer is never no for a true separation, because a
/// vertex is an orbit. A cut through a handle gives a false yes (figure 4).
inline bool oracle_says_new(const FaceSplit& s) { return s.did && s.vertex_count == 3; }

/// Unsews the face and reports which of its vertices and edges came apart.
///
///     before            after, passed side = A       vertex row v: A keeps v, B gets a new row
///      ___v___           ___v   v'___                when no chain of faces joins A to B round v;
///     | A | B |   ->    | A |   | B |                an edge comes apart when no chain round the
///     |___|___|         |___|   |___|                edge does.
///
/// Edges come first: an edge comes apart exactly if it was on the boundary, which a walk round it
/// finds (about 5 tetrahedra). A vertex can come apart only if both of its edges did. Only then its
/// star is searched, in lockstep from both sides. New rows are appended in the order of `vertices`.
/// A boundary face is refused (`did` is false). Cost: the smaller sides of the stars, plus the
/// other side of the vertices that split. Requires: face < 4 tetrahedra(). Component labels stay as
/// they are: see components.hpp.
template <Kernel K>
FaceSplit split_face(K& map, HalfFaceId face);

/// The reason why two half-faces were not glued.
enum class GlueRefusal { none, not_boundary, same_half_face, different_points };

/// Result of one `glue_face`.
struct FaceGlue {
  GlueRefusal refusal = GlueRefusal::none;
  /// Rows merged: `old_row` is kept (the lower), `new_row` is retired.
  std::array<VertexCopy, 3> merged;
  int vertex_count = 0;
};

/// Sews two boundary half-faces with the same three file points: the inverse of `split_face`.
///
/// Vertices that meet are merged into the lower row. The higher row is retired, and retired rows at
/// the end are dropped, so gluing the last split face restores the same rows. Requires: opposite
/// sides of one face of the file. CGAL's topological test accepts more; equal points also decide
/// which corners meet. O(stars).
template <Kernel K>
FaceGlue glue_face(K& map, HalfFaceId a, HalfFaceId b);

}  // namespace sunder
