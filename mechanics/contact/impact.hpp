// SPDX-License-Identifier: MIT
// What counts as a blow, and how finely one has to be stepped; no step is taken here.
#pragma once

#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "mechanics/state/mechanics_state.hpp"

namespace sunder {

/// What a user chooses about impacts. The stress of a blow lives for a few L/c, the time in which a
/// wave crosses a component; a step of 10 L/c finds a fifteenth of it, and what breaks would be
/// decided by the step. So components that are struck are stepped finely while that lasts.
struct ImpactSettings {
  /// Whether they are; false steps everything with the scene's step.
  bool window = true;
  /// Largest sub-step over L/c, L the component's extent (twice the distance of its farthest vertex
  /// from its centre), c the speed of compression waves. Half the time in which a wave crosses a
  /// mean cell is never undercut: the mesh holds no shorter waves.
  double fraction = 0.0625;
  /// A blow counts when its stress rho c v is at least this part of the tensile strength.
  double negligible = 0.1;
  /// Sub-steps in one step; what is left of a step then is taken at once.
  std::uint32_t max_sub_steps = 256;
};

/// What is wrong with the settings, each an error with value, range and remedy; `place` names them.
std::vector<Finding> check(const ImpactSettings& settings, std::string_view place);

/// Blows that lie ahead in a step, or were felt in a sub-step.
struct Blows {
  double time = std::numeric_limits<double>::infinity();  ///< s, from the step's start to the first
  /// s, the longest sub-step that resolves them.
  double sub_step = std::numeric_limits<double>::infinity();
  std::vector<ComponentId> struck;  ///< ascending, none twice
};

/// s, the time of a compression wave's way through a cell of mean size: the mean of (6 V)^(1/3) /
/// c.
double cell_travel(const MechanicsState& state, const Component& component);

/// L/c of a component, s.
double extent_travel(const MechanicsState& state, const Component& component);

/// Longest sub-step that resolves a blow on the component, s.
double wave_sub_step(const MechanicsState& state, const Component& component,
                     const ImpactSettings& settings);

/// Whether `speed` (m/s, at which two surfaces meet) is a blow for the component: rho c v reaches
/// the part of its strength that is not negligible. A hard wall gives rho c v over a flat front; a
/// wave that meets its reflection doubles it. Below a tenth of the strength it would have to be
/// focused fivefold to break anything (a test holds that bodies struck just below stay whole). A
/// rigid tetrahedron cannot break: nothing is a blow for it.
bool is_blow(const MechanicsState& state, const Component& component, double speed,
             const ImpactSettings& settings);

}  // namespace sunder
