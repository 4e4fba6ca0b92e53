// SPDX-License-Identifier: MIT
// The file's order of corners, as a map remembers it.
#include "topology/mesh/build_map.hpp"

#include <algorithm>

#include "tests/support/built.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

/// The tetrahedra with corners 2 and 3 exchanged in the map against the file; the others must have
/// all corners in their places.
std::vector<TetId> exchanged(const VolumeMap& map, const TetMesh& file) {
  std::vector<TetId> rows;
  for (std::size_t t = 0; t < map.tetrahedra(); ++t) {
    auto points = file.tetrahedra[t];
    std::array<std::uint32_t, 4> now;
    for (std::size_t i = 0; i < 4; ++i) now[i] = map.point_of_vertex(map.corners(TetId{t})[i]);
    if (now == points) continue;
    std::swap(points[2], points[3]);
    CHECK(now == points);
    rows.push_back(TetId{t});
  }
  return rows;
}

}  // namespace

TEST_CASE(
    "reoriented names just the tetrahedra with two corners exchanged, whatever is done to the map",
    "[topology][build_map]") {
  const std::uint64_t seed = 77;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  for (const MapKernel kernel : {MapKernel::dense, MapKernel::lcc}) {
    TetMesh mesh = jittered(kuhn_box({3, 2, 2}), 0.1, 5);
    std::vector<TetId> turned;
    for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
      if (below(random, 3) != 0) continue;
      const std::size_t i = below(random, 4);
      std::swap(mesh.tetrahedra[t][i], mesh.tetrahedra[t][(i + 1 + below(random, 3)) % 4]);
      turned.push_back(TetId{t});
    }
    REQUIRE((turned.size() > 10 && 2 * turned.size() < mesh.tetrahedra.size()));
    VolumeMap map = built(mesh);
    map.set_kernel(kernel);
    const auto hold = [&](const VolumeMap& of) {
      CHECK(std::ranges::equal(of.reoriented(), turned));
      CHECK(exchanged(of, mesh) == turned);
    };
    hold(map);
    std::vector<FaceSplit> done;
    for (const HalfFaceId f : interior_faces(map)) done.push_back(split_face(map, f));
    hold(map);
    const VolumeMap copy = map;
    hold(copy);
    for (std::size_t i = done.size(); i > 0; --i) {
      glue_face(map, done[i - 1].face, done[i - 1].opposite);
    }
    hold(map);
    hold(VolumeMap(std::move(map)));
  }
}

TEST_CASE("a body turned over as a whole has all its tetrahedra reoriented, a good one none",
          "[topology][build_map]") {
  TetMesh mesh = side_by_side(kuhn_box({2, 1, 1}), two_tetrahedra());
  CHECK(built(mesh).reoriented().empty());
  for (std::size_t t = 0; t < 12; ++t) std::swap(mesh.tetrahedra[t][0], mesh.tetrahedra[t][3]);
  const VolumeMap map = built(mesh);
  CHECK(map.reoriented().size() == 12);
  CHECK(exchanged(map, mesh).size() == 12);
}
