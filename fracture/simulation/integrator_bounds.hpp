// SPDX-License-Identifier: MIT
// What bodies ask of integrators that are bounded: steps, counts and sizes.
#pragma once

#include <vector>

#include "fracture/scene/scene.hpp"
#include "mechanics/step.hpp"

namespace sunder {

/// The least bound on explicit steps of all components that are not rigid tetrahedra, with this
/// damping, s.
double least_step_bound(MechanicsScratch& scratch, const MechanicsState& state,
                        const RayleighDamping& damping);

/// What the bodies as they are ask of a bounded integrator beyond its bounds: a warning for verlet
/// above its step and for contact by penalty above that of a vertex on one spring, errors for
/// sub_stepped above its count and modal above its size. Splits only make bodies smaller.
std::vector<Finding> check_integrator_bounds(const Scene& scene, const MechanicsState& state,
                                             MechanicsScratch& scratch);

}  // namespace sunder
