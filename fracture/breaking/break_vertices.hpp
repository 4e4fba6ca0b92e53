// SPDX-License-Identifier: MIT
// Algorithms 3 and 4 as runs use them: the order of breaking vertices, the state of each decision,
// and the fate of the other vertices.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fracture/algorithms/find_fractures.hpp"
#include "fracture/breaking/planned_fan.hpp"
#include "fracture/energy/relax_patch.hpp"
#include "mechanics/state/step_input.hpp"

namespace sunder {

/// Working memory of `break_vertices`.
struct FractureScratch {
  /// As it stands after the fans of the last call; for display too.
  NodeStressField node_stress;
  std::vector<char> rows;     ///< |V|: looked at
  std::vector<char> cracked;  ///< |V|: at a crack; with the criterion `energy` only
  /// |V|, or none where no fan is empty: 1 + its place in `Cells::empty_fans`; 0: not there
  std::vector<std::uint32_t> held;
  std::vector<char> broken;      ///< |V|: broken in this call
  std::vector<VertexId> flanks;  ///< that waited there; some twice
  /// |V|: overstress with which it stands in the queue; 0: it does not
  std::vector<double> queued;
  ComponentScratch components;
  RelaxedState relaxed;  ///< with `FractureSettings::relax`
};

/// Finds the vertices over their thresholds (algorithm 3, `find_fractures`) on the element stresses
/// in `body.mechanics` (Pa, rest frame of each component). Splits them (algorithm 4, `split_fan`),
/// the most overstressed first.
///
/// Candidates with overstresses that differ by no more than 1e-6 from one to the next are tied.
/// Planes and faces of all of them are decided on the state as it is before any of them is split.
/// So the first break does not depend on the numbers of vertices, and mirror images break alike.
/// Their stresses differ by the rounding of sums in another order and of the solver, 1e-9 and less.
/// Tests check this for mirrors across the coordinate planes of the mesh through the body's mass
/// centre. Two things cannot be alike. A vertex on the mirror's plane with a best fan that is not
/// its own image has one of two images, by `choose_fan`'s last rule. The limits on pieces depend on
/// an order.
///
/// After the fans of a tie the stress of every vertex they split is measured again, of old rows as
/// of new. Those over their threshold take part with it. A vertex and its copies break once per
/// step at most. The element stresses are those from before, and breaking on them again would grind
/// the star to single tetrahedra. With `fit`, neighbours of split vertices are measured again when
/// their turn comes.
///
/// With `relax` the stresses around the fans of a tie are solved for again and decide from there
/// on. Vertices that they bring over the threshold join the queue, and relieved vertices leave it.
///
/// A vertex with an empty or refused fan waits, untested, until its stress changes. Its tensor over
/// its norm then differs by more than 0.01 (Frobenius; half a degree). A stress that only grows
/// keeps its planes. The vertex also ends its wait when it has been below its threshold, or has
/// been split.
/// With `CrackMode::object` vertices on the front of a crack come before those that would start
/// one. After each tie all vertices around its fans are tested again: a crack grows as far as the
/// stresses carry it before the next one starts. Vertices on a flank wait (`choose_crack`).
///
/// Leaves `mechanics.elements.component`, masses and frames to the caller (`rebuild`).
/// Tests only vertices of the components in `members`; the others are stepped separately.
/// `untested`: s, the time since the previous search. Loads have grown during it, so vertices that
/// are overloaded together would have broken one after the other. A new crack therefore holds
/// others back as far as its wave goes in that time (`choose_crack`).
FractureReport break_vertices(BreakableBody body, const FractureSettings& settings,
                              FractureScratch& scratch, const StepMembers& members = {},
                              const FanWatch& watch = {}, double untested = 0);

/// Whether `break_vertices` would look for a crack at any vertex of `members`. Vertices that wait,
/// at a flank or for their stress to change, are left out. O(|T|).
bool any_breaks(BreakableBody body, const FractureSettings& settings, FractureScratch& scratch,
                const StepMembers& members);

/// Splits fans that were decided on one state, in their order: `split_fan`, and the further values
/// of their events. Those with no face left give events without faces.
FanEvent split_planned(BreakableBody body, const PlannedFan& fan, const FractureSettings& settings,
                       ComponentScratch& scratch);

}  // namespace sunder
