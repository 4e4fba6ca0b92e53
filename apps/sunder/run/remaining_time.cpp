// SPDX-License-Identifier: MIT
// A faded mean of the rate in the phase at hand, expected rates in later ones.
#include "apps/sunder/run/remaining_time.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sunder {

RemainingTime::RemainingTime(ExpectedTime expected, double begin, double end)
    : expected_(std::move(expected)),
      end_(end),
      time_(begin),
      fade_(std::max(0.0, end - begin) / 20) {
  enter(0);
  reach_phase();
}

void RemainingTime::enter(std::size_t phase) {
  phase_ = phase;
  simulated_ = fade_ / 5;
  computed_ = expected_.phases[phase].rate * simulated_;
}

void RemainingTime::reach_phase() {
  while (time_ < end_ && time_ >= end_of(phase_)) enter(phase_ + 1);
}

double RemainingTime::end_of(std::size_t phase) const {
  return phase + 1 < expected_.phases.size() ? std::min(end_, expected_.phases[phase + 1].begin)
                                             : end_;
}

void RemainingTime::reach(double time, double elapsed) {
  const double step = time - time_;
  if (!(step > 0)) return;  // within a step that has come no further
  const double keep = std::exp(-step / fade_);
  computed_ = keep * computed_ + elapsed - elapsed_;
  simulated_ = keep * simulated_ + step;
  time_ = time;
  elapsed_ = elapsed;
  reach_phase();
}

double RemainingTime::left() const {
  if (!(simulated_ > 0) || time_ >= end_) return 0;
  const double now = end_of(phase_);
  return computed_ / simulated_ * std::max(0.0, now - time_) + expected_.between(now, end_);
}

}  // namespace sunder
