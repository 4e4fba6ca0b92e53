// SPDX-License-Identifier: MIT
// The search for fractures of a part of a step.
#include "fracture/simulation/break.hpp"

#include <algorithm>

namespace sunder {

FractureReport break_members(SimulationState& s, const FractureSettings& settings,
                             SearchPlace place, const StepMembers& members,
                             FractureScratch& scratch, const FanWatch& watch) {
  // A search fails on stresses that are not numbers; a script has nothing for them.
  const bool is_scripted =
      s.script && std::ranges::all_of(s.mechanics.elements.stress,
                                      [](const Mat3& stress) { return stress.allFinite(); });
  const BreakableBody body{s.cells, s.mechanics};
  if (!is_scripted) return break_vertices(body, settings, scratch, members, watch);
  FractureReport made;
  made.fans = make_fans(body, settings, *s.script, place, scratch.components, watch);
  return made;
}

}  // namespace sunder
