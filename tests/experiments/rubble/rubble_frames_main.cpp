// SPDX-License-Identifier: MIT
// `rubble_frames SCENE.json|boxes|wall [KEY=VALUE...] [--threads N] [--seconds S] [--seed K]
// [--scale X] [--trace T]`: the cost of frames of 1/60 s from the first touch until all sleeps, or
// S s, and an outside judge's findings for the last one, and every T s.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "apps/scene/scene_json.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "tests/experiments/rubble/frame_scenes.hpp"
#include "tests/experiments/rubble/thread_clock.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

struct Options {
  std::string scene;
  std::vector<std::string> settings;
  unsigned threads = 1, seed = 1;
  double seconds = 5, trace = 0, scale = 1;
};

Options read_options(int argc, char** argv) {
  Options o;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word.starts_with("--") && i + 1 < argc) {
      const char* value = argv[++i];
      if (word == "--threads") o.threads = static_cast<unsigned>(std::atoi(value));
      if (word == "--seed") o.seed = static_cast<unsigned>(std::atoi(value));
      if (word == "--scale") o.scale = std::atof(value);
      if (word == "--trace") o.trace = std::atof(value);
      if (word == "--seconds") o.seconds = std::atof(value);
    } else if (word.find('=') != std::string::npos) {
      o.settings.push_back(word);
    } else {
      o.scene = word;
    }
  }
  return o;
}

/// ms of each frame, by thread and by all threads.
struct Frames {
  std::vector<double> thread, process;
  double start = 0;  ///< s, of the first touch; below 0: none yet

  void add(double time, double thread_ms, double process_ms) {
    // A step that ends with a frame belongs to it, to rounding.
    const auto k = static_cast<std::size_t>(std::max(0.0, (time - start) * 60 - 1e-6));
    thread.resize(std::max(thread.size(), k + 1));
    process.resize(thread.size());
    thread[k] += thread_ms;
    process[k] += process_ms;
  }
};

void print_frames(const char* name, std::vector<double> ms, double seconds) {
  if (ms.empty()) return;
  std::ranges::sort(ms);
  const auto at = [&](double share) {
    return ms[std::min(ms.size() - 1, static_cast<std::size_t>(share * double(ms.size())))];
  };
  double sum = 0;
  for (const double m : ms) sum += m;
  std::printf("%s: %zu frames, p50 %.2f, p99 %.2f, worst %.2f ms; %.0f ms a simulated second\n",
              name, ms.size(), at(0.5), at(0.99), ms.back(), sum / seconds);
}

const char* name_of(CrackMode mode) {
  return mode == CrackMode::paper ? "paper" : mode == CrackMode::object ? "object" : "cohesive";
}

void print_modes(const Scene& s, unsigned threads) {
  std::printf("scene %s: step %.4g ms, ladder.rubble %s, declared_rubble %g, sleep %s\n",
              s.name.c_str(), 1e3 * s.integrator.time_step,
              s.ladder.rubble == RubbleMode::off ? "off" : "certified", s.ladder.declared_rubble,
              s.ladder.sleep ? "on" : "off");
  std::printf("fracture.crack %s, mode %s, smallest_piece %g kg, threads %u\n",
              name_of(s.fracture.crack),
              s.fracture.mode == FractureMode::off   ? "off"
              : s.fracture.mode == FractureMode::all ? "all"
                                                     : "budget",
              s.fracture.smallest_piece, threads);
}

void print_judgement(const Simulation& sim) {
  const std::vector<SeenPart> parts = seen_parts(sim);
  const SeenOverlaps seen = see_overlaps(parts);
  const double percent = 100 / seen.edge;
  std::printf(
      "judge: %zu pairs overlap, deepest %.3f %% (pieces %u and %u), mean %.4f %% of the mean edge "
      "%.2f mm\n",
      seen.pairs, percent * seen.deepest, parts[seen.where[0]].piece, parts[seen.where[1]].piece,
      percent * seen.mean, 1e3 * seen.edge);
  const BelowPlanes below = below_planes(sim, 0.02 * seen.edge);
  std::printf("below the floor: %.3f %% (%.3g mm, piece %u); %zu pieces by more than 2 %%\n",
              percent * std::max(0.0, below.depth), 1e3 * below.depth, below.piece, below.pieces);
}

/// Prints when a piece is first seen through the floor, a tenth of a millimetre or more.
void watch_floor(const Simulation& sim, double time, bool& told) {
  if (told) return;
  const BelowPlanes below = below_planes(sim, 1e-4);
  if (below.pieces == 0) return;
  told = true;
  const Component& c = sim.state->mechanics.components[below.piece];
  std::printf(
      "first below the floor: %.4f s, piece %u, %zu tetrahedra, rung %d%s, %.3g mm, born in "
      "step %llu, at %.3g m/s\n",
      time, below.piece, c.tetrahedra.size(), static_cast<int>(c.rung), c.rigid ? ", rigid" : "",
      1e3 * below.depth, static_cast<unsigned long long>(sim.state->birth_step[below.piece]),
      c.momentum.norm() / c.mass);
}

