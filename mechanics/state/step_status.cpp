// SPDX-License-Identifier: MIT
// Parts of a step added up, and the finding that says a step failed.
#include "mechanics/state/step_status.hpp"

#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "topology/base/assert.hpp"

namespace sunder {

void add_status(StepStatus& sum, StepStatus part) {
  part.damping_work = sum.damping_work + part.damping_work;
  add_part(part.solve, sum.solve);
  sum = std::move(part);
}

Finding to_finding(const StepStatus& status) {
  SUNDER_ASSERT(status.outcome != StepOutcome::fine, "to_finding: the step was fine");
  Finding finding;
  finding.ids = {static_cast<std::int64_t>(status.vertex.value)};
  finding.remedy =
      "Take a shorter time_step (for verlet below explicit_step_bound) or the integrator "
      "floating_frame; look for loads that are too large for young_modulus.";
  char text[200];
  char shorter[120];
  if (status.turned > M_PI) {
    // Half a turn per step: the limit of an extrapolation through the step.
    std::snprintf(shorter, sizeof shorter,
                  "Take a time_step below %.3g s: the component turns by %.3g rad within %.3g s.",
                  status.time_step * M_PI / status.turned, status.turned, status.time_step);
    finding.remedy = shorter;
  }
  if (status.outcome == StepOutcome::overturned) {
    finding.code = "overturned";
    finding.ids = {static_cast<std::int64_t>(status.component.value)};
    std::snprintf(text, sizeof text,
                  "At %.9g s the loads on component %u, which keep their direction, turn it by "
                  "%.3g rad within one step.",
                  status.time, status.component.value, status.turned);
    finding.remedy =
        "Take a shorter time step, hold the body, or give the load as a pressure, which turns with "
        "it.";
  } else if (status.outcome == StepOutcome::spun_too_far) {
    finding.code = "spun_too_far";
    finding.ids = {static_cast<std::int64_t>(status.component.value)};
    std::snprintf(text, sizeof text,
                  "At %.9g s component %u spins by %.3g rad within one step: up to %g rad are "
                  "followed.",
                  status.time, status.component.value, status.turned, longest_turn);
  } else if (status.outcome == StepOutcome::too_many_sub_steps) {
    finding.code = "too_many_sub_steps";
    finding.ids.clear();
    std::snprintf(text, sizeof text,
                  "The step that ends at %.9g s would need %u explicit sub-steps, more than "
                  "max_sub_steps.",
                  status.time, static_cast<unsigned>(status.solve.sub_steps));
    finding.remedy =
        "Raise integrator.max_sub_steps, take a shorter time step, or use floating_frame.";
  } else if (status.outcome == StepOutcome::diverged) {
    finding.code = "diverged";
    std::snprintf(text, sizeof text,
                  "At %.9g s vertex %u of component %u is displaced by %.6g m, more than ten radii "
                  "of its component.",
                  status.time, status.vertex.value, status.component.value, status.displacement);
  } else {
    finding.code = "not_a_number";
    std::snprintf(text, sizeof text,
                  "At %.9g s the position or velocity of vertex %u of component %u is not a finite "
                  "number.",
                  status.time, status.vertex.value, status.component.value);
  }
  finding.text = text;
  return finding;
}

}  // namespace sunder
