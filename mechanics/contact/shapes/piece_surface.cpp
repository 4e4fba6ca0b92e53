// SPDX-License-Identifier: MIT
// From faces without a neighbour to the edges of the surface.
#include "mechanics/contact/shapes/piece_surface.hpp"

#include <algorithm>
#include <utility>

#include "topology/base/sort_unique.hpp"

namespace sunder {
namespace {

/// One side of a face of the surface.
struct FaceSide {
  std::array<VertexId, 2> end;  ///< ascending
  VertexId beside;              ///< the third corner
  std::uint32_t row = 0;        ///< of the face
  std::uint8_t side = 0;
  std::uint8_t place = 0;  ///< of the edge in its tetrahedron
};

std::vector<FaceSide> sides_of_faces(const PieceSurface& s) {
  std::vector<FaceSide> sides;
  for (std::size_t row = 0; row < s.faces.size(); ++row) {
    const Corners& corners = s.corners[tetrahedron_of(s.faces[row]).index()];
    const auto& places = outward_face[static_cast<std::size_t>(place_of(s.faces[row]))];
    for (std::uint8_t k = 0; k < 3; ++k) {
      const std::uint8_t from = places[k], to = places[(k + 1u) % 3];
      std::array<VertexId, 2> end = {corners[from], corners[to]};
      if (end[1] < end[0]) std::swap(end[0], end[1]);
      sides.push_back({end, corners[places[(k + 2u) % 3]], static_cast<std::uint32_t>(row), k,
                       static_cast<std::uint8_t>(edge_between(from, to))});
    }
  }
  std::ranges::sort(sides, {}, [](const FaceSide& a) { return std::pair(a.end, a.row); });
  return sides;
}

void make_edges(PieceSurface& s) {
  const std::vector<FaceSide> sides = sides_of_faces(s);
  s.edges.clear();
  s.face_edges.resize(s.faces.size());
  for (std::size_t first = 0; first < sides.size();) {
    std::size_t end = first + 1;
    while (end < sides.size() && sides[end].end == sides[first].end) ++end;
    const bool are_two = end - first == 2;
    for (std::size_t k = first; k < end; ++k) {
      const FaceSide& a = sides[k];
      if (!are_two || k == first) {
        s.edges.push_back(
            {a.end,
             {a.beside, are_two ? sides[k + 1].beside : VertexId::none()},
             {s.faces[a.row], are_two ? s.faces[sides[k + 1].row] : HalfFaceId::none()},
             a.place});
      }
      s.face_edges[a.row][a.side] = static_cast<std::uint32_t>(s.edges.size() - 1);
    }
    first = end;
  }
}

void make_rings(PieceSurface& s, const ElementColumns& elements, std::size_t vertices) {
  std::vector<std::pair<VertexId, VertexId>> ends;
  for (const HalfFaceId face : s.faces) {
    const TetId t = tetrahedron_of(face);
    const Corners& corners = s.corners[t.index()];
    const auto& places = outward_face[static_cast<std::size_t>(place_of(face))];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint8_t from = places[k], to = places[(k + 1) % 3];
      ends.emplace_back(corners[from], corners[to]);
      ends.emplace_back(corners[to], corners[from]);
      if (!is_second_order(elements, t)) continue;
      const auto edge = static_cast<std::size_t>(edge_between(from, to));
      const VertexId middle = elements.edge_nodes[t.index()][edge];
      for (const std::uint8_t corner : places) ends.emplace_back(middle, corners[corner]);
    }
  }
  sort_unique(ends);
  s.ring_first.assign(vertices + 1, 0);
  s.ring.clear();
  for (const auto& [v, end] : ends) {
    ++s.ring_first[v.index() + 1];
    s.ring.push_back(end);
  }
  for (std::size_t v = 0; v < vertices; ++v) s.ring_first[v + 1] += s.ring_first[v];
}

}  // namespace

void update_surface(PieceSurface& s, const ElementColumns& elements,
                    std::span<const Corners> corners,
                    std::span<const std::array<HalfFaceId, 4>> neighbours, std::size_t vertices) {
  if (s.ring_first.size() == vertices + 1 && std::ranges::equal(s.corners, corners) &&
      std::ranges::equal(s.neighbours, neighbours)) {
    return;
  }
  ++s.version;
  s.corners.assign(corners.begin(), corners.end());
  s.neighbours.assign(neighbours.begin(), neighbours.end());
  s.faces.clear();
  for (std::size_t t = 0; t < corners.size(); ++t) {
    for (int place = 0; place < 4; ++place) {
      if (neighbours[t][static_cast<std::size_t>(place)].is_none()) {
        s.faces.push_back(half_face(TetId{t}, place));
      }
    }
  }
  make_edges(s);
  make_rings(s, elements, vertices);
}

}  // namespace sunder
