// SPDX-License-Identifier: MIT
// The committed sample meshes: counts of table 1, one whole body each, sound elements.
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>

#include "topology/io/mesh_file.hpp"
#include "topology/kernel/invariants.hpp"
#include "topology/mesh/build_map.hpp"

namespace {

using namespace sunder;
namespace fs = std::filesystem;

struct Sample {
  std::string name;
  std::size_t vertices, edges, faces, tetrahedra;
  std::array<std::ptrdiff_t, 3> betti;
  /// Lengths of the bounding box, m, to 1 per cent; the lowest point is at `lowest`.
  std::array<double, 3> box;
  double lowest;
  /// Degrees; a mesh below ten has slivers.
  double least_dihedral_angle;
};

std::ostream& operator<<(std::ostream& out, const Sample& s) { return out << s.name; }

const std::vector<Sample>& samples() {
  static const std::vector<Sample> all{
      {"two_tets", 5, 9, 7, 2, {1, 0, 0}, {1, 1, 2}, -1, 54},
      {"cube", 27, 98, 120, 48, {1, 0, 0}, {2, 2, 2}, 0, 44.9},
      {"ring", 32, 112, 128, 48, {1, 1, 0}, {3, 3, 1}, 0, 44.9},
      {"bar", 975, 5150, 7632, 3456, {1, 0, 0}, {0.8, 0.06, 0.4}, 0, 20},
      {"monolith", 172, 735, 988, 424, {1, 0, 0}, {1, 0.3, 2}, 0, 15},
      {"slab", 975, 4878, 7264, 3360, {1, 0, 0}, {1, 0.3, 2}, 0, 10},
      {"ball", 315, 1790, 2779, 1303, {1, 0, 0}, {0.1992, 0.1989, 0.1992}, -0.099295076, 14.9},
      {"vase", 2066, 10365, 14536, 6236, {1, 0, 0}, {0.1512, 0.1511, 0.24}, 0, 13},
      {"bunny", 1396, 8246, 12996, 6145, {1, 0, 0}, {0.1509, 0.117, 0.15}, 0, 12.5},
  };
  return all;
}

fs::path file_of(const std::string& name) { return fs::path(SUNDER_MESHES_DIR) / (name + ".msh"); }

std::string bytes_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

double signed_volume(const TetMesh& mesh, const std::array<std::uint32_t, 4>& t) {
  const Point& o = mesh.points[t[0]];
  return dot(minus(mesh.points[t[1]], o),
             cross(minus(mesh.points[t[2]], o), minus(mesh.points[t[3]], o))) /
         6;
}

/// The least of the six angles between faces, degrees, from the outward normals of the faces.
double least_dihedral_angle(const TetMesh& mesh, const std::array<std::uint32_t, 4>& t) {
  std::array<Point, 4> normal;
  for (int k = 0; k < 4; ++k) {
    const Point& a = mesh.points[t[(k + 1) % 4]];
    normal[k] = cross(minus(mesh.points[t[(k + 2) % 4]], a), minus(mesh.points[t[(k + 3) % 4]], a));
    if (dot(normal[k], minus(mesh.points[t[k]], a)) > 0) {
      for (double& x : normal[k]) x = -x;
    }
  }
  double least = 180;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < i; ++j) {
      const double cosine = dot(normal[i], normal[j]) /
                            std::sqrt(dot(normal[i], normal[i]) * dot(normal[j], normal[j]));
      least =
          std::min(least, 180 - std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi);
    }
  }
  return least;
}

bool holds_face(const TetMesh& mesh, std::array<std::uint32_t, 3> face, int times) {
  const auto has_it = [&](const auto& t) {
    return std::all_of(face.begin(), face.end(),
                       [&](auto v) { return std::find(t.begin(), t.end(), v) != t.end(); });
  };
  return std::count_if(mesh.tetrahedra.begin(), mesh.tetrahedra.end(), has_it) == times;
}

}  // namespace

TEST_CASE("every sample mesh reads without a finding and builds one whole body", "[meshes]") {
  const auto& sample = GENERATE(from_range(samples()));
  CAPTURE(sample);
  const auto mesh = read_mesh(file_of(sample.name));
  REQUIRE(mesh);
  CHECK(mesh.findings.empty());
  const auto map = build_map(*mesh);
  REQUIRE(map);
  CHECK(map.findings.empty());

  const Counts counts = count_cells(*map);
  CHECK(counts.vertices == sample.vertices);
  CHECK(counts.edges == sample.edges);
  CHECK(counts.faces == sample.faces);
  CHECK(counts.tetrahedra == sample.tetrahedra);
  CHECK(counts.components == 1);
  CHECK(counts.boundary_sheets == 1);
  REQUIRE(counts.betti);
  CHECK(*counts.betti == sample.betti);
}

