// SPDX-License-Identifier: MIT
// Cracks in mesh files against the 3-map: the same faces split there give the same vertices.
#include "topology/mesh/crack.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <set>

#include "tests/support/built.hpp"
#include "topology/mesh/file_mesh.hpp"
#include "topology/mesh/repair.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// A grid of cubes, six tetrahedra each, with everything that a crack has to keep.
FileMesh grid(std::uint32_t n) {
  FileMesh mesh;
  const auto row = [n](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return (z * (n + 1) + y) * (n + 1) + x;
  };
  for (std::uint32_t i = 0; i < (n + 1) * (n + 1) * (n + 1); ++i) {
    const std::uint32_t x = i % (n + 1), y = i / (n + 1) % (n + 1), z = i / (n + 1) / (n + 1);
    mesh.points.push_back({double(x), double(y), double(z)});
    mesh.point_region.push_back(static_cast<std::int32_t>(i % 5));
    mesh.source_point_id.push_back(1000 + i);
  }
  constexpr int orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  for (std::uint32_t cube = 0; cube < n * n * n; ++cube) {
    const std::array<std::uint32_t, 3> base = {cube % n, cube / n % n, cube / n / n};
    for (const auto& order : orders) {
      std::array<std::uint32_t, 3> at = base;
      std::array<std::uint32_t, 4> corners{row(at[0], at[1], at[2])};
      for (std::size_t k = 0; k < 3; ++k) {
        ++at[static_cast<std::size_t>(order[k])];
        corners[k + 1] = row(at[0], at[1], at[2]);
      }
      mesh.tetrahedra.corners.push_back(corners);
      mesh.tetrahedra.region.push_back(base[0] < n / 2 ? 1 : 2);
    }
  }
  mesh.region_name[3] = {{1, "left"}, {2, "right"}};
  std::vector<double> heights;
  for (const Point& p : mesh.points) heights.push_back(p[2] + 0.25);
  mesh.point_data.push_back({"height", 1, NumberType::float64, heights});
  std::vector<double> vectors;
  std::vector<std::int64_t> pairs;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const auto number = static_cast<std::int64_t>(i);
    for (const double part : {0.25, 0.5, 0.75}) vectors.push_back(static_cast<double>(i) + part);
    pairs.insert(pairs.end(), {number, -number});
  }
  mesh.point_data.push_back({"vector", 3, NumberType::float64, vectors});
  mesh.point_data.push_back({"pair", 2, NumberType::int64, pairs});
  return mesh;
}

double volume(const FileMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.tetrahedra.corners) {
    const auto edge = [&](std::size_t k, std::size_t i) {
      return mesh.points[t[k]][i] - mesh.points[t[0]][i];
    };
    sum += std::abs(edge(1, 0) * (edge(2, 1) * edge(3, 2) - edge(2, 2) * edge(3, 1)) -
                    edge(1, 1) * (edge(2, 0) * edge(3, 2) - edge(2, 2) * edge(3, 0)) +
                    edge(1, 2) * (edge(2, 0) * edge(3, 1) - edge(2, 1) * edge(3, 0))) /
           6;
  }
  return sum;
}

/// Corners of tetrahedra, 4 t + k, numbered by the first of their point: a partition.
template <class Corners>
std::vector<std::size_t> partition(const Corners& corners) {
  std::map<std::size_t, std::size_t> first;
  std::vector<std::size_t> parts;
  for (std::size_t t = 0; t < corners.size(); ++t) {
    for (const std::size_t point : corners[t]) {
      parts.push_back(first.emplace(point, parts.size()).first->second);
    }
  }
  return parts;
}

/// The same of a map's vertices, each found at the file's corner that has its point.
std::vector<std::size_t> partition(const VolumeMap& map, const FileMesh& before) {
  std::vector<std::array<std::size_t, 4>> corners(before.tetrahedra.corners.size());
  for (std::size_t t = 0; t < corners.size(); ++t) {
    for (std::size_t k = 0; k < 4; ++k) {
      for (const VertexId v : map.corners(TetId{t})) {
        if (map.point_of_vertex(v) == before.tetrahedra.corners[t][k]) corners[t][k] = v.index();
      }
    }
  }
  return partition(corners);
}

