// SPDX-License-Identifier: MIT
// How long each fan of a search takes, for reports.
#pragma once

#include <chrono>
#include <unordered_map>

#include "fracture/algorithms/fan_event.hpp"

namespace sunder {

/// Adds up the wall time of work on each vertex's fan.
class FanClock {
 public:
  /// For `break_vertices` and `make_fans`; for as long as this clock lives.
  FanWatch watch() {
    return [this](VertexId v) { turn_to(v); };
  }
  /// us, of the fan of `v`: choosing its plane and splitting it; 0 where there was none.
  double us(VertexId v) const {
    const auto at = us_.find(v);
    return at == us_.end() ? 0 : at->second;
  }

 private:
  using Clock = std::chrono::steady_clock;

  void turn_to(VertexId v) {
    const Clock::time_point now = Clock::now();
    if (!vertex_.is_none()) {
      us_[vertex_] += std::chrono::duration<double, std::micro>(now - since_).count();
    }
    vertex_ = v;
    since_ = now;
  }

  VertexId vertex_;
  Clock::time_point since_;
  std::unordered_map<VertexId, double> us_;
};

}  // namespace sunder
