// SPDX-License-Identifier: MIT
// Fragments of a ring that flies apart. `ring_burst`: cracks that open at once, over the rate, and
// the slope of their size. `ring_burst --ties`: cracks that take energy, next to Zhou's law and the
// one-dimensional program; `ring_burst --chain`: that program alone. Both take
// `--seeds N` (10), `--places N`, `--spread S` and `--rate R`, --ties also `--cells N` and `--step
// S`.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <string_view>
#include <vector>

#include "tests/experiments/cases/ring_burst.hpp"

using namespace sunder::accuracy;

namespace {

RingOutcome row(const RingBurst& burst) {
  const RingOutcome o = run_ring(burst);
  std::printf("%d,%g,%g,%g,%g,%zu,%zu,%zu,%.1f,%.4g\n", burst.cells, burst.rate, burst.spread,
              burst.step, burst.viscosity, o.fragments, o.expected, o.same_sections,
              o.mean_expected, o.energy_per_area);
  std::fflush(stdout);
  return o;
}

double slope(std::size_t few, std::size_t many, double rates) {
  return -std::log(double(many) / double(few)) / std::log(rates);
}

/// The rings with ties to run; as they stand, those of docs/lab/accuracy.md.
struct Plan {
  std::vector<double> spreads = {0.5, 3}, rates = {1.5, 6};
  std::vector<int> meshes = {400, 800, 1600};
  unsigned seeds = 10;
  int places = RingBurst{}.places;
  double step = RingBurst{}.step;
};

struct Means {
  double fragments = 0, taken = 0, live = 0, contact = 0, residual = 0;
};

/// Over seeds 1, 2, ...; each on the standard error as it comes.
Means sunder_means(RingBurst burst, unsigned seeds) {
  Means mean;
  for (burst.seed = 1; burst.seed <= seeds; ++burst.seed) {
    const RingOutcome o = run_ring(burst);
    mean.fragments += double(o.fragments) / seeds;
    mean.taken += o.taken / seeds;
    std::fprintf(stderr, "spread %g, rate %g, %d cells, seed %u: %zu\n", burst.spread, burst.rate,
                 burst.cells, burst.seed, o.fragments);
  }
  return mean;
}

Means chain_means(RingBurst burst, unsigned seeds, double step, double viscosity = 0) {
  Means mean;
  for (burst.seed = 1; burst.seed <= seeds; ++burst.seed) {
    const ChainRingOutcome o = run_ring_on_chain(burst, burst.cells, step, viscosity);
    mean.fragments += double(o.fragments) / seeds;
    mean.taken += o.taken / seeds;
    mean.live += double(o.live) / seeds;
    mean.contact += o.contact / seeds;
    mean.residual = std::max(mean.residual, o.residual);
  }
  return mean;
}

/// Calls `visit(ring)` for each spread and rate of a plan.
template <class Visit>
void for_rings(const Plan& plan, const Visit& visit) {
  for (const double spread : plan.spreads) {
    for (const double rate : plan.rates) {
      visit(
          RingBurst{.rate = rate, .spread = spread, .fracture_energy = 33, .places = plan.places});
    }
  }
}

/// The program by itself, as its cells and steps shrink.
void print_chain(const Plan& plan) {
  std::puts(
      "spread,rate / (1/s),cells,step / (cell / c),viscosity,fragments,open by a "
      "tenth,taken,contact,"
      "residual,by Zhou,by Glenn");
  for_rings(plan, [&](const RingBurst& ring) {
    const auto row = [&](int cells, double step, double viscosity) {
      RingBurst burst = ring;
      burst.cells = cells;
      const Means m = chain_means(burst, plan.seeds, step, viscosity);
      std::printf("%g,%g,%d,%g,%g,%.1f,%.1f,%.3f,%.3f,%.1e,%.1f,%.1f\n", ring.spread, ring.rate,
                  cells, step, viscosity, m.fragments, m.live, m.taken, m.contact, m.residual,
                  zhou_fragments(ring), glenn_fragments(ring));
      std::fflush(stdout);
    };
    for (const int cells : {400, 800, 1600, 3200, 6400}) row(cells, 0.1, 0);
    for (const double step : {0.5, 0.025}) row(1600, step, 0);
    // The viscosity of Sunder's sub-steps, and their former one with 0.1 of the scene's own.
    for (const double viscosity : {0.1, 0.4}) {
      for (const int cells : {400, 800, 1600}) row(cells, 0.1, viscosity);
    }
  });
}

/// Rings with tied sections, next to Zhou's law and the program on its finest chain.
void print_ties(const Plan& plan) {
  std::puts(
      "spread,rate / (1/s),cells,step / (cell / c),fragments,taken,by Zhou,over Zhou,"
      "by the chain of 6400,over the chain");
  for_rings(plan, [&](RingBurst burst) {
    burst.cells = 6400;
    const double zhou = zhou_fragments(burst), fine = chain_means(burst, plan.seeds, 0.1).fragments;
    burst.step = plan.step;
    for (const int cells : plan.meshes) {
      burst.cells = cells;
      const Means m = sunder_means(burst, plan.seeds);
      std::printf("%g,%g,%d,%g,%.1f,%.3f,%.1f,%.3f,%.1f,%.3f\n", burst.spread, burst.rate, cells,
                  burst.step, m.fragments, m.taken, zhou, m.fragments / zhou, fine,
                  m.fragments / fine);
      std::fflush(stdout);
    }
  });
}

}  // namespace

int main(int count, char** words) {
  Plan plan;
  bool ties = false, chain = false;
  for (int k = 1; k < count; ++k) {
    const std::string_view word = words[k];
    ties |= word == "--ties";
    chain |= word == "--chain";
    if (word == "--ties" || word == "--chain") continue;
    const double value = k + 1 < count ? std::atof(words[++k]) : 0;
    if (!(value > 0)) {
      std::fprintf(stderr, "%s wants a number > 0 after it\n", word.data());
      return 2;
    }
    if (word == "--seeds") plan.seeds = unsigned(value);
    if (word == "--places") plan.places = int(value);
    if (word == "--cells") plan.meshes = {int(value)};
    if (word == "--spread") plan.spreads = {value};
    if (word == "--rate") plan.rates = {value};
    if (word == "--step") plan.step = value;
  }
  if (ties) print_ties(plan);
  if (chain) print_chain(plan);
  if (ties || chain) return 0;
  std::puts(
      "cells,rate / (1/s),spread,step / (cell / c),viscosity,fragments,by the rule,same sections,"
      "mean of the rule,energy lost a crack area / (J/m^2)");
  for (const int cells : {400, 800, 1600}) {
    const RingOutcome slow = row({.cells = cells, .rate = 1.5});
    row({.cells = cells, .rate = 3});
    const RingOutcome fast = row({.cells = cells, .rate = 6});
    std::printf("# size over rate to the power of %.2f, by the rule %.2f\n",
                slope(slow.fragments, fast.fragments, 4), slope(slow.expected, fast.expected, 4));
  }
  for (const double viscosity : {0.0, 0.3}) row({.viscosity = viscosity});
  for (const double step : {0.0625, 1.0}) row({.step = step});
  for (const double spread : {0.1, 1.0}) row({.spread = spread});
}
