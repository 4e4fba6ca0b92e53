// SPDX-License-Identifier: MIT
// Components and obstacles as bodies of the rubble solver.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "fracture/simulation/simulation.hpp"
#include "mechanics/rubble/rubble.hpp"

namespace sunder {

/// The bodies of a tick, and the components and obstacles that they stand for. Moving it keeps the
/// addresses of its solids.
struct RubbleWorld {
  static constexpr std::uint32_t no_row = ~0u;
  std::vector<RubbleBody> bodies;
  std::vector<RubbleShape> shapes;
  std::deque<ConvexSolid> solids;  ///< of shapes
  std::vector<RubblePartner> partners;
  /// Rows of bodies or `no_row`; row = ComponentId, row = obstacle.
  std::vector<std::uint32_t> of_component, of_obstacle;
};

/// Whether the rubble solver has such a body: planes, spheres and boxes. Bodies near other shapes
/// stay with the elastic solver.
bool has_rubble_shape(const Obstacle& obstacle);

/// The components and free obstacles that are marked, all driven obstacles of the solver's shapes,
/// and the faces that came apart between them. Pieces are the tetrahedra of their surface, those
/// that parted from nothing and are one small convex solid that solid; shut cracks are no surface.
/// Keys of shapes are rows of tetrahedra, those of obstacles follow.
RubbleWorld make_rubble_world(const Simulation& sim, const std::vector<char>& component,
                              const std::vector<char>& ball);

}  // namespace sunder
