// SPDX-License-Identifier: MIT
// Shapes of tetrahedra: dihedral angles, radius ratio, volumes, edges.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "topology/base/elementary.hpp"
#include "topology/base/point_math.hpp"
#include "topology/kernel/kernel.hpp"
#include "topology/mesh/radius_ratio.hpp"
#include "topology/mesh/survey.hpp"

namespace sunder {
namespace {

using detail::cross, detail::difference, detail::dot, detail::length;

constexpr std::array<std::array<int, 2>, 6> edge_ends = {
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// One tetrahedron, divided by `unit`: a power of two near its longest edge, so that no product of
/// its lengths overflows or vanishes.
struct Shape {
  double unit = 1;
  std::array<double, 6> edge = {};   // as edge_ends
  std::array<Point, 4> normal = {};  // twice the area, out of or into the tetrahedron alike
  std::array<double, 4> area = {};   // twice
  double volume = 0;                 // six times, without sign
};

Shape shape_of(const std::array<Point, 4>& corners) {
  Shape s;
  std::array<Point, 4> x;
  double widest = 0;
  for (int i = 0; i < 4; ++i) {
    x[i] = difference(corners[i], corners[0]);
    for (const double v : x[i]) widest = std::max(widest, std::abs(v));
  }
  int exponent = 0;
  std::frexp(widest, &exponent);
  s.unit = std::ldexp(1.0, exponent);
  const double inverse = std::ldexp(1.0, -exponent);
  for (Point& p : x) {
    for (double& v : p) v *= inverse;
  }
  for (int k = 0; k < 6; ++k) {
    const Point e = difference(x[edge_ends[k][1]], x[edge_ends[k][0]]);
    s.edge[k] = length(e);
  }
  for (int p = 0; p < 4; ++p) {
    const auto& c = dart_order::face_corners[p];
    s.normal[p] = cross(difference(x[c[1]], x[c[0]]), difference(x[c[2]], x[c[0]]));
    s.area[p] = length(s.normal[p]);
  }
  s.volume = std::abs(dot(s.normal[0], difference(x[0], x[1])));
  return s;
}

std::array<Point, 4> corners_of(const TetMesh& mesh, std::uint32_t t) {
  std::array<Point, 4> x;
  for (int i = 0; i < 4; ++i) x[i] = mesh.points[mesh.tetrahedra[t][i]];
  return x;
}

/// 3 r / R: with r = 3 V / S and R = sqrt(q) / (24 V), where S is the surface and q the product
/// below of sums of the products of opposite edges (Crelle's formula).
double radius_ratio(const Shape& s) {
  const double surface = (s.area[0] + s.area[1] + s.area[2] + s.area[3]) / 2;
  const double a = s.edge[0] * s.edge[5], b = s.edge[1] * s.edge[4], c = s.edge[2] * s.edge[3];
  const double q = (a + b + c) * (a + b - c) * (a - b + c) * (b + c - a);
  const double volume = s.volume / 6;
  const double ratio = 216 * volume * volume / (surface * std::sqrt(std::max(q, 0.0)));
  // A face or an edge without extent leaves 0 / 0.
  return std::isfinite(ratio) ? std::min(ratio, 1.0) : 0;
}

/// Cosine of the angle between faces i and j, seen from inside; none where one has no area.
std::optional<double> cosine(const Shape& s, int i, int j) {
  const double areas = s.area[i] * s.area[j];
  if (!(areas > 0)) return std::nullopt;
  return -dot(s.normal[i], s.normal[j]) / areas;
}

/// The angle itself, degrees; near 0 and 180 as good as in the middle.
double angle(const Shape& s, int i, int j) {
  const Point c = cross(s.normal[i], s.normal[j]);
  return direction_angle(length(c), -dot(s.normal[i], s.normal[j])) * 180 / std::numbers::pi;
}

using Extreme = Quality::Extreme;

void lower(Extreme& e, double value, std::uint32_t t) {
  if (value < e.value) e = {value, t};
}
void raise(Extreme& e, double value, std::uint32_t t) {
  if (value > e.value) e = {value, t};
}

/// The extreme cosines met so far, and where.
struct Angles {
  double cosine;
  std::uint32_t tetrahedron = 0;
  int i = 0, j = 0;
};

void measure_angles(const Shape& s, std::uint32_t t, Angles& smallest, Angles& largest) {
  for (const auto& [i, j] : edge_ends) {
    const std::optional<double> c = cosine(s, i, j);
    if (!c) continue;
    if (*c > smallest.cosine) smallest = {*c, t, i, j};
    if (*c < largest.cosine) largest = {*c, t, i, j};
  }
}

}  // namespace

double radius_ratio(const std::array<Point, 4>& corners) { return radius_ratio(shape_of(corners)); }

std::optional<Quality> quality_of(const Survey& survey) {
  constexpr double none = std::numeric_limits<double>::infinity();
  Quality q;
  q.smallest_radius_ratio = q.smallest_volume = q.shortest_edge = {none, 0};
  q.largest_volume = q.longest_edge = {-1, 0};
  Angles smallest{-2}, largest{2};
  std::size_t measured = 0;
  const TetMesh& mesh = survey.mesh;
  for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    if (!survey.usable[t]) continue;
    const Shape s = shape_of(corners_of(mesh, t));
    if (!std::isfinite(s.unit) || !std::isfinite(s.volume)) continue;
    ++measured;
    const double ratio = radius_ratio(s);
    q.mean_radius_ratio += ratio;
    lower(q.smallest_radius_ratio, ratio, t);
    const double volume = s.volume / 6 * s.unit * s.unit * s.unit;
    lower(q.smallest_volume, volume, t);
    raise(q.largest_volume, volume, t);
    const auto [shortest, longest] = std::minmax_element(s.edge.begin(), s.edge.end());
    lower(q.shortest_edge, *shortest * s.unit, t);
    raise(q.longest_edge, *longest * s.unit, t);
    measure_angles(s, t, smallest, largest);
  }
  if (measured == 0) return std::nullopt;
  q.mean_radius_ratio /= static_cast<double>(measured);
  const auto angle_at = [&](const Angles& a) {
    const Shape s = shape_of(corners_of(mesh, a.tetrahedron));
    return Extreme{angle(s, a.i, a.j), a.tetrahedron};
  };
  // No face with an area at all: every angle is one of a flat tetrahedron.
  const bool has_angle = smallest.i != smallest.j;
  q.smallest_dihedral = has_angle ? angle_at(smallest) : Extreme{0, 0};
  q.largest_dihedral = has_angle ? angle_at(largest) : Extreme{180, 0};
  return q;
}

}  // namespace sunder
