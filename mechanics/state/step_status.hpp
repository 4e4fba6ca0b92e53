// SPDX-License-Identifier: MIT
// How a step went: sound or not, and how its equations were solved.
#pragma once

#include <cstdint>

#include "topology/kernel/finding.hpp"
#include "topology/kernel/ids.hpp"

namespace sunder {

/// How the iterations of a step went; nothing of integrators that have none.
struct SolveReport {
  std::uint32_t sub_steps = 0;          ///< of sub_stepped, the most of any component
  std::uint32_t iterations = 0;         ///< the most of any component
  std::uint32_t force_evaluations = 0;  ///< of all components
  std::uint32_t not_converged = 0;      ///< components whose step the factor took instead
};

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

/// Adds the iterations of another component, or of another part of a step.
void add_solve(SolveReport& sum, const SolveReport& part);

/// The finding that says a step failed: where, value, remedy. Needs an outcome other than fine.
Finding to_finding(const StepStatus& status);

}  // namespace sunder
