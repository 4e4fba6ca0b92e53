// SPDX-License-Identifier: MIT
// Turns surfaces, spheres and boxes into triangles and edges.
#include "apps/render/scene_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include "topology/base/whole_number.hpp"

namespace sunder::render {
namespace {

using Corners = std::array<Eigen::Vector3f, 3>;

std::array<float, 3> packed(const Eigen::Vector3f& v) { return {v.x(), v.y(), v.z()}; }

std::array<std::uint8_t, 4> packed(Color c) {
  const auto byte = [](float v) {
    return whole_number<std::uint8_t>(std::round(255 * std::clamp(v, 0.0f, 1.0f)));
  };
  return {byte(c.r), byte(c.g), byte(c.b), 255};
}

void add_triangle(SceneGeometry& geometry, const Corners& p, const Corners& n, Color color) {
  for (std::size_t i = 0; i < 3; ++i) {
    geometry.triangles.push_back({packed(p[i]), packed(n[i]), packed(color)});
    geometry.casters.extend(p[i]);
  }
}

Corners flat_normals(const Corners& p) {
  // In double: the edges of a chip of a millimeter have a product of 1e-6, and degenerate ones 0.
  const Eigen::Vector3d a = (p[1] - p[0]).cast<double>(), b = (p[2] - p[0]).cast<double>();
  const Eigen::Vector3f n = a.cross(b).stableNormalized().cast<float>();
  return {n, n, n};
}

Color face_color(const Surface& s, std::size_t t) {
  const bool cracked = !s.face_class.empty() && s.face_class[t] == FaceClass::crack;
  const std::uint32_t piece = s.piece.empty() ? 0 : s.piece[t];
  // Crack faces keep their hue, so that they are known as such on every piece.
  return cracked ? tinted(s.colors.crack, piece, 0.25f * s.colors.piece_tint)
                 : tinted(s.colors.skin, piece, s.colors.piece_tint);
}

void add_faces(SceneGeometry& geometry, const Surface& s) {
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    if (!is_drawable(s, s.triangles[t])) continue;
    Corners p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = s.positions[s.triangles[t][i]];
    const Corners n = s.corner_normals.empty() ? flat_normals(p) : s.corner_normals[t];
    add_triangle(geometry, p, n, face_color(s, t));
  }
}

void add_edges(std::vector<EdgeInstance>& lines, const Surface& s) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& t : s.triangles) {
    if (!is_drawable(s, t)) continue;
    for (std::size_t i = 0; i < 3; ++i) edges.push_back(std::minmax({t[i], t[(i + 1) % 3]}));
  }
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  for (const auto& [a, b] : edges) {
    lines.push_back({packed(s.positions[a]), packed(s.positions[b]), packed(s.colors.wire)});
  }
}

/// Edges at which a crack comes to the skin, each once: a closed crack is a line there.
void add_crack_lines(std::vector<EdgeInstance>& lines, const Surface& s) {
  if (s.face_class.empty()) return;
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  std::vector<Edge> of_skin, of_cracks, both;
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    const auto& corners = s.triangles[t];
    if (!is_drawable(s, corners)) continue;
    std::vector<Edge>& edges = s.face_class[t] == FaceClass::crack ? of_cracks : of_skin;
    for (std::size_t i = 0; i < 3; ++i) {
      edges.push_back(std::minmax({corners[i], corners[(i + 1) % 3]}));
    }
  }
  for (std::vector<Edge>* edges : {&of_skin, &of_cracks}) {
    std::ranges::sort(*edges);
    edges->erase(std::unique(edges->begin(), edges->end()), edges->end());
  }
  std::ranges::set_intersection(of_skin, of_cracks, std::back_inserter(both));
  for (const auto& [a, b] : both) {
    lines.push_back({packed(s.positions[a]), packed(s.positions[b]), packed(s.colors.crack_line)});
  }
}

void add_sphere(SceneGeometry& geometry, const Sphere& sphere) {
  constexpr int rings = 32, sectors = 64;  // a silhouette of 64 sides: round at any usual size
  const auto direction = [](int ring, int sector) {
    const double polar = std::numbers::pi * ring / rings;
    const double turn = 2 * std::numbers::pi * (sector % sectors) / sectors;
    return Eigen::Vector3f(Eigen::Vector3d(std::sin(polar) * std::cos(turn),
                                           std::sin(polar) * std::sin(turn), std::cos(polar))
                               .cast<float>());
  };
  const auto add = [&](const Corners& n) {
    const auto at = [&](int i) {
      return Eigen::Vector3f(sphere.center + sphere.radius * n[static_cast<std::size_t>(i)]);
    };
    add_triangle(geometry, {at(0), at(1), at(2)}, n, sphere.color);
  };
  for (int r = 0; r < rings; ++r) {
    for (int s = 0; s < sectors; ++s) {
      const Corners upper{direction(r, s), direction(r + 1, s), direction(r, s + 1)};
      const Corners lower{direction(r + 1, s), direction(r + 1, s + 1), direction(r, s + 1)};
      if (r > 0) add(upper);
      if (r < rings - 1) add(lower);
    }
  }
}

void add_box(SceneGeometry& geometry, const Box& box) {
  const Eigen::Matrix3f turn = box.rotation.normalized().toRotationMatrix();
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0f, 1.0f}) {
      const Eigen::Vector3f n = side * turn.col(axis);
      const Eigen::Vector3f middle = box.center + box.half_extent[axis] * n;
      const int a = (axis + 1) % 3, b = (axis + 2) % 3;
      const Eigen::Vector3f u = box.half_extent[a] * turn.col(a);
      const Eigen::Vector3f v = side * box.half_extent[b] * turn.col(b);
      const Corners normals{n, n, n};
      add_triangle(geometry, {middle - u - v, middle + u - v, middle + u + v}, normals, box.color);
      add_triangle(geometry, {middle - u - v, middle + u + v, middle - u + v}, normals, box.color);
    }
  }
}

}  // namespace

SceneGeometry scene_geometry(const FrameScene& scene) {
  SceneGeometry geometry;
  for (const Surface& s : scene.surfaces) {
    if (s.style != SurfaceStyle::wireframe) add_faces(geometry, s);
    if (s.style == SurfaceStyle::wireframe) add_edges(geometry.wires, s);
    if (s.style == SurfaceStyle::filled_with_edges) add_edges(geometry.edges, s);
    if (s.style == SurfaceStyle::filled) add_crack_lines(geometry.edges, s);
  }
  for (const Sphere& s : scene.spheres) add_sphere(geometry, s);
  for (const Box& b : scene.boxes) add_box(geometry, b);
  return geometry;
}

void sort_front_to_back(SceneGeometry& geometry, const Eigen::Vector3f& eye) {
  const auto& rows = geometry.triangles;
  std::vector<std::pair<float, std::size_t>> order(rows.size() / 3);
  for (std::size_t t = 0; t < order.size(); ++t) {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (std::size_t i = 0; i < 3; ++i) sum += Eigen::Vector3f(rows[3 * t + i].position.data());
    order[t] = {(sum / 3 - eye).squaredNorm(), t};
  }
  std::ranges::sort(order);
  std::vector<MeshVertex> sorted;
  sorted.reserve(rows.size());
  for (const auto& [distance, t] : order) {
    for (std::size_t i = 0; i < 3; ++i) sorted.push_back(rows[3 * t + i]);
  }
  geometry.triangles = std::move(sorted);
}

}  // namespace sunder::render
