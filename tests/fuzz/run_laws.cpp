// SPDX-License-Identifier: MIT
// The promises of the readers of a run's inputs, one function each.
#include "run_laws.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "apps/scene/scene_hash.hpp"
#include "apps/scene/scene_json.hpp"
#include "apps/sunder/run/replay.hpp"
#include "apps/sunder/run/saved/resume.hpp"
#include "fracture/saving/saved_state.hpp"
#include "fracture/saving/state_numbers.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "topology/suite/fixtures/shapes.hpp"
#include "topology/suite/kernels/judged_kernel.hpp"

namespace sunder::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// Two tetrahedra on a face.
TetMesh small_mesh() {
  TetMesh mesh;
  mesh.points = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}, {0.1, 0.1, 0.1}};
  mesh.tetrahedra = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  return mesh;
}

/// A mesh that breaks in a few steps.
TetMesh breaking_mesh() { return suite::kuhn_box({2, 1, 1}, 0.1); }

FileMesh small_surface() {
  FileMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles.corners = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return mesh;
}

const SceneFiles& small_files() {
  static const SceneFiles files{
      .mesh = [](const std::string&) -> Result<TetMesh> { return breaking_mesh(); },
      .surface = [](const std::string&) -> Result<FileMesh> { return small_surface(); },
      .faces = [](const std::string&) -> Result<std::vector<std::array<std::uint32_t, 3>>> {
        return std::vector<std::array<std::uint32_t, 3>>{{1, 2, 3}};
      },
      .point_field = [](const std::string&, const std::string&) -> Result<std::vector<double>> {
        return std::vector<double>(breaking_mesh().points.size(), 1e6);
      }};
  return files;
}

constexpr std::string_view small_scene = R"({
  "name": "small", "bodies": [{"mesh": "a.msh", "velocity": [0, 0, -5], "translation": [0, 0, 0.001],
  "material": {"young_modulus": 1e8, "tensile_strength": 1e4},
  "held": [], "loads": [{"minimum": [0, 0, 0], "maximum": [1, 1, 1], "force": [0, 0, -1]}]}],
  "obstacles": [{"plane": {"normal": [0, 0, 1]}}, {"sphere": {"center": [0, 0, 1], "radius": 0.1},
  "velocity": [0, 0, -3], "mass": 1}], "gravity": {"acceleration": [0, 0, -9.8]},
  "time_step": 1e-3, "duration": 0.01, "ladder": {"sleep_after": 1},
  "output": {"frames": 2, "checkpoint": {"steps": 3, "minutes": 0}}})";

/// Promises to users of findings: no part may be missing, or hold bytes that move a terminal.
std::string bad_findings(const std::vector<Finding>& findings) {
  const auto is_control = [](char c) {
    return static_cast<unsigned char>(c) < ' ' || static_cast<unsigned char>(c) == 0x7f;
  };
  for (const Finding& f : findings) {
    if (f.code.empty() || f.text.empty()) return "a finding without code or text";
    if (f.severity == Severity::error && f.remedy.empty()) return f.code + " has no remedy";
    if (f.text.size() > 20000) return fmt::format("{} has {} bytes of text", f.code, f.text.size());
    if (std::ranges::any_of(f.text + f.remedy, is_control)) return "control bytes in " + f.code;
  }
  return {};
}

template <class T>
std::string bad_result(const Result<T>& result) {
  if (bool(result) == has_error(result.findings)) return "an error and a value, or neither";
  return bad_findings(result.findings);
}

double largest_share = 0;

/// Empty, or that `work` took more than `times` the bytes and 8 MiB.
template <class Work>
std::string excess(std::size_t bytes, std::size_t times, Work work) {
  begin_counting();
  work();
  const auto peak = end_counting().peak;
  const std::size_t bound = times * bytes + (8u << 20);
  largest_share = std::max(largest_share, static_cast<double>(peak) / static_cast<double>(bound));
  if (peak <= static_cast<std::ptrdiff_t>(bound)) return {};
  return fmt::format("{} bytes of memory for an input of {}: {} are the bound", peak, bytes, bound);
}

std::uint64_t fnv(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char byte : bytes) {
    hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3u;
  }
  return hash;
}

