// SPDX-License-Identifier: MIT
// The search for fractures of a part of a step.
#include "fracture/breaking/break.hpp"

#include <algorithm>

namespace sunder {

FractureReport break_members(BreakableBody body, std::optional<FanScript>& script,
                             const FractureSettings& settings, SearchPlace place,
                             const StepMembers& members, FractureScratch& scratch, double untested,
                             const FanWatch& watch) {
  // A search fails on stresses that are not numbers; a script has nothing for them.
  const bool is_scripted =
      script && std::ranges::all_of(body.mechanics.elements.stress,
                                    [](const Mat3& stress) { return stress.allFinite(); });
  if (!is_scripted) return break_vertices(body, settings, scratch, members, watch, untested);
  FractureReport made;
  made.fans = make_fans(body, settings, *script, place, scratch.components, untested, watch);
  return made;
}

}  // namespace sunder
