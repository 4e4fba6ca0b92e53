// SPDX-License-Identifier: MIT
// Where the momentum of a step comes from and goes to: added up part by part.
#pragma once

#include <span>
#include <vector>

#include "fracture/simulation/ledger/energy_ledger.hpp"

namespace sunder {

/// Momentum of bodies and free balls, and their angular momentum about the origin.
Impulse total_momentum(const SimulationState& state);

/// Momentum of a component by its frame, and its angular momentum about the origin.
Impulse momentum_of(const Component& component);

/// Adds the impulses of a part that was just adopted, with their moments about the origin. They are
/// gravity on moving bodies, surface loads, contact with driven obstacles, and supports. The
/// support impulse is the momentum change of a held component that the other terms do not explain.
/// Sleeping components do not contribute. Exact for floating_frame except where surface loads turn
/// a body far in a part; other integrators turn bodies by schemes of their own. O(components +
/// contacts + loads). `supports`: `support_impulses` of the part.
void add_part_momentum(MomentumLedger& ledger, const AdoptedPart& part,
                       std::span<const Impulse> supports);

/// Finds the impulse of supports on each held component in an adopted part, row = ComponentId: its
/// change of momentum less weight, surface loads and contact. Empty where nothing is held.
void support_impulses(std::vector<Impulse>& supports, const AdoptedPart& part);

}  // namespace sunder
