// SPDX-License-Identifier: MIT
// How a step went: sound or not, and how its equations were solved.
#pragma once

#include <cstdint>

#include "topology/kernel/counters.hpp"
#include "topology/kernel/finding.hpp"
#include "topology/kernel/ids.hpp"

namespace sunder {

/// How the iterations of a step went; nothing of integrators that have none.
struct SolveReport {
  std::uint64_t sub_steps = 0;          ///< of sub_stepped, the most of any component
  std::uint64_t iterations = 0;         ///< the most of any component
  std::uint64_t force_evaluations = 0;  ///< of all components
  std::uint64_t not_converged = 0;      ///< components whose step the factor took instead
};

/// Over a run: sums of the steps' worst, and the steps in which iterations were given up.
constexpr auto counters_of(const SolveReport*) {
  return std::tuple{Counter{"iterations", &SolveReport::iterations, Adds::most, Adds::sum},
                    Counter{"force_evaluations", &SolveReport::force_evaluations},
                    Counter{"not_converged", &SolveReport::not_converged, Adds::sum, Adds::once},
                    Counter{"sub_steps", &SolveReport::sub_steps, Adds::most, Adds::sum}};
}

enum class StepOutcome {
  fine,
  not_a_number,        ///< a position or velocity is not finite
  diverged,            ///< a vertex is farther from its reference than ten radii of its component
  overturned,          ///< loads turn a component by more than half a turn within the step
  too_many_sub_steps,  ///< sub_stepped would need more than allowed; nothing was stepped
};

/// How a step went; never silent.
struct StepStatus {
  StepOutcome outcome = StepOutcome::fine;
  VertexId vertex;          ///< the first vertex that shows it
  ComponentId component;    ///< its component
  double displacement = 0;  ///< m, of that vertex
  double turned = 0;        ///< rad, of that component, for `overturned`
  double time = 0;          ///< s, end of the step
  double damping_work = 0;  ///< J taken by Rayleigh damping in this step
  SolveReport solve;
};

/// Adds another part of the same step: outcome, vertex and time are the part's.
void add_status(StepStatus& sum, StepStatus part);

/// The finding that says a step failed: where, value, remedy. Needs an outcome other than fine.
Finding to_finding(const StepStatus& status);

}  // namespace sunder