TEST_CASE("the monolith and the bunny have table 1's counts within 3 per cent", "[meshes]") {
  struct Row {
    const char* name;
    double tetrahedra, vertices;
  };
  const auto row = GENERATE(Row{"monolith", 413, 174}, Row{"bunny", 6142, 1363});
  CAPTURE(row.name);
  const auto mesh = read_mesh(file_of(row.name));
  REQUIRE(mesh);
  CHECK(std::abs(mesh->tetrahedra.size() / row.tetrahedra - 1) <= 0.03);
  CHECK(std::abs(mesh->points.size() / row.vertices - 1) <= 0.03);
}

TEST_CASE("every sample mesh has its size in metres, one named region and sound elements",
          "[meshes]") {
  const auto& sample = GENERATE(from_range(samples()));
  CAPTURE(sample);
  const auto mesh = read_mesh(file_of(sample.name));
  REQUIRE(mesh);
  Point low = mesh->points.front(), high = low;
  for (const Point& p : mesh->points) {
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  }
  for (int k = 0; k < 3; ++k) CHECK(high[k] - low[k] == Approx(sample.box[k]).epsilon(0.01));
  CHECK(low[2] == Approx(sample.lowest).margin(1e-9));

  REQUIRE(mesh->region.size() == mesh->tetrahedra.size());
  CHECK(mesh->region_name.at(mesh->region.front()) == sample.name);
  CHECK(std::count(mesh->region.begin(), mesh->region.end(), mesh->region.front()) ==
        static_cast<std::ptrdiff_t>(mesh->region.size()));

  double least_angle = 180, least_volume = 1e300;
  for (const auto& t : mesh->tetrahedra) {
    least_volume = std::min(least_volume, signed_volume(*mesh, t));
    least_angle = std::min(least_angle, least_dihedral_angle(*mesh, t));
  }
  CHECK(least_volume > 0);
  CHECK(least_angle >= sample.least_dihedral_angle);
}

TEST_CASE("the monolith stands and lies on plane sides", "[meshes]") {
  const auto mesh = read_mesh(file_of("monolith"));
  REQUIRE(mesh);
  const auto count_on = [&](int axis, double value) {
    return std::count_if(mesh->points.begin(), mesh->points.end(),
                         [&](const Point& p) { return p[axis] == value; });
  };
  // A grid of 6 x 2 x 7 cells; the four halved upright edges add one point to two sides each.
  CHECK(count_on(2, 0.0) == 7 * 3);
  CHECK(count_on(2, 2.0) == 7 * 3);
  CHECK(count_on(1, -0.15) == 7 * 8 + 2);
  CHECK(count_on(1, 0.15) == 7 * 8 + 2);
  CHECK(count_on(0, -0.5) == 3 * 8 + 2);
  CHECK(count_on(0, 0.5) == 3 * 8 + 2);
}

TEST_CASE("the ring has the rows of figure 4 and the cube those of figure 5", "[meshes]") {
  using Faces = std::vector<std::array<std::uint32_t, 3>>;
  const auto ring = read_mesh(file_of("ring"));
  const auto cube = read_mesh(file_of("cube"));
  REQUIRE(ring);
  REQUIRE(cube);
  for (const auto& face : Faces{{1, 5, 21}, {1, 17, 21}, {9, 13, 29}, {9, 25, 29}}) {
    CAPTURE(face);
    CHECK(holds_face(*ring, face, 2));
  }
  for (const auto& face : Faces{{1, 4, 14}, {4, 14, 17}, {4, 7, 17}}) {
    CAPTURE(face);
    CHECK(holds_face(*cube, face, 2));
  }
}

TEST_CASE("writing a sample mesh again gives its bytes", "[meshes][io]") {
  const auto& sample = GENERATE(from_range(samples()));
  CAPTURE(sample);
  const auto mesh = read_mesh(file_of(sample.name));
  REQUIRE(mesh);
  const fs::path copy = fs::temp_directory_path() / ("sunder_sample_" + sample.name + ".msh");
  CHECK(write_mesh(copy, *mesh).empty());
  CHECK(bytes_of(copy) == bytes_of(file_of(sample.name)));
  fs::remove(copy);
}
