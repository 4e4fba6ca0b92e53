// SPDX-License-Identifier: MIT
// Generators of closed 3-manifolds and random pseudomanifolds.
#include "tests/topology/suite/abstract_bodies.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "topology/suite/fixtures/shapes.hpp"

namespace sunder::test {
namespace {

using Quad = std::array<std::uint32_t, 4>;

/// A cell of the join of two circles of n points: points 0 to n - 1 and n to 2 n - 1, rising.
using Cell = std::vector<std::uint32_t>;

/// The lowest of a cell's images under the rotations.
Cell representative(const Cell& cell, std::uint32_t p, std::uint32_t q) {
  const std::uint32_t n = 2 * p;
  Cell lowest = cell;
  for (std::uint32_t turn = 1; turn < p; ++turn) {
    Cell image;
    for (const std::uint32_t x : cell) {
      image.push_back(x < n ? (x + 2 * turn) % n : n + (x - n + 2 * q * turn) % n);
    }
    std::sort(image.begin(), image.end());
    lowest = std::min(lowest, image);
  }
  return lowest;
}

}  // namespace

Tetrahedra lens_space(std::uint32_t p, std::uint32_t q) {
  const std::uint32_t n = 2 * p;
  std::map<Cell, std::uint32_t> number;
  std::set<Quad> tetrahedra;
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      Cell corners = {i, (i + 1) % n, n + j, n + (j + 1) % n};
      std::sort(corners.begin(), corners.end());
      // Each order of the corners is a chain of cells: a tetrahedron of the subdivision.
      Cell order = corners;
      do {
        Quad chain;
        for (std::size_t d = 0; d < 4; ++d) {
          Cell cell(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(d) + 1);
          std::sort(cell.begin(), cell.end());
          const auto next = static_cast<std::uint32_t>(number.size());
          chain[d] = number.emplace(representative(cell, p, q), next).first->second;
        }
        tetrahedra.insert(chain);
      } while (std::next_permutation(order.begin(), order.end()));
    }
  }
  return {tetrahedra.begin(), tetrahedra.end()};
}

Tetrahedra sphere_bundle(std::uint32_t length, bool twisted) {
  Tetrahedra tetrahedra;
  const auto point = [&](std::uint32_t layer, std::uint32_t a) {
    if (layer < length) return 4 * layer + a;
    // Exchanging points 0 and 1 reflects the sphere.
    return twisted && a < 2 ? 1 - a : a;
  };
  for (std::uint32_t layer = 0; layer < length; ++layer) {
    for (std::uint32_t left_out = 0; left_out < 4; ++left_out) {
      std::array<std::uint32_t, 3> face;
      for (std::uint32_t a = 0, i = 0; a < 4; ++a) {
        if (a != left_out) face[i++] = a;
      }
      const auto [a, b, c] = face;
      const auto low = [&](std::uint32_t x) { return point(layer, x); };
      const auto high = [&](std::uint32_t x) { return point(layer + 1, x); };
      tetrahedra.push_back({low(a), low(b), low(c), high(c)});
      tetrahedra.push_back({low(a), low(b), high(b), high(c)});
      tetrahedra.push_back({low(a), high(a), high(b), high(c)});
    }
  }
  return tetrahedra;
}

Tetrahedra three_torus(std::uint32_t n) {
  Tetrahedra tetrahedra;
  for (std::uint32_t cube = 0; cube < n * n * n; ++cube) {
    const std::array<std::uint32_t, 3> low = {cube % n, cube / n % n, cube / n / n};
    std::array<std::size_t, 3> axes = {0, 1, 2};
    do {
      std::array<std::uint32_t, 3> at = low;
      Quad t;
      for (std::size_t step = 0; step < 4; ++step) {
        if (step > 0) at[axes[step - 1]] = (at[axes[step - 1]] + 1) % n;
        t[step] = (at[2] * n + at[1]) * n + at[0];
      }
      tetrahedra.push_back(t);
    } while (std::next_permutation(axes.begin(), axes.end()));
  }
  return tetrahedra;
}

Tetrahedra random_pseudomanifold(std::uint32_t points, std::size_t tetrahedra,
                                 std::mt19937_64& random) {
  Tetrahedra candidates;
  for (std::uint32_t a = 0; a < points; ++a) {
    for (std::uint32_t b = a + 1; b < points; ++b) {
      for (std::uint32_t c = b + 1; c < points; ++c) {
        for (std::uint32_t d = c + 1; d < points; ++d) candidates.push_back({a, b, c, d});
      }
    }
  }
  Tetrahedra taken;
  std::map<std::array<std::uint32_t, 3>, int> sides;
  while (!candidates.empty() && taken.size() < tetrahedra) {
    std::swap(candidates[suite::below(random, candidates.size())], candidates.back());
    const Quad t = candidates.back();
    candidates.pop_back();
    const std::array<std::array<std::uint32_t, 3>, 4> faces = {
        {{t[0], t[1], t[2]}, {t[0], t[1], t[3]}, {t[0], t[2], t[3]}, {t[1], t[2], t[3]}}};
    if (std::any_of(faces.begin(), faces.end(), [&](const auto& f) { return sides[f] == 2; })) {
      continue;
    }
    for (const auto& f : faces) ++sides[f];
    taken.push_back(t);
  }
  return taken;
}

suite::GlueTwin glued(const Tetrahedra& tetrahedra) {
  std::uint32_t points = 0;
  for (const Quad& t : tetrahedra)
    points = std::max(points, 1 + *std::max_element(t.begin(), t.end()));
  return suite::glue_twin(tetrahedra, points);
}

void cut_at_random(suite::GlueTwin& twin, double probability, std::mt19937_64& random) {
  for (std::size_t f = 0; f < twin.glued.size(); ++f) {
    const HalfFaceId across = twin.glued[f];
    if (across.is_none() || across.index() < f || suite::unit(random) >= probability) continue;
    twin.glued[f] = twin.glued[across.index()] = HalfFaceId::none();
  }
}

}  // namespace sunder::test
