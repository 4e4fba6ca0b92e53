// SPDX-License-Identifier: MIT
// write_reader_seeds FOLDER: small meshes with everything in them, in every format, version and
// encoding.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "topology/io/format_traits.hpp"
#include "topology/io/mesh_file.hpp"

using namespace sunder;

namespace {

DataColumn reals(std::string name, std::size_t components, std::size_t rows) {
  std::vector<double> values;
  for (std::size_t i = 0; i < rows * components; ++i) values.push_back(0.5 * double(i));
  return {std::move(name), components, NumberType::float64, std::move(values)};
}

FileMesh small_mesh() {
  FileMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0.25, -2}};
  mesh.tetrahedra.corners = {{0, 1, 2, 3}, {1, 0, 2, 4}};
  mesh.tetrahedra.region = {2, 5};
  mesh.region_name[3] = {{2, "body"}, {5, "foot"}};
  return mesh;
}

FileMesh full_mesh() {
  FileMesh mesh = small_mesh();
  mesh.source_point_id = {9, 4, 107, 1, 2};
  mesh.vertices.corners = {{0}, {3}};
  mesh.vertices.region = {4, 4};
  mesh.vertices.source_id = {7, 8};
  mesh.edges.corners = {{0, 1}};
  mesh.edges.entity = {12};
  mesh.edges.region = {5};
  mesh.edges.source_id = {3};
  mesh.triangles.corners = {{0, 1, 2}, {1, 2, 3}};
  mesh.triangles.region = {2, 6};
  mesh.triangles.entity = {31, 32};
  mesh.triangles.source_id = {21, 20};
  mesh.tetrahedra.entity = {41, 42};
  mesh.tetrahedra.source_id = {100, 50};
  mesh.region_name[2] = {{2, "wall"}};
  mesh.point_region = {0, 3, 3, -1, 2};
  mesh.point_data = {reals("u", 1, 5), reals("v", 3, 5)};
  mesh.tetrahedra.data = {reals("d", 1, 2)};
  mesh.triangles.data = {reals("d", 1, 2)};
  return mesh;
}

/// A cell of every kind, in one region a kind.
FileMesh mesh_of_all_kinds() {
  FileMesh mesh;
  for (int i = 0; i < 27; ++i) mesh.points.push_back({i % 3 * 1.0, i / 3 % 3 * 1.0, i / 9 * 1.0});
  for (const CellKind kind : all_cell_kinds) {
    std::vector<std::uint32_t> nodes(kind == CellKind::polygon ? 5 : traits_of(kind).nodes);
    for (std::uint32_t k = 0; k < nodes.size(); ++k) nodes[k] = k;
    append_cell(mesh, kind, nodes);
    columns_of(mesh, kind).region = {static_cast<std::int32_t>(index_of(kind)) + 1};
    columns_of(mesh, kind).data = {reals("d", 1, 1)};
  }
  return mesh;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::puts("usage: write_reader_seeds FOLDER");
    return 2;
  }
  for (const FormatTraits& t : format_traits()) {
    const std::string_view ending = t.extensions[0];
    const auto folder = std::filesystem::path(argv[1]) / ending.substr(1);
    std::filesystem::create_directories(folder);
    std::vector<std::string> versions(t.versions.begin(), t.versions.end());
    if (versions.empty()) versions.emplace_back();
    for (const std::string& version : versions) {
      for (const Encoding encoding : t.encodings) {
        for (const bool pack : {false, true}) {
          const std::string name =
              fmt::format("{}{}{}{}", version, static_cast<int>(encoding), int(pack), ending);
          const WriteOptions way{t.format, version, encoding, pack};
          write_file_mesh(folder / ("small" + name), small_mesh(), way);
          write_file_mesh(folder / ("full" + name), full_mesh(), way);
          write_file_mesh(folder / ("kinds" + name), mesh_of_all_kinds(), way);
        }
      }
    }
  }
}
