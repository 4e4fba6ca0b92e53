// SPDX-License-Identifier: MIT
// Formats of surfaces: files of other programs, the boundary of a body, losses on the way.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <map>

#include "tests/support/io_support.hpp"
#include "topology/mesh/boundary_surface.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// Six times the volume that the triangles enclose, each seen from the origin.
double volume6(const FileMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles.corners) {
    const Point &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    sum += a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sum;
}

bool has(const std::vector<Finding>& findings, std::string_view code, std::size_t count) {
  return std::ranges::any_of(findings,
                             [&](const Finding& f) { return f.code == code && f.count == count; });
}

using Key = std::array<std::uint32_t, 3>;

Key key_of(Key corners) {
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// A block of 3 x 3 x 3 cubes, each of five tetrahedra, some of them inverted.
FileMesh block() {
  FileMesh mesh;
  for (int i = 0; i < 64; ++i) {
    mesh.points.push_back({double(i % 4), double(i / 4 % 4), double(i / 16)});
  }
  const auto at = [](int x, int y, int z) { return std::uint32_t(x + 4 * y + 16 * z); };
  for (int i = 0; i < 27; ++i) {
    const int x = i % 3, y = i / 3 % 3, z = i / 9, odd = (x + y + z) % 2;
    const auto c = [&](int dx, int dy, int dz) { return at(x + (dx ^ odd), y + dy, z + dz); };
    for (const auto& t : {std::array{c(0, 0, 0), c(1, 0, 0), c(0, 1, 0), c(0, 0, 1)},
                          std::array{c(1, 1, 0), c(0, 1, 0), c(1, 0, 0), c(1, 1, 1)},
                          std::array{c(1, 0, 1), c(0, 0, 1), c(1, 1, 1), c(1, 0, 0)},
                          std::array{c(0, 1, 1), c(1, 1, 1), c(0, 0, 1), c(0, 1, 0)},
                          std::array{c(1, 0, 0), c(0, 1, 0), c(0, 0, 1), c(1, 1, 1)}}) {
      mesh.tetrahedra.corners.push_back(t);
    }
  }
  return mesh;
}

}  // namespace

TEST_CASE("surfaces of other programs are read", "[io][surface]") {
  struct Sample {
    const char* name;
    std::size_t points, triangles;
    double volume;
  };
  // The wall between gmsh's two boxes stands in the files once: it adds 1/3 of its area.
  for (const Sample& s : std::initializer_list<Sample>{{"gmsh.stl", 23, 44, 0},
                                                       {"gmsh_binary.stl", 23, 44, 0},
                                                       {"meshio.stl", 23, 44, 0},
                                                       {"meshio.off", 23, 44, 0},
                                                       {"admesh.stl", 23, 44, 0},
                                                       {"admesh_binary.stl", 23, 44, 0},
                                                       {"admesh.off", 8, 12, 6},
                                                       {"meshio.ply", 23, 44, 0},
                                                       {"meshio_binary.ply", 23, 44, 0},
                                                       {"meshio.obj", 23, 44, 0},
                                                       {"assimp.obj", 8, 12, 6},
                                                       {"assimp.ply", 36, 12, 6},
                                                       {"assimp_binary.ply", 36, 12, 6},
                                                       {"openscad.stl", 8, 12, 6}}) {
    INFO(s.name);
    const Result<FileMesh> mesh = read_file_mesh(sample(s.name));
    INFO(summary(mesh.findings));
    REQUIRE(mesh);
    CHECK(summary(mesh.findings) == (s.name == std::string("assimp.obj")
                                         ? "warning skipped_data 4, warning skipped_data 28"
                                         : ""));
    CHECK(mesh->points.size() == s.points);
    CHECK(mesh->triangles.corners.size() == s.triangles);
    if (s.volume > 0) CHECK(volume6(*mesh) / 6 == Approx(s.volume).epsilon(1e-12));
  }
}

