// SPDX-License-Identifier: MIT
// Labels, and their effect on the faces whatever the order of the fans.
#include "fracture/cracks/crack_labels.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <numeric>
#include <set>

#include "fracture/algorithms/split_fan.hpp"
#include "tests/support/tension.hpp"
#include "topology/base/union_find.hpp"
#include "topology/kernel/invariants.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

/// A break: every copy of a point, by one crack.
struct Break {
  std::uint32_t point = 0;
  CrackId crack;
};

/// Cracks that have labelled every tetrahedron beforehand, and which of them break where.
struct Labelled {
  Tension body;
  std::vector<Break> breaks;
};

Labelled labelled_body(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Labelled labelled{
      uniform_tension(jittered(kuhn_box({3, 2, 2}, 0.1), 0.015, seed), Vec3::UnitX(), 1e6), {}};
  VolumeMap& map = labelled.body.cells.map;
  CrackLabels& cracks = labelled.body.cells.cracks;
  for (int k = 0; k < 3; ++k) {
    const CrackId crack = add_crack(cracks, map.tetrahedra());
    Vec3 normal;
    for (double& x : normal) x = 2 * unit(random) - 1;
    const double offset = normal.dot(Vec3(0.15, 0.1, 0.1));
    for (std::size_t t = 0; t < map.tetrahedra(); ++t) {
      double distance = -offset;
      for (const VertexId v : map.corners(TetId{t})) {
        distance += 0.25 * normal.dot(Vec3(map.point(v).data()));
      }
      // The last one is no plane at all: nothing here needs one.
      add_label(cracks, crack, TetId{t}, k < 2 ? distance > 0 : below(random, 2) == 0);
    }
    for (std::uint32_t p = 0; p < map.points().size(); ++p) {
      if (below(random, k < 2 ? 2 : 8) == 0) labelled.breaks.push_back({p, crack});
    }
  }
  return labelled;
}

bool differs(const CrackLabels& cracks, CrackId crack, HalfFaceId a, HalfFaceId b) {
  return side_of(cracks, crack, tetrahedron_of(a)) != side_of(cracks, crack, tetrahedron_of(b));
}

std::set<HalfFaceId> free_faces(const VolumeMap& map) {
  std::set<HalfFaceId> faces;
  for (std::size_t f = 0; f < 4 * map.tetrahedra(); ++f) {
    if (map.neighbour(HalfFaceId{f}).is_none()) faces.insert(HalfFaceId{f});
  }
  return faces;
}

/// The slow twin: a face is unsewn where a crack that broke one of its points has labels that
/// differ across it.
std::set<HalfFaceId> expected_faces(const Labelled& labelled) {
  const VolumeMap& map = labelled.body.cells.map;
  std::set<HalfFaceId> faces = free_faces(map);
  for (std::size_t f = 0; f < 4 * map.tetrahedra(); ++f) {
    const HalfFaceId face{f}, other = map.neighbour(face);
    if (other.is_none()) continue;
    for (const Break& b : labelled.breaks) {
      bool at_point = false;
      for (const int place : dart_order::face_corners[place_of(face)]) {
        at_point |= map.point_of_vertex(map.corners(tetrahedron_of(face))[place]) == b.point;
      }
      if (at_point && differs(labelled.body.cells.cracks, b.crack, face, other)) faces.insert(face);
    }
  }
  return faces;
}

/// Corners that are one vertex, by the lowest of them: across the faces that are not in `cut`.
/// `intact`: the map before anything broke.
std::vector<std::uint32_t> expected_orbits(const VolumeMap& intact,
                                           const std::set<HalfFaceId>& cut) {
  UnionFind corners(4 * intact.tetrahedra());
  for (std::size_t f = 0; f < 4 * intact.tetrahedra(); ++f) {
    const HalfFaceId face{f}, other = intact.neighbour(face);
    if (cut.contains(face)) continue;
    const Corners& here = intact.corners(tetrahedron_of(face));
    const Corners& there = intact.corners(tetrahedron_of(other));
    for (const int a : dart_order::face_corners[place_of(face)]) {
      for (const int b : dart_order::face_corners[place_of(other)]) {
        if (here[a] != there[b]) continue;
        corners.join(corner(tetrahedron_of(face), a).value, corner(tetrahedron_of(other), b).value);
      }
    }
  }
  std::vector<std::uint32_t> orbits(corners.size());
  for (std::uint32_t c = 0; c < orbits.size(); ++c) orbits[c] = corners.root(c);
  return orbits;
}

