// SPDX-License-Identifier: MIT
// Checkpoints as bytes and files.
#include "apps/sunder/run/saved/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <nlohmann/json.hpp>

#include "apps/sunder/run/event_log.hpp"
#include "apps/sunder/run/saved/run_folder.hpp"
#include "fracture/saving/archive.hpp"
#include "fracture/saving/saved_state.hpp"
#include "topology/base/fnv1a.hpp"
#include "topology/io/files/output_file.hpp"

namespace sunder {

namespace fs = std::filesystem;

// One that gains or loses a member does not compile until this and `checkpoint_format` are looked
// at.
constexpr auto member_names(const RunRecord*) {
  return names("statistics", "frames", "obstacles", "history", "pictures", "last_frame",
               "last_picture", "log_bytes");
}
constexpr auto member_names(const PvdFrame*) { return names("time", "file"); }
constexpr auto member_names(const ObstacleMotion*) {
  return names("time", "row", "pose", "velocity", "spin");
}
constexpr auto member_names(const History*) {
  return names("sums", "obstacle_centre", "held_centre", "values", "last_row");
}
constexpr auto member_names(const HistorySums*) {
  return names("since", "obstacle", "held", "gap_error", "overlap", "load_work", "released",
               "taken");
}
constexpr auto member_names(const HistorySettings*) { return names("interval"); }
constexpr auto member_names(const Pose*) { return names("centre", "orientation"); }
constexpr auto member_names(const TimeSample*) {
  return names("count", "sum", "largest", "kept", "stride");
}
constexpr auto member_names(const SearchCounts*) {
  return names("tested", "suspects", "reached", "empty_fans", "refused_fans", "still_empty",
               "relieved", "waiting", "on_flanks", "unfitted");
}
constexpr auto member_names(const ContactReport*) {
  return names("candidates", "contacts", "passes", "iterations", "residual", "tolerated",
               "force_error", "converged", "deepest", "left_out", "obstacle_impulse");
}
constexpr auto member_names(const ImpactReport*) {
  return names("opened", "spared_by_pair", "spared_by_island", "closed_by_time", "closed_by_energy",
               "sub_steps", "time", "components", "carried", "scaled_cells", "coarseness",
               "stopped");
}
constexpr auto member_names(const LadderReport*) { return names("components", "tetrahedra"); }
constexpr auto member_names(const RubbleStepReport*) {
  return names("ticks", "awake", "asleep", "points", "deepest", "refused", "mixed", "solids",
               "struck", "rigid", "declared", "declared_share");
}
constexpr auto member_names(const SolveReport*) {
  return names("sub_steps", "iterations", "force_evaluations", "not_converged");
}
constexpr auto member_names(const EnergyLedger*) {
  return names("kinetic", "strain", "gravity", "loads", "contact", "friction", "push_out",
               "supports", "cracks", "numerical", "residual", "moved");
}
constexpr auto member_names(const TieStatistics*) { return names("sum", "releases", "released"); }
constexpr auto member_names(const TieReport*) {
  return names("pairs", "opening", "residual", "work", "dissipated", "stored", "torn");
}
constexpr auto member_names(const TiesOfCrack*) {
  return names("tied", "released", "area", "due", "energy");
}
constexpr auto member_names(const CrackEnergy*) {
  return names("fan", "time", "area", "projected", "energy");
}
constexpr auto member_names(const Energies*) { return names("kinetic", "strain", "gravity"); }
constexpr auto member_names(const MomentumLedger*) {
  return names("gravity", "loads", "obstacles", "supports", "sleep");
}
constexpr auto member_names(const Finding*) {
  return names("code", "severity", "count", "ids", "text", "remedy", "file", "line");
}
constexpr auto member_names(const RunTroubles*) {
  return names("left_out", "not_converged", "overlaps", "stopped", "given_up", "residual", "risen",
               "residual_size", "moved", "mean_edge", "balance");
}
constexpr auto member_names(const Trouble*) { return names("first", "last", "steps", "size"); }
constexpr auto member_names(const EnergyBalance*) {
  return names("level", "lowest", "risen", "most", "weight", "work", "body_energy", "ball_energy",
               "ball_centre");
}
constexpr auto member_names(const Choice*) { return names("key", "value", "reason"); }
constexpr auto member_names(const OutputSettings*) {
  return names("frames", "frame_interval", "frames_at_impacts", "crack_surface", "history",
               "pictures", "checkpoint");
}
constexpr auto member_names(const PictureSettings*) {
  return names("count", "times", "width", "height", "show", "camera");
}
constexpr auto member_names(const CameraSettings*) {
  return names("eye", "target", "field_of_view");
}
constexpr auto member_names(const CheckpointSettings*) { return names("steps", "minutes", "keep"); }

template <class Archive, class S>
requires std::is_same_v<std::remove_const_t<S>, RunStatistics>
void archive_struct(Archive& a, S& statistics) {
  auto& [step_ms, stage_ms, fans, faces_split, search, contact, impact, ladder, rubble, solve,
         energy, ties, contact_steps, unconverged_steps, impact_steps, stopped_steps,
         worst_residual, tolerated, force_error, worst_step, most_iterations, predicted,
         predicted_rightly, separated, fan_us, searched, damping_work, energy_released, cracks,
         energy_at_start, momentum_at_start, momentum, mass_at_start, drawn_off, drawn_off_step,
         warnings, troubles, turned_too_far] = statistics;
  const auto all = [&](auto&... member) { (archive(a, member), ...); };
  all(step_ms, stage_ms, fans, faces_split, search, contact, impact, ladder, rubble, solve, energy,
      ties, contact_steps, unconverged_steps, impact_steps, stopped_steps, worst_residual,
      tolerated, force_error, worst_step, most_iterations, predicted, predicted_rightly, separated,
      fan_us, searched, damping_work, energy_released, cracks, energy_at_start, momentum_at_start,
      momentum, mass_at_start, drawn_off, drawn_off_step, warnings, troubles, turned_too_far);
}

/// All but the scene, which the saved state has.
template <class Archive, class S>
requires std::is_same_v<std::remove_const_t<S>, SceneFile>
void archive_struct(Archive& a, S& file) {
  auto& [schema, description, accuracy, choices, scene, output] = file;
  const auto all = [&](auto&... member) { (archive(a, member), ...); };
  all(schema, description, accuracy, choices, output);
}

namespace {

constexpr std::string_view magic = "SunderCp";
constexpr std::string_view ending = ".checkpoint";

std::uint64_t checksum(std::initializer_list<std::string_view> parts) {
  Fnv1a sum;
  for (const std::string_view bytes : parts) sum.add(bytes);
  return sum.value;
}

fs::path place_of(const fs::path& folder) { return folder / "checkpoints"; }

/// Steps and files of the checkpoints of a folder, the latest first.
std::vector<std::pair<std::uint64_t, fs::path>> checkpoints_of(const fs::path& folder) {
  std::vector<std::pair<std::uint64_t, fs::path>> found;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(place_of(folder), none)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with("step_") || !name.ends_with(ending)) continue;
    const char* const end = name.data() + name.size() - ending.size();
    std::uint64_t step = 0;
    if (std::from_chars(name.data() + 5, end, step).ptr == end) found.emplace_back(step, entry);
  }
  std::ranges::sort(found, std::greater<>());
  return found;
}

