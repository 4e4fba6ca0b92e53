// SPDX-License-Identifier: MIT
// A step at work, whole or in parts: what simulation.cpp and impact_step.cpp share.
#pragma once

#include <chrono>

#include "fracture/simulation/simulation_state.hpp"

namespace sunder {

/// Adds the time until the end of its scope to a stage.
class StageTimer {
 public:
  StageTimer(StepReport& report, Stage stage)
      : ms_(report.stage_ms[static_cast<std::size_t>(stage)]) {}
  ~StageTimer() {
    ms_ += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_)
               .count();
  }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  double& ms_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// One step on its way.
struct StepWork {
  Simulation& sim;
  const StepObserver& observe;
  Loads loads;
  StepReport report;
  /// Members of the part at hand; rows of components and obstacles, empty: all.
  std::vector<char> components, balls;

  StepMembers members() const { return {components, balls}; }
  bool failed() const {
    return report.status.outcome != StepOutcome::fine || report.fracture.not_a_number.has_value() ||
           report.departed;
  }
};

/// Which part of a step comes next and how long it is, s.
struct PartPlan {
  StepPart part;
  double length = 0;
};

/// What of it there is to know.
struct PartResult {
  bool adopted = true;
  Blows blows;
};

/// Contact and mechanics of one part for the members; the report grows by it.
PartResult take_part(StepWork& work, const PartPlan& plan);

/// Fracture of the members at the state as it is, and the components that come of it. Pieces of
/// members are members, and have their share in open windows.
void break_members(StepWork& work);

/// A step of the integrator sub_stepped: equal parts below nine tenths of the least element bound,
/// each with contact and cracks of its own.
void advance_sub_stepped(StepWork& work);

/// What the bodies as they are ask of a bounded integrator beyond its bounds: a warning for verlet
/// above its step, errors for sub_stepped above its count and modal above its size. Splits only
/// make bodies smaller.
std::vector<Finding> check_integrator_bounds(Simulation& sim);

/// A step in which components may be struck: blows ahead open windows (docs/impact.md).
void advance_with_windows(StepWork& work);

}  // namespace sunder
