// SPDX-License-Identifier: MIT
// A loop over the components that live.
#pragma once

#include "mechanics/state/mechanics_state.hpp"
#include "mechanics/state/step_members.hpp"

namespace sunder {

/// Calls `visit(component)` for every component that has tetrahedra and is a member.
template <class Visit>
void for_each_living(const MechanicsState& state, const StepMembers& members, Visit visit) {
  for (const Component& c : state.components) {
    if (!c.tetrahedra.empty() && members.has(c.id)) visit(c);
  }
}

}  // namespace sunder
