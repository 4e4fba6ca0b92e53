// SPDX-License-Identifier: MIT
// Elastic forces by the model that the settings name, for integrators whose state is (x, v).
#pragma once

#include <span>

#include "mechanics/frame/rigid_reference.hpp"
#include "mechanics/integrators/component_step.hpp"

namespace sunder {

/// Elastic forces on the vertices of `step.component` at `positions` (|V|, m), N, world, into
/// `force` (|V|). rigid_reference: algorithm 1 in the form that the settings name, a supported
/// component in `support`, which is its frame then. corotational: `corotational_forces`.
/// Overwrites the component's rows of `predicted.displacement`. O(tetrahedra).
void model_forces(std::span<Vec3> force, const ComponentStep& step, std::span<const Vec3> positions,
                  const Pose& support);

/// The frame of a supported component at the end of the step: it moves with its support.
Pose support_at_end(const ComponentStep& step);

/// Writes displacements, their rates and the frame of the component from `predicted.position` and
/// `predicted.velocity`: the end of every integrator of (x, v).
void fit_prediction(const ComponentStep& step);

/// How much lower than x + h v a free component ends: its mass centre flies on a parabola, so
/// h^2 g / 2; nothing where the weight is a blow at the start, or where supports carry it.
inline Vec3 parabola_shift(const ComponentStep& step) {
  const Loads& loads = step.input.loads;
  const double h = step.input.settings.time_step;
  if (step.component.supported || loads.weight_at_start) return Vec3::Zero();
  return 0.5 * h * h * loads.gravity;
}

}  // namespace sunder
