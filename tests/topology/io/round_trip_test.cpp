// SPDX-License-Identifier: MIT
// A mesh with everything in it through every format, version and encoding: contents that a format
// holds come back in every bit, all others were announced as lost.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <string>

#include "tests/support/io_support.hpp"
#include "topology/io/format_traits.hpp"
#include "topology/mesh/boundary_surface.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

DataColumn reals(std::string name, std::size_t components, std::size_t rows) {
  std::vector<double> values;
  for (std::size_t i = 0; i < rows * components; ++i) {
    values.push_back(1 / (static_cast<double>(i) + 3) - 0.1);
  }
  return {std::move(name), components, NumberType::float64, std::move(values)};
}

/// Cells of every dimension, labels, entities, ids, names, data: all that MSH holds.
FileMesh full_mesh() {
  FileMesh mesh = file_mesh_of(two_tetrahedra());
  mesh.points[4][0] = -1e30;  // floats must hold it, for binary STL
  mesh.source_point_id = {9, 4, 1'000'000'007, 1, 2};
  mesh.vertices.corners = {{0}, {3}};
  mesh.vertices.region = {4, 4};
  mesh.vertices.source_id = {7, 8};
  mesh.edges.corners = {{0, 1}};
  mesh.edges.entity = {12};
  mesh.edges.region = {5};
  mesh.edges.source_id = {3};
  mesh.triangles.corners = {{0, 1, 2}, {1, 2, 3}, {0, 1, 3}};
  mesh.triangles.region = {2, 2, 6};
  mesh.triangles.entity = {31, 32, 33};
  mesh.triangles.source_id = {21, 20, 19};
  mesh.tetrahedra.entity = {41, 42};
  mesh.tetrahedra.source_id = {100, 50};
  mesh.region_name[2] = {{2, "inlet wall"}, {6, "out \\ let"}};
  mesh.region_name[0] = {{4, "pinned"}};
  mesh.point_region = {0, 3, 3, -1, 2};
  mesh.point_data = {reals("height", 1, 5), reals("velocity", 3, 5)};
  mesh.tetrahedra.data = {reals("damage", 1, 2), reals("stress", 9, 2)};
  mesh.triangles.data = {reals("damage", 1, 3)};
  return mesh;
}

/// STL's points: the places that triangles use, in their order, in binary files as floats.
void keep_places(FileMesh& mesh, bool as_floats) {
  std::vector<Point> places;
  for (auto& corners : mesh.triangles.corners) {
    for (std::uint32_t& corner : corners) {
      Point p = mesh.points[corner];
      for (double& x : p) x = as_floats ? static_cast<double>(static_cast<float>(x)) : x;
      const auto at = std::ranges::find(places, p);
      corner = static_cast<std::uint32_t>(at - places.begin());
      if (at == places.end()) places.push_back(p);
    }
  }
  mesh.points = std::move(places);
}

/// Nastran and UNV have columns of so many digits for numbers of points.
void keep_small_numbers(FileMesh& mesh, std::int64_t highest) {
  if (std::ranges::any_of(mesh.source_point_id, [&](auto n) { return n > highest; })) {
    mesh.source_point_id.clear();
  }
}

/// UNV has names in groups, and groups have members.
void keep_used_names(FileMesh& mesh) {
  for_each_cell_list(mesh, [&](const auto& cells, int d) {
    std::erase_if(mesh.region_name[static_cast<std::size_t>(d)], [&](const auto& name) {
      return std::ranges::find(cells.region, name.first) == cells.region.end();
    });
  });
}

struct Variant {
  const FormatTraits* traits;
  std::string version;
  Encoding encoding = Encoding::text;
  bool pack = false;
};

/// The rest of `mesh` in a format.
FileMesh held(FileMesh mesh, const Variant& variant) {
  const FormatTraits& t = *variant.traits;
  const std::string& version = variant.version;
  if (!contains(t.cells, CellKind::tetrahedron) && has_volume_cells(mesh)) {
    mesh = boundary_surface(mesh).mesh;
  }
  const bool is_msh_1 = t.format == MeshFormat::msh && version == "1";
  for_each_cell_list(mesh, [&](auto& cells, int d) {
    if (!contains(t.cells, simplex_of(d))) cells = {};
    const bool is_binary_stl = t.format == MeshFormat::stl && variant.encoding == Encoding::binary;
    if (!t.holds_regions || is_binary_stl) cells.region.clear();
    if (!t.holds_entities) cells.entity.clear();
    if (!t.holds_cell_ids || d < t.cell_ids_from) cells.source_id.clear();
    if (!t.holds_cell_data || d < t.cell_data_from || is_msh_1) cells.data.clear();
  });
  // MSH numbers all cells or none; vertices that come from Abaqus' sets have no numbers.
  if (t.format == MeshFormat::msh &&
      mesh.vertices.source_id.size() < mesh.vertices.corners.size()) {
    for_each_cell_list(mesh, [](auto& cells, int) { cells.source_id.clear(); });
  }
  if (!t.holds_point_ids) mesh.source_point_id.clear();
  if (!t.holds_point_data || is_msh_1) mesh.point_data.clear();
  if (!t.holds_point_regions) mesh.point_region.clear();
  if (t.format == MeshFormat::stl) keep_places(mesh, variant.encoding == Encoding::binary);
  const bool is_nastran = t.format == MeshFormat::nastran, is_unv = t.format == MeshFormat::unv;
  if (is_nastran || is_unv) keep_small_numbers(mesh, is_nastran ? 99'999'999 : 999'999'999);
  if (is_nastran) {
    for (Point& p : mesh.points) {
      for (double& x : p) x = in_sixteen_characters(x);
    }
  }
  if (is_unv) keep_used_names(mesh);
  return mesh;
}

std::string to_string(const Variant& v) {
  constexpr const char* words[] = {" text", " binary", " base64"};
  return std::string(v.traits->name) + " " + v.version + words[static_cast<int>(v.encoding)] +
         (v.pack ? " zlib" : "");
}

std::vector<Variant> variants() {
  std::vector<Variant> all;
  for (const FormatTraits& t : format_traits()) {
    std::vector<std::string> versions(t.versions.begin(), t.versions.end());
    if (versions.empty()) versions.emplace_back();
    for (const std::string& version : versions) {
      for (const Encoding encoding : t.encodings) {
        const bool is_msh_1 = t.format == MeshFormat::msh && version == "1";
        if (is_msh_1 && encoding != Encoding::text) continue;
        all.push_back({&t, version, encoding});
        if (t.packs && encoding != Encoding::text) all.push_back({&t, version, encoding, true});
      }
    }
  }
  return all;
}

}  // namespace

