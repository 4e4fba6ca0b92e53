// SPDX-License-Identifier: MIT
// The components that live: those that have tetrahedra.
#pragma once

#include <vector>

#include "mechanics/state/step_input.hpp"

namespace sunder {

/// Calls `visit(component)` for every component that has tetrahedra and is a member.
template <class Visit>
void for_each_living(const MechanicsState& state, const StepMembers& members, Visit visit) {
  for (const Component& c : state.components) {
    if (!c.tetrahedra.empty() && members.has(c.id)) visit(c);
  }
}

/// The ids of the components that live (have tetrahedra) and are members, ascending.
std::vector<ComponentId> living_components(const MechanicsState& state,
                                           const StepMembers& members = {});

}  // namespace sunder
