// SPDX-License-Identifier: MIT
// Algorithm 3: which vertices break in this step, in which order, and what became of the others.
#pragma once

#include <cstddef>
#include <vector>

#include "fracture/energy/relax_patch.hpp"
#include "fracture/algorithms/fracture_report.hpp"
#include "fracture/algorithms/split_fan.hpp"
#include "fracture/algorithms/stress_fit.hpp"
#include "mechanics/step.hpp"

namespace sunder {

/// Working memory of `find_fractures`.
struct FractureScratch {
  /// |V|, Pa, as it stands after the fans of the last call; for display too.
  std::vector<Mat3> node_stress;
  std::vector<double> weight;  ///< |V|, of `average_node_stress`
  std::vector<char> rows;      ///< |V|: looked at
  std::vector<char> broken;    ///< |V|: broken in this call
  std::vector<double>
      queued;     ///< |V|: overstress with which it stands in the queue; 0: it does not
  StressFit fit;  ///< of the node stress `fit`
  FanScratch fan;
  RelaxedState relaxed;  ///< with `FractureSettings::relax`
};

/// Node stress of every vertex in one of its modes, Pa, rest frame: for reports. The fit's weights
/// are made anew.
std::vector<Mat3> node_stress_of(const Cells& cells, const MechanicsState& mechanics,
                                 NodeStress mode);

/// Algorithm 3, on the element stresses in `mechanics` (Pa, rest frame of each component):
/// node stress (eq. 6), the test against the threshold (eq. 7), and for the vertices that reach
/// theirs a fan each (algorithm 4), most overstressed first.
///
/// Candidates whose overstresses differ by no more than 1e-6 from one to the next are tied: planes
/// and faces of all of them are decided on the state as it is before any of them is split. So what
/// breaks first does not depend on the numbers of vertices, and mirror images break alike: their
/// stresses differ by the rounding of sums in another order and of the solver, 1e-9 and less. Held
/// by tests for mirrors across the coordinate planes of the mesh through the body's mass centre.
/// What cannot be alike: a vertex on the mirror's plane whose best fan is not its own image has one
/// of two images, by `choose_fan`'s last rule; and the limits on pieces, which know an order.
///
/// After the fans of a tie the stress of every vertex they split is measured again, of old rows as
/// of new, and those over their threshold take part with it. A vertex and its copies break once a
/// step at most: the element stresses are those from before, and breaking on them again would grind
/// the star to single tetrahedra. With `fit`, neighbours of what split are measured again when
/// their turn comes.
///
/// With `relax` the stresses around the fans of a tie are solved for again and decide from there
/// on: whoever they bring over the threshold joins the queue, whoever they relieve leaves it.
///
/// A vertex whose fan is empty or was refused waits until its stress changes, untested: until its
/// tensor over its norm differs by more than 0.01 (Frobenius; half a degree; a stress that only
/// grows keeps its planes), it has been below its threshold, or it has been split.
/// Leaves `mechanics.elements.component`, masses and frames to the caller (`rebuild`).
/// Only vertices of `members` are tested; the others are in another part of the step.
FractureReport find_fractures(Cells& cells, MechanicsState& mechanics,
                              const FractureSettings& settings, FractureScratch& scratch,
                              const StepMembers& members = {});

}  // namespace sunder
