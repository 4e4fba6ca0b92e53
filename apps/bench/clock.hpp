// SPDX-License-Identifier: MIT
// Clocks and medians for measurements.
#pragma once

#include <time.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <vector>

namespace sunder {

/// Microseconds of work of this thread, which the load of others on the machine hardly changes.
/// Asking costs a system call (0.3 us): for stretches of work, not for single operations.
inline double thread_us() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e6 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_nsec);
}

/// Microseconds on the wall; asking costs 0.03 us. For single operations, of which the median over
/// several runs is taken.
inline double wall_us() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double, std::micro>(now).count();
}

/// Needs: not empty. The upper one of two middle values.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace sunder
