// SPDX-License-Identifier: MIT
// Nearest points on segments, triangles and tetrahedra: inside, if the foot of the point lies
// there, else the nearest point of the boundary.
#include "mechanics/contact/shapes/nearest_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sunder {
namespace {

using Corners4 = std::array<Vec3, 4>;
using Weights = std::array<double, 4>;

Vec3 point_of(const Corners4& corners, const Weights& weights) {
  Vec3 point = Vec3::Zero();
  for (std::size_t i = 0; i < 4; ++i) point += weights[i] * corners[i];
  return point;
}

/// The nearest of the points tried so far.
struct NearestCorners {
  const Corners4& corners;
  const Vec3& x;
  Weights weights = {1, 0, 0, 0};
  double squared = std::numeric_limits<double>::infinity();

  void attempt(const Weights& other) {
    const double distance = (point_of(corners, other) - x).squaredNorm();
    if (distance < squared) {
      squared = distance;
      weights = other;
    }
  }
};

void try_segment(NearestCorners& nearest, std::size_t i, std::size_t j) {
  const Vec3 along = nearest.corners[j] - nearest.corners[i];
  const double length = along.squaredNorm();
  const double share =
      length > 0 ? std::clamp(along.dot(nearest.x - nearest.corners[i]) / length, 0.0, 1.0) : 0.0;
  Weights weights = {0, 0, 0, 0};
  weights[i] = 1 - share;
  weights[j] = share;
  nearest.attempt(weights);
}

/// The foot of the point in the plane of three corners, where it lies between them.
void try_inside_of_triangle(NearestCorners& nearest, std::size_t i, std::size_t j, std::size_t k) {
  const Vec3 a = nearest.corners[j] - nearest.corners[i];
  const Vec3 b = nearest.corners[k] - nearest.corners[i];
  const Vec3 p = nearest.x - nearest.corners[i], normal = a.cross(b);
  const double square = normal.squaredNorm();
  const double v = p.cross(b).dot(normal), w = a.cross(p).dot(normal);
  if (!(square > 0 && v >= 0 && w >= 0 && v + w <= square)) return;
  Weights weights = {0, 0, 0, 0};
  weights[j] = v / square;
  weights[k] = w / square;
  weights[i] = 1 - weights[j] - weights[k];
  nearest.attempt(weights);
}

}  // namespace

std::array<double, 4> barycentric(const std::array<Vec3, 4>& corners, const Vec3& x) {
  const Vec3 a = corners[1] - corners[0], b = corners[2] - corners[0], c = corners[3] - corners[0];
  const Vec3 p = x - corners[0];
  const double volume = a.cross(b).dot(c);
  const double u = p.cross(b).dot(c) / volume, v = a.cross(p).dot(c) / volume,
               w = a.cross(b).dot(p) / volume;
  return {1 - u - v - w, u, v, w};
}

std::array<double, 4> nearest_point(const std::array<Vec3, 4>& corners, const Vec3& x) {
  const Weights inside = barycentric(corners, x);
  // In a flat tetrahedron shares are rounding divided by rounding: they must give the point again.
  const double size = (corners[0] - corners[1]).squaredNorm() +
                      (corners[0] - corners[2]).squaredNorm() +
                      (corners[0] - corners[3]).squaredNorm();
  constexpr double again = 1e-9;
  if (std::ranges::all_of(inside, [](double w) { return w >= 0; }) &&
      (point_of(corners, inside) - x).squaredNorm() <= again * again * size) {
    return inside;
  }
  NearestCorners nearest{corners, x};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      try_segment(nearest, i, j);
      for (std::size_t k = j + 1; k < 4; ++k) try_inside_of_triangle(nearest, i, j, k);
    }
  }
  return nearest.weights;
}

std::array<double, 3> nearest_on_triangle(const std::array<Vec3, 3>& corners, const Vec3& x) {
  const Corners4 four = {corners[0], corners[1], corners[2], corners[2]};
  NearestCorners nearest{four, x};
  for (std::size_t i = 0; i < 3; ++i) try_segment(nearest, i, (i + 1) % 3);
  try_inside_of_triangle(nearest, 0, 1, 2);
  return {nearest.weights[0], nearest.weights[1], nearest.weights[2]};
}

std::array<double, 4> affine_weights(const std::array<Vec3, 4>& corners, const Vec3& x) {
  const Weights weights = barycentric(corners, x);
  constexpr double flat = 1e6;
  const bool usable = std::ranges::all_of(weights, [](double w) { return std::abs(w) < flat; });
  return usable ? weights : nearest_point(corners, x);
}

}  // namespace sunder
