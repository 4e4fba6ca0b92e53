// SPDX-License-Identifier: MIT
// Bodies of closed forms (shells, discs, plates with a hole, bars) and their equilibrium when free.
#pragma once

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <vector>

#include "fracture/node_stress.hpp"
#include "mechanics/loads.hpp"
#include "tests/mechanics/bodies.hpp"

namespace sunder::accuracy {

using test::Body;
using std::numbers::pi;

/// A triangulated sheet whose points are given layer by layer when it is extruded.
struct Sheet {
  std::size_t points = 0;
  std::vector<std::array<std::size_t, 3>> triangles;
};

/// Three tetrahedra a prism between two layers, diagonals from the lower number: conforming for any
/// sheet. `layers`: the sheet's points in each layer.
inline Body extruded(const Sheet& sheet, const std::vector<std::vector<Vec3>>& layers) {
  Body body;
  for (const auto& layer : layers) body.rest.insert(body.rest.end(), layer.begin(), layer.end());
  const auto volume = [&](const Corners& c) {
    const auto x = [&](std::size_t k) { return body.rest[c[k].index()]; };
    return (x(1) - x(0)).cross(x(2) - x(0)).dot(x(3) - x(0));
  };
  for (std::size_t l = 0; l + 1 < layers.size(); ++l) {
    for (auto t : sheet.triangles) {
      std::sort(t.begin(), t.end());
      const auto low = [&](int k) { return VertexId{l * sheet.points + t[std::size_t(k)]}; };
      const auto top = [&](int k) { return VertexId{(l + 1) * sheet.points + t[std::size_t(k)]}; };
      for (Corners c : {Corners{low(0), low(1), low(2), top(2)}, {low(0), low(1), top(1), top(2)},
                        {low(0), top(0), top(1), top(2)}}) {
        if (volume(c) < 0) std::swap(c[2], c[3]);
        body.corners.push_back(c);
      }
    }
  }
  return body;
}

/// A unit sphere of 8 * 4^levels triangles from an octahedron.
inline Sheet sphere_sheet(int levels, std::vector<Vec3>& points) {
  points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  Sheet sheet;
  for (std::size_t x : {0, 1}) {
    for (std::size_t y : {2, 3}) {
      for (std::size_t z : {4, 5}) sheet.triangles.push_back({x, y, z});
    }
  }
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> middle;
    const auto between = [&](std::size_t a, std::size_t b) {
      const auto [at, fresh] = middle.try_emplace(std::minmax(a, b), points.size());
      if (fresh) points.push_back((points[a] + points[b]).normalized());
      return at->second;
    };
    std::vector<std::array<std::size_t, 3>> finer;
    for (const auto& [a, b, c] : sheet.triangles) {
      const std::size_t ab = between(a, b), bc = between(b, c), ca = between(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    sheet.triangles = std::move(finer);
  }
  sheet.points = points.size();
  return sheet;
}

/// A grid of rings: `around` points on each of `rings + 1` rings, diagonals alternating, point
/// numbers ring * around + place.
inline Sheet ring_sheet(std::size_t around, std::size_t rings) {
  Sheet sheet{around * (rings + 1), {}};
  for (std::size_t r = 0; r < rings; ++r) {
    for (std::size_t k = 0; k < around; ++k) {
      const std::size_t next = (k + 1) % around;
      const std::size_t a = r * around + k, b = r * around + next;
      const std::size_t c = a + around, d = b + around;
      if ((r + k) % 2 == 0) {
        sheet.triangles.insert(sheet.triangles.end(), {{a, b, d}, {a, d, c}});
      } else {
        sheet.triangles.insert(sheet.triangles.end(), {{a, b, c}, {b, d, c}});
      }
    }
  }
  return sheet;
}

/// A sheet in the plane z = 0 made `height` thick in `layers` cells.
inline Body plate(const Sheet& sheet, const std::vector<Vec3>& points, double height, int layers) {
  std::vector<std::vector<Vec3>> stack;
  for (int l = 0; l <= layers; ++l) {
    stack.push_back(points);
    for (Vec3& x : stack.back()) x.z() = height * (double(l) / layers - 0.5);
  }
  return extruded(sheet, stack);
}

/// A disc of radius `radius`: rings about a middle point, which comes last.
inline Body disc(std::size_t around, std::size_t rings, double radius, double height) {
  Sheet sheet = ring_sheet(around, rings - 1);
  std::vector<Vec3> points;
  for (std::size_t r = 0; r < rings; ++r) {
    for (std::size_t k = 0; k < around; ++k) {
      const double angle = 2 * pi * double(k) / double(around);
      points.push_back(radius * double(rings - r) / double(rings) *
                       Vec3(std::cos(angle), std::sin(angle), 0));
    }
  }
  for (std::size_t k = 0; k < around; ++k) {
    const std::size_t inner = (rings - 1) * around;
    sheet.triangles.push_back({inner + k, inner + (k + 1) % around, points.size()});
  }
  points.push_back(Vec3::Zero());
  sheet.points = points.size();
  return plate(sheet, points, height, 1);
}

/// Tetrahedron and opposite corner of every boundary face all of whose vertices are `inside`.
inline std::vector<std::pair<TetId, int>> boundary_faces(
    const Body& body, const std::function<bool(const Vec3&)>& inside) {
  std::map<std::array<std::uint32_t, 3>, int> uses;
  const auto key = [&](std::size_t t, int place) {
    std::array<std::uint32_t, 3> k;
    for (int i = 1; i < 4; ++i) {
      k[std::size_t(i - 1)] = body.corners[t][std::size_t((place + i) % 4)].value;
    }
    std::sort(k.begin(), k.end());
    return k;
  };
  for (std::size_t t = 0; t < body.corners.size(); ++t) {
    for (int place = 0; place < 4; ++place) ++uses[key(t, place)];
  }
  std::vector<std::pair<TetId, int>> faces;
  for (std::size_t t = 0; t < body.corners.size(); ++t) {
    for (int place = 0; place < 4; ++place) {
      const auto face = key(t, place);
      bool all = uses[face] == 1;
      for (std::uint32_t v : face) all = all && inside(body.rest[v]);
      if (all) faces.emplace_back(TetId{t}, place);
    }
  }
  return faces;
}

/// Pressure (Pa) on those faces, as forces on vertices.
inline void press(std::vector<Vec3>& force, const Body& body, const MechanicsState& state,
                  double pressure, const std::function<bool(const Vec3&)>& inside) {
  std::vector<CornerLoad> loads;
  for (const auto& [t, place] : boundary_faces(body, inside)) {
    for (const CornerLoad& load : face_pressure(state.elements, t, place, pressure)) {
      loads.push_back(load);
    }
  }
  add_corner_loads(force, loads, state, body.corners, 0);
}

/// Equilibrium of a free body under loads in balance with themselves and its spin: large steps
/// without numerical memory (rho_inf = 0) come to it by themselves. `h` (s) >> its periods.
inline void settle(MechanicsState& state, const Body& body, double h, const Loads& loads = {},
                   int steps = 12) {
  const StepStatus status = test::run(state, body, {.time_step = h, .rho_infinity = 0}, steps, loads);
  if (status.outcome != StepOutcome::fine) throw std::runtime_error(to_finding(status).text);
}

inline std::vector<Mat3> node_stress(const MechanicsState& state, const Body& body) {
  std::vector<Mat3> stress;
  average_node_stress(stress, {body.corners, state.elements.stress, state.elements.rest_volume},
                      body.rest.size());
  return stress;
}

/// t^T sigma t.
inline double along(const Mat3& sigma, const Vec3& t) { return t.dot(sigma * t); }

}  // namespace sunder::accuracy
