// SPDX-License-Identifier: MIT
// A scene on the ladder, always on its top rung, and always on top from a start moved by nothing.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "fracture/simulation/simulation_state.hpp"

namespace sunder::accuracy {

struct LadderOutcome {
  std::vector<std::pair<std::uint64_t, VertexId>> fans;  ///< step and vertex, in order
  std::vector<double> time;                              ///< s, of each fan
  std::size_t pieces = 0;
  double ms = 0;                                     ///< of the processor, all steps
  std::array<std::size_t, rung_count> tetrahedra{};  ///< tetrahedron-steps on each rung
};

/// Steps the scene to its end. Throws where it cannot be built or a step fails.
LadderOutcome run_on_ladder(const Scene& scene);

/// The same scene without the lower rungs.
Scene always_full(Scene scene);

/// The same scene, gravity greater by 1e-12 of itself and bodies faster by 1e-12 m/s: differences
/// of its run are decided by less than any arithmetic.
Scene moved_by_nothing(Scene scene);

/// How many fans of two runs are the same, from the first on.
std::size_t same_fans(const LadderOutcome& a, const LadderOutcome& b);

}  // namespace sunder::accuracy
