// SPDX-License-Identifier: MIT
// `ring_burst [--ties]`: fragments of a ring that flies apart, over the rate, and the slope of their size.
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <string_view>

#include "tests/experiments/cases/ring_burst.hpp"

using namespace sunder::accuracy;

namespace {

RingOutcome row(const RingBurst& burst) {
  const RingOutcome o = run_ring(burst);
  std::printf("%d,%g,%g,%g,%g,%g,%zu,%zu,%zu,%.1f,%.1f,%.4g\n", burst.cells, burst.rate,
              burst.spread, burst.step, burst.viscosity, burst.toughness.value_or(0), o.fragments,
              o.expected, o.same_sections, o.mean_expected, o.grady_fragments, o.energy_per_area);
  std::fflush(stdout);
  return o;
}

double slope(std::size_t few, std::size_t many, double rates) {
  return -std::log(double(many) / double(few)) / std::log(rates);
}

/// Rings whose sections are tied: fragments over cells, rate and seed.
void print_ties() {
  std::puts("cells,rate / (1/s),spread,step / (cell / c),seed,fragments,by Zhou,taken");
  for (const double spread : {0.5, 3.0}) {
    for (const double rate : {1.5, 6.0}) {
      for (const int cells : {400, 800, 1600}) {
        for (const std::uint32_t seed : {1u, 2u, 3u}) {
          const RingBurst burst{.cells = cells, .rate = rate, .spread = spread, .seed = seed,
                                .fracture_energy = 33};
          const RingOutcome o = run_ring(burst);
          std::printf("%d,%g,%g,%g,%u,%zu,%.1f,%.3f\n", cells, rate, spread, burst.step, seed,
                      o.fragments, o.zhou_fragments, o.taken);
          std::fflush(stdout);
        }
      }
    }
  }
}

}  // namespace

int main(int count, char** words) {
  if (count > 1 && std::string_view(words[1]) == "--ties") {
    print_ties();
    return 0;
  }
  std::puts(
      "cells,rate / (1/s),spread,step / (cell / c),viscosity,K_Ic / (Pa sqrt m),fragments,by the "
      "rule,same sections,mean of the rule,by Grady,energy lost a crack area / (J/m^2)");
  for (const int cells : {400, 800, 1600}) {
    const RingOutcome slow = row({.cells = cells, .rate = 1.5, .toughness = 1e6});
    row({.cells = cells, .rate = 3, .toughness = 1e6});
    const RingOutcome fast = row({.cells = cells, .rate = 6, .toughness = 1e6});
    std::printf("# size over rate to the power of %.2f, by the rule %.2f, by Grady %.2f\n",
                slope(slow.fragments, fast.fragments, 4), slope(slow.expected, fast.expected, 4),
                -2.0 / 3);
  }
  for (const double viscosity : {0.0, 0.3}) row({.viscosity = viscosity});
  for (const double step : {0.0625, 1.0}) row({.step = step});
  for (const double spread : {0.1, 1.0}) row({.spread = spread});
  row({});
  for (const double toughness : {3e5, 3e6, 1e7}) row({.toughness = toughness});
}
