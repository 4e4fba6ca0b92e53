// SPDX-License-Identifier: MIT
// Splitting one face of a 3-map, and gluing it again. Which faces to split is decided elsewhere.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "topology/base/ids.hpp"
#include "topology/kernel/kernel.hpp"

namespace sunder {

/// A vertex that came apart: the passed side kept `old_row`, the other side got `new_row`.
struct VertexCopy {
  VertexId old_row;
  VertexId new_row;
};

/// What one `split_face` did.
struct FaceSplit {
  /// False: the face was on the boundary, nothing changed, nothing below but `face` holds.
  bool did = false;
  /// The half-face that was passed; its side keeps its rows.
  HalfFaceId face;
  /// The half-face that lay on the other side.
  HalfFaceId opposite;
  /// Rows of the face before the split, in the order of the darts of `face` (dart_order).
  std::array<VertexId, 3> vertices;
  /// The first `vertex_count` hold, in the order of `vertices`.
  std::array<VertexCopy, 3> split_vertices;
  int vertex_count = 0;
  /// Bit i: the edge from vertices[i] to vertices[(i + 1) % 3] came apart.
  std::uint8_t split_edges = 0;
  /// Tetrahedra visited by walks round edges and searches of stars, one visited twice counted
  /// twice: a measure of the cost, the same on every machine.
  std::uint32_t visited = 0;
};

inline int edge_count(const FaceSplit& s) { return std::popcount(s.split_edges); }

/// The oracle of section 4.2: only when all three vertices of the face split can the face have been
/// the last tie between two components. Never says no to a true separation (a vertex is an orbit);
/// says yes falsely when a handle is cut (figure 4).
inline bool oracle_says_new(const FaceSplit& s) { return s.did && s.vertex_count == 3; }

/// Unsews the face and reports which of its vertices and edges came apart.
///
///     before            after, passed side = A       vertex row v: A keeps v, B gets a new row
///      ___v___           ___v   v'___                when no chain of faces joins A to B round v;
///     | A | B |   ->    | A |   | B |                an edge comes apart when no chain round the
///     |___|___|         |___|   |___|                edge does.
///
/// Edges first: an edge comes apart exactly when it was on the boundary before, which a walk round
/// it tells (about 5 tetrahedra); a vertex can only follow when both its edges did, and only then
/// its star is searched, in lockstep from both sides.
/// New rows are appended in the order of `vertices`. A boundary face is refused (`did` is false).
/// Cost: the smaller sides of the stars, plus the other side of those vertices that split.
/// Needs: face < 4 tetrahedra(). Component labels are not touched: see components.hpp.
template <Kernel K>
FaceSplit split_face(K& map, HalfFaceId face);

/// Why two half-faces could not be glued.
enum class GlueRefusal { none, not_boundary, same_half_face, different_points };

/// What one `glue_face` did.
struct FaceGlue {
  GlueRefusal refusal = GlueRefusal::none;
  /// Rows merged: `old_row` is kept (the lower), `new_row` is retired.
  std::array<VertexCopy, 3> merged;
  int vertex_count = 0;
};

/// Sews two boundary half-faces with the same three file points: the inverse of `split_face`.
///
/// Vertices that meet are merged into the lower row; the higher is retired, and retired rows at the
/// end are dropped, so that gluing what was split last restores the very same rows.
/// Needs: opposite sides of one face of the file (CGAL's topological test lets more pass; equal
/// points are asked for here because they also fix which corner meets which). O(stars).
template <Kernel K>
FaceGlue glue_face(K& map, HalfFaceId a, HalfFaceId b);

}  // namespace sunder
