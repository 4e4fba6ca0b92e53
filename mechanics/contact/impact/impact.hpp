// SPDX-License-Identifier: MIT
// Which contacts count as blows, and how finely one has to be stepped; no step is taken here.
#pragma once

#include <limits>
#include <vector>

#include "mechanics/contact/settings/impact_settings.hpp"
#include "mechanics/state/mechanics_state.hpp"
#include "mechanics/state/wave_travel.hpp"

namespace sunder {

/// Blows that lie ahead in a step, or were felt in a sub-step.
struct Blows {
  double time = std::numeric_limits<double>::infinity();  ///< s, from the step's start to the first
  /// s, the longest sub-step that resolves them: the least `Component::cell_travel` of the struck.
  double sub_step = std::numeric_limits<double>::infinity();
  std::vector<ComponentId> struck;  ///< ascending, none twice
  /// Struck, but without the energy to break (`ImpactEnergy`): by which bound.
  std::vector<ComponentId> spared_by_pair, spared_by_island;
};

/// Whether `speed` (m/s, at which two surfaces meet) is a blow for the component: rho c v reaches
/// the part of its strength (Pa, of its weakest vertex) that is not negligible. A hard wall gives
/// rho c v over a flat front; a wave that meets its reflection doubles it. Below a tenth of the
/// strength it would have to be focused fivefold to break anything (a test holds that bodies struck
/// just below stay whole). A rigid tetrahedron cannot break: nothing is a blow for it.
bool is_blow(const MechanicsState& state, const Component& component, double speed, double strength,
             const ImpactSettings& settings);

}  // namespace sunder
