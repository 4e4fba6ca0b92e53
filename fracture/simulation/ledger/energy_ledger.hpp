// SPDX-License-Identifier: MIT
// Where the energy of a step comes from and goes to: added up part by part.
#pragma once

#include "fracture/simulation/state.hpp"
#include "fracture/simulation/step_report.hpp"

namespace sunder {

/// Remembers the state before a part of a step: the reference of `add_part_energy`.
void remember_start(PartStart& start, const SimulationState& state, bool keeps_ledger);

/// A part that was just adopted.
struct AdoptedPart {
  SimulationState& state;
  const StepInput& input;  ///< as the part was taken with
  const ContactStepResult& result;
  PartStart& before;
  const ContactSettings& contact;
};

/// Whether contact gave a component or a ball impulses in the part; `touched` is the result's list
/// of either.
bool is_struck(const std::vector<char>& touched, std::size_t row);

/// Adds the changes of the part to the report of the step: the impulse of loads, and cracks with
/// settled energy. If the ledger is kept also: change of strain, work of gravity, surface loads,
/// contact and supports, losses. O(vertices + contacts), in addition to the pass over elements that
/// `adopt` makes anyway; one product with K for each component with moving supports.
void add_part_energy(StepReport& report, const AdoptedPart& part, bool keeps_ledger);

/// Closes the ledger of a step that began with `kinetic` J and ended with `kinetic_now`.
void close_ledger(StepReport& report, double kinetic, double kinetic_now);

}  // namespace sunder
