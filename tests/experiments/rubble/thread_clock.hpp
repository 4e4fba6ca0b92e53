// SPDX-License-Identifier: MIT
// Processor time, which does not count the work of others on the machine.
#pragma once

#include <ctime>

namespace sunder::test {

/// ms of the processor that the calling thread has taken.
inline double thread_ms() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

/// ms of the processor that all threads of the program have taken.
inline double process_ms() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

}  // namespace sunder::test