TEST_CASE("faces of four corners are quadrilaterals, and who wants triangles has them left out",
          "[io][surface]") {
  const Result<FileMesh> mesh = read_file_mesh(sample("openscad.off"));
  REQUIRE(mesh);
  CHECK(mesh->points.size() == 8);
  CHECK(mesh->triangles.corners.empty());
  CHECK(rows_of(*mesh, CellKind::quad4).count == 6);
  CHECK(mesh.findings.empty());
  const Result<FileMesh> triangles = read_file_mesh(sample("openscad.off"), {.simplices = true});
  REQUIRE(triangles);
  CHECK(cell_count(*triangles) == 0);
  CHECK(summary(triangles.findings) == "note skipped_cells 10");
  CHECK(triangles.findings[0].count == 6);
}

TEST_CASE("a surface is no body, and the message says what to do", "[io][surface]") {
  for (const char* name : {"gmsh.stl", "gmsh_binary.stl", "meshio.off"}) {
    const Result<TetMesh> mesh = read_mesh(sample(name));
    REQUIRE_FALSE(mesh);
    CHECK(mesh.findings[0].code == "no_tetrahedron");
    CHECK(mesh.findings[0].remedy.find("tetgen -pq") != std::string::npos);
  }
}

TEST_CASE("the boundary of a body is closed, outward and in order", "[io][surface]") {
  FileMesh mesh = block();
  for (std::size_t t = 0; t < mesh.tetrahedra.corners.size(); t += 3) {
    std::swap(mesh.tetrahedra.corners[t][0], mesh.tetrahedra.corners[t][1]);
  }
  mesh.points.push_back({9, 9, 9});
  const BoundarySurface surface = boundary_surface(mesh);
  CHECK(surface.mesh.tetrahedra.corners.empty());
  CHECK(surface.mesh.triangles.corners.size() == 6 * 9 * 2);
  CHECK(volume6(surface.mesh) == Approx(6 * 27).epsilon(1e-12));
  CHECK(surface.lost_points == 9);  // eight inside, one far away
  CHECK(surface.mesh.points.size() == 56);
  CHECK(surface.mesh.source_point_id.size() == 56);
  CHECK(surface.mesh.source_point_id.back() == 64);
  // The slow twin: faces counted in a map, in the order of (row, corner left out).
  std::map<Key, int> count;
  for (const auto& t : mesh.tetrahedra.corners) {
    for (int f = 0; f < 4; ++f) ++count[key_of({t[(f + 1) % 4], t[(f + 2) % 4], t[(f + 3) % 4]})];
  }
  std::vector<Key> expected, found;
  for (const auto& t : mesh.tetrahedra.corners) {
    for (int f = 0; f < 4; ++f) {
      const Key key = key_of({t[(f + 1) % 4], t[(f + 2) % 4], t[(f + 3) % 4]});
      if (count[key] == 1) expected.push_back(key);
    }
  }
  for (Key corners : surface.mesh.triangles.corners) {
    for (std::uint32_t& corner : corners) {
      corner = std::uint32_t(surface.mesh.source_point_id[corner] - 1);
    }
    found.push_back(key_of(corners));
  }
  CHECK(found == expected);
}

TEST_CASE("triangles of the file give the boundary their labels, others are lost",
          "[io][surface]") {
  FileMesh mesh = file_mesh_of(two_tetrahedra());
  mesh.triangles.corners = {
      {0, 3, 1}, {1, 0, 2}, {3, 1, 0}};  // boundary, the wall, the first again
  mesh.triangles.region = {7, 8, 9};
  mesh.triangles.source_id = {70, 80, 90};
  mesh.triangles.data = {{"load", 1, NumberType::float64, std::vector<double>{1.5, 2.5, 3.5}}};
  mesh.edges.corners = {{3, 4}, {0, 1}};
  mesh.edges.region = {1, 2};
  const BoundarySurface surface = boundary_surface(mesh);
  REQUIRE(surface.mesh.triangles.corners.size() == 6);
  std::array<std::size_t, cell_kinds> lost{};
  lost[index_of(CellKind::triangle)] = 2;
  CHECK(surface.lost_cells == lost);
  CHECK(surface.lost_points == 0);
  CHECK(surface.mesh.source_point_id.empty());
  CHECK(surface.mesh.edges == mesh.edges);
  std::int64_t next = 91;
  for (std::size_t i = 0; i < 6; ++i) {
    const bool is_first = key_of(surface.mesh.triangles.corners[i]) == Key{0, 1, 3};
    CHECK(surface.mesh.triangles.region[i] == (is_first ? 7 : 0));
    CHECK(surface.mesh.triangles.source_id[i] == (is_first ? 70 : next++));
    const double load = std::get<0>(surface.mesh.triangles.data[0].values)[i];
    CHECK((is_first ? load == 1.5 : load != load));
  }
}

