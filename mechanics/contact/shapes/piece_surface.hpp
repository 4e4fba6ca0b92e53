// SPDX-License-Identifier: MIT
// The surface of pieces: faces without a neighbour, their edges, and vertices joined along it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mechanics/state/columns.hpp"
#include "topology/base/ids.hpp"

namespace sunder {

/// Places of the corners of each face in its tetrahedron, seen from outside counter-clockwise.
inline constexpr std::array<std::array<std::uint8_t, 3>, 4> outward_face = {
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// An edge between two faces of the surface.
struct SurfaceEdge {
  std::array<VertexId, 2> end;  ///< ascending
  /// The third corners of the two faces; the second is none() where the edge has not two faces.
  std::array<VertexId, 2> beside;
  std::array<HalfFaceId, 2> face;  ///< ascending; the second none() likewise
  std::uint8_t place = 0;          ///< of the edge in the tetrahedron of the first (`edge_ends`)
};

/// Surfaces of all pieces together.
struct PieceSurface {
  /// |V| + 1: where the ring of each vertex begins.
  std::vector<std::uint32_t> ring_first;
  /// Vertices at the other ends of the edges of faces without a neighbour.
  std::vector<VertexId> ring;
  std::vector<HalfFaceId> faces;  ///< without a neighbour, ascending
  std::vector<SurfaceEdge> edges;
  /// Row = face: its edges, that from corner k to the next (`outward_face`), by rows of `edges`.
  std::vector<std::array<std::uint32_t, 3>> face_edges;

  /// Ascending; empty for a vertex inside.
  std::span<const VertexId> ring_of(VertexId v) const {
    return std::span(ring).subspan(ring_first[v.index()],
                                   ring_first[v.index() + 1] - ring_first[v.index()]);
  }

  std::uint64_t version = 0;  ///< grows with every change of the surface

  /// The input of the surface.
  std::vector<Corners> corners;
  std::vector<std::array<HalfFaceId, 4>> neighbours;
};

/// Makes the surface again where corners or neighbours (the half-face beyond each face, or none();
/// |T| rows each) have changed since the last call. O(|T|).
/// The node of an edge is joined to the corners of its faces. An edge with more than two faces,
/// where pieces touch themselves, is in `edges` once for each.
void update_surface(PieceSurface& surface, const ElementColumns& elements,
                    std::span<const Corners> corners,
                    std::span<const std::array<HalfFaceId, 4>> neighbours, std::size_t vertices);

}  // namespace sunder
