// SPDX-License-Identifier: MIT
// Edges, points, shells, and triangles that meet.
#include "mechanics/contact/shapes/solid_surface_check.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "topology/base/elementary.hpp"
#include "topology/base/sort_unique.hpp"
#include "topology/base/union_find.hpp"

namespace sunder {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;
using Triangle = std::array<Vec3, 3>;

Finding finding(const char* code, std::vector<std::int64_t> ids, std::string text,
                std::string remedy) {
  Finding f;
  f.code = code;
  f.count = ids.size();
  ids.resize(std::min(ids.size(), Finding::max_ids));
  f.ids = std::move(ids);
  f.text = std::move(text);
  f.remedy = std::move(remedy);
  return f;
}

/// "triangle 3" or "12 triangles, the first is 3".
std::string these(const std::vector<std::int64_t>& ids, const std::string& what) {
  if (ids.size() == 1) return what + " " + std::to_string(ids[0]);
  return std::to_string(ids.size()) + " " + what + "s, the first is " + std::to_string(ids[0]);
}

/// Rows, coordinates and areas.
std::vector<Finding> check_rows(const TriangleSurface& s) {
  if (s.triangles.empty()) {
    return {finding("empty_surface", {}, "there is no triangle",
                    "give a surface of triangles; faces of more corners are not read")};
  }
  if (s.triangles.size() > most_obstacle_triangles) {
    return {finding("too_many_triangles", {},
                    "there are " + std::to_string(s.triangles.size()) + " triangles; allowed are " +
                        std::to_string(most_obstacle_triangles),
                    "make the surface coarser: an obstacle need not be finer than what meets it")};
  }
  std::vector<std::int64_t> bad, flat;
  for (std::size_t p = 0; p < s.points.size(); ++p) {
    if (!s.points[p].allFinite()) bad.push_back(static_cast<std::int64_t>(p));
  }
  if (!bad.empty()) {
    return {finding("nan_coordinate", bad,
                    these(bad, "point") + " with a coordinate that is no number",
                    "write the surface again with finite coordinates")};
  }
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    const auto& c = s.triangles[t];
    const auto id = static_cast<std::int64_t>(t);
    if (std::ranges::any_of(c, [&](std::uint32_t p) { return p >= s.points.size(); })) {
      return {finding("index_out_of_range", {id},
                      "triangle " + std::to_string(t) + " names a point that is not there",
                      "correct its corners")};
    }
    const Vec3 a = s.points[c[1]] - s.points[c[0]], b = s.points[c[2]] - s.points[c[0]];
    const double size = std::max({a.squaredNorm(), b.squaredNorm(), (a - b).squaredNorm()});
    if (!(a.cross(b).norm() > 1e-12 * size)) flat.push_back(id);
  }
  if (flat.empty()) return {};
  return {finding("flat_triangle", flat, these(flat, "triangle") + " without an area",
                  "take such triangles out and close the surface without them")};
}

/// Every edge once in each direction.
std::vector<Finding> check_edges(const TriangleSurface& s) {
  std::map<Edge, std::vector<std::int64_t>> along;
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      along[{s.triangles[t][k], s.triangles[t][(k + 1) % 3]}].push_back(
          static_cast<std::int64_t>(t));
    }
  }
  std::vector<std::int64_t> open, many, turned;
  for (const auto& [edge, triangles] : along) {
    const auto back = along.find({edge.second, edge.first});
    const std::size_t all = triangles.size() + (back == along.end() ? 0 : back->second.size());
    if (all == 1) open.push_back(triangles[0]);
    if (all > 2) many.push_back(triangles[0]);
    if (all == 2 && triangles.size() == 2) turned.push_back(triangles[1]);
  }
  for (std::vector<std::int64_t>* ids : {&open, &many, &turned}) sort_unique(*ids);
  std::vector<Finding> found;
  if (!open.empty()) {
    found.push_back(finding("open_surface", open,
                            these(open, "triangle") + " with an edge where the surface is open",
                            "close the surface: every edge needs two triangles"));
  }
  if (!many.empty()) {
    found.push_back(
        finding("non_manifold_surface", many,
                these(many, "triangle") + " with an edge that has more than two",
                "part the surface there, or give each solid as an obstacle of its own"));
  }
  if (!turned.empty()) {
    found.push_back(
        finding("wrong_orientation", turned,
                these(turned, "triangle") + " that faces the other way than its neighbour",
                "turn triangles so that all are counter-clockwise from outside"));
  }
  return found;
}

/// Points where the triangles are more than one fan.
std::vector<Finding> check_points(const TriangleSurface& s) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> leaves;  // (point, from) -> to
  std::vector<std::uint32_t> degree(s.points.size(), 0), start(s.points.size(), 0);
  for (const auto& t : s.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      leaves[{t[k], t[(k + 1) % 3]}] = t[(k + 2) % 3];
      ++degree[t[k]];
      start[t[k]] = t[(k + 1) % 3];
    }
  }
  std::vector<std::int64_t> pinched;
  for (std::uint32_t p = 0; p < s.points.size(); ++p) {
    std::uint32_t steps = 0, at = start[p];
    if (degree[p] == 0) continue;
    do {
      at = leaves.at({p, at});
      ++steps;
    } while (at != start[p] && steps <= degree[p]);
    if (steps != degree[p]) pinched.push_back(p);
  }
  if (pinched.empty()) return {};
  return {finding(
      "non_manifold_surface", pinched,
      these(pinched, "point") + " where parts of the surface hang together by that point alone",
      "part the surface there, or give each solid as an obstacle of its own")};
}