TEST_CASE("faces of three tetrahedra and of two equal ones are no boundary", "[io][surface]") {
  FileMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 2}, {0, 0, 3}};
  mesh.tetrahedra.corners = {{0, 1, 2, 3}, {0, 1, 2, 4}, {0, 1, 2, 5}};
  CHECK(boundary_surface(mesh).mesh.triangles.corners.size() == 9);
  mesh.tetrahedra.corners = {{0, 1, 2, 3}, {0, 1, 2, 3}};
  CHECK(boundary_surface(mesh).mesh.triangles.corners.empty());
}

TEST_CASE("what a surface leaves out of a body is told, and is what is written", "[io][surface]") {
  const Folder folder;
  FileMesh mesh = block();
  mesh.points.push_back({9, 9, 9});
  mesh.triangles.corners = {{0, 1, 4}, {21, 22, 25}};
  const auto findings = write_file_mesh(folder.path() / "a.off", mesh);
  INFO(summary(findings));
  CHECK(has(findings, "cells_lost", 135));
  CHECK(has(findings, "points_lost", 9));
  CHECK(findings[0].text.find("boundary of 108 triangles") != std::string::npos);
  const Result<FileMesh> back = read_file_mesh(folder.path() / "a.off");
  REQUIRE(back);
  CHECK(back->triangles.corners == boundary_surface(mesh).mesh.triangles.corners);
  CHECK(lost_on_writing(mesh, {.format = MeshFormat::off}).size() == findings.size());
  CHECK(lost_on_writing(*back, {.format = MeshFormat::off}).empty());
}

TEST_CASE("binary STL tells what its floats change", "[io][stl]") {
  const Folder folder;
  FileMesh mesh;
  mesh.points = {{0, 0, 0}, {0.1, 0, 0}, {0, 1, 0}, {5, 5, 5}};
  mesh.triangles.corners = {{1, 2, 0}};
  auto lost = lost_on_writing(mesh, {.format = MeshFormat::stl, .encoding = Encoding::binary});
  CHECK(has(lost, "coordinates_rounded", 1));
  CHECK(has(lost, "points_renumbered", 4));
  lost = lost_on_writing(mesh, {.format = MeshFormat::stl, .encoding = Encoding::text});
  CHECK_FALSE(has(lost, "coordinates_rounded", 1));
  CHECK(has(lost, "points_renumbered", 4));
  mesh.points[0][2] = 1e39;
  const auto findings = write_file_mesh(folder.path() / "big.stl", mesh);
  CHECK(findings.at(0).code == "number_out_of_range");
  CHECK(folder.names().empty());
  CHECK_FALSE(
      has_error(write_file_mesh(folder.path() / "big.stl", mesh, {.encoding = Encoding::text})));
}

TEST_CASE("STL: -0 is 0, and a binary file may begin with solid", "[io][stl]") {
  const Folder folder;
  FileMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 0, -0.0}, {0, 0, 1}};
  mesh.triangles.corners = {{0, 1, 2}, {3, 2, 4}};
  for (const Encoding encoding : {Encoding::text, Encoding::binary}) {
    REQUIRE_FALSE(
        has_error(write_file_mesh(folder.path() / "a.stl", mesh, {.encoding = encoding})));
    std::string bytes = bytes_of(folder.path() / "a.stl");
    if (encoding == Encoding::binary) bytes.replace(0, 6, "solid ");
    const Result<FileMesh> back = read_file_mesh(bytes, "a.stl");
    REQUIRE(back);
    CHECK(back->points.size() == 4);
    CHECK(back->triangles.corners == std::vector<Key>{{0, 1, 2}, {0, 2, 3}});
  }
  // The normal of the first facet, computed.
  const std::string bytes = bytes_of(folder.path() / "a.stl");
  float normal[3];
  std::memcpy(normal, bytes.data() + 84, sizeof normal);
  CHECK((normal[0] == 0 && normal[1] == 0 && normal[2] == 1));
}

