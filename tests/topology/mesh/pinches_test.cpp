// SPDX-License-Identifier: MIT
// Bodies that touch themselves: every kind of pinch found, counted and split, against union-find.
#include <algorithm>
#include <map>

#include "tests/support/built.hpp"
#include "topology/mesh/repair.hpp"
#include "topology/suite/judge/judge_checks.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

namespace {

using Corners = std::vector<std::array<std::uint32_t, 4>>;

/// `parts` tetrahedra round the edge 0-1, two of which share nothing but that edge.
TetMesh round_an_edge(int parts) {
  TetMesh mesh = closed_fan(2 * parts);
  for (std::size_t t = 1; t < mesh.tetrahedra.size(); ++t) {
    mesh.tetrahedra.erase(mesh.tetrahedra.begin() + static_cast<std::ptrdiff_t>(t));
  }
  return mesh;
}

/// `parts` tetrahedra that share nothing but the point 0.
TetMesh round_a_vertex(std::uint32_t parts) {
  TetMesh mesh;
  mesh.points = {{0, 0, 0}};
  for (std::uint32_t i = 0; i < parts; ++i) {
    const double x = 2.0 * i - parts;
    mesh.points.insert(mesh.points.end(), {{x, 0, 1}, {x + 1, 0, 1}, {x, 1, 1}});
    mesh.tetrahedra.push_back({0, 3 * i + 1, 3 * i + 2, 3 * i + 3});
  }
  return mesh;
}

/// Tetrahedron 0 touches another one at each of its four points.
TetMesh at_all_corners() {
  TetMesh mesh = one_tetrahedron();
  for (std::uint32_t corner = 0; corner < 4; ++corner) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (std::size_t k = 0; k < 3; ++k) {
      Point p = mesh.points[corner];
      p[k] += 5 * (corner + 1.0);
      p[(k + 1) % 3] += 3;
      mesh.points.push_back(p);
    }
    mesh.tetrahedra.push_back({corner, first, first + 1, first + 2});
  }
  return mesh;
}

/// Cubes and tetrahedra of boxes left standing at random, some turned over.
TetMesh random_body(std::mt19937_64& random) {
  const Cells cells = {2 + static_cast<int>(below(random, 2)), 2, 2};
  TetMesh mesh = below(random, 2) == 0
                     ? kuhn_box(cells)
                     : kuhn_cubes(cells, [&](int, int, int) { return below(random, 2) == 0; });
  const double chance = 0.3 + 0.7 * unit(random);
  std::erase_if(mesh.tetrahedra, [&](const auto&) { return unit(random) > chance; });
  for (auto& t : mesh.tetrahedra) {
    if (below(random, 5) == 0) std::swap(t[below(random, 2)], t[2 + below(random, 2)]);
  }
  return mesh;
}

std::vector<std::uint32_t> flat(const Corners& corners) {
  std::vector<std::uint32_t> list;
  for (const auto& t : corners) list.insert(list.end(), t.begin(), t.end());
  return list;
}

/// Splits the pinched vertices: afterwards points are vertices, as union-find has them, and every
/// copy has the data of its point. Gives the number of copies.
std::size_t hold_split(const TetMesh& mesh) {
  FileMesh file = file_mesh_of(mesh);
  std::vector<double> vectors;
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    for (const double part : {0.25, 0.5, 0.75}) vectors.push_back(static_cast<double>(p) + part);
    file.point_region.push_back(static_cast<std::int32_t>(p % 3));
  }
  file.point_data = {{"vector", 3, NumberType::float64, vectors}};
  if (!mesh.tetrahedra.empty()) {
    const auto& t = mesh.tetrahedra.back();
    file.triangles.corners = {{t[0], t[1], t[2]}};
    file.edges.corners = {{t[1], t[3]}};
  }
  const FileMesh before = file;
  const GlueTwin twin = glue_twin(mesh.tetrahedra, mesh.points.size());
  const std::vector<std::uint32_t> expected = first_places(corner_classes(twin));
  const Finding told = split_nonmanifold(file);
  REQUIRE(told.severity == Severity::note);
  REQUIRE(told.count == file.points.size() - mesh.points.size());
  REQUIRE(first_places(flat(file.tetrahedra.corners)) == expected);
  const auto& now = std::get<std::vector<double>>(file.point_data[0].values);
  REQUIRE(now.size() == 3 * file.points.size());
  std::map<std::uint32_t, std::uint32_t> lowest;  // tetrahedron of each point of before
  for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t point = mesh.tetrahedra[t][i], row = file.tetrahedra.corners[t][i];
      if (lowest.emplace(point, t).second) CHECK(row == point);  // the first part keeps it
      REQUIRE(file.points[row] == mesh.points[point]);
      REQUIRE(file.point_region[row] == before.point_region[point]);
      for (std::size_t k = 0; k < 3; ++k) REQUIRE(now[3 * row + k] == vectors[3 * point + k]);
    }
  }
  CHECK(file.triangles == before.triangles);
  CHECK(file.edges == before.edges);
  const TetMesh split = {.points = file.points, .tetrahedra = file.tetrahedra.corners};
  const std::vector<std::string> found = codes(check_mesh(split, Severity::warning));
  CHECK(std::ranges::count(found, "pinched_vertex") == 0);
  CHECK(split_nonmanifold(file).count == 0);
  return told.count;
}

}  // namespace

