// SPDX-License-Identifier: MIT
// The plan of a step: plain data.
#pragma once

#include <cstdint>
#include <vector>

#include "fracture/simulation/boundary.hpp"
#include "fracture/simulation/state.hpp"
#include "fracture/simulation/step_report.hpp"
#include "mechanics/contact/step_division.hpp"

namespace sunder {

/// The parts of one step as they come about; each depends on the contacts of the one before.
struct StepPlan {
  enum class Phase {
    whole,        ///< one part for all bodies
    whole_done,   ///< which was taken
    equal,        ///< `parts` of one length: of an explicit integrator, or of a divided step
    others,       ///< bodies outside open windows, the whole step
    others_done,  ///< which was taken
    members,      ///< then bodies in windows and near them, in sub-steps
  };
  Phase phase = Phase::whole;
  double start = 0;             ///< s, when the step begins
  Vec3 gravity = Vec3::Zero();  ///< m/s^2, over the step
  StepDivision division;        ///< of `equal`
  bool divides = false;         ///< parts in which pieces would pass each other are divided

  /// Members of the part at hand; rows of components and obstacles, empty: all.
  std::vector<char> components, balls;
  Boundary boundary;  ///< roles of bodies once windows are open
  double reach = 0;   ///< m, `reach_of_step` as the roles were given
  /// |C|, Pa: of the weakest vertex, as the part at hand begins; kept in the scratch.
  std::vector<double>& strength;
  /// |C|, J: below it none of its vertices can break; kept in the scratch, empty: all can.
  std::vector<double>& threshold;
  BreakEnergyScratch& break_energy;
  bool knows_strengths = false;  ///< both are those of the pieces as they are
  /// Row = ComponentId: declared never to break (`note_unbreakable`).
  const std::vector<char>& declared;
  ImpactReport impact;
  double released = 0;              ///< J, of pieces that stopped deforming (`stiffen_members`)
  double blow = 0;                  ///< s, when the first blow falls
  std::uint64_t left = 0;           ///< sub-steps that the members have before them
  std::uint64_t still = 0;          ///< how many of them they now go with frozen deformations
  std::uint64_t served = 0;         ///< sub-steps for which contacts that were found still serve
  std::uint32_t together = 1;       ///< sub-steps of an explicit wave in the part to come, at most
  bool throughout = false;          ///< every sub-step is taken finely
  bool hurried = false;             ///< the rest is taken at once (`Simulation::hurry`)
  std::vector<Obstacle> obstacles;  ///< as they were at the start

  StepMembers members() const { return {components, balls}; }
};

}  // namespace sunder
