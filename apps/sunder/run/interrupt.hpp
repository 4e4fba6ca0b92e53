// SPDX-License-Identifier: MIT
// Signals that end a run in good order.
#pragma once

#include <atomic>

namespace sunder {

// A signal handler can reach nothing but a global.

/// Set by a signal: the run ends after this step.
inline std::atomic<bool> was_interrupted = false;
/// Set by a signal: the step at hand is cut short.
inline std::atomic<bool> hurry = false;
/// Set by the run: it could go on from the start of the step at hand.
inline std::atomic<bool> start_is_kept = false;
/// Set by the run: else there is nothing to end in good order.
inline std::atomic<bool> writes_files = false;

/// Resets these four, and watches for signals. SIGINT, SIGTERM and SIGHUP end the program at once
/// while nothing is written yet. Then they end the run after the step at hand, and that step as
/// soon as it can: at once where the run can go on from the step's start, else after a time in
/// which most steps end. A later signal ends the program at once.
void watch_for_interrupt();

}  // namespace sunder
