// SPDX-License-Identifier: MIT
// The event log of a run, line by line: complete enough to repeat the run.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/scene/scene_json.hpp"
#include "apps/sunder/run/report/recorder_report.hpp"
#include "fracture/simulation/simulation_state.hpp"

namespace sunder {

/// The format that a reader of the log must know; raised whenever a line's meaning changes.
inline constexpr int event_log_format = 3;

/// The words of `RunEnd`, as report and log have them.
std::string_view to_string(RunEnd end);

/// The JSON of one line of a log, or discarded: where it is no JSON, or nested deeper than any line
/// is (64 levels), since code that walks through values calls itself.
nlohmann::ordered_json parse_line(std::string_view text);

/// When a fan or a release happened.
struct EventTime {
  /// Which fan (release) of the run it is, from 0, its step, and which of the step's searches for
  /// fractures made it (came next).
  std::uint64_t number = 0, step = 0;
  std::uint32_t part = 0;
  /// s, at the end of the sub-step.
  double time = 0;
};

/// One fan: fan, step, part, round, time, vertex, point, rest_position, normal, stress, strength,
/// faces ({points, split_vertices [[old, new]...], split_edges, oracle}), oracle (faces that
/// predict a separation) and new_components. Rows as they are after the fan. `map`: at any later
/// time; names the faces' points.
nlohmann::ordered_json event_of(const FanEvent& event, const EventTime& when, const VolumeMap& map);

/// One release of spent ties: release, step, part, time, faces (as of a fan, rows of the map of
/// pieces, with their crack, projected_area (m^2) and the energy (J) they took), oracle and
/// new_components. `map`: at any later time; names the faces' points.
nlohmann::ordered_json event_of(const TieRelease& release, const EventTime& when,
                                const VolumeMap& map);

/// The lines of a step in their order: fans and releases by their parts, releases first. `fans` and
/// `releases`: how many came before it. `map`: at the end of the step.
std::vector<nlohmann::ordered_json> events_of(const StepReport& report, std::uint64_t fans,
                                              std::uint64_t releases, const VolumeMap& map);

/// The log as text, one JSON object a line. Its first line names format, program and scene; each
/// other is a fan or a release, the last says how the run ended. Guarded: every line ends with a
/// `check` over itself and the lines before it (the first over itself only: another program version
/// may replay the log), seeded with the scene's hash.
class EventLog {
 public:
  explicit EventLog(const SceneFile& file);
  void add(const nlohmann::ordered_json& line);
  const std::string& text() const { return text_; }
  /// The log with `text` as its content so far, and with the checks of the scene of `file`. The
  /// scene may be longer than the one it was written for. `branched_at`: the step from
  /// which on its settings are others; the head keeps the last such step. Nothing where a line is
  /// not the one that was written.
  static std::optional<EventLog> of(const SceneFile& file, std::string_view text,
                                    std::optional<std::uint64_t> branched_at = {});

 private:
  EventLog(const nlohmann::ordered_json& head, std::string hash);
  void add_line(std::string text);
  std::string text_;
  std::string check_;
};

/// The log's first line for a scene, without its check.
nlohmann::ordered_json event_log_head(const SceneFile& file, const std::string& hash);

/// Length of a line's `,"check":"0123456789abcdef"}`.
inline constexpr std::size_t check_length = 28;

/// The check of a line (its text without check) after a line with the check `before`.
std::string line_check(std::string_view line, std::string_view before);

}  // namespace sunder
