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
  std::vector<Vec3> displacement;                  ///< |V|, m, body frame
  std::vector<Mat3> stress;                        ///< |T|, Pa, body frame
  std::vector<std::array<Mat3, 4>> corner_stress;  ///< as that of `ElementColumns`
  /// N: force on rows that split, shared between the sides by their masses.
  std::map<VertexId, Vec3> share;
  std::vector<VertexId> split;    ///< vertices that fans have split since the last solve
  std::vector<VertexId> changed;  ///< by the last solve: rows with a star of changed stresses
  std::vector<std::uint32_t> local_row;  ///< |V|, room of the solve
};

/// The deformation of `mechanics`, with no fan yet. O(|V| + |T|).
void start_relaxing(RelaxedState& relaxed, const MechanicsState& mechanics);

/// Takes note of a new fan: shares the force on each vertex between its sides by their masses. The
/// force is that of loads and inertia, as borne by its tetrahedra before anything split. O(stars).
void note_fan(RelaxedState& relaxed, const Cells& cells, const MechanicsState& mechanics,
              const FanEvent& fan);

/// Lets the fans noted since the last call open. The vertices less than `rings` rings of tetrahedra
/// away from split vertices take their equilibrium, those on the patch's rim are held. Vertices
/// that an earlier patch left out of balance on its rim come to rest once they lie inside of one.
/// So patches are blocks of a Gauss-Seidel iteration towards the whole body's equilibrium. A rim
/// that holds lets a crack open less than the body would. The stress at its new tip is thus a lower
/// bound (docs/lab/energy.md has the difference).
/// Needs: `rings` of 1 or more. `mechanics` is changed during the call only (rims are held).
/// Cost: assembly, factor and solve of the patch: 0.07 ms for two rings around a fan, 0.5 for four.
void relax_around(RelaxedState& relaxed, const Cells& cells, MechanicsState& mechanics,
                  std::uint32_t rings);

}  // namespace sunder
