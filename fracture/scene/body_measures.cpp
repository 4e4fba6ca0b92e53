// SPDX-License-Identifier: MIT
// Sums over tetrahedra, faces paired by sorting, rays walked from face to face.
#include "fracture/scene/body_measures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanics/state/settings/material.hpp"
#include "topology/base/elementary.hpp"

namespace sunder {
namespace {

using Tetrahedron = std::array<std::uint32_t, 4>;

/// The face opposite corner `k`, outward for a tetrahedron of positive orientation.
std::array<std::uint32_t, 3> face_of(const Tetrahedron& t, std::size_t k) {
  constexpr std::array<std::array<std::size_t, 3>, 4> corners = {
      {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  return {t[corners[k][0]], t[corners[k][1]], t[corners[k][2]]};
}

void pair_faces(BodyMeasures& m, const std::vector<Tetrahedron>& tetrahedra) {
  struct Side {
    std::array<std::uint32_t, 3> key;
    std::uint32_t tetrahedron;
    std::uint32_t corner;
  };
  std::vector<Side> sides;
  sides.reserve(4 * tetrahedra.size());
  for (std::uint32_t t = 0; t < tetrahedra.size(); ++t) {
    for (std::uint32_t k = 0; k < 4; ++k) {
      sides.push_back({face_of(tetrahedra[t], k), t, k});
      std::ranges::sort(sides.back().key);
    }
  }
  std::ranges::sort(sides, [](const Side& a, const Side& b) {
    return a.key != b.key ? a.key < b.key : a.tetrahedron < b.tetrahedron;
  });
  m.across.assign(tetrahedra.size(), {-1, -1, -1, -1});
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Side& a = sides[i];
    if (i + 1 < sides.size() && sides[i + 1].key == a.key) {
      const Side& b = sides[++i];
      m.across[a.tetrahedron][a.corner] = static_cast<std::int32_t>(b.tetrahedron);
      m.across[b.tetrahedron][b.corner] = static_cast<std::int32_t>(a.tetrahedron);
    } else {
      m.outside.push_back({face_of(tetrahedra[a.tetrahedron], a.corner), a.tetrahedron});
    }
  }
}

double least_strength(const BodySettings& body) {
  double least = body.material.tensile_strength;
  if (!body.strength.painted.empty()) least = std::ranges::min(body.strength.painted);
  for (const RegionStrength& region : body.strength.regions) {
    if (region.tensile_strength) least = std::min(least, *region.tensile_strength);
  }
  return least;
}

/// Twice the area times the outward normal.
Vec3 area_normal(const std::vector<Vec3>& x, const std::array<std::uint32_t, 3>& face) {
  return (x[face[1]] - x[face[0]]).cross(x[face[2]] - x[face[0]]);
}

/// How many tetrahedra a ray meets from the middle of an outer face straight in until it leaves.
int met_by_ray(const BodySettings& body, const BodyMeasures& m, const OuterFace& face) {
  const std::vector<Vec3>& x = m.points;
  const Vec3 inward = -area_normal(x, face.points);
  const Vec3 start = (x[face.points[0]] + x[face.points[1]] + x[face.points[2]]) / 3;
  int met = 0;
  std::int32_t t = static_cast<std::int32_t>(face.tetrahedron), from = -1;
  // A ray that runs in circles by rounding ends with the tetrahedra.
  while (t >= 0 && met <= static_cast<int>(m.across.size())) {
    ++met;
    const auto row = static_cast<std::size_t>(t);
    double nearest = std::numeric_limits<double>::infinity();
    std::int32_t next = -1;
    for (std::size_t k = 0; k < 4; ++k) {
      if (from >= 0 && m.across[row][k] == from) continue;
      const auto plane = face_of(body.mesh.tetrahedra[row], k);
      const Vec3 normal = area_normal(x, plane);
      const double towards = normal.dot(inward);
      if (!(towards > 0)) continue;
      const double way = normal.dot(x[plane[0]] - start) / towards;
      if (way >= nearest) continue;
      nearest = way;
      next = m.across[row][k];
    }
    from = t;
    t = next;
  }
  return met;
}

}  // namespace

BodyMeasures measure(const BodySettings& body) {
  BodyMeasures m;
  for (const Point& p : body.mesh.points) {
    m.points.emplace_back(body.rotation * Vec3(p[0], p[1], p[2]) + body.translation);
  }
  const std::vector<Vec3>& x = m.points;
  Vec3 first = Vec3::Zero();
  for (const Tetrahedron& t : body.mesh.tetrahedra) {
    const double volume = (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]).dot(x[t[3]] - x[t[0]]) / 6;
    m.volume += volume;
    for (const std::uint32_t corner : t) {
      first += volume / 4 * x[corner];
      m.box.extend(x[corner]);
    }
  }
  m.centre = first / m.volume;
  m.cell = cube_root(6 * m.volume / static_cast<double>(body.mesh.tetrahedra.size()));
  // The integral of arm arm^T over the body.
  Mat3 second = Mat3::Zero();
  for (const Tetrahedron& t : body.mesh.tetrahedra) {
    const double volume = (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]).dot(x[t[3]] - x[t[0]]) / 6;
    Vec3 sum = Vec3::Zero();
    for (const std::uint32_t corner : t) {
      const Vec3 arm = x[corner] - m.centre;
      second += volume / 20 * arm * arm.transpose();
      sum += arm;
      m.extent = std::max(m.extent, 2 * arm.norm());
    }
    second += volume / 20 * sum * sum.transpose();
  }
  const Vec3 moments = Eigen::SelfAdjointEigenSolver<Mat3>(second).eigenvalues();
  m.slenderness = std::sqrt(moments[2] / moments[0]);
  m.wave_speed = compression_wave_speed(body.material);
  m.strength = least_strength(body);
  pair_faces(m, body.mesh.tetrahedra);
  return m;
}

double false_strain(const BodySettings& body, const BodyMeasures& m) {
  return m.strength / body.material.young_modulus * m.slenderness * m.slenderness / 2;
}

double layers_through(const BodySettings& body, const BodyMeasures& m) {
  constexpr int rays = 200;
  double area = 0;
  for (const OuterFace& face : m.outside) area += area_normal(m.points, face.points).norm();
  std::vector<int> met;
  double passed = 0;
  for (const OuterFace& face : m.outside) {
    passed += area_normal(m.points, face.points).norm();
    // As many rays as multiples of area / rays lie in this face's part of the sum, offset by half.
    while (static_cast<int>(met.size()) < rays &&
           passed >= (static_cast<double>(met.size()) + 0.5) / rays * area) {
      met.push_back(met_by_ray(body, m, face));
    }
  }
  if (met.empty()) return 0;
  const auto middle = met.begin() + static_cast<std::ptrdiff_t>(met.size() / 2);
  std::ranges::nth_element(met, middle);
  return *middle / 3.0;
}

}  // namespace sunder
