// SPDX-License-Identifier: MIT
// Where the energy of a step comes from and goes to: added up part by part.
#pragma once

#include "fracture/step_work.hpp"

namespace sunder {

/// Remembers where the vertices are before a part of a step.
void begin_part(StepWork& work);

/// Adds to the report of the step what gravity, surface loads and the integrator did in the part
/// just adopted: impulse and work of loads, work of gravity, numerical loss. `input`: as the part
/// was taken with. One product with K for each member.
void end_part(StepWork& work, const StepInput& input);

/// Closes the ledger of a step that began with `kinetic` and `strain`, J.
void close_ledger(StepWork& work, double kinetic, double strain);

}  // namespace sunder