TEST_CASE("OFF with colours, normals, comments, edges and vertices is read", "[io][off]") {
  const Result<FileMesh> mesh = read_file_mesh(R"(# made by hand
STCNOFF # header
4 5   # no number of edges
0 0 0  0 0 1  1 0 0 1  0.5 0.5
1 0 0  0 0 1  1 0 0 1  0.5 0.5
# a point in between
0 1 0  0 0 1  1 0 0 1  0.5 0.5
0 0 1  0 0 1  1 0 0 1  0.5 0.5
3 0 1 2  255 0 0
2 1 3
1 3 # a vertex
3 1 2 3
5 0 1 2 3 0
)",
                                               "made by hand");
  INFO(summary(mesh.findings));
  REQUIRE(mesh);
  CHECK(mesh->triangles.corners == std::vector<Key>{{0, 1, 2}, {1, 2, 3}});
  CHECK(mesh->edges.corners == std::vector<std::array<std::uint32_t, 2>>{{1, 3}});
  CHECK(mesh->vertices.corners == std::vector<std::array<std::uint32_t, 1>>{{3}});
  CHECK(summary(mesh.findings) ==
        "warning degenerate_cell 13, warning skipped_data 9, warning skipped_data 4");
  CHECK(other_cells(*mesh, CellKind::polygon).points == std::vector<std::uint32_t>{0, 1, 2, 3, 0});
}

TEST_CASE("binary OFF is read", "[io][off]") {
  std::string bytes = "OFF BINARY\n";
  const auto word = [&bytes](std::uint32_t w) {
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(w >> shift & 255);
  };
  const auto real = [&](float x) { word(std::bit_cast<std::uint32_t>(x)); };
  for (const std::uint32_t w : {3, 2, 3}) word(w);
  for (const float x : {0.F, 0.F, 0.F, 1.5F, 0.F, 0.F, 0.F, -2.F, 0.F}) real(x);
  for (const std::uint32_t w : {3, 0, 1, 2, 0}) word(w);
  for (const std::uint32_t w : {2, 2, 0, 3}) word(w);
  for (const float x : {1.F, 0.F, 0.F}) real(x);
  const Result<FileMesh> mesh = read_file_mesh(bytes, "binary");
  INFO(summary(mesh.findings));
  REQUIRE(mesh);
  CHECK(mesh->points == std::vector<Point>{{0, 0, 0}, {1.5, 0, 0}, {0, -2, 0}});
  CHECK(mesh->triangles.corners == std::vector<Key>{{0, 1, 2}});
  CHECK(mesh->edges.corners.size() == 1);
  CHECK(summary(mesh.findings) == "warning skipped_data 0");
}

namespace {

const std::string by_hand = R"(ply
format ascii 1.0
comment made by hand
obj_info and more
comment column vertex vx 3 "flow speed"
comment column vertex vx 4 "too many"
comment column face nothing 1 "not there"
element vertex 4
property float x
property float y
property float z
property uchar red
property float vx
property float vy
property float vz
property list uchar int neighbours
property int source_point_id
element camera 2
property list uchar float angles
property int mode
element face 3
property int8 kind
property list uint8 uint32 vertex_index
property short gmsh:physical
element edge 1
property int vertex1
property int vertex2
property float64 length
element empty 1
end_header
0 0 0 255 1 2 3 2 7 8 40
1 0 0 0 4 5 6 0 30
0 1 0 1 7 8 9 0 20
0 0 1 2 10 11 12 1 5 10
2 0.5 0.25 1
0 -7
-1 3 0 1 2 5
1 4 0 1 2 3 6
2 3 1 2 3 7
3 0 0.1
)";

template <class Value>
void put_big(std::string& bytes, Value value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof raw);
  std::reverse(std::begin(raw), std::end(raw));
  bytes.append(raw, sizeof raw);
}

}  // namespace