Finding unusable(const char* code, const fs::path& path, std::string text) {
  return {.code = code,
          .text = std::move(text),
          .remedy =
              "continue from an earlier one (--from STEP -o DIR), or run the scene from its start",
          .file = path.string()};
}

Result<Checkpoint> read_one(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in) return unusable("cannot_open", path, "it cannot be read");
  if (!bytes.starts_with(magic)) return unusable("damaged", path, "it does not begin as one");
  StateReader head{std::string_view(bytes).substr(magic.size())};
  std::uint32_t format = 0;
  std::uint64_t sum = 0, length = 0;
  archive(head, format);
  if (!head.failed && format != checkpoint_format) {
    return unusable(
        "other_version", path,
        fmt::format("its format is {}; this version reads {}", format, checkpoint_format));
  }
  archive(head, sum);
  const std::string_view summed = head.bytes;
  archive(head, length);
  if (head.failed || length > head.bytes.size() || checksum({summed}) != sum) {
    return unusable("damaged", path, "some of its bytes are missing or changed");
  }
  Checkpoint checkpoint;
  StateReader reader{head.bytes.substr(0, length)};
  archive(reader, checkpoint.file);
  archive(reader, checkpoint.record);
  Result<Simulation> simulation = restore(head.bytes.substr(length));
  for (Finding& f : simulation.findings) f.file = path.string();
  if (!simulation) return std::move(simulation.findings.front());
  // Frames are copied by these names: they lead nowhere else.
  const std::vector<PvdFrame>& frames = checkpoint.record.frames;
  bool fits = !reader.failed && reader.bytes.empty();
  for (std::size_t k = 0; k < frames.size(); ++k) fits = fits && frames[k].file == frame_name(k);
  // The report parses these values.
  for (const Choice& c : checkpoint.file.choices)
    fits = fits && !parse_line(c.value).is_discarded();
  if (!fits) return unusable("damaged", path, "what it holds does not fit together");
  checkpoint.simulation = std::move(*simulation);
  checkpoint.file.scene = checkpoint.simulation.scene;
  return checkpoint;
}

}  // namespace

