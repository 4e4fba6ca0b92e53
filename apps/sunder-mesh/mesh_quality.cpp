// SPDX-License-Identifier: GPL-3.0-or-later
// Angles, volumes, components and canonical order of a tetrahedral mesh.
#include "apps/sunder-mesh/mesh_quality.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>

#include "topology/base/assert.hpp"

namespace sunder {
namespace {

using Corners = std::array<std::uint32_t, 4>;

Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

double volume_of(const TetMesh& mesh, const Corners& t) {
  const Point& o = mesh.points[t[0]];
  return dot(mesh.points[t[1]] - o, cross(mesh.points[t[2]] - o, mesh.points[t[3]] - o)) / 6;
}

/// The angle, degrees, between the faces that meet in the edge from a to b, c and d opposite.
double dihedral_angle(const TetMesh& mesh, const Corners& abcd) {
  const Point& a = mesh.points[abcd[0]];
  const Point edge = mesh.points[abcd[1]] - a;
  const Point n1 = cross(edge, mesh.points[abcd[2]] - a);
  const Point n2 = cross(edge, mesh.points[abcd[3]] - a);
  const Point c = cross(n1, n2);
  return std::atan2(std::sqrt(dot(c, c)), dot(n1, n2)) * 180 / std::numbers::pi;
}

/// For each tetrahedron the lowest row of its component.
std::vector<std::size_t> component_roots(const std::vector<Corners>& tetrahedra) {
  std::vector<std::size_t> parent(tetrahedra.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::size_t t) {
    while (parent[t] != t) t = parent[t] = parent[parent[t]];
    return t;
  };
  std::map<std::array<std::uint32_t, 3>, std::size_t> first_at;
  for (std::size_t t = 0; t < tetrahedra.size(); ++t) {
    for (int opposite = 0; opposite < 4; ++opposite) {
      std::array<std::uint32_t, 3> face{};
      for (int k = 1; k < 4; ++k) face[k - 1] = tetrahedra[t][(opposite + k) % 4];
      std::sort(face.begin(), face.end());
      const auto [place, is_new] = first_at.try_emplace(face, t);
      if (is_new) continue;
      const auto [low, high] = std::minmax({root(place->second), root(t)});
      parent[high] = low;
    }
  }
  for (std::size_t t = 0; t < tetrahedra.size(); ++t) parent[t] = root(t);
  return parent;
}

/// An even permutation that brings the lowest row to the front and the second lowest next to it.
Corners lowest_first(Corners t) {
  const auto lowest = std::min_element(t.begin(), t.end()) - t.begin();
  if (lowest != 0) {
    std::swap(t[0], t[lowest]);
    const int others[2] = {lowest == 1 ? 2 : 1, lowest == 3 ? 2 : 3};
    std::swap(t[others[0]], t[others[1]]);
  }
  const auto second = std::min_element(t.begin() + 1, t.end());
  std::rotate(t.begin() + 1, second, t.end());
  return t;
}

}  // namespace

MeshQuality quality_of(const TetMesh& mesh) {
  MeshQuality q;
  if (mesh.tetrahedra.empty()) return q;
  q.least_dihedral_angle = 180;
  q.least_volume = std::numeric_limits<double>::infinity();
  q.largest_volume = -q.least_volume;
  constexpr int edges[6][4] = {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2},
                               {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}};
  for (const Corners& t : mesh.tetrahedra) {
    for (const auto& e : edges) {
      const double angle = dihedral_angle(mesh, {t[e[0]], t[e[1]], t[e[2]], t[e[3]]});
      q.least_dihedral_angle = std::min(q.least_dihedral_angle, angle);
      q.largest_dihedral_angle = std::max(q.largest_dihedral_angle, angle);
    }
    const double volume = volume_of(mesh, t);
    q.least_volume = std::min(q.least_volume, volume);
    q.largest_volume = std::max(q.largest_volume, volume);
    q.volume += volume;
  }
  const auto roots = component_roots(mesh.tetrahedra);
  for (std::size_t t = 0; t < roots.size(); ++t) q.components += roots[t] == t;
  return q;
}

void sort_rows(TetMesh& mesh) {
  SUNDER_ASSERT(
      mesh.region.empty() && mesh.source_point_id.empty() && mesh.source_tetrahedron_id.empty(),
      "sort before rows carry anything");
  std::vector<char> is_used(mesh.points.size(), 0);
  for (const Corners& t : mesh.tetrahedra) {
    for (std::uint32_t v : t) is_used[v] = 1;
  }
  std::vector<std::uint32_t> order;
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
    if (is_used[v]) order.push_back(v);
  }
  const auto key = [&](std::uint32_t v) {
    const Point& p = mesh.points[v];
    return std::array{p[2], p[1], p[0]};
  };
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return key(a) < key(b); });

  std::vector<std::uint32_t> new_row(mesh.points.size());
  std::vector<Point> points;
  for (std::uint32_t v : order) {
    new_row[v] = static_cast<std::uint32_t>(points.size());
    points.push_back(mesh.points[v]);
  }
  mesh.points = std::move(points);
  for (Corners& t : mesh.tetrahedra) {
    for (std::uint32_t& v : t) v = new_row[v];
    t = lowest_first(t);
  }
  std::sort(mesh.tetrahedra.begin(), mesh.tetrahedra.end());
}

std::size_t keep_largest_component(TetMesh& mesh) {
  const auto roots = component_roots(mesh.tetrahedra);
  std::vector<std::size_t> size(roots.size(), 0);
  for (std::size_t r : roots) ++size[r];
  const auto largest =
      static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
  std::vector<Corners> kept;
  for (std::size_t t = 0; t < roots.size(); ++t) {
    if (roots[t] == largest) kept.push_back(mesh.tetrahedra[t]);
  }
  const std::size_t left_out = mesh.tetrahedra.size() - kept.size();
  mesh.tetrahedra = std::move(kept);
  sort_rows(mesh);
  return left_out;
}

}  // namespace sunder
