// SPDX-License-Identifier: MIT
// One crack through a body under even tension: is it one surface?
#pragma once

#include <cstdint>

#include "fracture/algorithms/fracture_settings.hpp"
#include "mechanics/state/vec3.hpp"
#include "topology/base/tet_mesh.hpp"

namespace sunder::accuracy {

struct EvenTension {
  Vec3 axis = Vec3::UnitZ();  ///< of the tension, unit length
  double noise = 0.2;         ///< rad, of each vertex' own tension: root mean square of its turn
  std::uint64_t seed = 1;     ///< of the noise
  CrackMode crack = CrackMode::object;
};

struct TornBody {
  /// Area of all faces that were unsewn, and of their projections along the axis, over that of the
  /// plane's section through the body.
  double raw = 0, projected = 0;
  /// The same as drawn smooth (`smooth_crack_moves`).
  double smooth_raw = 0, smooth_projected = 0;
  std::size_t pieces = 0, cracks = 0, fans = 0;
  double two_largest = 0;  ///< share of the volume
  std::size_t debris = 0;  ///< tetrahedra outside the two largest pieces
};

/// Breaks the vertex nearest to the middle, and then every vertex on a crack face, in the order in
/// which they get there: as if the tension reached the threshold everywhere at once. No mechanics:
/// the planes of `choose_fan`, or the cracks of `choose_crack`, on tensions turned at random.
TornBody tear(const TetMesh& mesh, const EvenTension& tension);

}  // namespace sunder::accuracy
