// SPDX-License-Identifier: MIT
// Whether triangles cross, in whole numbers and by other means than the code that it judges.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "topology/base/tet_mesh.hpp"

namespace sunder::test {

using Corners = std::array<std::uint32_t, 3>;
using Whole = std::array<std::int64_t, 3>;

inline Whole whole(const Point& p) {
  return {static_cast<std::int64_t>(p[0]), static_cast<std::int64_t>(p[1]),
          static_cast<std::int64_t>(p[2])};
}
inline Whole minus(const Whole& a, const Whole& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline std::int64_t product(const Whole& a, const Whole& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Whole crossed(const Whole& a, const Whole& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline std::array<Whole, 3> places_of(const std::vector<Point>& points, const Corners& t) {
  return {whole(points[t[0]]), whole(points[t[1]]), whole(points[t[2]])};
}

inline Whole normal_of(const std::array<Whole, 3>& t) {
  return crossed(minus(t[1], t[0]), minus(t[2], t[0]));
}

inline bool is_no_line(const std::vector<Point>& points, const Corners& t) {
  return normal_of(places_of(points, t)) != Whole{0, 0, 0};
}

/// Whether a plane parts them. One is normal to a side of each, or to one of the two, or in the
/// plane of one to its side; those of the grid, which are asked first, are enough for most.
inline bool are_parted(const std::array<Whole, 3>& a, const std::array<Whole, 3>& b) {
  const auto parts = [&](const Whole& axis) {
    const auto along = [&](const std::array<Whole, 3>& t) {
      return std::minmax({product(axis, t[0]), product(axis, t[1]), product(axis, t[2])});
    };
    return along(a).second < along(b).first || along(b).second < along(a).first;
  };
  if (parts({1, 0, 0}) || parts({0, 1, 0}) || parts({0, 0, 1})) return true;
  if (parts(normal_of(a)) || parts(normal_of(b))) return true;
  for (std::size_t i = 0; i < 3; ++i) {
    const Whole e = minus(a[(i + 1) % 3], a[i]), f = minus(b[(i + 1) % 3], b[i]);
    if (parts(crossed(normal_of(a), e)) || parts(crossed(normal_of(b), f))) return true;
    for (std::size_t j = 0; j < 3; ++j) {
      if (parts(crossed(e, minus(b[(j + 1) % 3], b[j])))) return true;
    }
  }
  return false;
}

/// Whether x is s p + t q with s, t >= 0, all in one plane.
inline bool is_in_corner(const Whole& x, const Whole& p, const Whole& q) {
  const Whole n = crossed(p, q);
  return product(crossed(p, x), n) >= 0 && product(crossed(x, q), n) >= 0;
}

/// Whether the corners between p, q and between r, s, all from one point, have a ray in common.
inline bool share_a_ray(const Whole& p, const Whole& q, const Whole& r, const Whole& s) {
  const auto volume = [](const Whole& a, const Whole& b, const Whole& c) {
    return product(a, crossed(b, c));
  };
  // The one way in which a p + b q = c r + d s (Cramer's rule), but for its length.
  const std::array<std::int64_t, 4> way = {volume(q, r, s), -volume(p, r, s), volume(p, q, s),
                                           -volume(p, q, r)};
  const std::int64_t a = way[0], b = way[1], c = -way[2], d = -way[3];
  if (a != 0 || b != 0 || c != 0 || d != 0) {
    return (a >= 0 && b >= 0 && c >= 0 && d >= 0) || (a <= 0 && b <= 0 && c <= 0 && d <= 0);
  }
  return is_in_corner(p, r, s) || is_in_corner(q, r, s) || is_in_corner(r, p, q) ||
         is_in_corner(s, p, q);
}

/// Whether two triangles meet outside their common corner or edge. Needs: areas, whole coordinates.
inline bool twins_cross(const std::vector<Point>& points, Corners a, Corners b) {
  const auto share = [](Corners& t, const Corners& other) {
    return std::ranges::stable_partition(
               t, [&](std::uint32_t c) { return std::ranges::find(other, c) != other.end(); })
               .begin() -
           t.begin();
  };
  const Corners first = a;
  share(a, b);
  const auto shared = share(b, first);
  const std::array<Whole, 3> p = places_of(points, a), q = places_of(points, b);
  if (shared == 3) return true;
  if (shared == 0) return !are_parted(p, q);
  if (shared == 1) {
    return share_a_ray(minus(p[1], p[0]), minus(p[2], p[0]), minus(q[1], q[0]), minus(q[2], q[0]));
  }
  const Whole e = minus(p[1], p[0]), n = crossed(e, minus(p[2], p[0])),
              m = crossed(e, minus(whole(points[b[2]]), p[0]));
  return crossed(n, m) == Whole{0, 0, 0} && product(n, m) > 0;
}

}  // namespace sunder::test
