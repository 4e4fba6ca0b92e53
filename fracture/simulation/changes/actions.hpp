// SPDX-License-Identifier: MIT
// What a host does to a simulation between two steps, besides its bodies.
#pragma once

#include <optional>

#include "fracture/algorithms/fan_event.hpp"
#include "fracture/simulation/simulation.hpp"

namespace sunder {

/// Adds a free ball, behind the obstacles that are there. `velocity`: m/s; `mass`: kg. Errors,
/// which change nothing: bad_action (radius or mass not above 0, a number that is not finite).
std::optional<Finding> shoot(Simulation& simulation, const Sphere& ball, const Vec3& velocity,
                             double mass);

/// Splits every face between tetrahedra whose centres, where they are now, lie on different sides
/// of the plane through `point` (m, world) across `normal`. Errors, which change nothing:
/// bad_action, nothing_cut, and those of `split_faces`. O(|T|).
Result<FanEvent> cut(Simulation& simulation, const Vec3& point, const Vec3& normal);

/// Pulls a vertex to `end` (m, world) in every step until `release`, by a spring that is critically
/// damped, with a natural frequency of 5 Hz for the mass of the whole piece. A second pull takes
/// the place of the first. The spring is not saved. Errors, which change nothing: bad_action (no
/// such vertex, a number that is not finite).
std::optional<Finding> pull(Simulation& simulation, VertexId vertex, const Vec3& end);

/// Ends a pull, if there is one.
void release(Simulation& simulation);

}  // namespace sunder
