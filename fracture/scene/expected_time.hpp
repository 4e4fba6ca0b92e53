// SPDX-License-Identifier: MIT
// How long a run will take, before it begins.
#pragma once

#include <vector>

#include "fracture/scene/scene.hpp"

namespace sunder {

/// The computing time of a run, on one core of a server: a rate that changes when things touch and
/// break.
struct ExpectedTime {
  struct Phase {
    /// s, simulated, at which it begins.
    double begin = 0;
    /// s of computing per simulated second.
    double rate = 0;
  };
  /// One at least; the first begins at 0.
  std::vector<Phase> phases = {{}};

  /// s of computing from the simulated time `from` to `to`. Needs: 0 <= from <= to.
  double between(double from, double to) const;
};

/// ms that a step of the whole scene in full takes in flight, where nothing touches or breaks: from
/// the number of tetrahedra and their order, mostly to a factor of two (docs/lab/defaults.md).
double flight_ms(const Scene& scene);

/// Estimates a run of the scene. Bodies move as boxes that stop each other. Resting contact ends
/// when they fall asleep. After a blow with a stress rho c v well above the strength, or when
/// supports or driven obstacles have pressed a body to it, that body cracks throughout; then its
/// debris meets to the end. The factors are measured (tests/experiments/expected_time). Needs: a
/// scene and meshes without errors, settings chosen.
ExpectedTime expected_time(const Scene& scene);

}  // namespace sunder
