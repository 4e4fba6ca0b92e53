// SPDX-License-Identifier: MIT
// Times of a run of any length in little memory.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

namespace sunder {

/// Times, ms or us: mean and largest of all, median and 99th percentile of a sample of at most
/// `most_kept`, so that the memory of a long run does not grow.
struct TimeSample {
  static constexpr std::size_t most_kept = 1U << 14;

  std::uint64_t count = 0;
  double sum = 0;
  float largest = 0;
  /// Of the times in their order those number 0, stride, 2 stride, ...
  std::vector<float> kept;
  /// Doubled, and every second time let go, whenever `kept` is full.
  std::uint64_t stride = 1;
};

/// Adds a time. O(1) in the mean.
void add(TimeSample& sample, double time);

/// `mean`, `median`, `p99` and `max`, as report.json has them: 0 without any time. O(n log n) in
/// the times kept.
nlohmann::ordered_json distribution(const TimeSample& sample);

}  // namespace sunder
