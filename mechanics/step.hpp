// SPDX-License-Identifier: MIT
// One step of mechanics without contact: predict, then adopt.
#pragma once

#include <span>

#include "mechanics/integrators/scratch.hpp"
#include "mechanics/measure_elements.hpp"
#include "mechanics/state/step_input.hpp"

namespace sunder {

/// Computes the state of `components` at the end of the step into `scratch.predicted`: it may be
/// run again, say after `apply_impulses`. Builds and factors missing systems of these components in
/// `state.systems` (110 ms at 6 000 tetrahedra, once), then one solve each; changes nothing else.
void predict(MechanicsScratch& scratch, MechanicsState& state, const StepInput& input,
             std::span<const ComponentId> components);

/// Builds and factors the systems that the components will need in this part of a step, on
/// `input.threads` threads: `predict` would do it one by one.
void prepare(MechanicsState& state, const StepInput& input);

/// Makes the predicted state of every member the present one, advances the time, and computes
/// element stress and turn in one pass. Needs: `predict` for every active member since the last
/// adoption. On an outcome other than fine the state is as computed, for inspection.
StepStatus adopt(MechanicsState& state, MechanicsScratch& scratch, const StepInput& input);

/// The whole step without contact: predict all, adopt.
StepStatus advance(MechanicsState& state, MechanicsScratch& scratch, const StepInput& input);

}  // namespace sunder
