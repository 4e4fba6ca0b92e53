// SPDX-License-Identifier: MIT
// The cut mesh and the list of cuts next to it.
#include "apps/sunder/mesh/split_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <numeric>
#include <string>

#include "topology/base/split_text.hpp"
#include "topology/io/files/output_file.hpp"
#include "topology/io/format_traits.hpp"
#include "topology/io/mesh_file.hpp"
#include "topology/kernel/map_mesh.hpp"

namespace sunder {
namespace {

constexpr std::string_view cuts_title =
    "# Cut faces whose two sides have the same three points; for sunder split --faces";

std::string cuts_text(const TetMesh& cut, std::span<const HalfFaceId> faces) {
  std::string text{cuts_title};
  text += '\n';
  for (const HalfFaceId face : faces) {
    auto points = corners_of_face(cut.tetrahedra[tetrahedron_of(face).index()], face);
    std::sort(points.begin(), points.end());
    fmt::format_to(std::back_inserter(text), "{} {} {}\n", points[0], points[1], points[2]);
  }
  return text;
}

/// Removes a list of an earlier run: with this mesh it would cut faces that are not cut.
std::vector<Finding> remove_stale_cuts(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::vector<std::string_view> lines = lines_of(text);
  if (lines.empty() || lines[0] != cuts_title) return {};
  std::error_code reason;
  std::filesystem::remove(path, reason);
  if (!reason) return {};
  return {{.code = "cannot_write",
           .text = "a list of cuts of an earlier run cannot be removed: " + reason.message(),
           .remedy = "remove it: it does not belong to the mesh next to it",
           .file = path.string()}};
}

std::vector<Finding> write_cuts(const std::filesystem::path& path, const TetMesh& cut,
                                std::span<const HalfFaceId> faces) {
  if (faces.empty()) return remove_stale_cuts(path);
  if (auto failure = write_file(path, cuts_text(cut, faces))) return {*failure};
  return {{.code = "cuts_beside",
           .severity = Severity::note,
           .count = faces.size(),
           .text =
               "cut faces have the same three points on both sides, which vertex numbers cannot "
               "say; they are listed in this file next to the mesh",
           .remedy = "split the mesh with --faces and this list to have the same cuts again",
           .file = path.string()}};
}

}  // namespace

TetMesh cut_mesh(const CutBody& body) {
  const auto& [file, map, components] = body;
  TetMesh cut;
  cut.points = file.points;
  cut.source_tetrahedron_id = file.source_tetrahedron_id;
  cut.source_point_id = file.source_point_id;
  if (cut.source_point_id.empty()) {
    cut.source_point_id.resize(file.points.size());
    std::iota(cut.source_point_id.begin(), cut.source_point_id.end(), 1);
  }
  std::vector<char> taken(file.points.size(), 0);
  std::vector<std::uint32_t> point_of_row(map.vertices());
  for (std::size_t row = 0; row < map.vertices(); ++row) {
    const std::uint32_t point = map.point_of_vertex(VertexId{row});
    point_of_row[row] = point;
    if (taken[point]) {
      point_of_row[row] = static_cast<std::uint32_t>(cut.points.size());
      cut.points.push_back(file.points[point]);
      cut.source_point_id.push_back(cut.source_point_id[point]);
    }
    taken[point] = 1;
  }
  for (const auto& corners : map.corners()) {
    auto& tetrahedron = cut.tetrahedra.emplace_back();
    for (int k = 0; k < 4; ++k) tetrahedron[k] = point_of_row[corners[k].index()];
  }
  for (const ComponentId component : components.of_tetrahedron) {
    cut.region.push_back(static_cast<std::int32_t>(component.value) + 1);
  }
  return cut;
}

std::filesystem::path cuts_beside(const std::filesystem::path& output) {
  std::filesystem::path path = output;
  return path += ".cuts";
}

std::vector<Finding> write_cut_body(const std::filesystem::path& output, const CutBody& body) {
  std::vector<Finding> findings;
  TetMesh cut = cut_mesh(body);
  // Copies share their point's number, which only VTU can say.
  if (format_of_name(output) == MeshFormat::msh) cut.source_point_id.clear();
  if (!body.file.region.empty()) {
    findings.push_back({.code = "regions_replaced",
                        .severity = Severity::note,
                        .text = "the mesh's own regions give way to components",
                        .remedy = "take them from the input: tetrahedra keep their rows",
                        .file = output.string()});
  }
  const auto add = [&findings](std::vector<Finding> more) {
    std::move(more.begin(), more.end(), std::back_inserter(findings));
  };
  add(write_mesh(output, cut));
  if (!has_error(findings)) add(write_cuts(cuts_beside(output), cut, unexpressed_cuts(body.map)));
  return findings;
}

}  // namespace sunder
