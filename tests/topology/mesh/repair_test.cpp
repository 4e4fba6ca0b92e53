// SPDX-License-Identifier: MIT
// Repairs: their changes, the kept rest, and meshes without the fault, which stay as they are.
#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>

#include "tests/support/io_support.hpp"
#include "topology/mesh/check.hpp"
#include "topology/mesh/repair.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// Two tetrahedra on one face, with data on everything.
FileMesh body() {
  FileMesh mesh = file_mesh_of(two_tetrahedra());
  mesh.point_data = {{"row", 1, NumberType::int32, std::vector<std::int64_t>{0, 1, 2, 3, 4}}};
  mesh.tetrahedra.data = {{"pair", 2, NumberType::float64, std::vector<double>{0, 0.5, 1, 1.5}}};
  mesh.triangles.corners = {{1, 2, 3}};
  mesh.triangles.region = {8};
  return mesh;
}

const std::vector<double>& pairs_of(const FileMesh& mesh) {
  return std::get<std::vector<double>>(mesh.tetrahedra.data.at(0).values);
}

bool has(const FileMesh& mesh, const std::string& code) {
  FileMesh copy = mesh;
  const auto findings = check_mesh(tet_mesh_of(std::move(copy)), Severity::warning);
  return std::ranges::find(findings, code, &Finding::code) != findings.end();
}

/// `count` copies of the body next to each other, touching nowhere.
FileMesh several(std::size_t count) {
  FileMesh mesh = file_mesh_of(two_tetrahedra());
  const FileMesh one = mesh;
  for (std::size_t i = 1; i < count; ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (Point p : one.points) {
      p[0] += 10.0 * static_cast<double>(i);
      mesh.points.push_back(p);
    }
    auto t = one.tetrahedra.corners[0];
    for (std::uint32_t& corner : t) corner += first;
    mesh.tetrahedra.corners.push_back(t);
    mesh.tetrahedra.region.push_back(9);
  }
  return mesh;
}

}  // namespace

TEST_CASE("a mesh without faults is left as it is by every repair", "[io][repair]") {
  const FileMesh good = body();
  FileMesh mesh = good;
  for (const Finding& f : repair(mesh, {0.0, true, true, true, true, true})) {
    INFO(f.code << ": " << f.text);
    CHECK(f.count == 0);
    CHECK(f.severity == Severity::note);
  }
  CHECK(mesh == good);
}

TEST_CASE("inverted tetrahedra are turned round", "[io][repair]") {
  FileMesh mesh = body();
  const auto good = mesh.tetrahedra.corners;
  std::swap(mesh.tetrahedra.corners[1][0], mesh.tetrahedra.corners[1][1]);
  REQUIRE(has(mesh, "inverted_tetrahedron"));
  CHECK(fix_orientation(mesh).count == 1);
  CHECK_FALSE(has(mesh, "inverted_tetrahedron"));
  CHECK(mesh.tetrahedra.corners[0] == good[0]);
}

TEST_CASE("unused points are dropped, the others keep their data and numbers", "[io][repair]") {
  FileMesh mesh = body();
  const FileMesh good = mesh;
  mesh.points.insert(mesh.points.begin() + 2, {7, 7, 7});
  auto& rows = std::get<std::vector<std::int64_t>>(mesh.point_data[0].values);
  rows.insert(rows.begin() + 2, 99);
  for_each_cell_list(mesh, [](auto& cells, int) {
    for (auto& corners : cells.corners) {
      for (std::uint32_t& corner : corners) corner += corner >= 2;
    }
  });
  CHECK(drop_unused_points(mesh).count == 1);
  CHECK(mesh.points == good.points);
  CHECK(mesh.point_data == good.point_data);
  CHECK(mesh.tetrahedra == good.tetrahedra);
  CHECK(mesh.triangles == good.triangles);
  CHECK(mesh.source_point_id == std::vector<std::int64_t>{1, 2, 4, 5, 6});
}

TEST_CASE("near points are merged and tetrahedra without volume dropped", "[io][repair]") {
  FileMesh mesh = body();
  const FileMesh good = mesh;
  // The second tetrahedron gets its own copies of the shared face, a little off.
  for (std::uint32_t& corner : mesh.tetrahedra.corners[1]) {
    if (std::ranges::find(good.tetrahedra.corners[0], corner) == good.tetrahedra.corners[0].end()) {
      continue;
    }
    Point p = mesh.points[corner];
    p[1] += 1e-7;
    corner = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back(p);
  }
  mesh.point_data.clear();
  REQUIRE(mesh.points.size() == 8);
  FileMesh exact = mesh;
  CHECK(merge_points(exact, 0).count == 0);
  CHECK(merge_points(mesh, 1e-6).count == 3);
  CHECK(mesh.points == good.points);
  CHECK(mesh.tetrahedra.corners == good.tetrahedra.corners);
  FileMesh gone = body();
  gone.points[4] = {1, 1, 1};
  CHECK(merge_points(gone, 100).count == 4);
  CHECK(gone.tetrahedra.corners.empty());
  CHECK(gone.triangles.corners.empty());
}

