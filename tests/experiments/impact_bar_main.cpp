// SPDX-License-Identifier: MIT
// `impact_bar`: a CSV of the flat bar on a wall for steps from 0.01 to 250 L/c.
#include <cstdio>
#include <cstring>

#include "tests/experiments/cases/impact_bar.hpp"

using namespace sunder::accuracy;

namespace {

void print_row(const BarImpact& impact) {
  const BarOutcome o = run_bar(impact);
  std::printf("%dx%dx%d,%g,%g,%.3f,%.3f,%.3f,%.3f,%.4f,%.3f,%.3f,%.3f,%u,%s\n", impact.cells[0],
              impact.cells[1], impact.cells[2], impact.step, impact.touches_at,
              o.element_compression, o.node_compression, o.element_tension, o.node_tension,
              o.rebound, o.contact_time, o.energy_peak, o.energy_end, o.sub_steps,
              o.broke ? "yes" : "no");
  std::fflush(stdout);
}

}  // namespace

/// Arguments: `--whole` leaves fracture out, so that all of a run is of one bar; `--no-window`
/// leaves impact windows out.
int main(int argc, char** argv) {
  BarImpact impact;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--whole") == 0) {
      impact.breaks = false;
    } else if (std::strcmp(argv[i], "--no-window") == 0) {
      impact.impact.window = false;
    } else {
      std::fprintf(stderr, "usage: impact_bar [--whole] [--no-window]\n");
      return 2;
    }
  }
  std::puts(
      "cells,step/(L/c),touches_at,element_compression/(rho c v),node_compression/(rho c v),"
      "element_tension/xi,node_tension/xi,rebound/v,contact_time/(2L/c),energy_peak,energy_end,"
      "sub_steps,broke");
  for (const auto& cells : {std::array{50, 1, 1}, std::array{20, 2, 2}}) {
    for (const double step : {0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 25.0, 100.0, 250.0}) {
      impact.cells = cells;
      impact.step = step;
      print_row(impact);
    }
  }
}