std::size_t components(const FileMesh& mesh) {
  TetMesh tetrahedra;
  tetrahedra.points = mesh.points;
  tetrahedra.tetrahedra = mesh.tetrahedra.corners;
  return count_cells(built(tetrahedra)).components;
}

std::array<std::uint32_t, 3> points_of(const FileMesh& mesh, std::uint32_t face) {
  std::array<std::uint32_t, 3> points;
  std::size_t n = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    if (k != face % 4) points[n++] = mesh.tetrahedra.corners[face / 4][k];
  }
  return points;
}

VolumeMap map_of(const FileMesh& mesh) {
  TetMesh tetrahedra;
  tetrahedra.points = mesh.points;
  tetrahedra.tetrahedra = mesh.tetrahedra.corners;
  return built(tetrahedra);
}

/// The numbers of one row of a column; doubles hold all that stand in the columns here.
std::vector<double> row_of(const DataColumn& column, std::size_t row) {
  return std::visit(
      [&](const auto& values) {
        const auto first = values.begin() + static_cast<std::ptrdiff_t>(row * column.components);
        return std::vector<double>(first, first + static_cast<std::ptrdiff_t>(column.components));
      },
      column.values);
}

std::size_t row_count(const DataColumn& column) {
  return std::visit([](const auto& values) { return values.size(); }, column.values) /
         column.components;
}

/// Opens the crack and compares it with the map's split faces and the laws.
Crack checked(FileMesh& mesh, const FaceLinks& links, const CutFaces& faces) {
  const FileMesh before = mesh;
  const Crack crack = open_crack(mesh, links, faces);
  VolumeMap map = map_of(before);
  const std::size_t vertices = count_cells(map).vertices;
  for (const std::uint32_t face : faces) split_on(map, points_of(before, face));
  CHECK(partition(mesh.tetrahedra.corners) == partition(map, before));
  CHECK(crack.copies.size() == count_cells(map).vertices - vertices);
  CHECK(components(mesh) == count_cells(map).components);
  CHECK(volume(mesh) == Approx(volume(before)).epsilon(1e-14));
  REQUIRE(mesh.points.size() == before.points.size() + crack.copies.size());
  for (const auto& [point, copy] : crack.copies) {
    CHECK(mesh.points[copy] == mesh.points[point]);
    CHECK(mesh.point_region[copy] == mesh.point_region[point]);
    CHECK(mesh.source_point_id[copy] == mesh.source_point_id[point]);
    for (const DataColumn& column : mesh.point_data) {
      INFO(column.name);
      CHECK(row_of(column, copy) == row_of(column, point));
    }
  }
  for (std::size_t i = 0; i < mesh.point_data.size(); ++i) {
    const DataColumn &now = mesh.point_data[i], &then = before.point_data[i];
    REQUIRE(row_count(now) == mesh.points.size());
    for (std::size_t p = 0; p < before.points.size(); ++p) {
      REQUIRE(row_of(now, p) == row_of(then, p));
    }
  }
  for (const CrackFace& face : crack.faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(mesh.points[face.points[0][k]] == mesh.points[face.points[1][k]]);
    }
  }
  FileMesh glued = mesh;
  merge_points(glued, 0);
  CHECK(glued.points == before.points);
  CHECK(glued.tetrahedra.corners == before.tetrahedra.corners);
  CHECK(glued.triangles.corners == before.triangles.corners);
  return crack;
}

CutFaces all_faces(const FaceLinks& links) {
  CutFaces faces;
  for (std::uint32_t f = 0; f < 4 * links.across.size(); ++f) {
    const std::uint32_t across = links.across[f / 4][f % 4];
    if (across != FaceLinks::none && f < across) faces.push_back(f);
  }
  return faces;
}

}  // namespace

TEST_CASE("random cracks part the same corners as the 3-map", "[topology][crack]") {
  const auto seed = GENERATE(1U, 2U, 3U, 4U);
  INFO("seed " << seed);
  std::mt19937 random(seed);
  for (const double share : {0.02, 0.2, 0.5, 0.9}) {
    FileMesh mesh = grid(3);
    // Rows in another order: parts are identified by the lowest row.
    std::ranges::shuffle(mesh.tetrahedra.corners, random);
    const FaceLinks links = *face_links(mesh);
    CutFaces faces = all_faces(links);
    std::ranges::shuffle(faces, random);
    faces.resize(1 + static_cast<std::size_t>(share * static_cast<double>(faces.size() - 1)));
    std::ranges::sort(faces);
    checked(mesh, links, faces);
  }
}

