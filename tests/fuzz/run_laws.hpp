// SPDX-License-Identifier: MIT
// Promises of the readers of scenes, saved states, event logs, checkpoints and kernels' answers,
// whatever the bytes are. Targets as those of reader_laws.hpp.
#pragma once

#include <span>
#include <string>

#include "reader_laws.hpp"

namespace sunder::test {

/// scene (read, built, three steps), state (restored), log (read, and replayed where it may be),
/// checkpoint (a run resumed from it), protocol (answers of a kernel that is a process). Checksums
/// are made right first where a format has one: without that hardly a change would get past it.
std::span<const FuzzTarget> run_targets();

/// The largest share of its memory bound that an input took.
double largest_run_share();

/// An input that is right for a target, to change.
std::string seed_of(const FuzzTarget& target);

}  // namespace sunder::test
