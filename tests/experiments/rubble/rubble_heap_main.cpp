// SPDX-License-Identifier: MIT
// The cost of a heap of chips by the rubble solver, and an outside judge's findings about it.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "tests/experiments/rubble/rubble_scenes.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

double now_ms() {
  return std::chrono::duration<double, std::milli>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

}  // namespace

int main(int argc, char** argv) {
  const unsigned seed = argc > 1 ? static_cast<unsigned>(std::atoi(argv[1])) : 0;
  const double seconds = argc > 2 ? std::atof(argv[2]) : 2;
  const int per_second = argc > 3 ? std::atoi(argv[3]) : 240;
  RubbleScene scene = broken_block({5, 5, 8}, 0.01, {0, 0, 0.02}, 2, seed);
  RubbleSettings settings;
  settings.gravity = {0, 0, -9.81};
  settings.length = 1.0 / per_second;
  settings.sub_steps = argc > 4 ? std::atoi(argv[4]) : 4;
  if (argc > 5) settings.sleep_after = std::atof(argv[5]);
  if (argc > 6) settings.still_speed = std::atof(argv[6]);
  RubbleScratch scratch;
  std::puts("time,ms,broad,narrow,solve,awake,pairs,manifolds,points,kinetic,deepest,mean,below");
  double spent = 0, broad = 0, narrow = 0, solve = 0;
  for (int k = 1; k <= seconds * per_second; ++k) {
    const double start = now_ms();
    const RubbleReport report =
        advance_rubble(scene.bodies, scene.shapes, scene.memory, settings, scratch);
    spent += now_ms() - start;
    broad += report.broad_ms;
    narrow += report.narrow_ms;
    solve += report.solve_ms;
    const int every = per_second / 10;
    if (k % every != 0) continue;
    const std::vector<SeenPart> parts = parts_of(scene);
    const SeenOverlaps seen = see_overlaps(parts);
    const Sums sums = sums_of(scene, settings.gravity);
    std::printf("%.3f,%.2f,%.2f,%.2f,%.2f,%u,%u,%u,%u,%.3g,%.3g,%.3g,%.3g\n", k * settings.length,
                spent / every, broad / every, narrow / every, solve / every, report.awake,
                report.pairs, report.manifolds, report.points, sums.kinetic, seen.deepest,
                seen.mean, below_ground(parts));
    std::fflush(stdout);
    spent = broad = narrow = solve = 0;
  }
}