TEST_CASE("all faces cut leave each tetrahedron its own points", "[topology][crack]") {
  FileMesh mesh = grid(2);
  const FaceLinks links = *face_links(mesh);
  const Crack crack = checked(mesh, links, all_faces(links));
  CHECK(mesh.points.size() == 4 * mesh.tetrahedra.corners.size());
  CHECK(crack.closed_faces == 0);
}

TEST_CASE("a plane cuts what the 3-map's plane cuts", "[topology][crack]") {
  const FileMesh before = grid(4);
  const FaceLinks links = *face_links(before);
  const VolumeMap map = map_of(before);
  for (const CuttingPlane& plane : {CuttingPlane{{1, 0, 0}, 2}, CuttingPlane{{1, 2, -1}, 3},
                                    CuttingPlane{{-0.3, 0.2, 0.9}, 1.7}}) {
    const CutFaces faces = *section_faces(before, links, plane);
    std::set<std::set<std::uint32_t>> ours, theirs;
    for (const std::uint32_t face : faces) {
      const auto points = points_of(before, face);
      ours.insert({points.begin(), points.end()});
    }
    const auto of_map = plane_faces(map, plane);
    REQUIRE(of_map);
    for (const HalfFaceId face : *of_map) {
      std::set<std::uint32_t> points;
      for (int k = 0; k < 4; ++k) {
        const VertexId v = map.corners(tetrahedron_of(face))[static_cast<std::size_t>(k)];
        if (k != place_of(face)) points.insert(map.point_of_vertex(v));
      }
      theirs.insert(points);
    }
    CHECK(ours == theirs);
    FileMesh mesh = before;
    checked(mesh, links, faces);
    CHECK(components(mesh) == 2);
  }
}

TEST_CASE("a crack between two regions copies the points of the interface", "[topology][crack]") {
  FileMesh mesh = grid(4);
  // A triangle on the interface, one on the far side's surface, an edge and a vertex there.
  const auto at = [](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return (z * 5 + y) * 5 + x;
  };
  mesh.triangles.corners = {{at(2, 0, 0), at(2, 1, 0), at(2, 1, 1)},
                            {at(2, 0, 0), at(3, 0, 0), at(3, 0, 1)}};
  mesh.edges.corners = {{at(2, 0, 0), at(3, 0, 0)}};
  mesh.vertices.corners = {{at(2, 2, 2)}};
  const FaceLinks links = *face_links(mesh);
  const CutFaces faces = *interface_faces(mesh, links, {"left", "2"});
  CHECK(faces.size() == 32);
  const Crack crack = checked(mesh, links, faces);
  CHECK(crack.copies.size() == 25);
  CHECK(crack.closed_faces == 0);
  CHECK(crack.triangles_on_it == 1);
  CHECK(components(mesh) == 2);
  const auto is_copy = [](std::uint32_t point) { return point >= 125; };
  CHECK(std::ranges::none_of(mesh.triangles.corners[0], is_copy));
  CHECK(is_copy(mesh.triangles.corners[1][0]));
  CHECK(is_copy(mesh.edges.corners[0][0]));
  CHECK_FALSE(is_copy(mesh.vertices.corners[0][0]));
}

TEST_CASE("cells that no tetrahedron has stay, those behind them go along", "[topology][crack]") {
  FileMesh mesh = grid(4);
  const auto at = [](std::uint32_t x, std::uint32_t y) { return y * 5 + x; };
  const std::uint32_t p = at(2, 0);
  const std::array<std::uint32_t, 3> far = {p, at(3, 2), at(4, 4)};
  mesh.triangles.corners = {far, {p, at(3, 0), at(3, 1)}};
  mesh.edges.corners = {{p, p}, {p, at(4, 4)}, {p, at(3, 0)}};
  const FaceLinks links = *face_links(mesh);
  checked(mesh, links, *interface_faces(mesh, links, {"left", "right"}));
  CHECK(mesh.triangles.corners[0] == far);
  CHECK(mesh.triangles.corners[1][0] >= 125);
  CHECK(mesh.edges.corners[0] == std::array{p, p});
  CHECK(mesh.edges.corners[1] == std::array{p, at(4, 4)});
  CHECK(mesh.edges.corners[2][0] >= 125);
  CHECK(Crack{}.triangles_on_it == 0);
}

