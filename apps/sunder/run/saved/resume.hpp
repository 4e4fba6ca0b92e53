// SPDX-License-Identifier: MIT
// Runs that go on from the checkpoints of a folder: as they were, for longer, or otherwise.
#pragma once

#include <cstdint>
#include <filesystem>

#include "apps/sunder/run/recorder.hpp"

namespace sunder {

/// A run that stands where it can be stepped.
struct RunOnItsWay {
  SceneFile file;
  Simulation simulation;
  Recorder recorder;
};

/// Goes on in `folder` from its latest checkpoint; later content of the folder is removed. `until`
/// above 0: to that time, s; frames and pictures go on at the distance they have. Errors:
/// those of `read_checkpoint` and `Recorder::go_on`, other_log (events.jsonl is not that of the
/// checkpoint), over_already; too_many_steps, too_many_frames, too_many_pictures (of `until`, or of
/// a checkpoint that somebody made up) and whatever else `check_output` finds.
Result<RunOnItsWay> resume_run(const std::filesystem::path& folder, double until);

/// Makes `into`, empty, a run that stands where that of `folder` had its latest checkpoint up to
/// `step`. Errors: as above.
Result<RunOnItsWay> copy_run(const std::filesystem::path& folder, std::uint64_t step,
                             const std::filesystem::path& into);

/// The run goes on by the settings of `changed` from here: gravity, contact, impact, fracture but
/// its crack and criterion, ladder, kernel, ledger, output and duration may differ from those it
/// had. Its log says so, and cannot be replayed. Errors: not_in_mid_run and those above.
Result<RunOnItsWay> change_settings(const std::filesystem::path& folder, const SceneFile& changed);

}  // namespace sunder
