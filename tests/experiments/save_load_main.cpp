// SPDX-License-Identifier: MIT
// `save_load SCENE.json [MOMENTS] [DURATION]`: runs a scene twice side by side, once as it is and
// once saved to a file and loaded again at so many moments (10), and holds every step of the two
// against each other, byte by byte. Exit code 1 where they differ.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "apps/scene/scene_json.hpp"
#include "fracture/saving/saved_state.hpp"
#include "tests/support/same_state.hpp"

using namespace sunder;

namespace {

double ms_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

bool same_fans(const StepReport& a, const StepReport& b) {
  if (a.fracture.fans.size() != b.fracture.fans.size()) return false;
  for (std::size_t k = 0; k < a.fracture.fans.size(); ++k) {
    const FanEvent &one = a.fracture.fans[k], &other = b.fracture.fans[k];
    if (one.vertex != other.vertex || one.normal != other.normal || one.stress != other.stress) {
      return false;
    }
  }
  return true;
}

void print(const std::vector<Finding>& findings) {
  for (const Finding& f : findings) std::fprintf(stderr, "%s\n", f.text.c_str());
}

/// Saves the simulation to a file and replaces it by the loaded one; false where it cannot.
bool save_and_load(Simulation& sim, const std::filesystem::path& path) {
  auto start = std::chrono::steady_clock::now();
  const std::vector<Finding> unsaved = save(sim, path);
  print(unsaved);
  const double save_ms = ms_since(start);
  start = std::chrono::steady_clock::now();
  Result<Simulation> loaded = load(path);
  print(loaded.findings);
  if (!unsaved.empty() || !loaded) return false;
  sim = std::move(*loaded);
  std::printf(
      "%llu,%.9g,%llu,%zu,%ju,%.1f,%.1f\n", static_cast<unsigned long long>(sim.state->step),
      sim.state->mechanics.time, static_cast<unsigned long long>(sim.state->fans),
      sim.state->mechanics.components.size(),
      static_cast<std::uintmax_t>(std::filesystem::file_size(path)), save_ms, ms_since(start));
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argc > 4) {
    std::fputs("usage: save_load SCENE.json [MOMENTS] [DURATION]\n", stderr);
    return 2;
  }
  Result<SceneFile> file = read_scene(argv[1]);
  print(file.findings);
  if (!file) return 3;
  const long moments = argc > 2 ? std::atol(argv[2]) : 10;
  const double duration = argc > 3 ? std::atof(argv[3]) : file->scene.duration;
  const auto steps = std::lround(duration / file->scene.integrator.time_step);
  Result<Simulation> whole = build_simulation(file->scene), paused = build_simulation(file->scene);
  if (!whole || !paused || moments < 1) return 3;
  const auto path = std::filesystem::temp_directory_path() /
                    ("save_load_" + std::filesystem::path(argv[1]).stem().string());
  std::puts("step,time,fans,components,bytes,save ms,load ms");
  long done = 0;
  for (long step = 1; step <= steps; ++step) {
    const StepReport a = advance(*whole), b = advance(*paused);
    if (a.status.outcome != StepOutcome::fine) return 5;
    const std::string difference = test::first_difference(*whole, *paused);
    if (!difference.empty() || !same_fans(a, b)) {
      std::printf("step %ld differs: %s\n", step, difference.empty() ? "fans" : difference.c_str());
      return 1;
    }
    // In the middle of each of so many parts of the run.
    if (done < moments && 2 * step * moments >= (2 * done + 1) * steps) {
      ++done;
      if (!save_and_load(*paused, path)) return 5;
    }
  }
  const bool same = saved_state(*whole) == saved_state(*paused);
  std::filesystem::remove(path);
  std::printf("%ld steps, %ld moments: %s\n", steps, done,
              same ? "the same bytes" : "the saved states differ at the end");
  return same ? 0 : 1;
}
