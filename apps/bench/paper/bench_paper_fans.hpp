// SPDX-License-Identifier: MIT
// Fans of a run, cut again with every way of finding components; and the threshold tests, timed.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "apps/bench/paper/bench_paper_run.hpp"

namespace sunder {

/// Times that one way of finding components takes for the fans of a run.
struct FanTimes {
  /// us, means over fans without [0] and with [1] a new component: faces, rows, components and
  /// strengths (`split_fan`); 0 where there was none.
  std::array<double, 2> split_us{};
  /// Tetrahedra met by splits and search, means likewise.
  std::array<double, 2> visited{};
};

struct FanReplay {
  /// Row = `Detection`.
  std::array<FanTimes, 4> ways;
  /// us, means likewise: choosing the plane and its faces, the same in every way.
  std::array<double, 2> choose_us{};
  std::array<std::size_t, 2> fans{};
  /// Median over the fans with a new component of the time with oracle over that without it.
  double oracle_cost = 1;
  /// Fans with a new component at which the oracle was silent, as the walks tell.
  std::size_t missed = 0;
};

/// Cuts `fans` in their order on fresh bodies of the same scene, `repeats` times for each way in
/// turn; the time of a fan is the median of its repeats. All ways have the same fans, so that their
/// times can be compared. Needs: `fans` of a run of the same settings; repeats >= 1.
Result<FanReplay> replay_fans(const PaperRunSettings& settings, std::span<const RecordedFan> fans,
                              int repeats);

/// ns a vertex, over samples: Gershgorin's bound alone, and the whole test in each way.
struct TestTimes {
  double bound = 0;
  std::array<double, 4> ways{};  ///< row = `ThresholdTest`
};

/// Each is the median of `repeats` passes over all samples; 0 without samples.
TestTimes time_threshold_tests(std::span<const StressSample> samples, int repeats);

}  // namespace sunder