std::vector<std::uint32_t> orbits_of(const VolumeMap& map) {
  std::map<VertexId, std::uint32_t> lowest;
  std::vector<std::uint32_t> orbits;
  for (std::uint32_t c = 0; c < 4 * map.tetrahedra(); ++c) {
    orbits.push_back(lowest.try_emplace(map.corners(TetId{c / 4})[c % 4], c).first->second);
  }
  return orbits;
}

void break_point(Tension& body, const Break& b, ComponentScratch& scratch) {
  VolumeMap& map = body.cells.map;
  for (std::size_t v = 0; v < map.vertices(); ++v) {
    if (map.point_of_vertex(VertexId{v}) != b.point) continue;
    const VertexStar star = vertex_star(map, VertexId{v});
    std::vector<char> positive;
    for (const CornerId c : star.corners) {
      positive.push_back(side_of(body.cells.cracks, b.crack, tetrahedron_of(c)) == Side::positive);
    }
    split_fan({body.cells, body.state}, star, Vec3::UnitX(), positive, {}, scratch);
  }
}

}  // namespace

TEST_CASE("fans of labelled cracks commute: 1 000 orders leave the same faces and vertices",
          "[fracture][cracks]") {
  constexpr int bodies = 25, orders = 40;
  std::size_t cut = 0;
  for (std::uint64_t seed = 0; seed < bodies; ++seed) {
    INFO("seed " << seed);
    Labelled labelled = labelled_body(seed);
    const VolumeMap& intact = labelled.body.cells.map;
    const std::set<HalfFaceId> faces = expected_faces(labelled);
    const std::vector<std::uint32_t> orbits = expected_orbits(intact, faces);
    cut += faces.size() - free_faces(intact).size();
    std::mt19937_64 random(seed);
    for (int order = 0; order < orders; ++order) {
      std::shuffle(labelled.breaks.begin(), labelled.breaks.end(), random);
      Tension body = labelled.body;
      ComponentScratch scratch;
      for (const Break& b : labelled.breaks) break_point(body, b, scratch);
      REQUIRE(free_faces(body.cells.map) == faces);
      REQUIRE(orbits_of(body.cells.map) == orbits);
    }
  }
  CHECK(cut > 500);
}

TEST_CASE("a tetrahedron keeps its side, and a star tells fronts from flanks",
          "[fracture][cracks]") {
  CrackLabels cracks;
  CHECK(side_of(cracks, CrackId{0}, TetId{3}) == Side::undecided);
  const CrackId first = add_crack(cracks, 8), second = add_crack(cracks, 8);
  // The second one's label is the newest, and is met first.
  add_label(cracks, first, TetId{3}, true);
  add_label(cracks, second, TetId{3}, false);
  add_label(cracks, first, TetId{4}, false);
  CHECK(side_of(cracks, first, TetId{3}) == Side::positive);
  CHECK(side_of(cracks, second, TetId{3}) == Side::negative);
  CHECK(side_of(cracks, second, TetId{4}) == Side::undecided);
  const VertexStar around{VertexId{0}, {corner(TetId{3}, 0), corner(TetId{4}, 2)}};
  const std::vector<CrackAtVertex> at = cracks_at(cracks, around);
  REQUIRE(at.size() == 2);
  CHECK((at[0].crack == first && at[0].is_front()));
  CHECK((at[1].crack == second && !at[1].is_front() && at[1].negative));
}

TEST_CASE("anchors count by distance, up to 3 h, and in their own component",
          "[fracture][cracks]") {
  CrackLabels cracks;
  const CrackId crack = add_crack(cracks, 1), other = add_crack(cracks, 1);
  const std::vector<ComponentId> component = {ComponentId{0}, ComponentId{1}};
  const auto add = [&](CrackId k, VertexId row, VertexId copy, double x, const Vec3& normal) {
    add_anchor(cracks, {k, row, copy, Vec3(x, 0, 0), normal});
  };
  add(crack, VertexId{0}, VertexId::none(), 1, Vec3::UnitX());
  add(other, VertexId{0}, VertexId::none(), 1, Vec3::UnitZ());
  add(crack, VertexId{1}, VertexId{0}, 2, Vec3::UnitY());
  add(crack, VertexId{1}, VertexId::none(), 1, Vec3::UnitZ());
  add(crack, VertexId{0}, VertexId::none(), 3.001, Vec3::UnitZ());
  const AnchorSums sums = anchors_near(cracks, crack, Vec3::Zero(), 1, component, ComponentId{0});
  const double near = std::exp(-0.5), far = std::exp(-2.0);
  CHECK(sums.weight == Approx(near + far));
  CHECK((sums.normal - Vec3(near, far, 0)).norm() < 1e-12);
  CHECK((sums.at - Vec3(near + 2 * far, 0, 0)).norm() < 1e-12);
}
