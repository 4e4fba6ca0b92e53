// SPDX-License-Identifier: MIT
// Points by their places along x, and sides by the points in their boxes.
#include "topology/mesh/surface/repair/stitch.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "topology/base/point_math.hpp"
#include "topology/base/union_find.hpp"
#include "topology/mesh/box_tree.hpp"
#include "topology/mesh/surface/crossing.hpp"
#include "topology/mesh/surface/repair/walls.hpp"

namespace sunder {
namespace {

using detail::difference, detail::distance, detail::dot, detail::length;
using Row = std::uint32_t;

/// Shares of the diagonal, one after the other.
constexpr double shares[] = {0, 1e-7, 1e-6, 1e-5, 1e-4};

double diagonal(const std::vector<Point>& points, const std::vector<Triangle>& triangles) {
  if (triangles.empty()) return 0;
  BoundingBox box = box_around(points, triangles[0]);
  for (const Triangle& t : triangles) {
    for (const Row corner : t) extend(box, points[corner]);
  }
  return distance(box.low, box.high);
}

std::vector<Row> points_of(const std::vector<FaceSide>& sides) {
  std::vector<Row> rows;
  for (const FaceSide& s : sides) rows.insert(rows.end(), s.ends.begin(), s.ends.end());
  std::ranges::sort(rows);
  rows.erase(std::ranges::unique(rows).begin(), rows.end());
  return rows;
}

void drop_flat(const std::vector<Point>& points, std::vector<Triangle>& triangles) {
  std::erase_if(triangles, [&](const Triangle& t) { return !has_area(points, t); });
}

/// Points at open edges within `reach` of each other become the lowest of them.
void join_points(const std::vector<Point>& x, std::vector<Triangle>& triangles, double reach,
                 Stitching& done) {
  std::vector<Row> order = points_of(open_sides(triangles));
  std::ranges::sort(order, [&](Row a, Row b) { return x[a] != x[b] ? x[a] < x[b] : a < b; });
  UnionFind same(x.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Point& p = x[order[i]];
    for (std::size_t k = i + 1; k < order.size() && x[order[k]][0] - p[0] <= reach; ++k) {
      if (distance(x[order[k]], p) <= reach) same.join(order[i], order[k]);
    }
  }
  for (const Row row : order) {
    const Row root = same.root(row);
    if (root == row) continue;
    ++done.points;
    done.distance = std::max(done.distance, distance(x[row], x[root]));
  }
  for (Triangle& t : triangles) {
    for (Row& corner : t) corner = same.root(corner);
  }
}

/// Open points on the open side from `a` to `b`, from `a` on.
std::vector<Row> points_on(const std::vector<Point>& x, const std::vector<Row>& open,
                           const BoxTree& tree, Row a, Row b, double reach, double& farthest) {
  BoundingBox box = box_around(x, std::array{a, b});
  for (std::size_t k = 0; k < 3; ++k) {
    box.low[k] -= reach;
    box.high[k] += reach;
  }
  const Point way = difference(x[b], x[a]);
  const double square = dot(way, way);
  std::vector<std::pair<double, Row>> found;
  const auto near = [&](const BoundingBox& other) { return overlap(box, other); };
  for_each_box(tree, near, [&](Row i) {
    const Row row = open[i];
    if (row == a || row == b || !(square > 0)) return;
    const Point from = difference(x[row], x[a]);
    const double along = dot(from, way) / square;
    if (!(along > 0) || !(along < 1)) return;
    const double off =
        length({from[0] - along * way[0], from[1] - along * way[1], from[2] - along * way[2]});
    if (off > reach) return;
    farthest = std::max(farthest, off);
    found.emplace_back(along, row);
  });
  std::ranges::sort(found);
  std::vector<Row> rows;
  for (const auto& [along, row] : found) rows.push_back(row);
  return rows;
}

/// A triangle as a fan around the corner opposite to the divided side.
void divide(std::vector<Triangle>& triangles, Row t, Row a, const std::vector<Row>& between) {
  const Triangle old = triangles[t];
  const auto at = static_cast<std::size_t>(std::ranges::find(old, a) - old.begin());
  const Row end = old[(at + 1) % 3], opposite = old[(at + 2) % 3];
  Row from = a;
  for (const Row row : between) {
    triangles.push_back({from, row, opposite});
    from = row;
  }
  triangles[t] = {from, end, opposite};
}

/// One side of each triangle at most; gives the number of sides divided.
std::size_t divide_sides(const std::vector<Point>& x, std::vector<Triangle>& triangles,
                         double reach, Stitching& done) {
  const std::vector<FaceSide> sides = open_sides(triangles);
  const std::vector<Row> open = points_of(sides);
  std::vector<BoundingBox> boxes;
  for (const Row row : open) boxes.push_back({x[row], x[row]});
  const BoxTree tree = box_tree(std::move(boxes));
  std::vector<char> is_divided(triangles.size(), 0);
  std::size_t count = 0;
  for (const FaceSide& side : sides) {
    if (is_divided[side.face]) continue;
    const Row a = side.is_forward ? side.ends[0] : side.ends[1];
    const Row b = side.is_forward ? side.ends[1] : side.ends[0];
    const Triangle& t = triangles[side.face];
    std::vector<Row> between = points_on(x, open, tree, a, b, reach, done.distance);
    std::erase_if(between, [&](Row row) { return std::ranges::find(t, row) != t.end(); });
    if (between.empty()) continue;
    divide(triangles, side.face, a, between);
    is_divided[side.face] = 1;
    ++count;
  }
  return count;
}

struct Attempt {
  std::vector<Triangle> triangles;
  Stitching done;
  EdgeCounts counts;
};

Attempt attempt(const std::vector<Point>& points, const std::vector<Triangle>& triangles,
                double reach) {
  Attempt a{triangles, {}, {}};
  join_points(points, a.triangles, reach, a.done);
  drop_flat(points, a.triangles);
  constexpr int most_passes = 10;
  for (int pass = 0; pass < most_passes; ++pass) {
    const std::size_t divided = divide_sides(points, a.triangles, reach, a.done);
    if (divided == 0) break;
    a.done.sides += divided;
    drop_flat(points, a.triangles);
  }
  // Doubled faces are dropped later: their edges are not too thick.
  std::vector<Triangle> single = a.triangles;
  drop_walls(single);
  a.counts = count_edges(single);
  return a;
}

}  // namespace

Stitching stitch(const std::vector<Point>& points, std::vector<Triangle>& triangles) {
  const double size = diagonal(points, triangles);
  std::optional<Attempt> best;
  for (const double share : shares) {
    // Sides as good as straight hold points that are rounded to single precision.
    Attempt next = attempt(points, triangles, share * size);
    const bool is_better =
        !best || (next.counts.open < best->counts.open && next.counts.thick <= best->counts.thick);
    if (is_better) best = std::move(next);
    if (best->counts.open == 0) break;
  }
  triangles = std::move(best->triangles);
  return best->done;
}

}  // namespace sunder