TEST_CASE("PLY with data, lists, other elements and polygons is read", "[io][ply]") {
  const Result<FileMesh> mesh = read_file_mesh(by_hand, "by hand");
  INFO(summary(mesh.findings));
  REQUIRE(mesh);
  CHECK(mesh->source_point_id == std::vector<std::int64_t>{40, 30, 20, 10});
  CHECK(mesh->point_data ==
        std::vector<DataColumn>{
            {"red", 1, NumberType::uint8, std::vector<std::int64_t>{255, 0, 1, 2}},
            {"flow speed", 3, NumberType::float32,
             std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}}});
  CHECK(mesh->triangles.corners == std::vector<Key>{{0, 1, 2}, {1, 2, 3}});
  CHECK(mesh->triangles.region == std::vector<std::int32_t>{5, 7});
  CHECK(mesh->triangles.data ==
        std::vector<DataColumn>{{"kind", 1, NumberType::int8, std::vector<std::int64_t>{-1, 2}}});
  CHECK(mesh->edges.corners == std::vector<std::array<std::uint32_t, 2>>{{3, 0}});
  CHECK(std::get<0>(mesh->edges.data.at(0).values) == std::vector<double>{0.1});
  CHECK(summary(mesh.findings) == "warning skipped_data 18, warning skipped_data 8");
  CHECK(rows_of(*mesh, CellKind::quad4).count == 1);
}

TEST_CASE("big-endian PLY is read", "[io][ply]") {
  std::string bytes =
      "ply\r\nformat binary_big_endian 1.0\r\nelement vertex 3\r\nproperty float x\r\n"
      "property double y\r\nproperty short z\r\nelement face 1\r\n"
      "property list ushort ushort vertex_indices\r\nend_header\r\n";
  for (int i = 0; i < 3; ++i) {
    put_big(bytes, i == 1 ? 0.5F : 0.F);
    put_big(bytes, i == 2 ? 0.1 : 0.0);
    put_big(bytes, std::int16_t(-i));
  }
  for (const int i : {3, 0, 1, 2}) put_big(bytes, std::uint16_t(i));
  const Result<FileMesh> mesh = read_file_mesh(bytes, "big");
  INFO(summary(mesh.findings));
  REQUIRE(mesh);
  CHECK(mesh->points == std::vector<Point>{{0, 0, 0}, {0.5, 0, -1}, {0, 0.1, -2}});
  CHECK(mesh->triangles.corners == std::vector<Key>{{0, 1, 2}});
}

