// SPDX-License-Identifier: MIT
// The search for fractures of a part of a step.
#include "fracture/simulation/break.hpp"

#include <algorithm>

namespace sunder {

FractureReport break_members(SimulationState& s, const FractureSettings& settings,
                             SearchPlace place, const StepMembers& members,
                             FractureScratch& scratch) {
  // A search fails on stresses that are not numbers; a script has nothing for them.
  const bool is_scripted =
      s.script && std::ranges::all_of(s.mechanics.elements.stress,
                                      [](const Mat3& stress) { return stress.allFinite(); });
  if (!is_scripted) return find_fractures(s.cells, s.mechanics, settings, scratch, members);
  FractureReport made;
  made.fans = make_fans({s.cells, s.mechanics}, settings, *s.script, place, scratch.fan);
  return made;
}

}  // namespace sunder