/// A few steps, each with `hurry` set: whatever the settings, it must come to an end.
std::string bad_steps(Simulation& sim, int steps) {
  const std::atomic<bool> hurry = true;
  sim.hurry = &hurry;
  const auto start = Clock::now();
  for (int k = 0; k < steps; ++k) {
    const StepReport report = advance(sim);
    if (report.status.outcome != StepOutcome::fine || report.fracture.not_a_number ||
        report.departed) {
      break;
    }
    if (!check_numbers(sim, NumbersOf::columns).empty()) break;  // the numbers that a run reports
    if (Clock::now() - start > std::chrono::seconds(20)) return "steps that do not end";
  }
  sim.hurry = nullptr;
  return {};
}

std::string broken_law_of_scene(const FuzzTarget&, std::string_view bytes) {
  Result<SceneFile> file;
  std::string bad = excess(bytes.size(), 4096, [&] {
    file = read_scene({bytes, "fuzz.json"}, small_files());
  });
  if (bad.empty()) bad = bad_result(file);
  if (!bad.empty() || !file) return bad;
  if (file->scene.bodies.size() > 6 || file->scene.obstacles.size() > 20) return {};
  Result<Simulation> sim = build_simulation(file->scene);
  bad = bad_result(sim);
  return bad.empty() && sim ? bad_steps(*sim, 3) : bad;
}

std::string sealed_state(std::string_view bytes) {
  std::string sealed(bytes);
  if (sealed.size() < 8) return sealed;
  const std::uint64_t sum = fnv(std::string_view(sealed).substr(0, sealed.size() - 8));
  std::memcpy(&sealed[sealed.size() - 8], &sum, 8);
  return sealed;
}

std::string broken_law_of_state(const FuzzTarget&, std::string_view bytes) {
  const std::string sealed = sealed_state(bytes);
  Result<Simulation> sim;
  std::string bad = excess(bytes.size(), 512, [&] { sim = restore(sealed); });
  if (bad.empty()) bad = bad_result(sim);
  if (!bad.empty() || !sim) return bad;
  // A restored state is saved with the same size. Reading and writing agree on every byte except
  // those of booleans, which are written as 0 and 1.
  check_numbers(*sim, NumbersOf::everything);
  return saved_state(*sim).size() == sealed.size() ? "" : "a state of another size comes back";
}

/// A folder in memory, gone at the end.
const fs::path& folder() {
  struct Place {
    fs::path path = fs::path("/dev/shm") / fmt::format("sunder-fuzz-run-{}", getpid());
    Place() { fs::create_directories(path); }
    ~Place() {
      std::error_code ignored;
      fs::remove_all(path, ignored);
    }
  };
  static const Place place;
  return place.path;
}

