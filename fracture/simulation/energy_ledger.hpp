// SPDX-License-Identifier: MIT
// Where the energy of a step comes from and goes to: added up part by part.
#pragma once

#include "fracture/simulation/step_work.hpp"

namespace sunder {

/// Remembers the state before a part of a step.
void begin_part(StepWork& work);

/// Adds to the report of the step what happened in the part just adopted: change of strain, work of
/// gravity, surface loads, contact and supports, losses, impulse of loads. `input`: as the part was
/// taken with. O(vertices + contacts), beside the pass over elements that `adopt` makes anyway; one
/// product with K for each component whose supports move.
void end_part(StepWork& work, const StepInput& input);

/// Closes the ledger of a step that began with `kinetic` J.
void close_ledger(StepWork& work, double kinetic);

}  // namespace sunder
