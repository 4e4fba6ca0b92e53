// SPDX-License-Identifier: MIT
// The files of a run and when they are written.
#include "apps/sunder/run/recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>

#include "apps/output/frame.hpp"
#include "apps/output/history.hpp"
#include "apps/output/smooth_cracks.hpp"
#include "apps/output/tables.hpp"
#include "apps/scene/json_text.hpp"
#include "apps/sunder/run/due_steps.hpp"
#include "apps/sunder/run/pictures.hpp"
#include "apps/sunder/run/report/counters_json.hpp"
#include "apps/sunder/run/report/settings_report.hpp"
#include "apps/sunder/run/saved/run_folder.hpp"
#include "topology/io/files/output_file.hpp"
#include "topology/io/vtu/vtu.hpp"

namespace sunder {

namespace fs = std::filesystem;

struct Recorder::Parts {
  fs::path folder;
  SceneFile file;  ///< without its scene, which the simulation has
  std::vector<std::uint64_t> frame_steps, picture_steps, history_steps;
  RunRecord done;
  EventLog events;
  std::optional<AppendedFile> log;
  ExpectedTime expected;
  nlohmann::ordered_json counts, settings;
  std::optional<Pictures> drawn;
  nlohmann::ordered_json report;
  /// Of the last checkpoint: when it was, and the frames and pictures that are on the disk.
  std::chrono::steady_clock::time_point saved_at = std::chrono::steady_clock::now();
  std::uint64_t frames_on_disk = 0, pictures_on_disk = 0;
  /// The last step that was kept: its checkpoint, when that was made and how long it took.
  std::optional<CheckpointBytes> kept;
  std::chrono::steady_clock::time_point kept_at;
  std::chrono::steady_clock::duration keeping = {};
  bool last_is_whole = true;  ///< the step at which the run stands
  std::optional<std::uint64_t> saved_step;

