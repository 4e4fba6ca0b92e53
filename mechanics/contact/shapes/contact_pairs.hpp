// SPDX-License-Identifier: MIT
// Pairs of vertices and balls from call to call: searched with a margin, sifted while it lasts.
#pragma once

#include "mechanics/contact/shapes/contact_grid.hpp"

namespace sunder {

/// Input of the last search, and its pairs with the margin. May be thrown away at any time.
struct PairCache {
  std::vector<Vec3> points, centres;
  std::vector<double> reach;  ///< |T|, m: radii with the margin
  std::vector<ComponentId> point_component, centre_component;
  std::vector<SpherePair> near;
  std::vector<Vec3> last_points;  ///< of the last call
  std::size_t searches = 0;       ///< in all, for tests
};

/// The same as `find_sphere_pairs`, to the bit. In sub-steps vertices hardly move: where the last
/// two calls differ by less than an eighth of the margin (a quarter of the mean radius), the search
/// is made with the margin, and calls that follow only sift its pairs, as long as nothing has
/// broken, and motions and radii stay within it. O(|V| + |T| + pairs) then.
void find_sphere_pairs(std::vector<SpherePair>& pairs, GridScratch& grid, PairCache& cache,
                       const SphereQuery& query);

}  // namespace sunder
