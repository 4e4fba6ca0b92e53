// SPDX-License-Identifier: MIT
// A walk over edges, then shell by shell.
#include "topology/mesh/surface/repair/facing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "topology/base/point_math.hpp"
#include "topology/base/union_find.hpp"
#include "topology/mesh/box_tree.hpp"
#include "topology/mesh/surface/enclosure.hpp"

namespace sunder {
namespace {

using detail::cross, detail::difference, detail::dot;
using Row = std::uint32_t;

/// Neighbours of a triangle over edges of two, and whether they run alike along it.
struct Neighbour {
  Row triangle;
  bool is_alike;
};

std::vector<std::vector<Neighbour>> neighbours_of(const std::vector<Triangle>& triangles) {
  std::vector<std::vector<Neighbour>> neighbours(triangles.size());
  for_each_edge(sides_of(triangles), [&](std::span<const FaceSide> edge) {
    if (edge.size() != 2) return;
    const bool is_alike = edge[0].is_forward == edge[1].is_forward;
    neighbours[edge[0].face].push_back({edge[1].face, is_alike});
    neighbours[edge[1].face].push_back({edge[0].face, is_alike});
  });
  return neighbours;
}

/// Triangles that run against the first of their patch, turned where they are the fewer.
std::size_t make_consistent(std::vector<Triangle>& triangles) {
  const auto neighbours = neighbours_of(triangles);
  std::vector<signed char> turn(triangles.size(), -1);
  std::size_t turned = 0;
  for (Row first = 0; first < triangles.size(); ++first) {
    if (turn[first] >= 0) continue;
    std::vector<Row> patch = {first};
    turn[first] = 0;
    std::size_t count = 0;
    for (std::size_t k = 0; k < patch.size(); ++k) {
      for (const auto& [next, is_alike] : neighbours[patch[k]]) {
        if (turn[next] >= 0) continue;
        turn[next] = static_cast<signed char>((turn[patch[k]] == 1) != is_alike);
        count += turn[next] == 1;
        patch.push_back(next);
      }
    }
    const signed char fewer = 2 * count <= patch.size() ? 1 : 0;
    for (const Row t : patch) {
      if (turn[t] != fewer) continue;
      std::swap(triangles[t][1], triangles[t][2]);
      ++turned;
    }
  }
  return turned;
}

struct Shell {
  std::vector<Row> rows;
  BoundingBox box;
  double volume = 0;
  bool is_closed = true;
};

Shell shell_of(const std::vector<Point>& x, const std::vector<Triangle>& triangles,
               std::vector<Row> rows) {
  Shell shell{std::move(rows), {}, 0, true};
  std::vector<Triangle> own;
  for (const Row t : shell.rows) own.push_back(triangles[t]);
  shell.volume = enclosed_volume(x, own);
  shell.is_closed = count_edges(own).open == 0;
  shell.box = box_around(x, own[0]);
  for (const Triangle& t : own) {
    for (const Row corner : t) extend(shell.box, x[corner]);
  }
  return shell;
}

std::vector<Shell> shells(const std::vector<Point>& x, const std::vector<Triangle>& triangles) {
  const std::vector<Row> root = shells_of(triangles);
  std::vector<std::vector<Row>> rows(triangles.size());
  for (Row t = 0; t < triangles.size(); ++t) rows[root[t]].push_back(t);
  std::vector<Shell> all;
  for (std::vector<Row>& own : rows) {
    if (!own.empty()) all.push_back(shell_of(x, triangles, std::move(own)));
  }
  return all;
}

/// The largest closed shell around a shell, or itself: that looks outward, and all inside with it.
const Shell& outermost(const std::vector<Point>& x, const std::vector<Triangle>& triangles,
                       const std::vector<Shell>& all, const Shell& shell) {
  const Shell* outer = &shell;
  const Point& p = x[triangles[shell.rows[0]][0]];
  for (const Shell& other : all) {
    const bool is_larger = std::abs(other.volume) > std::abs(outer->volume);
    if (!other.is_closed || !is_larger || !contains(other.box, p)) continue;
    std::vector<Triangle> own;
    for (const Row t : other.rows) own.push_back(triangles[t]);
    if (Enclosure(x, std::move(own)).holds(p)) outer = &other;
  }
  return *outer;
}

}  // namespace

double enclosed_volume(const std::vector<Point>& points, const std::vector<Triangle>& triangles) {
  double sum = 0;
  if (triangles.empty()) return 0;
  const Point origin = points[triangles[0][0]];
  for (const Triangle& t : triangles) {
    const Point a = difference(points[t[0]], origin), b = difference(points[t[1]], origin),
                c = difference(points[t[2]], origin);
    sum += dot(a, cross(b, c)) / 6;
  }
  return sum;
}

std::vector<std::uint32_t> shells_of(const std::vector<Triangle>& triangles) {
  UnionFind parts(triangles.size());
  for_each_edge(sides_of(triangles), [&](std::span<const FaceSide> edge) {
    for (const FaceSide& side : edge) parts.join(edge[0].face, side.face);
  });
  return std::move(parts).roots();
}

std::size_t face_outward(const std::vector<Point>& points, std::vector<Triangle>& triangles) {
  std::size_t turned = make_consistent(triangles);
  const std::vector<Shell> all = shells(points, triangles);
  for (const Shell& shell : all) {
    if (!shell.is_closed || outermost(points, triangles, all, shell).volume >= 0) continue;
    for (const Row t : shell.rows) std::swap(triangles[t][1], triangles[t][2]);
    turned += shell.rows.size();
  }
  return turned;
}

}  // namespace sunder