  Parts(const RecordedRun& run, EventLog so_far);
  std::vector<Finding> open_log(Durable durable);
  std::vector<Finding> write_log();
  std::vector<Finding> write_tables(const Simulation& now, RunEnd end);
  std::vector<Finding> write_frame_of(const Simulation& now);
  std::vector<Finding> draw_picture(const Simulation& now);
  std::vector<Finding> write_due(const Simulation& now);
  void note_history(const Simulation& now, const StepReport& step);
  bool saves() const;
  std::vector<Finding> save(const CheckpointBytes& checkpoint);
  std::vector<Finding> save(const Simulation& now);
  std::vector<Finding> save_interrupted(const Simulation& now);
  bool is_time_for_impact(const Simulation& now) const;
  bool is_time_to_save(const Simulation& now) const;
};

namespace {

template <class T>
void append(std::vector<T>& all, std::vector<T> more) {
  for (T& one : more) all.push_back(std::move(one));
}

void append(std::vector<Finding>& all, std::optional<Finding> one) {
  if (one) all.push_back(std::move(*one));
}

std::optional<Finding> cannot_write(const fs::path& path, const std::error_code& reason) {
  if (!reason) return std::nullopt;
  return Finding{.code = "cannot_write",
                 .text = fmt::format("cannot write {}: {}", path.string(), reason.message()),
                 .remedy = "give another folder with -o, or make this one writable",
                 .file = path.string()};
}

}  // namespace

Recorder::Recorder(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Recorder::Recorder(Recorder&&) noexcept = default;
Recorder& Recorder::operator=(Recorder&&) noexcept = default;
Recorder::~Recorder() = default;

const ExpectedTime& Recorder::expected() const { return parts_->expected; }

Recorder::Parts::Parts(const RecordedRun& run, EventLog so_far)
    : folder(run.folder),
      file(run.file),
      frame_steps(due_frames(run.file)),
      picture_steps(due_pictures(run.file)),
      history_steps(due_history_rows(run.file)),
      events(std::move(so_far)),
      expected(run.expected),
      counts(run.counts),
      settings(settings_json(run.file, run.expected)) {
  file.scene = {};
}

Result<Recorder> Recorder::open(const RecordedRun& run, const Simulation& start,
                                std::vector<Finding> warnings) {
  auto parts = std::make_unique<Parts>(run, EventLog(run.file));
  parts->done.statistics = begin_statistics(start, std::move(warnings));
  if (!parts->history_steps.empty()) parts->done.history = begin_history(start);
  Result<Recorder> result;
  if (!parts->picture_steps.empty()) {
    Result<Pictures> drawn = Pictures::open(start, run.file.output);
    append(result.findings, std::move(drawn.findings));
    if (!drawn) return result;
    parts->drawn = std::move(*drawn);
  }
  append(result.findings, cannot_write(run.folder, empty_run_folder(run.folder)));
  if (!has_error(result.findings)) append(result.findings, parts->open_log(Durable::no));
  if (!has_error(result.findings)) append(result.findings, parts->write_due(start));
  if (!has_error(result.findings)) result.value = Recorder(std::move(parts));
  return result;
}

Result<Recorder> Recorder::go_on(const RecordedRun& run, RunRecord record, EventLog log) {
  auto parts = std::make_unique<Parts>(run, std::move(log));
  parts->done = std::move(record);
  Result<Recorder> result;
  if (!parts->picture_steps.empty()) {
    // The camera is where it was: it was found from the start.
    const Result<Simulation> start = build_simulation(run.file.scene);
    if (!start) return start.findings.front();
    Result<Pictures> drawn = Pictures::open(*start, run.file.output);
    append(result.findings, std::move(drawn.findings));
    if (!drawn) return result;
    parts->drawn = std::move(*drawn);
  }
  const RunRecord& done = parts->done;
  append(result.findings,
         cannot_write(run.folder, remove_later(run.folder, done.frames.size(), done.pictures)));
  if (!has_error(result.findings)) append(result.findings, parts->open_log(Durable::yes));
  if (!has_error(result.findings) && !done.frames.empty()) {
    append(result.findings, write_pvd(run.folder / "frames.pvd", done.frames));
  }
  if (!has_error(result.findings)) result.value = Recorder(std::move(parts));
  return result;
}

/// The log's file as it stands now, open at its end. An older one stays until it is whole.
std::vector<Finding> Recorder::Parts::open_log(Durable durable) {
  const fs::path path = folder / "events.jsonl";
  const std::string_view text = events.text();
  std::vector<Finding> findings;
  append(findings, write_file(path, std::span(&text, 1), durable));
  if (!findings.empty()) return findings;
  Result<AppendedFile> opened = AppendedFile::open(path, text.size());
  if (!opened) return std::move(opened.findings);
  log = std::move(*opened);
  done.log_bytes = text.size();
  return {};
}

std::vector<Finding> Recorder::Parts::write_log() {
  const std::string_view fresh = std::string_view(events.text()).substr(done.log_bytes);
  if (fresh.empty()) return {};
  std::vector<Finding> findings;
  append(findings, log->append(fresh));
  if (findings.empty()) done.log_bytes = events.text().size();
  return findings;
}

std::vector<Finding> Recorder::Parts::write_frame_of(const Simulation& now) {
  const std::string name = frame_name(done.frames.size());
  std::vector<Vec3> moves;
  if (file.output.crack_surface == CrackSurface::smooth) {
    moves = smooth_crack_moves(now.state->cells);
  }
  std::vector<Finding> findings = write_frame(folder / name, now, moves);
  if (has_error(findings)) return findings;
  done.frames.push_back({now.state->mechanics.time, name});
  done.last_frame = now.state->step;
  append(done.obstacles, free_obstacles(now));
  append(findings, write_pvd(folder / "frames.pvd", done.frames));
  return findings;
}

std::vector<Finding> Recorder::Parts::draw_picture(const Simulation& now) {
  std::vector<Finding> findings = drawn->draw(folder / picture_name(done.pictures++), now);
  if (!has_error(findings)) done.last_picture = now.state->step;
  return findings;
}

std::vector<Finding> Recorder::Parts::write_due(const Simulation& now) {
  std::vector<Finding> findings;
  if (std::ranges::binary_search(frame_steps, now.state->step)) findings = write_frame_of(now);
  if (std::ranges::binary_search(picture_steps, now.state->step)) {
    append(findings, draw_picture(now));
  }
  return findings;
}

void Recorder::Parts::note_history(const Simulation& now, const StepReport& step) {
  // A branch may leave the history out, and a later branch may begin it.
  if (history_steps.empty()) return void(done.history = {});
  if (done.history.values.empty()) return void(done.history = begin_history(now));
  add_step(done.history, step);
  if (std::ranges::binary_search(history_steps, now.state->step)) add_row(done.history, now);
}

bool Recorder::Parts::is_time_for_impact(const Simulation& now) const {
  constexpr double least = 1.0 / 240;
  return file.output.frames_at_impacts &&
         (done.frames.empty() || now.state->mechanics.time - done.frames.back().time >= least);
}

/// Whether checkpoints are written at all.
bool Recorder::Parts::saves() const {
  const CheckpointSettings& when = file.output.checkpoint;
  return counts.is_null() && (when.steps > 0 || when.minutes > 0);
}

bool Recorder::Parts::is_time_to_save(const Simulation& now) const {
  const CheckpointSettings& when = file.output.checkpoint;
  if (!saves()) return false;
  if (when.steps > 0 && now.state->step % when.steps == 0) return true;
  const std::chrono::duration<double> since = std::chrono::steady_clock::now() - saved_at;
  return when.minutes > 0 && since.count() >= 60 * when.minutes;
}

std::vector<Finding> Recorder::record(const Simulation& now, const StepReport& report,
                                      double step_ms) {
  Parts& p = *parts_;
  // A step that failed or was cut short is nothing to go on from.
  p.last_is_whole = report.status.outcome == StepOutcome::fine && !(now.hurry && *now.hurry);
  RunStatistics& statistics = p.done.statistics;
  add_step(statistics, now, report, step_ms);
  p.note_history(now, report);
  const std::uint64_t fans = statistics.fans - report.fracture.fans.size();
  const std::uint64_t releases = statistics.ties.releases - report.releases.size();
  for (const auto& line : events_of(report, fans, releases, now.state->cells.map)) {
    p.events.add(line);
  }
  std::vector<Finding> findings = p.write_log();
  append(findings, p.write_due(now));
  if (report.impact.opened > 0 && p.is_time_for_impact(now)) {
    append(findings, p.write_frame_of(now));
  }
  if (p.last_is_whole && p.is_time_to_save(now)) {
    append(findings, p.write_tables(now, RunEnd::running));
    append(findings, p.save(now));
  }
  return findings;
}

/// Everything of the run so far on the disk, then the checkpoint that speaks of it.
std::vector<Finding> Recorder::Parts::save(const Simulation& now) {
  kept = checkpoint_bytes(file, done, now);
  return save(*kept);
}

std::vector<Finding> Recorder::Parts::save(const CheckpointBytes& checkpoint) {
  std::vector<Finding> findings;
  std::error_code error;
  fs::create_directories(folder / "checkpoints", error);
  append(findings, cannot_write(folder / "checkpoints", error));
  for (; frames_on_disk < done.frames.size(); ++frames_on_disk) {
    append(findings, sync_file(folder / done.frames[frames_on_disk].file));
  }
  for (; pictures_on_disk < done.pictures; ++pictures_on_disk) {
    append(findings, sync_file(folder / picture_name(pictures_on_disk)));
  }
  for (const char* place : {"events.jsonl", "frames", ""}) {
    append(findings, sync_file(folder / place));
  }
  if (findings.empty()) {
    findings = write_checkpoint(folder, checkpoint, file.output.checkpoint.keep);
  }
  saved_at = std::chrono::steady_clock::now();
  return findings;
}

std::vector<Finding> Recorder::save(const Simulation& now) { return parts_->save(now); }

bool Recorder::keep(const Simulation& now) {
  using Clock = std::chrono::steady_clock;
  Parts& p = *parts_;
  const Clock::time_point start = Clock::now();
  if (!p.saves() || (p.kept && start - p.kept_at < 100 * p.keeping)) return false;
  p.kept.reset();  // never two of them in memory
  p.kept = checkpoint_bytes(p.file, p.done, now);
  p.kept_at = Clock::now();
  p.keeping = p.kept_at - start;
  return true;
}

/// Before the files of the end are written, which the run that goes on must not have.
std::vector<Finding> Recorder::Parts::save_interrupted(const Simulation& now) {
  if (!saves() || !(last_is_whole || kept)) return {};
  std::vector<Finding> findings = last_is_whole ? save(now) : save(*kept);
  if (!has_error(findings)) saved_step = last_is_whole ? now.state->step : kept->step;
  return findings;
}

std::optional<Finding> Recorder::report_fault(const Simulation& now) const {
  const std::vector<Fragment> pieces = fragments(now);
  const nlohmann::ordered_json end =
      run_report(parts_->done.statistics, now, pieces, RunEnd::finished);
  const std::optional<std::string> key = first_no_number(end);
  if (!key) return std::nullopt;
  return Finding{.code = "not_a_number",
                 .text = fmt::format("{} of the report is no number, or infinite", *key),
                 .remedy =
                     "take a shorter time_step; look for values of the scene that are far "
                     "too large or too small",
                 .file = (parts_->folder / "report.json").string()};
}

std::optional<std::uint64_t> Recorder::saved_step() const { return parts_->saved_step; }

std::vector<Finding> Recorder::Parts::write_tables(const Simulation& now, RunEnd end) {
  // A folder that somebody took away is not made again for the last files of a run.
  if (!file_exists(folder)) {
    return {*cannot_write(folder, std::make_error_code(std::errc::no_such_file_or_directory))};
  }
  const std::vector<Fragment> pieces = fragments(now);
  report = run_report(done.statistics, now, pieces, end);
  report["settings"] = settings;
  std::vector<Finding> findings;
  const auto write = [&](const char* name, const std::string& text) {
    append(findings, write_file(folder / name, text));
  };
  write("cracks.csv", cracks_csv(done.statistics.cracks));
  write("fragments.csv", fragments_csv(pieces));
  std::vector<ObstacleMotion> obstacles = done.obstacles;
  if (done.last_frame != now.state->step) append(obstacles, free_obstacles(now));
  if (!obstacles.empty()) write("obstacles.csv", obstacles_csv(obstacles));
  if (!history_steps.empty()) {
    History history = done.history;
    if (history.values.empty()) history = begin_history(now);
    if (history.last_row != now.state->step) add_row(history, now);
    write("history.csv", history_csv(history, now.scene));
  }
  write("report.json", json_text(report) + "\n");
  return findings;
}

std::vector<Finding> Recorder::finish(const Simulation& now, RunEnd end) {
  Parts& p = *parts_;
  std::vector<Finding> findings;
  if (end == RunEnd::interrupted) findings = p.save_interrupted(now);
  if (end != RunEnd::finished) {
    if (!p.frame_steps.empty() && p.done.last_frame != now.state->step) {
      append(findings, p.write_frame_of(now));
    }
    if (p.drawn && p.done.last_picture != now.state->step) append(findings, p.draw_picture(now));
  }
  if (end == RunEnd::finished && p.saves()) append(findings, p.save(now));
  if (!p.counts.is_null()) read_counters(p.done.statistics.search, p.counts);
  p.events.add({{"end", to_string(end)},
                {"steps", now.state->step},
                {"fans", p.done.statistics.fans},
                {"releases", p.done.statistics.ties.releases},
                {"search", counters_json(p.done.statistics.search)}});
  append(findings, p.write_log());
  append(findings, p.write_tables(now, end));
  return findings;
}

const RunStatistics& Recorder::statistics() const { return parts_->done.statistics; }
const EventLog& Recorder::events() const { return parts_->events; }
const nlohmann::ordered_json& Recorder::report() const { return parts_->report; }

}  // namespace sunder