TEST_CASE("a crack that ends inside stays joined at its front", "[topology][crack]") {
  FileMesh mesh = grid(4);
  const FaceLinks links = *face_links(mesh);
  CutFaces faces = *interface_faces(mesh, links, {"left", "right"});
  std::erase_if(faces, [&](std::uint32_t face) {
    return std::ranges::any_of(points_of(mesh, face),
                               [&](std::uint32_t p) { return mesh.points[p][2] > 2; });
  });
  const Crack crack = checked(mesh, links, faces);
  CHECK(crack.copies.size() == 10);  // of 15 points the 5 of the front stay
  CHECK(components(mesh) == 1);
}

TEST_CASE("a face inside the body alone does not open", "[topology][crack]") {
  FileMesh mesh = grid(4);
  const FaceLinks links = *face_links(mesh);
  const CutFaces every = all_faces(links);
  const auto inside = std::ranges::find_if(every, [&](std::uint32_t face) {
    return std::ranges::all_of(points_of(mesh, face), [&](std::uint32_t p) {
      return std::ranges::all_of(mesh.points[p], [](double x) { return x > 0 && x < 4; });
    });
  });
  REQUIRE(inside != every.end());
  const Crack crack = checked(mesh, links, {*inside});
  CHECK(crack.copies.empty());
  CHECK(crack.closed_faces == 1);
}

TEST_CASE("faces that cannot be cut are named", "[topology][crack]") {
  FileMesh mesh = grid(2);
  const FaceLinks links = *face_links(mesh);
  using Triples = std::vector<std::array<std::uint32_t, 3>>;
  const auto inner = points_of(mesh, all_faces(links)[0]);
  const auto listed = listed_faces(mesh, links, Triples{inner, {0, 1, 4}, {0, 1, 999}});
  CHECK(finding(listed.findings, "not_interior").ids == std::vector<std::int64_t>{1, 2});
  CHECK(listed.findings[0].text == "on points 0, 1, 4 there is no face of two tetrahedra");
  const auto single = listed_faces(mesh, links, Triples{inner, {5, 26, 3}});
  CHECK(finding(single.findings, "not_interior").ids == std::vector<std::int64_t>{1});
  CHECK(single.findings[0].text == "on points 5, 26, 3 there is no face of two tetrahedra");
  CHECK(listed_faces(mesh, links, Triples{inner, inner})->size() == 1);
  finding(listed_faces(mesh, links, Triples{}).findings, "no_face");
  finding(section_faces(mesh, links, {{1, 0, 0}, 9}).findings, "no_face");
  finding(section_faces(mesh, links, {{0, 0, 0}, 9}).findings, "not_a_direction");
  finding(interface_faces(mesh, links, {"left", "middle"}).findings, "unknown_region");
  mesh.tetrahedra.region.assign(48, 5);
  mesh.tetrahedra.region[0] = 1;
  mesh.tetrahedra.region[47] = 2;
  const auto apart = interface_faces(mesh, links, {"left", "right"});
  finding(apart.findings, "no_face");
  CHECK(apart.findings[0].text ==
        "no tetrahedron of region left shares a face with one of region right");
  mesh.tetrahedra.region.clear();
  finding(interface_faces(mesh, links, {"left", "right"}).findings, "unknown_region");
  mesh.tetrahedra.corners.push_back(mesh.tetrahedra.corners[0]);
  mesh.tetrahedra.corners.push_back(mesh.tetrahedra.corners[0]);
  const auto overfull = face_links(mesh);
  CHECK(finding(overfull.findings, "overfull_face").ids == std::vector<std::int64_t>{0, 48, 49});
  CHECK(overfull.findings[0].text ==
        "more than two tetrahedra share the face on points 0, 1, 4: a crack has two sides");
}

TEST_CASE("faces of fewer than 2^30 tetrahedra have numbers", "[topology][mesh]") {
  constexpr std::size_t limit = std::size_t{1} << 30;
  CHECK(!too_many_to_link(0));
  CHECK(!too_many_to_link(limit - 1));
  REQUIRE(too_many_to_link(limit));
  CHECK(too_many_to_link(limit)->code == "too_many_tetrahedra");
}
