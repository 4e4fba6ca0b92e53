// SPDX-License-Identifier: MIT
// Files to meshes of bodies and solids.
#include "apps/scene/scene_meshes.hpp"

#include <algorithm>
#include <map>

#include "topology/io/mesh_file.hpp"
#include "topology/mesh/check.hpp"

namespace sunder {
namespace {

/// Places of the corners of each face of a tetrahedron, counter-clockwise from outside.
constexpr std::array<std::array<std::size_t, 3>, 4> faces = {
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// Whether the corners of a tetrahedron are in the order that counts as positive.
bool is_positive(const std::vector<Point>& points, const std::array<std::uint32_t, 4>& corners) {
  std::array<Vec3, 4> x;
  for (std::size_t k = 0; k < 4; ++k) {
    const Point& p = points[corners[k]];
    x[k] = {p[0], p[1], p[2]};
  }
  return (x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]) > 0;
}

/// Faces of tetrahedra that no second one has.
std::vector<std::array<std::uint32_t, 3>> boundary(const FileMesh& mesh) {
  std::map<std::array<std::uint32_t, 3>, std::pair<int, std::array<std::uint32_t, 3>>> seen;
  for (std::array<std::uint32_t, 4> t : mesh.tetrahedra.corners) {
    if (!is_positive(mesh.points, t)) std::swap(t[2], t[3]);
    for (const auto& face : faces) {
      const std::array<std::uint32_t, 3> triangle = {t[face[0]], t[face[1]], t[face[2]]};
      std::array<std::uint32_t, 3> key = triangle;
      std::ranges::sort(key);
      auto& [count, outward] = seen[key];
      ++count;
      outward = triangle;
    }
  }
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const auto& [key, entry] : seen) {
    if (entry.first == 1) triangles.push_back(entry.second);
  }
  return triangles;
}

/// Points at one place become one, those that no triangle has are left out.
TriangleSurface joined(const FileMesh& mesh,
                       const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  TriangleSurface surface;
  std::map<Point, std::uint32_t> row;
  for (const auto& triangle : triangles) {
    auto& corners = surface.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      Point p = mesh.points[triangle[k]];
      for (double& x : p) x += 0.0;  // -0 is 0
      const auto [at, is_new] = row.try_emplace(p, static_cast<std::uint32_t>(row.size()));
      if (is_new) surface.points.emplace_back(p[0], p[1], p[2]);
      corners[k] = at->second;
    }
  }
  return surface;
}

}  // namespace

std::vector<Finding> read_body_mesh(TetMesh& mesh, const SceneFiles& files,
                                    const std::string& name) {
  Result<TetMesh> read = files.mesh(name);
  std::vector<Finding> found = std::move(read.findings);
  if (!read) return found;
  for (Finding& f : check_mesh(*read)) found.push_back(std::move(f));
  mesh = std::move(*read);
  return found;
}

std::vector<Finding> read_solid(std::shared_ptr<const SolidSurface>& surface,
                                const SceneFiles& files, const std::string& name) {
  Result<FileMesh> read = files.surface(name);
  if (!read) return std::move(read.findings);
  const bool has_volume = !read->tetrahedra.corners.empty();
  const auto triangles = has_volume ? boundary(*read) : read->triangles.corners;
  Result<SolidSurface> made =
      make_solid_surface(joined(*read, triangles), name.substr(name.find_last_of('/') + 1));
  if (made) surface = std::make_shared<const SolidSurface>(std::move(*made));
  return std::move(made.findings);
}

}  // namespace sunder
