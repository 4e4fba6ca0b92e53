// SPDX-License-Identifier: MIT
// Faces by their points against the map's neighbours.
#include "topology/mesh/face_table.hpp"

#include "tests/support/built.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

TEST_CASE("the face table pairs what the map has sewn, and has every face once",
          "[topology][face_table]") {
  const TetMesh mesh = shuffled(kuhn_box({3, 2, 2}), 7);
  const VolumeMap map = built(mesh);
  REQUIRE(map.reoriented().empty());
  std::size_t faces = 0, sides_met = 0;
  std::array<std::uint32_t, 3> last = {0, 0, 0};
  for_each_face(face_table(mesh.tetrahedra, mesh.points.size()),
                [&](const auto& points, std::span<const TableFace> sides) {
                  CHECK(last < points);
                  last = points;
                  CHECK((points[0] < points[1] && points[1] < points[2]));
                  ++faces;
                  sides_met += sides.size();
                  const HalfFaceId f{sides[0].half_face};
                  const HalfFaceId across = map.neighbour(f);
                  REQUIRE(sides.size() == (across.is_none() ? 1 : 2));
                  if (!across.is_none()) CHECK(sides[1].half_face == across.value);
                  std::array<std::uint32_t, 4> t = mesh.tetrahedra[f.index() / 4];
                  t[f.index() % 4] = 0xffffffffU;
                  std::ranges::sort(t);
                  CHECK(std::equal(points.begin(), points.end(), t.begin()));
                });
  CHECK(faces == count_cells(map).faces);
  CHECK(sides_met == 4 * mesh.tetrahedra.size());
}

TEST_CASE("a face of three tetrahedra has three sides, one that is left out none",
          "[topology][face_table]") {
  const std::vector<std::array<std::uint32_t, 4>> tetrahedra = {
      {0, 1, 2, 3}, {2, 1, 0, 4}, {1, 2, 0, 5}, {0, 1, 2, 6}};
  const std::vector<char> usable = {1, 1, 1, 0};
  std::vector<std::uint32_t> shared;
  for_each_face(face_table(tetrahedra, 7, usable),
                [&](const auto& points, std::span<const TableFace> sides) {
                  CHECK(points[2] != 6);
                  if (points != std::array<std::uint32_t, 3>{0, 1, 2}) return;
                  for (const TableFace& side : sides) shared.push_back(side.half_face);
                });
  CHECK(shared == std::vector<std::uint32_t>{3, 7, 11});
}

TEST_CASE("a face of one point alone is a face, be it the last one", "[topology][face_table]") {
  const std::vector<std::array<std::uint32_t, 4>> tetrahedra = {{2, 2, 2, 2}};
  std::vector<std::size_t> sides_met;
  for_each_face(face_table(tetrahedra, 3),
                [&](const auto& points, std::span<const TableFace> sides) {
                  CHECK(points == std::array<std::uint32_t, 3>{2, 2, 2});
                  sides_met.push_back(sides.size());
                });
  CHECK(sides_met == std::vector<std::size_t>{4});
}