TEST_CASE("points merge with points of every cube around theirs, and the rows behind move up",
          "[io][repair]") {
  // Pairs that lie in cubes of the merging distance in each of the 27 ways to each other; cubes of
  // negative numbers and of 0 among them. Each point that goes moves the rows behind it.
  FileMesh mesh;
  std::vector<Point> kept;
  for (int way = 0; way < 27; ++way) {
    const std::array<int, 3> to = {way % 3 - 1, way / 3 % 3 - 1, way / 9 - 1};
    Point first, second;
    for (std::size_t k = 0; k < 3; ++k) {
      // Odd numbers of cubes along x: keys of some even ones are the same.
      const double cube = k == 0 ? 4.0 * way - 51 : -1;
      first[k] = cube + 0.5 + 0.4 * to[k];
      second[k] = cube + 0.5 + 0.6 * to[k];
    }
    mesh.points.insert(mesh.points.end(), {first, second});
    kept.push_back(first);
  }
  for (std::uint32_t i = 0; i + 3 < 27; ++i) {
    mesh.tetrahedra.corners.push_back({2 * i + 1, 2 * i + 2, 2 * i + 5, 2 * i + 6});
  }
  CHECK(merge_points(mesh, 1).count == 27);
  CHECK(mesh.points == kept);
  REQUIRE(mesh.tetrahedra.corners.size() == 24);
  for (std::uint32_t i = 0; i < 24; ++i) {
    CHECK(mesh.tetrahedra.corners[i] == std::array<std::uint32_t, 4>{i, i + 1, i + 2, i + 3});
  }
}

TEST_CASE("merging agrees with comparing all pairs", "[io][repair]") {
  FileMesh mesh;
  std::uint64_t state = 7;
  const auto random = [&state] {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state >> 40) / static_cast<double>(1 << 24) - 0.5;
  };
  for (int i = 0; i < 400; ++i) mesh.points.push_back({random(), random(), random()});
  std::vector<Point> kept;
  std::vector<std::array<std::uint32_t, 1>> row;  // of each point, once all are merged
  for (std::uint32_t i = 0; i < 400; ++i) {
    const Point& p = mesh.points[i];
    const auto near = std::ranges::find_if(kept, [&](const Point& q) {
      double sum = 0;
      for (int k = 0; k < 3; ++k) sum += (p[k] - q[k]) * (p[k] - q[k]);
      return sum <= 0.01;
    });
    row.push_back({static_cast<std::uint32_t>(near - kept.begin())});
    if (near == kept.end()) kept.push_back(p);
    mesh.vertices.corners.push_back({i});
  }
  CHECK(merge_points(mesh, 0.1).count == 400 - kept.size());
  CHECK(mesh.points == kept);
  CHECK(mesh.vertices.corners == row);
}

TEST_CASE("points that coincide merge at distance 0, and as quickly", "[io][repair]") {
  // By all pairs this would be 10^10 distances.
  constexpr std::uint32_t n = 100000;
  FileMesh mesh;
  for (std::uint32_t i = 0; i < 2 * n; ++i) {
    const double x = -1e3 - (i % n) * 1e-9;
    mesh.points.push_back({x, x - 7, i % 3 == 0 ? 0.0 : -0.0});
    mesh.vertices.corners.push_back({i});
  }
  mesh.points.push_back({std::nan(""), 0, 0});
  mesh.points.push_back({std::nan(""), 0, 0});
  mesh.points.push_back({std::numeric_limits<double>::infinity(), 0, 0});
  CHECK(merge_points(mesh, 0).count == n);
  REQUIRE(mesh.points.size() == n + 3);
  for (std::uint32_t i = 0; i < 2 * n; ++i) REQUIRE(mesh.vertices.corners[i][0] == i % n);
}