CheckpointBytes checkpoint_bytes(const SceneFile& file, const RunRecord& record,
                                 const Simulation& simulation) {
  StateWriter recorded;
  archive(recorded, file);
  archive(recorded, record);
  const std::string state = saved_state(simulation);
  StateWriter length, head;
  const std::uint64_t bytes = recorded.bytes.size();
  archive(length, bytes);
  const std::uint64_t sum = checksum({length.bytes, recorded.bytes, state});
  head.bytes = magic;
  archive(head, checkpoint_format);
  archive(head, sum);
  CheckpointBytes whole{steps_taken(simulation), std::move(head.bytes)};
  whole.bytes.reserve(whole.bytes.size() + length.bytes.size() + recorded.bytes.size() +
                      state.size());
  whole.bytes.append(length.bytes).append(recorded.bytes).append(state);
  return whole;
}

std::vector<Finding> write_checkpoint(const fs::path& folder, const CheckpointBytes& checkpoint,
                                      std::uint32_t keep) {
  const fs::path path = place_of(folder) / fmt::format("step_{:010}{}", checkpoint.step, ending);
  const std::string_view bytes = checkpoint.bytes;
  if (auto finding = write_file(path, std::span(&bytes, 1), Durable::yes)) {
    return {std::move(*finding)};
  }
  const auto old = checkpoints_of(folder);
  std::error_code error;  // one more than wanted does no harm
  for (std::size_t i = keep; keep > 0 && i < old.size(); ++i) fs::remove(old[i].second, error);
  return {};
}

Result<Checkpoint> read_checkpoint(const fs::path& folder, std::optional<std::uint64_t> until) {
  std::vector<Finding> passed_over;
  for (const auto& [step, path] : checkpoints_of(folder)) {
    if (until && step > *until) continue;
    Result<Checkpoint> checkpoint = read_one(path);
    if (checkpoint || checkpoint.findings.front().code != "damaged") {
      checkpoint.findings.insert(checkpoint.findings.end(), passed_over.begin(), passed_over.end());
      return checkpoint;
    }
    passed_over.push_back(std::move(checkpoint.findings.front()));
    passed_over.back().severity = Severity::warning;
  }
  Result<Checkpoint> none =
      Finding{.code = "no_checkpoint",
              .text = fmt::format("{} holds no checkpoint{} to go on from", folder.string(),
                                  until ? fmt::format(" up to step {}", *until) : ""),
              .remedy = "run the scene again; output.checkpoint sets when a run saves checkpoints",
              .file = folder.string()};
  none.findings.insert(none.findings.end(), passed_over.begin(), passed_over.end());
  return none;
}

}  // namespace sunder
