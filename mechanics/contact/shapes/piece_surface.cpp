// SPDX-License-Identifier: MIT
// From faces without a neighbour to the edges of the surface.
#include "mechanics/contact/shapes/piece_surface.hpp"

#include <algorithm>
#include <utility>

#include "topology/base/sort_unique.hpp"

namespace sunder {

void update_surface(PieceSurface& s, const ElementColumns& elements,
                    std::span<const Corners> corners, std::span<const std::array<HalfFaceId, 4>> neighbours,
                    std::size_t vertices) {
  if (s.ring_first.size() == vertices + 1 && std::ranges::equal(s.corners, corners) &&
      std::ranges::equal(s.neighbours, neighbours)) {
    return;
  }
  s.corners.assign(corners.begin(), corners.end());
  s.neighbours.assign(neighbours.begin(), neighbours.end());
  std::vector<std::pair<VertexId, VertexId>> ends;
  for (std::size_t t = 0; t < corners.size(); ++t) {
    for (std::size_t place = 0; place < 4; ++place) {
      if (!neighbours[t][place].is_none()) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const VertexId a = corners[t][outward_face[place][k]];
        const VertexId b = corners[t][outward_face[place][(k + 1) % 3]];
        ends.emplace_back(a, b);
        ends.emplace_back(b, a);
        if (!is_second_order(elements, TetId{t})) continue;
        const int edge = edge_between(outward_face[place][k], outward_face[place][(k + 1) % 3]);
        const VertexId middle = elements.edge_nodes[t][static_cast<std::size_t>(edge)];
        for (const std::uint8_t corner : outward_face[place]) {
          ends.emplace_back(middle, corners[t][corner]);
        }
      }
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

}  // namespace sunder
