// SPDX-License-Identifier: MIT
// The one assertion macro: for mistakes of a programmer, never for a user's input.
#pragma once

#include <cstdio>
#include <cstdlib>

#ifdef NDEBUG
#define SUNDER_ASSERT(condition, message) ((void)sizeof((condition) ? 1 : 0))
#else
/// Stops the program with `message` and the place when `condition` does not hold (debug builds).
#define SUNDER_ASSERT(condition, message)                                                    \
  ((condition)                                                                               \
       ? (void)0                                                                             \
       : (std::fprintf(stderr, "%s:%d: %s (%s)\n", __FILE__, __LINE__, message, #condition), \
          std::abort()))
#endif
