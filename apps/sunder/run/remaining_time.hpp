// SPDX-License-Identifier: MIT
// The computing time that a run still needs: the expected rate, corrected by the measured one.
#pragma once

#include "fracture/scene/expected_time.hpp"

namespace sunder {

/// Follows a run. The expected rate of each phase counts as if it had been measured over a
/// hundredth of the run; older measurements fade over a twentieth of the run.
class RemainingTime {
 public:
  /// Of a run from the simulated time `begin` to `end`, s.
  RemainingTime(ExpectedTime expected, double begin, double end);

  /// The run has reached the simulated time `time` after `elapsed` s of computing. Times never
  /// decrease.
  void reach(double time, double elapsed);

  /// s of computing from the last `reach` to the end.
  double left() const;

 private:
  void enter(std::size_t phase);
  /// Enters the phase of the time reached.
  void reach_phase();
  double end_of(std::size_t phase) const;

  ExpectedTime expected_;
  double end_, time_, elapsed_ = 0;
  std::size_t phase_ = 0;
  /// s of computing and s simulated, faded.
  double computed_ = 0, simulated_ = 0, fade_;
};

}  // namespace sunder
