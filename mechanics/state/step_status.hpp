// SPDX-License-Identifier: MIT
// The outcome of a step, and how its equations were solved.
#pragma once

#include <cstdint>

#include "topology/base/counters.hpp"
#include "topology/base/finding.hpp"
#include "topology/base/ids.hpp"

namespace sunder {

/// The iterations of a step; all zero for integrators without iterations.
struct SolveReport {
  std::uint64_t sub_steps = 0;          ///< of sub_stepped; maximum over components
  std::uint64_t iterations = 0;         ///< maximum over components
  std::uint64_t force_evaluations = 0;  ///< sum over components
  std::uint64_t not_converged = 0;      ///< components solved with the factor instead
};

/// Over a run: sums of the steps' maxima, and the number of steps in which iterations were given
/// up.
constexpr auto counters_of(const SolveReport*) {
  return std::tuple{Counter{"iterations", &SolveReport::iterations, Adds::most, Adds::sum},
                    Counter{"force_evaluations", &SolveReport::force_evaluations},
                    Counter{"not_converged", &SolveReport::not_converged, Adds::sum, Adds::once},
                    Counter{"sub_steps", &SolveReport::sub_steps, Adds::most, Adds::sum}};
}

/// rad: a longer turn within one step is not followed.
inline constexpr double longest_turn = 1024;

enum class StepOutcome {
  fine,
  not_a_number,        ///< a position or velocity is not finite
  diverged,            ///< a vertex is farther from its reference than ten radii of its component
  overturned,          ///< loads turn a component by more than half a turn within the step
  spun_too_far,        ///< a component turns by more than `longest_turn` within the step
  too_many_sub_steps,  ///< sub_stepped would need more than allowed; no step was taken
};

/// The outcome of a step, with the evidence of a failure.
struct StepStatus {
  StepOutcome outcome = StepOutcome::fine;
  VertexId vertex;          ///< the first vertex with the failure
  ComponentId component;    ///< its component
  double displacement = 0;  ///< m, of that vertex
  double turned = 0;        ///< rad, of that component within the step, where it turns freely
  double time_step = 0;     ///< s, of the part of the step
  double time = 0;          ///< s, end of the step
  double damping_work = 0;  ///< J taken by Rayleigh damping in this step
  SolveReport solve;
};

/// Adds another part of the same step. Outcome, vertex and time are taken from the part.
void add_status(StepStatus& sum, StepStatus part);

/// The finding of a failed step: place, value, remedy. Requires: an outcome other than fine.
Finding to_finding(const StepStatus& status);

}  // namespace sunder
