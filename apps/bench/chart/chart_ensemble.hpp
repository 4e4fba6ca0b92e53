// SPDX-License-Identifier: MIT
// Runs that differ by nothing, or by the mesh: one run of a chaotic system is no result.
#pragma once

#include <span>

#include "apps/bench/chart/chart_run.hpp"
#include "fracture/scene/scene.hpp"

namespace sunder {

/// Moves every body and its velocity by up to 1e-12 (m, m/s; each axis by itself) and multiplies
/// its strengths and toughnesses by one number within 1e-6 of 1. Depends on `member` alone; member
/// 0 is left as it is.
void move_by_nothing(Scene& scene, std::size_t member);

/// The values of several runs of one setting, summarised.
struct ChartBand {
  Vec3 mean = Vec3::Zero();
  /// Least and largest, each component by itself.
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();
  /// Root of the mean square distance from the mean, n - 1 for n; 0 of one run.
  double deviation = 0;
};

/// Needs: at least one value.
ChartBand band_of(std::span<const Vec3> values);

/// `members` runs of a setting, the first as it is and (with `timed`) timed, the others moved by
/// nothing or on the runner's other meshes: `value` is their mean and `values` are all of them.
/// Where one ends otherwise than fine, so does the whole, and the reason names it.
ChartOutcome run_ensemble(const ChartRunner& runner, std::size_t members,
                          std::span<const std::string> changes, std::size_t mesh, bool timed);

}  // namespace sunder
