// SPDX-License-Identifier: MIT
// The ids of living components, ascending.
#include "mechanics/state/living.hpp"

namespace sunder {

std::vector<ComponentId> living_components(const MechanicsState& state,
                                           const StepMembers& members) {
  std::vector<ComponentId> living;
  for (const Component& component : state.components) {
    if (!component.tetrahedra.empty() && members.has(component.id)) living.push_back(component.id);
  }
  return living;
}

}  // namespace sunder
