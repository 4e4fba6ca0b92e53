// SPDX-License-Identifier: MIT
// Meshes of bodies with closed forms: shells, rings, discs, plates.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "tests/support/bodies.hpp"

namespace sunder::accuracy {

using std::numbers::pi;
using test::Body;

/// A triangulated sheet; its points are given layer by layer when it is extruded.
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
      for (Corners c : {Corners{low(0), low(1), low(2), top(2)},
                        {low(0), low(1), top(1), top(2)},
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

}  // namespace sunder::accuracy
