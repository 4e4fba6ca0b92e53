// SPDX-License-Identifier: MIT
// Measures and normals of closed surfaces, the tree of their triangles, and distances to them.
#include "mechanics/contact/shapes/solid_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "mechanics/contact/shapes/nearest_point.hpp"
#include "mechanics/contact/shapes/solid_surface_check.hpp"
#include "topology/base/elementary.hpp"

namespace sunder {
namespace {

constexpr double far_off = std::numeric_limits<double>::infinity();

std::array<Vec3, 3> corners_of(const SolidSurface& s, std::size_t t) {
  const auto& c = s.triangles[t];
  return {s.points[c[0]], s.points[c[1]], s.points[c[2]]};
}

/// Volume, its centre and its inertia, by tetrahedra from the mean of the points.
void measure(SolidSurface& s) {
  Vec3 from = Vec3::Zero();
  for (const Vec3& p : s.points) from += p;
  from /= static_cast<double>(s.points.size());
  s.volume = 0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    auto x = corners_of(s, t);
    for (Vec3& p : x) p -= from;
    const double six = x[0].cross(x[1]).dot(x[2]);
    const Vec3 sum = x[0] + x[1] + x[2];
    s.volume += six / 6;
    first += six / 24 * sum;
    second += six / 120 *
              (sum * sum.transpose() + x[0] * x[0].transpose() + x[1] * x[1].transpose() +
               x[2] * x[2].transpose());
  }
  const Vec3 arm = first / s.volume;
  s.centre = from + arm;
  second -= s.volume * arm * arm.transpose();
  s.inertia = -second;
  s.inertia.diagonal().array() += second.trace();
  s.radius = 0;
  for (const Vec3& p : s.points) s.radius = std::max(s.radius, (p - s.centre).norm());
}

void find_normals(SolidSurface& s) {
  s.face_normal.clear();
  s.point_normal.assign(s.points.size(), Vec3::Zero());
  s.edge_normal.assign(s.triangles.size(), {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()});
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> triangle_of;
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    const auto x = corners_of(s, t);
    const Vec3 normal = (x[1] - x[0]).cross(x[2] - x[0]).normalized();
    s.face_normal.push_back(normal);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 a = x[(k + 1) % 3] - x[k], b = x[(k + 2) % 3] - x[k];
      s.point_normal[s.triangles[t][k]] += direction_angle(a.cross(b).norm(), a.dot(b)) * normal;
      triangle_of[{s.triangles[t][k], s.triangles[t][(k + 1) % 3]}] = t;
    }
  }
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = s.triangles[t][k], to = s.triangles[t][(k + 1) % 3];
      s.edge_normal[t][k] = s.face_normal[t] + s.face_normal[triangle_of.at({to, from})];
    }
  }
}

/// Edges are there in both directions: each gives its end to the ring of its start.
void find_rings(SolidSurface& s) {
  s.ring_first.assign(s.points.size() + 1, 0);
  for (const auto& t : s.triangles) {
    for (const std::uint32_t p : t) ++s.ring_first[p + 1];
  }
  std::partial_sum(s.ring_first.begin(), s.ring_first.end(), s.ring_first.begin());
  s.ring.resize(s.ring_first.back());
  std::vector<std::uint32_t> next(s.ring_first.begin(), s.ring_first.end() - 1);
  for (const auto& t : s.triangles) {
    for (std::size_t k = 0; k < 3; ++k) s.ring[next[t[k]]++] = t[(k + 1) % 3];
  }
}

void find_sharp_edges(SolidSurface& s) {
  struct Side {
    std::array<std::uint32_t, 2> end;
    std::uint32_t beside, triangle;
  };
  std::vector<Side> sides;
  for (std::uint32_t t = 0; t < s.triangles.size(); ++t) {
    const auto& corner = s.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(corner[k], corner[(k + 1) % 3]);
      sides.push_back({{low, high}, corner[(k + 2) % 3], t});
    }
  }
  std::ranges::sort(sides, {}, [](const Side& a) { return std::pair(a.end, a.triangle); });
  constexpr double flat = 0.02;
  for (std::size_t k = 0; k + 1 < sides.size(); k += 2) {
    const Side &a = sides[k], &b = sides[k + 1];
    const Vec3 beside = s.points[b.beside] - s.points[a.end[0]];
    if (s.face_normal[a.triangle].dot(beside) >= -flat * beside.norm()) continue;
    s.sharp_edges.push_back({a.end, {a.beside, b.beside}});
  }
}

/// Fills node `at` with the triangles [first, end) of the order.
void build_node(SolidSurface& s, std::size_t at, std::uint32_t first, std::uint32_t end) {
  constexpr std::uint32_t few = 4;
  Vec3 low = Vec3::Constant(far_off), high = -low, low_middle = low, high_middle = high;
  const auto middle_of = [&](std::uint32_t t) -> Vec3 {
    const auto x = corners_of(s, t);
    return (x[0] + x[1] + x[2]) / 3;
  };
  for (std::uint32_t k = first; k < end; ++k) {
    for (const Vec3& x : corners_of(s, s.order[k])) {
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
    }
    low_middle = low_middle.cwiseMin(middle_of(s.order[k]));
    high_middle = high_middle.cwiseMax(middle_of(s.order[k]));
  }
  s.tree[at] = {low, high, first, end - first};
  if (end - first <= few) return;
  Eigen::Index axis = 0;
  (high_middle - low_middle).maxCoeff(&axis);
  const std::uint32_t half = first + (end - first) / 2;
  std::nth_element(s.order.begin() + first, s.order.begin() + half, s.order.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) {
                     return std::pair(middle_of(a)[axis], a) < std::pair(middle_of(b)[axis], b);
                   });
  const std::size_t child = s.tree.size();
  s.tree.resize(child + 2);
  s.tree[at].first = static_cast<std::uint32_t>(child);
  s.tree[at].count = 0;
  build_node(s, child, first, half);
  build_node(s, child + 1, half, end);
}