TEST_CASE("of equal tetrahedra the first stays, with its data", "[io][repair]") {
  FileMesh mesh = body();
  auto again = mesh.tetrahedra.corners[0];
  std::rotate(again.begin(), again.begin() + 1, again.end());
  mesh.tetrahedra.corners.insert(mesh.tetrahedra.corners.begin() + 1, again);
  mesh.tetrahedra.region = {2, 7, 5};
  mesh.tetrahedra.data = {{"pair", 2, NumberType::float64, std::vector<double>{0, 0, 1, 1, 2, 2}}};
  REQUIRE(has(mesh, "mirrored_tetrahedron") != has(mesh, "duplicate_tetrahedron"));
  CHECK(drop_duplicate_tetrahedra(mesh).count == 1);
  CHECK(mesh.tetrahedra.corners == body().tetrahedra.corners);
  CHECK(mesh.tetrahedra.region == std::vector<std::int32_t>{2, 5});
  CHECK(pairs_of(mesh) == std::vector<double>{0, 0, 2, 2});
  CHECK(mesh.tetrahedra.source_id == std::vector<std::int64_t>{2, 4});  // the triangle is 1
  CHECK(mesh.triangles.source_id == std::vector<std::int64_t>{1});
}

TEST_CASE("the largest component stays, with its surfaces", "[io][repair]") {
  FileMesh mesh = several(3);
  mesh.triangles.corners = {{5, 6, 7}, {0, 1, 2}};
  CHECK(keep_largest_component(mesh).count == 2);
  CHECK(mesh.tetrahedra.corners.size() == 2);
  CHECK(mesh.triangles.corners == std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
  CHECK(drop_unused_points(mesh).count == 10);
}

TEST_CASE("of what touches the largest component only its own surfaces, edges and vertices stay",
          "[io][repair]") {
  // Two tetrahedra on a face; others touch them in an edge, in a vertex and in three points that
  // have no face in common.
  FileMesh mesh;
  mesh.points.resize(11);
  mesh.tetrahedra.corners = {{0, 1, 5, 6}, {0, 1, 2, 3}, {1, 0, 2, 4}, {2, 7, 8, 9}, {0, 3, 4, 10}};
  mesh.triangles.corners = {{0, 1, 5}, {0, 1, 3}, {2, 7, 8}, {7, 8, 9}, {0, 3, 4}, {1, 2, 4}};
  mesh.triangles.region = {1, 2, 3, 4, 5, 6};
  mesh.edges.corners = {{0, 1}, {0, 5}, {7, 8}};
  mesh.vertices.corners = {{7}, {2}};
  CHECK(keep_largest_component(mesh).count == 3);
  CHECK(mesh.tetrahedra.corners ==
        std::vector<std::array<std::uint32_t, 4>>{{0, 1, 2, 3}, {1, 0, 2, 4}});
  CHECK(mesh.triangles.corners ==
        std::vector<std::array<std::uint32_t, 3>>{{0, 1, 3}, {0, 3, 4}, {1, 2, 4}});
  CHECK(mesh.triangles.region == std::vector<std::int32_t>{2, 5, 6});
  CHECK(mesh.edges.corners == std::vector<std::array<std::uint32_t, 2>>{{0, 1}});
  CHECK(mesh.vertices.corners == std::vector<std::array<std::uint32_t, 1>>{{2}});
}

TEST_CASE("vertices that only touch are split into copies", "[io][repair]") {
  // Two tetrahedra on one edge, and a third at one vertex.
  FileMesh mesh;
  mesh.points = {{0, 0, 0},   {0, 0, 1},  {1, 0, 0},  {1, 1, 0}, {-1, 0, 0},
                 {-1, -1, 0}, {0, 0, -1}, {1, 0, -1}, {0, 1, -1}};
  mesh.tetrahedra.corners = {{0, 2, 3, 1}, {0, 4, 5, 1}, {0, 6, 7, 8}};
  mesh.point_region = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  fix_orientation(mesh);
  REQUIRE(has(mesh, "pinched_edge"));
  REQUIRE(has(mesh, "pinched_vertex"));
  CHECK(split_nonmanifold(mesh).count == 3);
  CHECK(mesh.points.size() == 12);
  CHECK(mesh.point_region.size() == 12);
  CHECK(mesh.source_point_id.size() == 12);
  CHECK_FALSE(has(mesh, "pinched_edge"));
  CHECK_FALSE(has(mesh, "pinched_vertex"));
  CHECK(split_nonmanifold(mesh).count == 0);
  mesh.tetrahedra.corners.push_back(mesh.tetrahedra.corners[0]);
  const Finding refused = split_nonmanifold(mesh);
  CHECK(refused.severity == Severity::error);
}
