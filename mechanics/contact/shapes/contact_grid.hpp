// SPDX-License-Identifier: MIT
// Which vertices lie inside which balls of other components: a uniform grid, no contact decided.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mechanics/state/columns.hpp"
#include "topology/base/ids.hpp"

namespace sunder {

/// A vertex in the ball of a tetrahedron of another component.
struct SpherePair {
  TetId tetrahedron;
  VertexId vertex;
  friend constexpr auto operator<=>(const SpherePair&, const SpherePair&) = default;
};

/// The input of `find_sphere_pairs`. A vertex and a ball with the same component never pair.
struct SphereQuery {
  /// |V| positions, m.
  std::span<const Vec3> points;
  /// |V|.
  std::span<const ComponentId> point_component;
  /// |T| centres of balls, m.
  std::span<const Vec3> centres;
  /// |T| radii, m, >= 0.
  std::span<const double> radii;
  /// |T|.
  std::span<const ComponentId> centre_component;
};

/// Room that `find_sphere_pairs` reuses: no allocation once it has grown.
struct GridScratch {
  using Cell = std::array<std::int32_t, 3>;
  std::vector<Cell> cell_of;            ///< |V|
  std::vector<std::uint32_t> first_of;  ///< buckets + 1: where each bucket begins in `sorted`
  std::vector<VertexId> sorted;         ///< |V|: vertices by bucket, ascending inside each
};

/// Every (tetrahedron, vertex) of different components with `|point - centre| < radius`, sorted by
/// tetrahedron, then vertex; `pairs` is overwritten. The cell is as wide as the mean ball; vertices
/// are counted into hashed cells, each ball visits the cells it covers (or all vertices, where
/// those are fewer). O(|V| + |T| + pairs) while balls are of similar size. Points and balls that
/// are not finite pair with nothing.
void find_sphere_pairs(std::vector<SpherePair>& pairs, GridScratch& scratch,
                       const SphereQuery& query);

/// The same by comparing every vertex with every ball: the slow twin for tests. O(|V| |T|).
void find_sphere_pairs_brute_force(std::vector<SpherePair>& pairs, const SphereQuery& query);

}  // namespace sunder