double distance_to_box(const SolidSurface::Node& node, const Vec3& x) {
  return (node.low - x).cwiseMax(x - node.high).cwiseMax(0.0).squaredNorm();
}

/// The nearest point, the triangle it is of, and its shares of that one's corners.
struct NearestFace {
  double squared = far_off;
  std::size_t triangle = 0;
  std::array<double, 3> share{};
  Vec3 place = Vec3::Zero();
};

NearestFace nearest_of(const SolidSurface& s, const Vec3& point) {
  NearestFace best;
  std::array<std::uint32_t, 64> open;  // a level of the tree leaves one behind
  std::size_t count = 0;
  open[count++] = 0;
  while (count > 0) {
    const SolidSurface::Node& node = s.tree[open[--count]];
    if (!(distance_to_box(node, point) < best.squared)) continue;
    if (node.count == 0) {
      const bool is_first = distance_to_box(s.tree[node.first], point) <=
                            distance_to_box(s.tree[node.first + 1], point);
      open[count++] = is_first ? node.first + 1 : node.first;
      open[count++] = is_first ? node.first : node.first + 1;
      continue;
    }
    for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
      const auto x = corners_of(s, s.order[k]);
      const std::array<double, 3> share = nearest_on_triangle(x, point);
      const Vec3 place = share[0] * x[0] + share[1] * x[1] + share[2] * x[2];
      const double squared = (point - place).squaredNorm();
      const bool nearer =
          squared < best.squared || (squared == best.squared && s.order[k] < best.triangle);
      if (nearer) best = {squared, s.order[k], share, place};
    }
  }
  return best;
}

/// Of the face, edge or point that the shares name.
Vec3 pseudonormal(const SolidSurface& s, const NearestFace& nearest) {
  constexpr double none = 1e-12;
  int zeros = 0;
  std::size_t zero = 0, other = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (nearest.share[k] > none) {
      other = k;
      continue;
    }
    ++zeros;
    zero = k;
  }
  if (zeros == 0) return s.face_normal[nearest.triangle];
  if (zeros == 1) return s.edge_normal[nearest.triangle][(zero + 1) % 3];
  return s.point_normal[s.triangles[nearest.triangle][other]];
}

}  // namespace

Result<SolidSurface> make_solid_surface(TriangleSurface triangles, std::string file) {
  Result<SolidSurface> result;
  result.findings = check_triangles(triangles);
  if (has_error(result.findings)) return result;
  SolidSurface s;
  s.file = std::move(file);
  s.points = std::move(triangles.points);
  s.triangles = std::move(triangles.triangles);
  measure(s);
  if (s.volume < 0) {
    for (auto& t : s.triangles) std::swap(t[1], t[2]);
    measure(s);
  }
  find_normals(s);
  find_rings(s);
  s.order.resize(s.triangles.size());
  std::iota(s.order.begin(), s.order.end(), 0u);
  s.tree.resize(1);
  build_node(s, 0, 0, static_cast<std::uint32_t>(s.order.size()));
  result.findings = check_solid(s);
  if (!has_error(result.findings)) find_sharp_edges(s);
  if (!has_error(result.findings)) result.value = std::move(s);
  return result;
}

std::vector<std::uint32_t> triangles_near(const SolidSurface& s, const Vec3& point,
                                          double distance) {
  std::vector<std::uint32_t> found, open = {0};
  while (!open.empty()) {
    const SolidSurface::Node& node = s.tree[open.back()];
    open.pop_back();
    if (distance_to_box(node, point) > distance * distance) continue;
    if (node.count == 0) {
      open.push_back(node.first);
      open.push_back(node.first + 1);
      continue;
    }
    for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
      const auto x = corners_of(s, s.order[k]);
      const std::array<double, 3> share = nearest_on_triangle(x, point);
      const Vec3 place = share[0] * x[0] + share[1] * x[1] + share[2] * x[2];
      if ((point - place).squaredNorm() <= distance * distance) found.push_back(s.order[k]);
    }
  }
  std::ranges::sort(found);
  return found;
}

SurfacePoint distance_to_surface(const SolidSurface& s, const Vec3& point) {
  const NearestFace nearest = nearest_of(s, point);
  const Vec3 arm = point - nearest.place;
  const Vec3 outward = pseudonormal(s, nearest);
  const double distance = std::sqrt(nearest.squared);
  const bool is_inside = arm.dot(outward) < 0;
  // On the surface the direction to it is rounding.
  const double rounding = 1e-12 * s.radius;
  const Vec3 normal = distance > rounding ? Vec3(is_inside ? -arm : arm) : outward;
  return {is_inside ? -distance : distance, normal.normalized()};
}

}  // namespace sunder
