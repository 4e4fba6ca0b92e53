// SPDX-License-Identifier: MIT
// Demands of bodies on integrators that are bounded: steps, counts and sizes.
#pragma once

#include <vector>

#include "fracture/scene/scene.hpp"
#include "mechanics/step.hpp"

namespace sunder {

/// The least bound on explicit steps of all components that are not rigid tetrahedra, with this
/// damping, s.
double least_step_bound(MechanicsScratch& scratch, const MechanicsState& state,
                        const RayleighDamping& damping);

/// Demands of the present bodies beyond the bounds of an integrator. Warnings: verlet above its
/// step, and contact by penalty above that of a vertex on one spring. Errors: sub_stepped above its
/// count, and modal above its size. Splits only make bodies smaller.
std::vector<Finding> check_integrator_bounds(const Scene& scene, const MechanicsState& state,
                                             MechanicsScratch& scratch);

}  // namespace sunder
