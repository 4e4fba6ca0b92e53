// SPDX-License-Identifier: MIT
// The ring round an edge against a walk over darts.
#include "topology/kernel/edges.hpp"

#include <random>

#include "tests/support/built.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

/// Out of the first tetrahedron opposite to the lower of the corners that are no ends, and, where
/// the boundary ends that way, opposite to the other one.
std::vector<CellEdge> slow_ring(const VolumeMap& map, CellEdge edge) {
  const auto [i, j] = edge_ends[static_cast<std::size_t>(edge.place)];
  const TetId t = edge.tetrahedron;
  std::vector<CellEdge> ring = {edge};
  for (int leave = 0; leave < 4; ++leave) {
    if (leave == i || leave == j) continue;
    DartId d = map.dart(half_face(t, leave), corner(t, i));
    if (map.vertex(map.beta1(d)) != map.corners(t)[static_cast<std::size_t>(j)]) {
      d = map.dart(half_face(t, leave), corner(t, j));
    }
    while (!map.is_free(d)) {
      d = map.beta2(map.beta3(d));
      const TetId u{d.index() / 12};
      if (u == t) return ring;
      const int k = static_cast<int>(d.index() % 12);
      ring.push_back({u, edge_between(dart_order::origin(k), dart_order::target(k))});
    }
  }
  return ring;
}

}  // namespace

TEST_CASE("the ring round an edge is that of the darts, in their order", "[topology][edges]") {
  std::mt19937_64 random(5);
  std::size_t open = 0, closed = 0;
  for (const TetMesh& mesh :
       {one_tetrahedron(), closed_fan(6), octahedron_star(), kuhn_box({3, 2, 2})}) {
    VolumeMap map = built(shuffled(mesh, 3));
    for (int cuts = 0; cuts < 3; ++cuts) {
      const EdgeRows rows = edge_rows(map);
      CHECK(rows.first.size() == count_cells(map).edges);
      for (std::size_t t = 0; t < map.tetrahedra(); ++t) {
        for (int e = 0; e < 6; ++e) {
          const std::vector<CellEdge> ring = edge_ring(map, {TetId{t}, e});
          REQUIRE(ring == slow_ring(map, {TetId{t}, e}));
          const std::uint32_t row = rows.of_cell[t][static_cast<std::size_t>(e)];
          for (const auto& [u, place] : ring) {
            REQUIRE(rows.of_cell[u.index()][static_cast<std::size_t>(place)] == row);
          }
          ++(ring.size() > 1 ? closed : open);
        }
      }
      for (const HalfFaceId f : interior_faces(map)) {
        if (below(random, 6) == 0) split_face(map, f);
      }
    }
  }
  CHECK((open > 100 && closed > 100));
}
