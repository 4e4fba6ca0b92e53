// SPDX-License-Identifier: MIT
// The troubles that a run must report: work left undone, solves that did not end, energy that came
// from nowhere.
#pragma once

#include <cstdint>
#include <vector>

#include "fracture/simulation/simulation_state.hpp"

namespace sunder {

/// One kind of trouble over the steps of a run.
struct Trouble {
  std::uint64_t first = 0, last = 0, steps = 0;  ///< first and last step that had it, and how many
  double size = 0;                               ///< the worst, or the sum, in the kind's unit

  void note(std::uint64_t step) {
    if (steps++ == 0) first = step;
    last = step;
  }
};

/// Kinetic and strain energy of everything that moves less the work that came in from gravity,
/// loads, supports and driven obstacles. The rest may sink (sliding, blows without a bounce,
/// damping, cracks) and never rise. J; 0 at the start.
struct EnergyBalance {
  double level = 0, lowest = 0;
  double risen = 0;        ///< most that it has stood above an earlier level
  double most = 0;         ///< largest kinetic and strain energy so far
  double weight = 0;       ///< m g L, summed over bodies and free balls at the start
  double work = 0;         ///< magnitudes of the work from outside but of gravity, summed
  double body_energy = 0;  ///< kinetic and strain energy of bodies at the end of the last step
  double ball_energy = 0;  ///< kinetic energy of free balls there
  std::vector<Vec3> ball_centre;  ///< row = obstacle
};

/// Troubles of a run as its steps come.
struct RunTroubles {
  Trouble left_out;       ///< contacts, summed
  Trouble not_converged;  ///< contact; m, the worst residual
  Trouble overlaps;       ///< over a twentieth of the mean edge; m, the deepest
  Trouble stopped;        ///< sub-steps of windows that ran out
  Trouble given_up;       ///< iterations of the integrator
  Trouble residual;       ///< steps with an energy ledger off by more than a hundredth; J, worst
  Trouble risen;          ///< J, most
  double residual_size = 0, moved = 0;  ///< J, sums over the run
  double mean_edge = 0;                 ///< m, of tetrahedra at rest
  EnergyBalance balance;
};

/// J, the scene's own energy so far, with which errors are compared: the largest of the kinetic and
/// strain energy that there was, the work from outside, and the weight's, m g L.
double energy_of_scene(const EnergyBalance& balance);

/// The troubles of a run that stands at its start: none.
RunTroubles begin_troubles(const Simulation& start);

/// Adds a step. O(obstacles).
void note_troubles(RunTroubles& troubles, const Simulation& now, const StepReport& report);

/// A warning per kind that there was, with first and last step, size and remedy. Of energy only
/// where the scene keeps its ledger, and above rounding: a millionth of `energy_of_scene`. Sweeps
/// of contact that did not converge count where a gap is off by more than `allowed_penetration` and
/// than a thousandth of the mean edge, where energy rose or something lay deep, or without a
/// ledger.
std::vector<Finding> warnings_of(const RunTroubles& troubles, const Scene& scene);

}  // namespace sunder
