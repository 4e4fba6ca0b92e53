// SPDX-License-Identifier: MIT
// Where the momentum of a step comes from and goes to: added up part by part.
#pragma once

#include "fracture/simulation/energy_ledger.hpp"

namespace sunder {

/// Adds the impulses of a part that was just adopted: weight of what moved, driven obstacles, and
/// supports, which are what a held component's momentum changed by beside its weight, its loads and
/// its contacts. What sleeps moves nothing and counts for nothing. O(components + contacts +
/// loads).
void add_part_momentum(MomentumLedger& ledger, const AdoptedPart& part);

}  // namespace sunder
