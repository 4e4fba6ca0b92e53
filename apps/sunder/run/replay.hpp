// SPDX-License-Identifier: MIT
// The event log of an earlier run, read back to repeat it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/sunder/run/event_log.hpp"
#include "fracture/breaking/fan_script.hpp"
#include "topology/base/finding.hpp"

namespace sunder {

/// The content of an event log, ready to be replayed.
struct Replay {
  std::string file;
  FanScript script;
  std::vector<std::size_t> line_of_fan;  ///< from 1
  std::uint64_t releases = 0;
  /// The log's lines after its first, as they stand.
  std::string lines;
  std::size_t compared = 0;  ///< bytes of them that the replay has written too
  /// How the run ended and after how many steps.
  RunEnd end = RunEnd::finished;
  std::uint64_t steps = 0;
  /// The counts of the run's searches, which a replay does not make.
  nlohmann::ordered_json counts;
};

/// The scene that a log has to be of.
struct ReplayedScene {
  std::string hash;         ///< `scene_hash`
  std::uint64_t steps = 0;  ///< `step_count`
};

/// Reads an event log for a scene, holding every line to its check and its place. Warning:
/// other_program (a run of another version may depart). Errors, with file, line and remedy:
/// cannot_open, other_log_format, other_scene, bad_event_log (not JSON, changed, missing or
/// repeated lines, a fan or a release out of order, cut off).
Result<Replay> read_replay(const std::filesystem::path& path, const ReplayedScene& scene);

/// Compares the replay's own log so far (`EventLog::text`) with the log. The finding
/// `replay_departed` names the first line that differs, the key in it, and both values.
/// `finished`: whether the replay's log is whole. Needs: `text` only ever grows. O(new text).
std::optional<Finding> compare_logs(Replay& replay, std::string_view text, bool finished);

/// The fan of the script that could not be made, as a finding `replay_departed`.
Finding departure(const Replay& replay, const ScriptDeparture& departure);

/// The same for a run that failed where its replay did not.
Finding missed_failure(const Replay& replay);

}  // namespace sunder
