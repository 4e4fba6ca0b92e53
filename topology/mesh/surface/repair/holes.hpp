// SPDX-License-Identifier: MIT
// Holes of a surface: their rims, and triangles that close them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "topology/base/tet_mesh.hpp"
#include "topology/mesh/surface/edges.hpp"

namespace sunder {

/// A closed way along open edges; each point once. The surface runs the other way along it.
using Rim = std::vector<std::uint32_t>;

/// The rims of an oriented surface. Where open edges lead to no closed way, they are in none.
/// O(n log n).
std::vector<Rim> rims_of(const std::vector<Triangle>& triangles);

/// The largest side of the box around a rim, in the unit of the points.
double width_of(const std::vector<Point>& points, const Rim& rim);

/// The mean of a rim's points.
Point middle_of(const std::vector<Point>& points, const Rim& rim);

/// Triangles of least area between the points of a rim, which close it without a new point. No edge
/// of the surface is used twice. None where there are no such triangles, or the rim has more points
/// than `longest_rim`. O(n^3).
std::vector<Triangle> cover_of(const std::vector<Point>& points,
                               const std::vector<Triangle>& triangles, const Rim& rim);
inline constexpr std::size_t longest_rim = 400;

}  // namespace sunder
