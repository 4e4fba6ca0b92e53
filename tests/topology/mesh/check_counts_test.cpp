// SPDX-License-Identifier: MIT
// Counts from adjacency against those of the 3-map and of union-find, on every body at hand and on
// random ones; vertices where a surface touches itself against walks over the darts.
#include <set>

#include "tests/support/built.hpp"
#include "topology/mesh/survey.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

/// Counts of the check, compared with the map's: equal in every member, the volume to the bit.
void hold_counts(const TetMesh& mesh) {
  const MeshCheck checked = check_file_mesh(file_mesh_of(mesh));
  const Result<VolumeMap> map = build_map(mesh, Severity::warning);
  REQUIRE(checked.counts.has_value() == static_cast<bool>(map));
  if (!map) return;
  const Counts slow = count_cells(*map), &fast = *checked.counts;
  REQUIRE(counts_without_chi(fast) == counts_without_chi(slow));
  REQUIRE(counts_without_chi(fast) == union_find_counts(twin_of(*map, mesh.points.size())));
  REQUIRE(fast.euler_characteristic == slow.euler_characteristic);
  REQUIRE((fast.volume == slow.volume || std::isnan(slow.volume)));
  const bool is_in_space = !has_error(check_mesh(mesh));
  REQUIRE(fast.betti == (is_in_space ? slow.betti : std::nullopt));
}

/// Points with a vertex orbit in the map that is bounded by more than one circle of faces.
std::set<std::uint32_t> touching_points(const VolumeMap& map) {
  const std::size_t darts = 12 * map.tetrahedra();
  std::vector<char> met(darts, 0);
  std::vector<int> circles(map.vertices(), 0);
  for (std::size_t k = 0; k < darts; ++k) {
    const TetId t{k / 12};
    const int place = static_cast<int>(k % 12);
    const DartId first = map.dart(half_face(t, place / 3), corner(t, dart_order::origin(place)));
    if (!map.is_free(first) || met[first.index()]) continue;
    ++circles[map.vertex(first).index()];
    // Over the edge before the vertex to the next boundary face at it, until round.
    for (DartId d = first; !met[d.index()];) {
      met[d.index()] = 1;
      d = map.beta2(map.beta0(d));
      while (!map.is_free(d)) d = map.beta2(map.beta3(d));
    }
  }
  std::set<std::uint32_t> points;
  for (std::size_t v = 0; v < circles.size(); ++v) {
    if (circles[v] > 1) points.insert(map.point_of_vertex(VertexId{v}));
  }
  return points;
}

std::set<std::uint32_t> found_points(const MeshCheck& check, const std::string& code) {
  for (const FindingPlaces& places : check.places) {
    if (places.code == code) return {places.rows.begin(), places.rows.end()};
  }
  return {};
}

/// A box of which every cube, or every tetrahedron, stands with a chance.
TetMesh random_body(std::mt19937_64& random) {
  const double chance = 0.2 + 0.7 * unit(random);
  const Cells cells = {1 + static_cast<int>(below(random, 4)),
                       1 + static_cast<int>(below(random, 4)),
                       1 + static_cast<int>(below(random, 4))};
  if (below(random, 2) == 0) {
    return kuhn_cubes(cells, [&](int, int, int) { return unit(random) < chance; });
  }
  TetMesh mesh = kuhn_box(cells);
  std::erase_if(mesh.tetrahedra, [&](const auto&) { return unit(random) > chance; });
  return mesh;
}

}  // namespace

TEST_CASE("counts from adjacency are the map's on every shape", "[topology][check]") {
  for (const NamedMesh& shape : all_shapes()) {
    INFO(shape.name);
    hold_counts(shape.mesh);
    hold_counts(shuffled(shape.mesh, 7));
  }
  hold_counts(closed_simplex_boundary());
  hold_counts(joined_ring(4, true));  // not orientable: neither has counts
}

TEST_CASE("counts from adjacency are the map's on random bodies of cubes and tetrahedra",
          "[topology][check]") {
  const std::uint64_t seed = 20261121;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  for (int trial = 0; trial < 400; ++trial) {
    INFO("trial " << trial);
    TetMesh mesh = random_body(random);
    for (auto& t : mesh.tetrahedra) {
      if (below(random, 4) == 0) std::swap(t[0], t[1]);
    }
    hold_counts(mesh);
  }
}

