// SPDX-License-Identifier: MIT
// Element stress and turn from displacements, in one pass over the tetrahedra.
#pragma once

#include <span>

#include "mechanics/integrators/scratch.hpp"
#include "mechanics/state/step_input.hpp"

namespace sunder {

/// Which elements are measured, and how.
struct ElementMeasure {
  StepMembers members = {};
  ElasticModel model = ElasticModel::rigid_reference;
  bool strain = false;  ///< whether `Component::strain_change` is wanted
};

/// Element stress (eq. 5) and the largest turn of an element in each component, in one pass, from
/// the present displacements. `adopt` does it; call it after setting displacements otherwise.
/// With corotational elements the stress is that of their own strain, in the body frame as if they
/// had not turned in it. This is the rest configuration, where cracks are decided. Turns count as
/// none.
void measure_elements(MechanicsState& state, MechanicsScratch& scratch,
                      std::span<const Corners> corners, const ElementMeasure& measure = {});

}  // namespace sunder
