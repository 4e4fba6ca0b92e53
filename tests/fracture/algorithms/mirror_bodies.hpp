// SPDX-License-Identifier: MIT
// Irregular bodies that are their own mirror image, and which point is the image of which.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "topology/suite/fixtures/shapes.hpp"

namespace sunder::test {

/// A mesh that a mirror across the plane x_axis = offset maps to itself.
struct MirrorBody {
  TetMesh mesh;
  int axis = 0;
  double offset = 0;
  std::vector<std::uint32_t> image_of_point;
  std::vector<std::size_t> image_of_tetrahedron;
};

/// How the two halves are joined.
enum class Joint {
  faces,  ///< along common faces in the mirror's plane
  bridge  ///< by tetrahedra that are their own images, with edges from a vertex to its image
};

/// Jittered cubes with gaps on the side x > 0; those at x = 0 stay there.
inline TetMesh random_half(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::array<bool, 27> keep;
  for (bool& k : keep) k = suite::below(random, 8) != 0;
  const suite::Cells cells = {2 + static_cast<int>(suite::below(random, 2)), 3, 3};
  TetMesh half = suite::kuhn_cubes(
      cells, [&](int i, int j, int k) { return i == 0 || keep[9 * i + 3 * j + k]; }, 0.1);
  for (Point& p : half.points) {
    const bool on_plane = p[0] == 0;
    for (double& x : p) x += 0.02 * (2 * suite::unit(random) - 1);
    if (on_plane) p[0] = 0;
  }
  return half;
}

/// Adds prisms between the half's faces at x = 0, moved apart, and their images, each cut into
/// cones from its middle. `image`: of each point of the half.
inline void add_bridge(TetMesh& mesh, const std::vector<std::array<std::uint32_t, 3>>& faces,
                       const std::vector<std::uint32_t>& image) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle_of_edge;
  const auto add_point = [&](std::initializer_list<std::uint32_t> corners) {
    Point p = {0, 0, 0};
    for (const std::uint32_t c : corners) {
      for (int i = 1; i < 3; ++i) p[i] += mesh.points[c][i] / static_cast<double>(corners.size());
    }
    mesh.points.push_back(p);
    return static_cast<std::uint32_t>(mesh.points.size() - 1);
  };
  for (const auto& f : faces) {
    const std::uint32_t top = add_point({f[0], f[1], f[2]});
    const auto cone = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      mesh.tetrahedra.push_back({top, a, b, c});
    };
    cone(f[0], f[1], f[2]);
    cone(image[f[0]], image[f[1]], image[f[2]]);
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = f[i], b = f[(i + 1) % 3];
      const auto [entry, is_new] = middle_of_edge.try_emplace(std::minmax(a, b), 0);
      if (is_new) entry->second = add_point({a, b});
      const std::uint32_t m = entry->second;
      cone(a, b, m), cone(image[a], image[b], m), cone(a, image[a], m), cone(b, image[b], m);
    }
  }
}

/// Faces of the half with all points at x = 0 (each belongs to one tetrahedron).
inline std::vector<std::array<std::uint32_t, 3>> faces_on_plane(const TetMesh& half) {
  std::vector<std::array<std::uint32_t, 3>> faces;
  for (const auto& t : half.tetrahedra) {
    for (int out = 0; out < 4; ++out) {
      std::array<std::uint32_t, 3> f;
      for (int i = 0, n = 0; i < 4; ++i) {
        if (i != out) f[n++] = t[i];
      }
      if (std::ranges::all_of(f, [&](std::uint32_t p) { return half.points[p][0] == 0; })) {
        faces.push_back(f);
      }
    }
  }
  return faces;
}

inline void orient(TetMesh& mesh) {
  for (auto& t : mesh.tetrahedra) {
    std::array<std::array<double, 3>, 3> e;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) e[i][j] = mesh.points[t[i + 1]][j] - mesh.points[t[0]][j];
    }
    const double det = e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
                       e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                       e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
    if (det < 0) std::swap(t[2], t[3]);
  }
}

/// Finds the image of every point, to 1e-9 m, and of every tetrahedron.
inline void find_images(MirrorBody& body) {
  const auto& points = body.mesh.points;
  for (Point p : points) {
    p[body.axis] = 2 * body.offset - p[body.axis];
    std::uint32_t found = 0;
    for (std::size_t q = 0; q < points.size(); ++q) {
      double distance = 0;
      for (int i = 0; i < 3; ++i) distance += std::abs(points[q][i] - p[i]);
      if (distance < 1e-9) found = static_cast<std::uint32_t>(q);
    }
    body.image_of_point.push_back(found);
  }
  std::map<std::array<std::uint32_t, 4>, std::size_t> by_corners;
  const auto& tetrahedra = body.mesh.tetrahedra;
  for (std::size_t t = 0; t < tetrahedra.size(); ++t) {
    auto key = tetrahedra[t];
    std::ranges::sort(key);
    by_corners[key] = t;
  }
  for (auto corners : tetrahedra) {
    for (std::uint32_t& p : corners) p = body.image_of_point[p];
    std::ranges::sort(corners);
    body.image_of_tetrahedron.push_back(by_corners.at(corners));
  }
}

/// Both halves with x and `axis` exchanged, moved to `offset` and renumbered at random.
inline MirrorBody mirror_body(std::uint64_t seed, Joint joint, int axis, double offset) {
  TetMesh mesh = random_half(seed);
  const auto faces = faces_on_plane(mesh);
  if (joint == Joint::bridge) {
    for (Point& p : mesh.points) p[0] += 0.03;
  }
  const std::size_t half_points = mesh.points.size();
  std::vector<std::uint32_t> image(half_points);
  for (std::uint32_t p = 0; p < half_points; ++p) {
    image[p] = p;
    if (mesh.points[p][0] == 0) continue;
    image[p] = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back({-mesh.points[p][0], mesh.points[p][1], mesh.points[p][2]});
  }
  const std::size_t half_tetrahedra = mesh.tetrahedra.size();
  for (std::size_t t = 0; t < half_tetrahedra; ++t) {
    std::array<std::uint32_t, 4> corners = mesh.tetrahedra[t];
    for (std::uint32_t& p : corners) p = image[p];
    mesh.tetrahedra.push_back(corners);
  }
  if (joint == Joint::bridge) add_bridge(mesh, faces, image);
  for (Point& p : mesh.points) {
    std::swap(p[0], p[axis]);
    p[axis] += offset;
  }
  orient(mesh);

  MirrorBody body{suite::shuffled(mesh, seed), axis, offset, {}, {}};
  find_images(body);
  return body;
}

}  // namespace sunder::test