/// One line of the judge's findings.
void print_trace(const Simulation& sim, double time) {
  const std::vector<SeenPart> parts = seen_parts(sim);
  const SeenOverlaps seen = see_overlaps(parts);
  const PieceCount count = count_pieces(sim);
  std::printf("%.3f s: %zu pieces, %zu asleep; overlaps %zu, mean %.3f %%, deepest %.2f %%", time,
              count.pieces, count.asleep, seen.pairs, 100 * seen.mean / seen.edge,
              100 * seen.deepest / seen.edge);
  for (const std::uint32_t row : seen.where) {
    if (seen.pairs == 0) break;
    const Component& c = sim.state->mechanics.components[parts[row].piece];
    std::printf("; piece %u: %zu tetrahedra, rung %d%s, %.2g m/s", parts[row].piece,
                c.tetrahedra.size(), static_cast<int>(c.rung), c.rigid ? ", rigid" : "",
                c.momentum.norm() / c.mass);
  }
  std::puts("");
  std::fflush(stdout);
}

/// The components awake at the end: a line for each of the largest.
void print_awake(const Simulation& sim) {
  std::vector<const Component*> awake;
  for (const Component& c : sim.state->mechanics.components) {
    if (!c.tetrahedra.empty() && c.rung != Rung::asleep) awake.push_back(&c);
  }
  std::ranges::sort(awake, std::greater{}, [](const Component* c) { return c->tetrahedra.size(); });
  constexpr std::size_t most = 10;
  for (std::size_t k = 0; k < std::min(most, awake.size()); ++k) {
    const Component& c = *awake[k];
    const std::vector<double>& quiet = sim.state->impact.quiet;
    const bool is_open = c.id.index() < quiet.size() && quiet[c.id.index()] != ImpactWindow::closed;
    double fastest = 0;
    for (const VertexId v : c.vertices) {
      fastest = std::max(fastest, sim.state->mechanics.vertices.velocity[v.index()].norm());
    }
    std::printf("awake: piece %u, %zu tetrahedra, rung %d%s, %.3g m/s, fastest vertex %.3g m/s%s\n",
                unsigned(c.id.index()), c.tetrahedra.size(), static_cast<int>(c.rung),
                c.rigid ? ", rigid" : "", c.momentum.norm() / c.mass, fastest,
                is_open ? ", in a window" : "");
  }
}

Result<Scene> scene_of(const Options& o) {
  if (o.scene == "boxes") return boxes_scene(o.seed, o.scale);
  if (o.scene == "wall") return wall_scene();
  Result<SceneFile> file = read_scene(o.scene, o.settings);
  Result<Scene> result;
  result.findings = file.findings;
  if (file) result = std::move(file->scene);
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  const Options o = read_options(argc, argv);
  if (o.scene.empty()) {
    std::fputs(
        "usage: rubble_frames SCENE.json|boxes|wall [KEY=VALUE...] [--threads N] "
        "[--seconds S] [--seed K] [--scale X] [--trace T]\n",
        stderr);
    return 2;
  }
  Result<Scene> scene = scene_of(o);
  for (const Finding& f : scene.findings) std::fprintf(stderr, "%s\n", f.text.c_str());
  if (!scene) return 3;
  Result<Simulation> sim = build_simulation(std::move(*scene));
  for (const Finding& f : sim.findings) std::fprintf(stderr, "%s\n", f.text.c_str());
  if (!sim) return 3;
  sim->threads = o.threads;
  print_modes(sim->scene, o.threads);
  Frames frames{.start = -1};
  Frames asleep;
  double time = 0;
  std::size_t fans = 0, ticks = 0, mixed = 0, refused = 0, windows = 0;
  double before = 0, rest = -1;
  bool told = false;
  double next_trace = o.trace > 0 ? o.trace : std::numeric_limits<double>::infinity();
  for (;;) {
    const double thread = thread_ms(), process = process_ms();
    const StepReport report = advance(*sim);
    const double thread_took = thread_ms() - thread, process_took = process_ms() - process;
    if (report.status.outcome != StepOutcome::fine) {
      std::printf("the run failed at %.4f s\n", report.time);
      return 5;
    }
    fans += report.fracture.fans.size();
    ticks += report.rubble.ticks;
    mixed += report.rubble.mixed;
    refused += report.rubble.refused;
    windows += report.impact.opened;
    if (frames.start < 0 && (report.contact.contacts > 0 || report.rubble.points > 0)) {
      frames.start = before;
    }
    before = time = report.time;
    watch_floor(*sim, time, told);
    if (time >= next_trace) {
      print_trace(*sim, time);
      next_trace += o.trace;
    }
    if (rest >= 0) {
      asleep.add(time, thread_took, process_took);
      if (time > rest + 0.25) break;
      continue;
    }
    if (frames.start < 0) {
      if (time > o.seconds) break;
      continue;
    }
    frames.add(time, thread_took, process_took);
    const PieceCount count = count_pieces(*sim);
    if (count.pieces == count.asleep) asleep.start = rest = time;
    if (time > frames.start + o.seconds) break;
  }
  const PieceCount count = count_pieces(*sim);
  const double end = rest >= 0 ? rest : time;
  std::printf("first touch %.4f s, %s %.3f s later; %zu pieces, %zu asleep; %zu fans\n",
              frames.start, rest >= 0 ? "all asleep" : "ended", end - frames.start, count.pieces,
              count.asleep, fans);
  std::printf("%zu ticks; islands mixed %zu times, refused %zu; windows %zu\n", ticks, mixed,
              refused, windows);
  print_frames("thread", frames.thread, end - frames.start);
  print_frames("all threads", frames.process, end - frames.start);
  if (rest >= 0) print_frames("asleep, thread", asleep.thread, time - rest);
  print_awake(*sim);
  print_judgement(*sim);
}
