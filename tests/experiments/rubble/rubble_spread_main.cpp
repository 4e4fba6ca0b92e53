// SPDX-License-Identifier: MIT
// `rubble_spread [SEEDS] [SECONDS] [FASTER] [SUB_STEPS]`: height and radius of heaps of 1 200 chips
// by ticks of 1/240 s, of so many sub-steps at least (4), and by ticks so many times shorter (4), a
// row a seed, means and their differences last.
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "tests/experiments/rubble/outside_judge.hpp"
#include "tests/experiments/rubble/rubble_scenes.hpp"
#include "tests/experiments/rubble/thread_clock.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// The measurements of one heap.
struct Outcome {
  HeapShape shape;
  double ms = 0;  ///< of the processor for each simulated second
  unsigned awake = 0;
  SeenOverlaps seen;
  double below = 0;  ///< m
};

Outcome heap_of(unsigned seed, double seconds, int per_second, int sub_steps) {
  RubbleScene scene = broken_block({5, 5, 8}, 0.01, {0, 0, 0.02}, 2, seed);
  RubbleSettings settings;
  settings.gravity = {0, 0, -9.81};
  settings.length = 1.0 / per_second;
  settings.sub_steps = sub_steps;
  RubbleScratch scratch;
  Outcome o;
  const double start = thread_ms();
  for (int k = 0; k < seconds * per_second; ++k) {
    o.awake = advance_rubble(scene.bodies, scene.shapes, scene.memory, settings, scratch).awake;
  }
  o.ms = (thread_ms() - start) / seconds;
  std::vector<SeenMass> masses;
  for (const RubbleBody& b : scene.bodies) masses.push_back({b.centre, b.mass});
  o.shape = see_heap(masses);
  const std::vector<SeenPart> parts = parts_of(scene);
  o.seen = see_overlaps(parts);
  o.below = below_ground(parts);
  return o;
}

std::array<double, 3> values(const HeapShape& s) { return {s.height, s.radius, s.centre}; }

}  // namespace

int main(int argc, char** argv) {
  const int seeds = argc > 1 ? std::atoi(argv[1]) : 10;
  const double seconds = argc > 2 ? std::atof(argv[2]) : 2;
  const int faster = argc > 3 ? std::atoi(argv[3]) : 4;
  const int sub_steps = argc > 4 ? std::atoi(argv[4]) : RubbleSettings{}.sub_steps;
  std::puts(
      "seed,per second,height mm,radius mm,centre mm,awake,ms a second,deepest mm,mean mm,below "
      "mm");
  std::array<double, 3> sum{}, fast_sum{}, square{};
  for (int seed = 1; seed <= seeds; ++seed) {
    std::array<Outcome, 2> both;
    for (int k = 0; k < 2; ++k) {
      const int rate = k == 0 ? 240 : 240 * faster;
      const Outcome o = both[std::size_t(k)] =
          heap_of(static_cast<unsigned>(seed), seconds, rate,
                  k == 0 ? sub_steps : RubbleSettings{}.sub_steps);
      std::printf("%d,%d,%.2f,%.2f,%.2f,%u,%.0f,%.4f,%.4f,%.4f\n", seed, rate, 1e3 * o.shape.height,
                  1e3 * o.shape.radius, 1e3 * o.shape.centre, o.awake, o.ms, 1e3 * o.seen.deepest,
                  1e3 * o.seen.mean, 1e3 * o.below);
      std::fflush(stdout);
    }
    const auto one = values(both[0].shape), fast = values(both[1].shape);
    for (std::size_t k = 0; k < 3; ++k) {
      sum[k] += one[k];
      fast_sum[k] += fast[k];
      square[k] += (one[k] - fast[k]) * (one[k] - fast[k]);
    }
  }
  const char* names[] = {"height", "radius", "centre"};
  for (std::size_t k = 0; k < 3; ++k) {
    const double mean = (sum[k] - fast_sum[k]) / seeds;
    const double error = std::sqrt(std::max(0.0, square[k] / seeds - mean * mean) / (seeds - 1));
    const double percent = 100 * seeds / fast_sum[k];
    std::printf("%s: mean %.2f mm, of the shorter ticks %.2f mm: %+.2f %% (+- %.2f)\n", names[k],
                1e3 * sum[k] / seeds, 1e3 * fast_sum[k] / seeds, percent * mean, percent * error);
  }
}
