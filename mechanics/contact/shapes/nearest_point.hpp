// SPDX-License-Identifier: MIT
// The point of a tetrahedron that is nearest to another point, by its weights.
#pragma once

#include <array>

#include "mechanics/state/vec3.hpp"

namespace sunder {

/// Shares of the corners in the point of the tetrahedron that is nearest to `x` (m): in [0, 1] with
/// sum 1, the barycentric coordinates of `x` itself where it lies inside. A flat tetrahedron is its
/// faces; of corners that coincide one has all.
std::array<double, 4> nearest_point(const std::array<Vec3, 4>& corners, const Vec3& x);

/// The same of a triangle.
std::array<double, 3> nearest_on_triangle(const std::array<Vec3, 3>& corners, const Vec3& x);

/// Shares of the corners in `x` (m), of any size and sign with sum 1; not numbers in a flat
/// tetrahedron.
std::array<double, 4> barycentric(const std::array<Vec3, 4>& corners, const Vec3& x);

/// Shares of the corners in `x` (m) itself, of any size and sign with sum 1: it moves with a rigid
/// tetrahedron as a point fast to it. One that is flat to rounding gives its nearest point.
std::array<double, 4> affine_weights(const std::array<Vec3, 4>& corners, const Vec3& x);

}  // namespace sunder
