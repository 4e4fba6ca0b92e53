// SPDX-License-Identifier: MIT
// Clusters of normals, and four points of each.
#include "mechanics/rubble/merge_patches.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sunder {
namespace {

constexpr double one_cluster = 0.9;  ///< cosine between normals

using Point = RubblePatch::Point;

double deepest_of(const RubblePatch& patch) {
  double least = patch.point[0].separation;
  for (int k = 1; k < patch.count; ++k) {
    least = std::min(least, patch.point[static_cast<std::size_t>(k)].separation);
  }
  return least;
}

/// A point with its place on B, world.
struct Placed {
  Point point;
  Vec3 at{0, 0, 0};
};

/// Puts the four points that span `points` into `patch`.
void keep_four(RubblePatch& patch, std::vector<Placed>& points) {
  const auto bring = [&](std::size_t place, auto value) {
    std::size_t best = place;
    for (std::size_t k = place + 1; k < points.size(); ++k) {
      if (value(points[k]) > value(points[best])) best = k;
    }
    std::swap(points[place], points[best]);
  };
  bring(0, [](const Placed& p) { return -p.point.separation; });
  // Points much higher than the deepest one carry nothing before it gives way.
  double reach = 0;
  for (const Placed& p : points) reach = std::max(reach, (p.at - points[0].at).norm());
  const double highest = std::max(0.0, points[0].point.separation) + 0.01 * reach;
  std::vector<Placed> low;
  for (const Placed& p : points) {
    if (p.point.separation <= highest) low.push_back(p);
  }
  points = std::move(low);
  if (points.size() > 4) {
    const Vec3 first = points[0].at;
    bring(1, [&](const Placed& p) { return (p.at - first).squaredNorm(); });
    const Vec3 across = patch.normal.cross(points[1].at - first);
    bring(2, [&](const Placed& p) { return across.dot(p.at - first); });
    bring(3, [&](const Placed& p) { return -across.dot(p.at - first); });
  }
  patch.count = static_cast<int>(std::min<std::size_t>(points.size(), 4));
  for (std::size_t k = 0; k < static_cast<std::size_t>(patch.count); ++k) {
    patch.point[k] = points[k].point;
  }
}

}  // namespace

void merge_patches(std::vector<RubblePatch>& patches, std::span<const MovingBody> bodies) {
  std::vector<std::uint32_t> order(patches.size());
  std::iota(order.begin(), order.end(), 0u);
  std::vector<double> depth;
  for (const RubblePatch& p : patches) depth.push_back(deepest_of(p));
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    const RubblePatch &p = patches[i], &q = patches[j];
    return std::tuple(p.a, p.b, depth[i], i) < std::tuple(q.a, q.b, depth[j], j);
  });
  std::vector<RubblePatch> merged;
  std::vector<Placed> points;
  std::vector<std::uint32_t> rest;
  for (std::size_t first = 0; first < order.size();) {
    std::size_t end = first + 1;
    const auto same = [&](std::uint32_t i, std::uint32_t j) {
      return patches[i].a == patches[j].a && patches[i].b == patches[j].b;
    };
    while (end < order.size() && same(order[first], order[end])) ++end;
    rest.assign(order.begin() + static_cast<std::ptrdiff_t>(first),
                order.begin() + static_cast<std::ptrdiff_t>(end));
    while (!rest.empty()) {
      RubblePatch patch = patches[rest.front()];
      points.clear();
      std::size_t left = 0, joined = 0;
      for (const std::uint32_t row : rest) {
        const RubblePatch& other = patches[row];
        if (other.normal.dot(patch.normal) < one_cluster) {
          rest[left++] = row;
          continue;
        }
        ++joined;
        for (std::size_t k = 0; k < static_cast<std::size_t>(other.count); ++k) {
          const MovingBody &a = bodies[patch.a], &b = bodies[patch.b];
          Placed placed{other.point[k], b.centre + b.turned * other.point[k].local_b};
          const Vec3 on_a = a.centre + a.turned * other.point[k].local_a;
          placed.point.separation = patch.normal.dot(on_a - placed.at);
          points.push_back(placed);
        }
      }
      rest.resize(left);
      if (joined > 1) keep_four(patch, points);
      merged.push_back(patch);
    }
    first = end;
  }
  patches = std::move(merged);
}

}  // namespace sunder