TEST_CASE("PLY keeps types and any names, 64-bit integers where 32 bits hold them", "[io][ply]") {
  const Folder folder;
  FileMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles.corners = {{0, 1, 2}};
  using Whole = std::vector<std::int64_t>;
  using Real = std::vector<double>;
  mesh.point_data = {{"x", 1, NumberType::float32, Real{1.5, 2, 3}},
                     {"vertex_indices", 2, NumberType::uint8, Whole{1, 2, 3, 4, 5, 255}},
                     {"", 1, NumberType::int16, Whole{-1, 2, -32768}},
                     {"same", 1, NumberType::float64, Real{0.1, 0.2, 0.3}},
                     {"sa me", 1, NumberType::float64, Real{1, 2, 3}},
                     {"sa\"me", 1, NumberType::uint16, Whole{1, 2, 65535}}};
  mesh.triangles.data = {{"region", 1, NumberType::int32, Whole{-5}},
                         {"entity", 1, NumberType::uint32, Whole{4294967295}}};
  for (const Encoding encoding : {Encoding::text, Encoding::binary}) {
    const auto findings = write_file_mesh(folder.path() / "a.ply", mesh, {.encoding = encoding});
    CHECK(findings.empty());
    const Result<FileMesh> back = read_file_mesh(folder.path() / "a.ply");
    INFO(summary(back.findings) << bytes_of(folder.path() / "a.ply"));
    REQUIRE(back);
    CHECK(back->point_data == mesh.point_data);
    CHECK(back->triangles == mesh.triangles);
  }
  mesh.point_data = {{"small", 1, NumberType::int64, Whole{-1, 2, 3}},
                     {"big", 1, NumberType::uint64, Whole{-1, 2, 3'000'000'000}}};
  mesh.source_point_id = {1, 2, 5'000'000'000};
  auto lost = lost_on_writing(mesh, {.format = MeshFormat::ply});
  CHECK(has(lost, "data_lost", 1));
  CHECK(has(lost, "number_types_lost", 1));
  CHECK(has(lost, "source_ids_lost", 3));
  CHECK(lost.size() == 3);
}

TEST_CASE("OBJ with groups, negative numbers, lines, points and free forms is read", "[io][obj]") {
  const Result<FileMesh> mesh = read_file_mesh(R"(# by hand
mtllib /etc/passwd
o whole
g left
f 1 2 3
v 0 0 0
v 1 0 0 0.5
v 0 1 0 1 0 0 # red
v 0 0 \
  1
vn 0 0 1
vt 0 0
f -4/1/1 -3//1 -2/1
g right
f 1 2 3 4
f 2 3 \
  4
g left
f 1 2 4
g
l 1 2 3
p 4 1
s off
vp 0.5
curv 0 1 1 2
surf 0 1 0 1 1 2
strange things
)",
                                               "by hand");
  INFO(summary(mesh.findings));
  REQUIRE(mesh);
  CHECK(mesh->points == std::vector<Point>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  CHECK(mesh->triangles.corners == std::vector<Key>{{0, 1, 2}, {0, 1, 2}, {1, 2, 3}, {0, 1, 3}});
  CHECK(mesh->triangles.region == std::vector<std::int32_t>{1, 1, 2, 1});
  CHECK(mesh->region_name[2] == std::map<std::int32_t, std::string>{{1, "left"}, {2, "right"}});
  CHECK(mesh->edges.corners == std::vector<std::array<std::uint32_t, 2>>{{0, 1}, {1, 2}});
  CHECK(mesh->edges.region.empty());
  CHECK(mesh->vertices.corners == std::vector<std::array<std::uint32_t, 1>>{{3}, {0}});
  CHECK(summary(mesh.findings) ==
        "warning skipped_cells 25, warning skipped_data 2, warning skipped_data 27, "
        "warning skipped_data 24, warning skipped_data 3, warning skipped_data 7");
  CHECK(rows_of(*mesh, CellKind::quad4).count == 1);
  CHECK(columns_of(*mesh, CellKind::quad4).region == std::vector<std::int32_t>{2});
}

TEST_CASE("OBJ without groups takes objects as regions, without those materials", "[io][obj]") {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const auto names = [](const std::string& text) {
    const Result<FileMesh> mesh = read_file_mesh(text, "text");
    REQUIRE(mesh);
    return mesh->region_name[2];
  };
  using Names = std::map<std::int32_t, std::string>;
  CHECK(names(points + "usemtl a\nf 1 2 3\nusemtl b\nf 1 3 2\n") == Names{{1, "a"}, {2, "b"}});
  CHECK(names(points + "o a b\nusemtl c\nf 1 2 3\n") == Names{{1, "a b"}});
  CHECK(names(points + "f 1 2 3\n").empty());
}

TEST_CASE("solids of an STL text are regions", "[io][stl]") {
  const std::string facet =
      "facet normal 0 0 0 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet\n";
  const std::string text = "solid inlet wall\n" + facet + "endsolid inlet wall\nSOLID\n" + facet +
                           "ENDSOLID\nsolid region_7\n" + facet + facet + "endsolid\n";
  const Result<FileMesh> mesh = read_file_mesh(text, "text");
  INFO(summary(mesh.findings));
  REQUIRE(mesh);
  CHECK(mesh->points.size() == 3);
  CHECK(mesh->triangles.region == std::vector<std::int32_t>{1, 0, 7, 7});
  CHECK(mesh->region_name[2] == std::map<std::int32_t, std::string>{{1, "inlet wall"}});
  const Folder folder;
  CHECK(has(write_file_mesh(folder.path() / "a.stl", *mesh), "regions_lost", 4));
  const auto findings =
      write_file_mesh(folder.path() / "a.stl", *mesh, {.encoding = Encoding::text});
  CHECK(summary(findings) == "note names_beside 0");
  const Result<FileMesh> back = read_file_mesh(folder.path() / "a.stl");
  REQUIRE(back);
  CHECK(back->triangles == mesh->triangles);
  CHECK(back->region_name == mesh->region_name);
}
