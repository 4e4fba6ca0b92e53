// SPDX-License-Identifier: MIT
// Uniform refinement of tetrahedra by the middles of their edges.
#include "apps/bench/chart/chart_mesh.hpp"

#include <algorithm>
#include <utility>

namespace sunder {
namespace {

using Row = std::uint32_t;

double squared(const Point& p) { return p[0] * p[0] + p[1] * p[1] + p[2] * p[2]; }

double squared_distance(const Point& a, const Point& b) {
  return squared({a[0] - b[0], a[1] - b[1], a[2] - b[2]});
}

/// Rows of the middles of edges, made when first asked for.
struct Middles {
  TetMesh& mesh;
  std::map<std::pair<Row, Row>, Row> of_edge;

  Row operator()(Row a, Row b) {
    const auto [place, is_new] =
        of_edge.try_emplace(std::minmax(a, b), static_cast<Row>(mesh.points.size()));
    if (is_new) {
      const Point p = mesh.points[a], q = mesh.points[b];
      mesh.points.push_back({(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2});
    }
    return place->second;
  }
};

/// The octahedron between three pairs of opposite middles a-a', b-b', c-c' as four tetrahedra
/// around the diagonal a-a'. Positive where (a, b, c) and (a, c, b') are seen anticlockwise from
/// outside.
void add_octahedron(TetMesh& mesh, const std::array<Row, 2>& axis, const std::array<Row, 4>& rim) {
  for (std::size_t i = 0; i < 4; ++i) {
    mesh.tetrahedra.push_back({axis[0], axis[1], rim[i], rim[(i + 1) % 4]});
  }
}

}  // namespace

TetMesh refined(const TetMesh& mesh) {
  TetMesh fine;
  fine.points = mesh.points;
  fine.region_name = mesh.region_name;
  Middles middle{fine, {}};
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const auto [a, b, c, d] = mesh.tetrahedra[t];
    const Row ab = middle(a, b), ac = middle(a, c), ad = middle(a, d);
    const Row bc = middle(b, c), bd = middle(b, d), cd = middle(c, d);
    fine.tetrahedra.insert(fine.tetrahedra.end(),
                           {{a, ab, ac, ad}, {ab, b, bc, bd}, {ac, bc, c, cd}, {ad, bd, cd, d}});
    const auto length = [&](Row p, Row q) {
      return squared_distance(fine.points[p], fine.points[q]);
    };
    const double first = length(ab, cd), second = length(ac, bd), third = length(ad, bc);
    // Each rim turns about its axis as (b, c, d) turns about a.
    if (first <= second && first <= third) {
      add_octahedron(fine, {ab, cd}, {ac, ad, bd, bc});
    } else if (second <= third) {
      add_octahedron(fine, {ac, bd}, {ad, ab, bc, cd});
    } else {
      add_octahedron(fine, {ad, bc}, {ab, ac, cd, bd});
    }
    if (!mesh.region.empty()) fine.region.insert(fine.region.end(), 8, mesh.region[t]);
  }
  return fine;
}

Point farthest_point(const TetMesh& mesh) {
  const auto nearer = [](const Point& a, const Point& b) { return squared(a) < squared(b); };
  return *std::ranges::max_element(mesh.points, nearer);
}

}  // namespace sunder