TEST_CASE("counts from adjacency are the map's where points are joined at random",
          "[topology][check]") {
  const std::uint64_t seed = 6;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  std::size_t counted = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    INFO("trial " << trial);
    TetMesh mesh;
    const std::size_t points = 4 + below(random, 8), tetrahedra = 1 + below(random, 9);
    for (std::size_t p = 0; p < points; ++p) {
      mesh.points.push_back({unit(random), unit(random), unit(random)});
    }
    for (std::size_t t = 0; t < tetrahedra; ++t) {
      auto& corners = mesh.tetrahedra.emplace_back();
      for (auto& p : corners) p = static_cast<std::uint32_t>(below(random, points));
    }
    hold_counts(mesh);
    counted += check_file_mesh(file_mesh_of(mesh)).counts ? 1 : 0;
  }
  CHECK(counted > 100);
}

TEST_CASE("there are no Betti numbers while any part is closed, wherever it stands in the file",
          "[topology][check]") {
  const TetMesh closed = closed_simplex_boundary(), open = one_tetrahedron();
  const auto betti_of = [](const TetMesh& mesh) {
    const auto betti = count_cells(built(mesh)).betti;
    CHECK(count_cells(survey_mesh(mesh, Severity::warning)).betti == betti);
    return betti;
  };
  CHECK_FALSE(betti_of(side_by_side(closed, open)));
  CHECK_FALSE(betti_of(side_by_side(open, closed)));
  CHECK_FALSE(betti_of(side_by_side(closed, closed)));
  CHECK_FALSE(betti_of(side_by_side(side_by_side(open, closed), open)));
  CHECK(betti_of(side_by_side(open, open)) == Betti{2, 0, 0});
  // The first cut of the closed part gives it a boundary, and both parts their numbers.
  const TetMesh mesh = side_by_side(open, closed);
  VolumeMap map = built(mesh);
  const Counts before = count_cells(map);
  const FaceSplit split = split_face(map, half_face(TetId{1}, 0));
  CHECK(*count_cells(map).betti == Betti{2, 0, 0});
  CHECK(counts_after(before, map, std::span(&split, 1), 0) == count_cells(map));
  // Cut elsewhere it stays closed, and there are none.
  VolumeMap beside = built(side_by_side(two_tetrahedra(), closed));
  const Counts whole = count_cells(beside);
  const FaceSplit apart = split_face(beside, interior_faces(beside).front());
  REQUIRE(apart.vertex_count == 3);
  CHECK_FALSE(count_cells(beside).betti);
  CHECK(counts_after(whole, beside, std::span(&apart, 1), 1) == count_cells(beside));
  CHECK(survey_mesh(side_by_side(closed, open), Severity::warning).closed_components == 1);
}

TEST_CASE("a surface that touches itself in a vertex is told", "[topology][check]") {
  // Two holes that meet in the point (2, 2, 2): round it the body hangs together as a ring.
  const Cells cells = {4, 4, 4};
  const TetMesh mesh = kuhn_cubes(cells, [](int i, int j, int k) {
    return !(i == 1 && j == 1 && k == 1) && !(i == 2 && j == 2 && k == 2);
  });
  const MeshCheck check = check_file_mesh(file_mesh_of(mesh));
  const Finding f = finding(check.findings, "nonmanifold_vertex");
  CHECK(f.severity == Severity::note);
  CHECK(f.ids == std::vector<std::int64_t>{grid_point(cells, 2, 2, 2)});
  CHECK(codes(check.findings) == std::vector<std::string>{"nonmanifold_vertex"});
  // The same point as the first of the file.
  TetMesh other = mesh;
  const auto at = static_cast<std::uint32_t>(f.ids[0]);
  std::swap(other.points[0], other.points[at]);
  for (auto& t : other.tetrahedra) {
    for (std::uint32_t& p : t) p = p == 0 ? at : p == at ? 0 : p;
  }
  CHECK(finding(check_file_mesh(file_mesh_of(other)).findings, "nonmanifold_vertex").ids ==
        std::vector<std::int64_t>{0});
}

TEST_CASE("vertices where a surface touches itself are those with several circles of faces",
          "[topology][check]") {
  const std::uint64_t seed = 17;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  std::size_t found = 0;
  for (int trial = 0; trial < 300; ++trial) {
    INFO("trial " << trial);
    const TetMesh mesh = random_body(random);
    const Result<VolumeMap> map = build_map(mesh);
    if (!map) continue;
    const auto points =
        found_points(check_file_mesh(file_mesh_of(mesh), true), "nonmanifold_vertex");
    REQUIRE(points == touching_points(*map));
    found += points.size();
  }
  CHECK(found > 10);
}