TEST_CASE("Gmsh's legacy VTK file is read", "[io][vtk]") {
  const Result<TetMesh> mesh = read_mesh(sample("gmsh.vtk"));
  INFO(summary(mesh.findings));
  REQUIRE(mesh);
  CHECK(mesh->points.size() == 23);
  CHECK(mesh->tetrahedra.size() == 48);
  CHECK(volume(*mesh) == Approx(1.7).epsilon(1e-12));
}

TEST_CASE("a name that ends with .meshb is written as binary MEDIT", "[io][medit]") {
  const Folder folder;
  const FileMesh mesh = file_mesh_of(two_tetrahedra());
  CHECK_FALSE(has_error(write_file_mesh(folder.path() / "a.meshb", mesh)));
  CHECK(bytes_of(folder.path() / "a.meshb")[0] == 1);
  CHECK(read_file_mesh(folder.path() / "a.meshb")->points == mesh.points);
}

namespace {

/// Writes `mesh` as `variant` and reads it again; nothing is lost beyond the announced losses.
FileMesh through(const FileMesh& mesh, const Variant& variant) {
  const Folder folder;
  const auto path = folder.path() / ("mesh" + std::string(variant.traits->extensions[0]));
  const auto findings = write_file_mesh(
      path, mesh, {variant.traits->format, variant.version, variant.encoding, variant.pack});
  INFO(summary(findings));
  REQUIRE_FALSE(has_error(findings));
  Result<FileMesh> back = read_file_mesh(path);
  INFO(summary(back.findings));
  REQUIRE(back);
  CHECK(back.findings.empty());
  return std::move(*back);
}

/// A number for not-a-number, which is equal to nothing: boundaries have it where a body's
/// triangles have data and others none.
FileMesh with_numbers(FileMesh mesh) {
  for_each_cell_list(mesh, [](auto& cells, int) {
    for (DataColumn& column : cells.data) {
      for (double& x : std::get<0>(column.values)) x = x == x ? x : 12345;
    }
  });
  return mesh;
}

void check_equal(const FileMesh& first, const FileMesh& second) {
  const FileMesh a = with_numbers(first), b = with_numbers(second);
  CHECK(a.points == b.points);
  CHECK(a.source_point_id == b.source_point_id);
  CHECK(a.point_region == b.point_region);
  CHECK(a.point_data == b.point_data);
  CHECK(a.vertices == b.vertices);
  CHECK(a.edges == b.edges);
  CHECK(a.triangles == b.triangles);
  CHECK(a.tetrahedra == b.tetrahedra);
  CHECK(a.region_name == b.region_name);
}

}  // namespace

TEST_CASE("what a format holds comes back in every bit", "[io][round_trip]") {
  for (const Variant& variant : variants()) {
    INFO(to_string(variant));
    const FileMesh mesh = held(full_mesh(), variant);
    CHECK(std::ranges::none_of(
        lost_on_writing(mesh, {variant.traits->format, variant.version, variant.encoding}),
        [](const Finding& f) { return f.severity != Severity::note; }));
    check_equal(through(mesh, variant), mesh);
  }
}

TEST_CASE("from any format to any other, what both hold comes back in every bit",
          "[io][round_trip]") {
  for (const Variant& from : variants()) {
    const FileMesh first = through(held(full_mesh(), from), from);
    for (const Variant& to : variants()) {
      INFO(to_string(from) << " to " << to_string(to));
      check_equal(through(first, to), held(first, to));
    }
  }
}

TEST_CASE("names of an earlier mesh do not come back with a new one", "[io][round_trip]") {
  const Folder folder;
  const auto path = folder.path() / "mesh.vtu";
  FileMesh mesh = file_mesh_of(two_tetrahedra());
  mesh.region_name[3] = {{2, "core"}};
  CHECK_FALSE(has_error(write_file_mesh(path, mesh)));
  CHECK(read_file_mesh(path)->region_name == mesh.region_name);
  mesh.region_name = {};
  const std::vector<Finding> findings = write_file_mesh(path, mesh);
  REQUIRE(findings.size() == 1);
  CHECK(findings[0].code == "names_cleared");
  CHECK(read_file_mesh(path)->region_name == mesh.region_name);
}