TEST_CASE("every kind of pinch is split into the vertices that union-find has",
          "[topology][pinch]") {
  for (const std::uint32_t parts : {2U, 3U, 5U}) {
    INFO(parts << " parts");
    CHECK(hold_split(round_a_vertex(parts)) == parts - 1);
    CHECK(hold_split(shuffled(round_a_vertex(parts), parts)) == parts - 1);
    CHECK(hold_split(round_an_edge(static_cast<int>(parts))) == 2 * (parts - 1));
  }
  CHECK(hold_split(at_all_corners()) == 4);
  // A bar that touches itself in a vertex, an edge, the corners of a triangle.
  CHECK(hold_split(bent_bar(4, {{0, 0}})) == 1);
  CHECK(hold_split(bent_bar(4, {{0, 0}, {0, 1}})) == 2);
  CHECK(hold_split(bent_bar(4, {{0, 0}, {1, 1}})) == 2);
  CHECK(hold_split(joined_ring(4, false)) == 0);
  for (const NamedMesh& shape : all_shapes()) {
    INFO(shape.name);
    hold_split(shape.mesh);
  }
}

TEST_CASE("random pinches, of parts turned over among them, are split as union-find has them",
          "[topology][pinch]") {
  const std::uint64_t seed = 31;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  std::size_t copies = 0;
  for (int trial = 0; trial < 200; ++trial) {
    INFO("trial " << trial);
    const TetMesh mesh = random_body(random);
    if (!mesh.tetrahedra.empty()) copies += hold_split(mesh);
  }
  CHECK(copies > 500);
}

TEST_CASE("an edge of three and more orbits is one pinched edge with two pinched ends",
          "[topology][pinch]") {
  for (const int parts : {2, 3, 4, 6}) {
    INFO(parts << " orbits");
    const TetMesh mesh = round_an_edge(parts);
    const std::vector<Finding> findings = check_mesh(mesh);
    CHECK(codes(findings) == std::vector<std::string>{"pinched_vertex", "pinched_edge"});
    CHECK(finding(findings, "pinched_edge").count == 1);
    CHECK(finding(findings, "pinched_edge").ids == std::vector<std::int64_t>{0, 1});
    CHECK(finding(findings, "pinched_vertex").count == 2);
    const VolumeMap map = built(mesh);
    const auto k = static_cast<std::size_t>(parts);
    CHECK(cells(map) == Cells5{4 * k, 6 * k, 4 * k, k, k});
    CHECK(counts_without_chi(*check_file_mesh(file_mesh_of(mesh)).counts) ==
          counts_without_chi(count_cells(map)));
  }
}

TEST_CASE("a vertex whose link is a closed surface but no sphere is told", "[topology][pinch]") {
  // The torus of 7 points, and cones over it: round an apex everything is sewn, and yet no ball.
  TetMesh cone;
  std::mt19937_64 random(3);
  for (int p = 0; p < 9; ++p) cone.points.push_back({unit(random), unit(random), unit(random)});
  for (std::uint32_t i = 0; i < 7; ++i) {
    cone.tetrahedra.push_back({i, (i + 1) % 7, (i + 3) % 7, 7});
    cone.tetrahedra.push_back({i, (i + 2) % 7, (i + 3) % 7, 7});
  }
  TetMesh suspended = cone;
  for (std::size_t t = 0; t < 14; ++t) {
    auto other = cone.tetrahedra[t];
    other[3] = 8;
    suspended.tetrahedra.push_back(other);
  }
  const auto told = [](const TetMesh& mesh) {
    return finding(check_file_mesh(file_mesh_of(mesh)).findings, "nonmanifold_vertex").ids;
  };
  CHECK(told(cone) == std::vector<std::int64_t>{7});
  CHECK(told(suspended) == std::vector<std::int64_t>{7, 8});
  // Nothing is reported of vertices inside a ball, or half of one.
  for (const TetMesh& ball : {octahedron_star(), vertex_star(64), edge_ring(64),
                              kuhn_box({2, 2, 2}), closed_simplex_boundary()}) {
    const std::vector<std::string> found = codes(check_file_mesh(file_mesh_of(ball)).findings);
    CHECK(std::ranges::count(found, "nonmanifold_vertex") == 0);
  }
}
