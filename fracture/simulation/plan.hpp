// SPDX-License-Identifier: MIT
// In which parts a step is taken: whole, in equal sub-steps, or through impact windows.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "fracture/simulation/boundary.hpp"
#include "fracture/simulation/part.hpp"

namespace sunder {

/// The parts of one step as they come about; each depends on what the one before met.
struct StepPlan {
  enum class Phase {
    whole,        ///< one part for everybody
    whole_done,   ///< which was taken
    equal,        ///< `parts` of one length, of an explicit integrator
    others,       ///< those whom open windows do not concern, the whole step
    others_done,  ///< which was taken
    members,      ///< then those whom windows do concern, in sub-steps
  };
  Phase phase = Phase::whole;
  double start = 0;             ///< s, when the step begins
  Vec3 gravity = Vec3::Zero();  ///< m/s^2, over the step
  std::uint32_t parts = 1;      ///< of `equal`
  std::uint32_t taken = 0;      ///< parts so far

  /// Members of the part at hand; rows of components and obstacles, empty: all.
  std::vector<char> components, balls;
  Boundary boundary;  ///< who is who once windows are open
  double reach = 0;   ///< m, `reach_of_step` as the roles were given
  /// |C|, Pa: of the weakest vertex, as the part at hand begins; kept in the scratch.
  std::vector<double>& strength;
  /// |C|, J: below it none of its vertices can break; kept in the scratch, empty: all can.
  std::vector<double>& threshold;
  BreakEnergyScratch& break_energy;
  ImpactReport impact;
  double blow = 0;                  ///< s, when the first blow falls
  std::uint64_t left = 0;           ///< sub-steps that the members have before them
  std::uint64_t still = 0;          ///< how many of them they now go with frozen deformations
  bool throughout = false;          ///< every sub-step is taken finely
  bool hurried = false;             ///< what is left is taken at once (`Simulation::hurry`)
  std::vector<Obstacle> obstacles;  ///< as they were at the start

  StepMembers members() const { return {components, balls}; }
};

/// The plan of a step from the state as it is. With impact windows a part may be refused for blows
/// that lie ahead; windows open, and the plan goes on from there (docs/impact.md).
StepPlan plan_step(const Scene& scene, SimulationState& state, SimulationScratch& scratch);

/// The next part; nothing when the step is through. Times and driven obstacles go back to where the
/// part begins; windows close where the limit on sub-steps is reached.
std::optional<PlannedPart> next_part(StepPlan& plan, const Scene& scene, SimulationState& state);

/// Tells the plan what became of the part that it gave last: windows open, stay or close.
void note_part(StepPlan& plan, const PlannedPart& part, const ContactStepResult& result,
               const Scene& scene, SimulationState& state);

/// Components in which cracks run, ascending, none twice, as what a blow has struck.
Blows struck_by_cracks(std::vector<ComponentId> components, const Scene& scene,
                       const MechanicsState& mechanics);

/// Opens windows for what fans have just cracked, after `rebuild_pieces` (`CrackMode::object`): a
/// crack runs on with the waves, and a step whose load grows meanwhile would break what the crack
/// relieves.
void note_fans(StepPlan& plan, const Scene& scene, SimulationState& s,
               std::span<const FanEvent> fans);

}  // namespace sunder