void write(const fs::path& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

const SceneFile& small_file() {
  static const SceneFile file = *read_scene({small_scene, "small.json"}, small_files());
  return file;
}

Simulation small_simulation() {
  Result<Simulation> built = build_simulation(small_file().scene);
  built->reports_forces = true;
  return std::move(*built);
}

/// A run of the small scene in a folder: its log and its last checkpoint.
const fs::path& finished_run() {
  static const fs::path place = [] {
    const fs::path run = folder() / "finished";
    Simulation sim = small_simulation();
    Result<Recorder> opened = Recorder::open({run, small_file(), {}}, sim, {});
    Recorder recorder = std::move(*opened);
    for (int k = 0; k < 6; ++k) recorder.record(sim, advance(sim), 0);
    recorder.finish(sim, RunEnd::finished);
    return run;
  }();
  return place;
}

std::string bytes_in(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The log with every line's check made right.
std::string sealed_log(std::string_view bytes) {
  std::string sealed, before;
  while (!bytes.empty()) {
    const std::string_view line = bytes.substr(0, bytes.find('\n'));
    bytes.remove_prefix(std::min(bytes.size(), line.size() + 1));
    std::string text(line.substr(0, line.size() - std::min(line.size(), check_length)));
    text += '}';
    const std::string check = line_check(text, before);
    before = sealed.empty() ? scene_hash(small_file()) : check;
    text.insert(text.size() - 1, ",\"check\":\"" + check + "\"");
    sealed += text + "\n";
  }
  return sealed;
}

std::string broken_law_of_log(const FuzzTarget&, std::string_view bytes) {
  const fs::path path = folder() / "events.jsonl";
  for (const bool seal : {false, true}) {
    write(path, seal ? sealed_log(bytes) : std::string(bytes));
    Result<Replay> replay;
    std::string bad = excess(bytes.size(), 512, [&] {
      replay = read_replay(path, {scene_hash(small_file()), step_count(small_file().scene)});
    });
    if (bad.empty()) bad = bad_result(replay);
    if (!bad.empty()) return bad;
    if (!replay) continue;
    Simulation sim = small_simulation();
    sim.state->script = replay->script;
    bad = bad_steps(sim, 6);
    if (!bad.empty()) return bad;
  }
  return {};
}

std::string broken_law_of_checkpoint(const FuzzTarget&, std::string_view bytes) {
  const fs::path run = folder() / "resumed";
  std::error_code none;
  fs::remove_all(run, none);
  fs::create_directories(run / "checkpoints");
  fs::create_directories(run / "frames");
  fs::copy_file(finished_run() / "events.jsonl", run / "events.jsonl");
  std::string sealed(bytes);
  if (sealed.size() > 28) {
    // The saved state's own sum, then that of all behind the head.
    std::uint64_t length = 0;
    std::memcpy(&length, &sealed[20], 8);
    if (length <= sealed.size() - 28) {
      sealed = sealed.substr(0, 28 + length) +
               sealed_state(std::string_view(sealed).substr(28 + length));
    }
    const std::uint64_t sum = fnv(std::string_view(sealed).substr(20));
    std::memcpy(&sealed[12], &sum, 8);
  }
  write(run / "checkpoints/step_0000000006.checkpoint", sealed);
  Result<RunOnItsWay> resumed;
  std::string bad = excess(bytes.size(), 512, [&] { resumed = resume_run(run, 0); });
  return bad.empty() ? bad_result(resumed) : bad;
}

std::string broken_law_of_protocol(const FuzzTarget&, std::string_view bytes) {
  const fs::path path = folder() / "answers";
  write(path, bytes);
  const auto start = Clock::now();
  std::string bad;
  try {
    // Answers are there before they are asked for; then the kernel listens and says nothing.
    suite::JudgedKernel kernel =
        suite::process_kernel(fmt::format("cat {}; exec sleep 1", path.string()), 0.2);
    bad = bad_findings({{.code = "name", .text = kernel.name + ".", .remedy = "-"}});
    const std::vector<Finding> found = kernel.load(small_mesh());
    for (Finding f : found) {
      f.text += ".";
      f.remedy = "-";
      if (bad.empty()) bad = bad_findings({f});
    }
    kernel.split({0, 0});
    kernel.counts();
    if (kernel.vertex_of_corner().size() != 8) return "rows of another number";
    if (kernel.component_of_tetrahedron().size() != 2) return "components of another number";
    if (kernel.homology) kernel.homology();
    if (kernel.orientable) kernel.orientable();
  } catch (const suite::KernelLost& lost) {
    bad = bad_findings({{.code = "lost", .text = lost.what(), .remedy = "-"}});
  }
  if (bad.empty() && Clock::now() - start > std::chrono::seconds(10))
    bad = "answers that do not end";
  return bad;
}

constexpr std::string_view small_answers =
    "hello 1 fuzz glue homology orientable\nok\nsplit 1 2 2 0 1 1 2 1\ncounts 5 9 7 2 1 6 1\n"
    "vertices 0 1 2 3 1 2 3 4\ncomponents 0 0\nhomology 1 0 0 0 0 0 0 0\norientable 1\n";

}  // namespace

std::span<const FuzzTarget> run_targets() {
  static const std::vector<FuzzTarget> targets = {{"scene", broken_law_of_scene},
                                                  {"state", broken_law_of_state},
                                                  {"log", broken_law_of_log},
                                                  {"checkpoint", broken_law_of_checkpoint},
                                                  {"protocol", broken_law_of_protocol}};
  return targets;
}

double largest_run_share() { return largest_share; }

std::string seed_of(const FuzzTarget& target) {
  if (target.name == "scene") return std::string(small_scene);
  if (target.name == "protocol") return std::string(small_answers);
  if (target.name == "log") return bytes_in(finished_run() / "events.jsonl");
  if (target.name == "checkpoint") {
    return bytes_in(finished_run() / "checkpoints/step_0000000006.checkpoint");
  }
  Simulation sim = small_simulation();
  for (int k = 0; k < 6; ++k) advance(sim);
  return saved_state(sim);
}

}  // namespace sunder::test
