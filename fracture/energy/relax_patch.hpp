// SPDX-License-Identifier: MIT
// Stresses around fans as they would be once these have opened: a small static solve after them.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "fracture/algorithms/cells.hpp"
#include "fracture/algorithms/fan_event.hpp"

namespace sunder {

/// Deformation as the fans of one `break_vertices` have changed it. For decisions only: the state
/// keeps its displacements, and the dynamics opens the cracks.
struct RelaxedState {
  std::vector<Vec3> displacement;  ///< |V|, m, body frame
  std::vector<Mat3> stress;        ///< |T|, Pa, body frame
  std::vector<std::array<Mat3, 4>> corner_stress;  ///< as that of `ElementColumns`
  /// N: what acts on rows that split, by the masses of the sides.
  std::map<VertexId, Vec3> share;
  std::vector<VertexId> split;    ///< vertices at what fans have split since the last solve
  std::vector<VertexId> changed;  ///< by the last solve: rows whose star has other stresses now
  std::vector<std::uint32_t> local_row;  ///< |V|, room of the solve
};

/// The deformation of `mechanics`, with no fan yet. O(|V| + |T|).
void start_relaxing(RelaxedState& relaxed, const MechanicsState& mechanics);

/// Takes note of what a fan has just split: divides what acts on each vertex (loads, inertia: what
/// its tetrahedra bore before anything split) by the masses of its sides. O(stars).
void note_fan(RelaxedState& relaxed, const Cells& cells, const MechanicsState& mechanics,
              const FanEvent& fan);

/// Lets the fans noted since the last call open: the vertices less than `rings` rings of tetrahedra
/// away from what they split take their equilibrium, those on the patch's rim are held. Vertices
/// that an earlier patch left out of balance on its rim come to rest once they lie inside of one:
/// patches are blocks of a Gauss-Seidel iteration towards the whole body's equilibrium. A rim that
/// holds lets a crack open less than the body would: the stress at its new tip is a lower bound
/// (docs/lab/energy.md has by how much).
/// Needs: `rings` of 1 or more. `mechanics` is changed during the call only (rims are held).
/// Cost: assembly, factor and solve of the patch: 0.07 ms for two rings around a fan, 0.5 for four.
void relax_around(RelaxedState& relaxed, const Cells& cells, MechanicsState& mechanics,
                  std::uint32_t rings);

}  // namespace sunder