/// Full turns that triangles make around a point [Van Oosterom and Strackee 1983].
double winding(const SolidSurface& s, UnionFind& shells, std::uint32_t without, const Vec3& x) {
  double sum = 0;
  for (const auto& t : s.triangles) {
    if (shells.root(t[0]) == without) continue;
    const Vec3 a = s.points[t[0]] - x, b = s.points[t[1]] - x, c = s.points[t[2]] - x;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2 * direction_angle(a.dot(b.cross(c)),
                               la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (4 * M_PI);
}

/// A shell stands by itself or bounds a hole of another.
std::vector<Finding> check_shells(const SolidSurface& s) {
  UnionFind shells(s.points.size());
  for (const auto& t : s.triangles) {
    shells.join(t[0], t[1]);
    shells.join(t[0], t[2]);
  }
  std::map<std::uint32_t, double> volume;
  std::map<std::uint32_t, std::int64_t> first;
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    const auto& c = s.triangles[t];
    const Vec3 a = s.points[c[0]] - s.centre, b = s.points[c[1]] - s.centre;
    volume[shells.root(c[0])] += a.cross(b).dot(s.points[c[2]] - s.centre);
    first.try_emplace(shells.root(c[0]), static_cast<std::int64_t>(t));
  }
  if (volume.size() == 1) return {};
  for (const auto& [root, six] : volume) {
    const double around = winding(s, shells, root, s.points[root]);
    if (std::lround(around) == (six > 0 ? 0 : 1)) continue;
    return {finding("wrong_orientation", {first[root]},
                    "the part of the surface with triangle " + std::to_string(first[root]) +
                        " is turned inside out against the rest",
                    "turn its triangles; of holes the surface faces into the hole")};
  }
  return {};
}

double six_volumes(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return (b - a).cross(c - a).dot(d - a);
}

/// Whether the segment from p to q goes from one side of a triangle to the other through it.
bool goes_through(const Vec3& p, const Vec3& q, const Triangle& t) {
  double size = (q - p).squaredNorm();
  for (const Vec3& x : t) size = std::max(size, (x - p).squaredNorm());
  const double rounding = 1e-12 * size * std::sqrt(size);
  const double above = six_volumes(t[0], t[1], t[2], p), below = six_volumes(t[0], t[1], t[2], q);
  if (!(above > rounding && below < -rounding) && !(above < -rounding && below > rounding)) {
    return false;
  }
  const double a = six_volumes(p, q, t[0], t[1]), b = six_volumes(p, q, t[1], t[2]),
               c = six_volumes(p, q, t[2], t[0]);
  // Through an edge of the triangle too: its neighbour would not see it either.
  return (a > -rounding && b > -rounding && c > -rounding) ||
         (a < rounding && b < rounding && c < rounding);
}

/// Whether an edge of one triangle that the other has no corner of goes through that other.
bool cross(const SolidSurface& s, std::size_t one, std::size_t other) {
  const auto &a = s.triangles[one], &b = s.triangles[other];
  const auto is_of = [](const auto& t, std::uint32_t p) {
    return std::ranges::find(t, p) != t.end();
  };
  const auto pierces = [&](const auto& from, const auto& to) {
    const Triangle t = {s.points[to[0]], s.points[to[1]], s.points[to[2]]};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t p = from[k], q = from[(k + 1) % 3];
      if (is_of(to, p) || is_of(to, q)) continue;
      if (goes_through(s.points[p], s.points[q], t)) return true;
    }
    return false;
  };
  return pierces(a, b) || pierces(b, a);
}

}  // namespace

std::vector<Finding> check_triangles(const TriangleSurface& surface) {
  std::vector<Finding> found = check_rows(surface);
  if (found.empty()) found = check_edges(surface);
  if (found.empty()) found = check_points(surface);
  return found;
}

std::vector<Finding> check_solid(const SolidSurface& s) {
  if (!(s.volume > 1e-12 * s.radius * s.radius * s.radius)) {
    return {finding("no_volume", {}, "the surface has no volume",
                    "give a surface that bounds a solid")};
  }
  const auto [a, b] = meeting_triangles(s);
  if (a == b) return check_shells(s);
  return {finding(
      "self_intersection", {static_cast<std::int64_t>(a), static_cast<std::int64_t>(b)},
      "triangles " + std::to_string(a) + " and " + std::to_string(b) + " go through each other",
      "mend the surface so that it does not meet itself")};
}

std::array<std::size_t, 2> meeting_triangles(const SolidSurface& s) {
  std::vector<std::uint32_t> open;
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    Vec3 low = s.points[s.triangles[t][0]], high = low;
    for (const std::uint32_t p : s.triangles[t]) {
      low = low.cwiseMin(s.points[p]);
      high = high.cwiseMax(s.points[p]);
    }
    open.assign(1, 0);
    while (!open.empty()) {
      const SolidSurface::Node& node = s.tree[open.back()];
      open.pop_back();
      const bool apart =
          (node.low.array() > high.array()).any() || (node.high.array() < low.array()).any();
      if (apart) continue;
      if (node.count == 0) {
        open.push_back(node.first);
        open.push_back(node.first + 1);
        continue;
      }
      for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
        if (s.order[k] > t && cross(s, t, s.order[k])) return {t, s.order[k]};
      }
    }
  }
  return {s.triangles.size(), s.triangles.size()};
}

}  // namespace sunder
