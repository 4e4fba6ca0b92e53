// SPDX-License-Identifier: MIT
// Columns of one's own through split faces, by the rules copy and share, compared with the map's
// own answers.
#include "topology/cells/columns.hpp"

#include <numeric>

#include "tests/support/built.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

/// A quarter of the rest volume of every tetrahedron at each vertex, counted again.
std::vector<double> volume_at_vertices(const VolumeMap& map) {
  std::vector<double> volume(map.vertices(), 0);
  for (const auto& corners : map.corners()) {
    std::array<Point, 4> p;
    for (std::size_t i = 0; i < 4; ++i) p[i] = map.point(corners[i]);
    double six = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      six += (p[1][i] - p[0][i]) * ((p[2][j] - p[0][j]) * (p[3][k] - p[0][k]) -
                                    (p[2][k] - p[0][k]) * (p[3][j] - p[0][j]));
    }
    for (const VertexId v : corners) volume[v.index()] += std::abs(six) / 24;
  }
  return volume;
}

}  // namespace

TEST_CASE("columns follow every split to total shatter, and can be taken back",
          "[cells][columns]") {
  VolumeMap map = built(jittered(kuhn_box({3, 2, 2}, 0.1), 0.02, 5));
  std::vector<double> mass = volume_at_vertices(map);
  const std::vector<double> mass_at_start = mass;
  std::vector<std::uint32_t> point(map.point_of_vertex().begin(), map.point_of_vertex().end());
  const double total = std::accumulate(mass.begin(), mass.end(), 0.0);
  std::vector<HalfFaceId> faces;
  for (std::size_t f = 0; f < 4 * map.tetrahedra(); ++f) faces.emplace_back(f);
  std::mt19937_64 random(3);
  for (std::size_t i = faces.size(); i > 1; --i) std::swap(faces[i - 1], faces[below(random, i)]);

  std::vector<ColumnBefore<double>> before;
  for (const HalfFaceId f : faces) {
    const FaceSplit split = split_face(map, f);
    extend_vertices(point, split);
    before.push_back(share_vertices(mass, split, parted_shares(map, split)));
    REQUIRE(point.size() == map.vertices());
    REQUIRE(mass.size() == map.vertices());
  }
  REQUIRE(map.vertices() == 4 * map.tetrahedra());
  CHECK(std::equal(point.begin(), point.end(), map.point_of_vertex().begin()));
  const std::vector<double> expected = volume_at_vertices(map);
  for (std::size_t v = 0; v < mass.size(); ++v)
    REQUIRE(mass[v] == Approx(expected[v]).epsilon(1e-12));
  CHECK(std::accumulate(mass.begin(), mass.end(), 0.0) == Approx(total).epsilon(1e-13));

  for (std::size_t i = before.size(); i-- > 0;) take_back(mass, before[i]);
  CHECK(mass == mass_at_start);
}

TEST_CASE("shares go by volumes whatever their signs, and are halves where there are none",
          "[cells][columns]") {
  TetMesh two;
  two.tetrahedra = {{0, 1, 2, 3}, {0, 1, 2, 4}};
  const auto shares = [&two](const Point& d, const Point& e, double size = 1) {
    two.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, d, e};
    for (Point& x : two.points) x = {size * x[0], size * x[1], size * x[2]};
    VolumeMap map = built(two);
    const FaceSplit split = split_face(map, half_face(TetId{0}, 3));
    REQUIRE(split.vertex_count == 3);
    // Of the tetrahedron at the lower of the two file points.
    const bool is_new = map.corners(TetId{0})[0] == split.split_vertices[0].new_row;
    const double share = parted_shares(map, split)[0];
    return is_new ? share : 1 - share;
  };
  CHECK(shares({0, 0, 1}, {0, 0, -0.5}) == Approx(2 / 3.0));
  CHECK(shares({0, 0, 1}, {0.25, 0.25, 0.5}) == Approx(2 / 3.0));  // folded: both on one side
  CHECK(shares({1, 1, 0}, {0.25, 0.25, 0}) == 0.5);                // flat
  CHECK(shares({1, 1, 1}, {1, 1, -1}, 1e200) == 0.5);              // too large for numbers
}
