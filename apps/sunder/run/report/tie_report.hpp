// SPDX-License-Identifier: MIT
// Counts and energy of a run's ties, as `ties` in report.json, with a row for each crack.
#pragma once

#include <map>
#include <nlohmann/json.hpp>

#include "fracture/simulation/simulation_state.hpp"

namespace sunder {

/// Counts, area and energy of the ties of a crack, or of all.
struct TiesOfCrack {
  std::size_t tied = 0;      ///< faces
  std::size_t released = 0;  ///< faces
  double area = 0;           ///< m^2, of those released, projected on the crack
  double due = 0;            ///< J, G_c times that area
  double energy = 0;         ///< J dissipated, by those that are tied too
};

/// Ties over a run.
struct TieStatistics {
  TieReport sum;  ///< of all steps
  std::size_t releases = 0;
  std::map<CrackId, TiesOfCrack> released;  ///< without those that are still tied
};

/// Adds one step.
void note_ties(TieStatistics& statistics, const StepReport& report);

/// `ties` of report.json, keys as docs/explanation/cracks.md has them. Needs:
/// `CrackMode::cohesive`.
nlohmann::ordered_json tie_report(const TieStatistics& statistics, const Simulation& now);

}  // namespace sunder
