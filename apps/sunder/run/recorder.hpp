// SPDX-License-Identifier: MIT
// Writes a run into a folder: frames, events, fragments, pictures and the report.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "apps/scene/scene_json.hpp"
#include "apps/sunder/run/event_log.hpp"
#include "apps/sunder/run/report/recorder_report.hpp"
#include "apps/sunder/run/saved/checkpoint.hpp"
#include "fracture/scene/expected_time.hpp"
#include "fracture/simulation/simulation_state.hpp"

namespace sunder {

/// Where a run stands for its recorder.
struct RecordedRun {
  std::filesystem::path folder;
  const SceneFile& file;
  /// Of a replay: the counts of the searches in the run that it repeats (`SearchCounts`). A replay
  /// writes no checkpoints.
  nlohmann::ordered_json counts = nullptr;
  /// Of the whole scene.
  ExpectedTime expected = {};
};

/// Keeps the files of a run. Guarded: `frames.pvd` lists exactly the frames that are there, and a
/// picture's number is its place in time. The log grows with the run. All other files are written
/// under another name and renamed. A checkpoint is on the disk only after all files that it names.
///
///     folder/frames.pvd  frames/frame_000000.vtu ...   picture_000.png ...
///            events.jsonl  cracks.csv  fragments.csv  obstacles.csv  history.csv
///            report.json
///            checkpoints/step_0000000120.checkpoint ...
///
/// The same scene gives the same bytes but in report.json and checkpoints, which hold wall times.
class Recorder {
 public:
  /// Makes the folder, removes files of these names that an earlier run left there, and records the
  /// start. `warnings` (from reading and building) go into the report.
  /// Errors: cannot_write; those of the renderer where pictures are asked for.
  static Result<Recorder> open(const RecordedRun& run, const Simulation& start,
                               std::vector<Finding> warnings);

  /// Goes on where `record` left off: later content of the folder is removed. `log`: its
  /// events.jsonl up to there. Errors: as `open`.
  static Result<Recorder> go_on(const RecordedRun& run, RunRecord record, EventLog log);

  /// That of its `RecordedRun`.
  const ExpectedTime& expected() const;

  Recorder(Recorder&&) noexcept;
  Recorder& operator=(Recorder&&) noexcept;
  ~Recorder();

  /// Adds one step, writes its events and the frame or picture that is due, and where a checkpoint
  /// is due the tables, the report and that. Errors: cannot_write and those of the renderer.
  std::vector<Finding> record(const Simulation& now, const StepReport& report, double step_ms);

  /// Writes a checkpoint now, whatever the settings say. Errors: cannot_write.
  std::vector<Finding> save(const Simulation& now);

  /// After the start and after whole steps: holds the content of a checkpoint of now, in memory,
  /// so that a run can go on from here when its next step is cut short. Gives whether it does so:
  /// not where the scene wants no checkpoints, nor before a hundred times as long has passed as the
  /// last time took, so that all of them take a hundredth of the run.
  bool keep(const Simulation& now);

  /// Writes the results of the end. A run that ended early gets its last state as a frame, one that
  /// came to its end a checkpoint. An interrupted run gets a checkpoint of its last whole step, or,
  /// where that was not kept, of the last one that was. Errors: cannot_write.
  std::vector<Finding> finish(const Simulation& now, RunEnd end);

  /// The fault of the report of a run that ends now, if it has one: not_a_number with the key of
  /// the first value that is not a number. JSON cannot hold it, and would have null.
  std::optional<Finding> report_fault(const Simulation& now) const;

  /// The step of the checkpoint that `finish` wrote of an interrupted run, if it did.
  std::optional<std::uint64_t> saved_step() const;

  const RunStatistics& statistics() const;
  /// events.jsonl as far as it goes; whole after `finish`.
  const EventLog& events() const;
  /// report.json; needs `finish`.
  const nlohmann::ordered_json& report() const;

 private:
  struct Parts;
  explicit Recorder(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace sunder
