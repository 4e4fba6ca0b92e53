// SPDX-License-Identifier: MIT
// Rims by the next open edge; covers by the least area of each part of a rim.
#include "topology/mesh/surface/repair/holes.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "topology/base/point_math.hpp"
#include "topology/mesh/box_tree.hpp"
#include "topology/mesh/surface/crossing.hpp"

namespace sunder {
namespace {

using detail::cross, detail::difference, detail::length;
using Row = std::uint32_t;
using Edge = std::pair<Row, Row>;
constexpr double never = std::numeric_limits<double>::infinity();

Edge edge_of(Row a, Row b) { return {std::min(a, b), std::max(a, b)}; }

/// Cuts ways that meet a point twice into ways of their own.
void add_simple(const Rim& way, std::vector<Rim>& rims) {
  Rim stack;
  std::map<Row, std::size_t> place;
  for (const Row row : way) {
    const auto [at, is_new] = place.try_emplace(row, stack.size());
    if (!is_new) {
      const auto from = stack.begin() + static_cast<std::ptrdiff_t>(at->second);
      if (stack.end() - from >= 3) rims.emplace_back(from, stack.end());
      for (auto it = from; it != stack.end(); ++it) {
        if (*it != row) place.erase(*it);
      }
      stack.erase(from, stack.end());
    }
    stack.push_back(row);
  }
  if (stack.size() >= 3) rims.push_back(std::move(stack));
}

/// The least area of the part of a rim from i to k, and the point in between that gives it.
class LeastArea {
 public:
  LeastArea(const std::vector<Point>& points, const std::set<Edge>& used, const Rim& rim)
      : x_(points), used_(used), rim_(rim), n_(rim.size()), area_(n_ * n_, 0), by_(n_ * n_, 0) {
    for (std::size_t span = 2; span < n_; ++span) {
      for (std::size_t i = 0; i + span < n_; ++i) choose(i, i + span);
    }
  }

  std::vector<Triangle> cover() const {
    std::vector<Triangle> triangles;
    if (area_[n_ - 1] == never) return triangles;
    std::vector<std::pair<std::size_t, std::size_t>> parts = {{0, n_ - 1}};
    while (!parts.empty()) {
      const auto [i, k] = parts.back();
      parts.pop_back();
      if (k - i < 2) continue;
      const std::size_t j = by_[i * n_ + k];
      triangles.push_back({rim_[i], rim_[j], rim_[k]});
      parts.push_back({i, j});
      parts.push_back({j, k});
    }
    return triangles;
  }

 private:
  void choose(std::size_t i, std::size_t k) {
    double& least = area_[i * n_ + k];
    least = never;
    const bool is_rim = i == 0 && k == n_ - 1;
    if (!is_rim && used_.contains(edge_of(rim_[i], rim_[k]))) return;
    for (std::size_t j = i + 1; j < k; ++j) {
      const double parts = area_[i * n_ + j] + area_[j * n_ + k];
      if (!(parts < least)) continue;
      const double all = parts + area(rim_[i], rim_[j], rim_[k]);
      if (!(all < least)) continue;
      least = all;
      by_[i * n_ + k] = j;
    }
  }

  double area(Row a, Row b, Row c) const {
    if (!has_area(x_, {a, b, c})) return never;
    return length(cross(difference(x_[b], x_[a]), difference(x_[c], x_[a]))) / 2;
  }

  const std::vector<Point>& x_;
  const std::set<Edge>& used_;
  const Rim& rim_;
  std::size_t n_;
  std::vector<double> area_;
  std::vector<std::size_t> by_;
};

}  // namespace

std::vector<Rim> rims_of(const std::vector<Triangle>& triangles) {
  std::multimap<Row, Row> next;  // against the way of the triangle
  for (const FaceSide& s : open_sides(triangles)) {
    next.emplace(s.ends[s.is_forward ? 1 : 0], s.ends[s.is_forward ? 0 : 1]);
  }
  std::vector<Rim> rims;
  while (!next.empty()) {
    Rim way;
    const Row first = next.begin()->first;
    Row row = first;
    for (auto step = next.find(row); step != next.end(); step = next.find(row)) {
      way.push_back(row);
      row = step->second;
      next.erase(step);
    }
    if (row == first) add_simple(way, rims);
  }
  return rims;
}

double width_of(const std::vector<Point>& points, const Rim& rim) {
  return longest_side(box_around(points, rim));
}

Point middle_of(const std::vector<Point>& points, const Rim& rim) {
  Point sum{};
  for (const Row row : rim) {
    for (std::size_t k = 0; k < 3; ++k) sum[k] += points[row][k] / static_cast<double>(rim.size());
  }
  return sum;
}

std::vector<Triangle> cover_of(const std::vector<Point>& points,
                               const std::vector<Triangle>& triangles, const Rim& rim) {
  if (rim.size() < 3 || rim.size() > longest_rim) return {};
  std::set<Edge> used;
  const std::set<Row> on_rim(rim.begin(), rim.end());
  for (const FaceSide& s : sides_of(triangles)) {
    if (on_rim.contains(s.ends[0]) && on_rim.contains(s.ends[1])) {
      used.insert({s.ends[0], s.ends[1]});
    }
  }
  return LeastArea(points, used, rim).cover();
}

}  // namespace sunder
