// SPDX-License-Identifier: MIT
// Layers that a pulse breaks off a flat bar. `spall`: cracks that open at once, over its peak,
// cells, steps and viscosity. `spall --ties`: cracks that take energy, next to the one-dimensional
// program; `spall --ties STEP`: in other steps than a quarter of a cell.
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <string_view>
#include <vector>

#include "tests/experiments/cases/spall.hpp"

using namespace sunder::accuracy;

namespace {

void row(const Spall& spall) {
  const SpallOutcome o = run_spall(spall);
  std::printf("%d x %d,%g,%g,%g,%g,%zu,%zu,%.4f,", spall.cells, spall.across, spall.peak,
              spall.front, spall.step, spall.viscosity, o.exact_layers, o.thickness.size(),
              o.exact_thickness);
  for (const double t : o.thickness) std::printf(" %.4f", t);
  std::printf(",%.3f,%.3f,%.12f\n", o.speed, o.time, o.momentum);
  std::fflush(stdout);
}

void print_layers(const std::vector<double>& thickness) {
  std::printf("%zu,", thickness.size());
  for (const double t : thickness) std::printf(" %.4f", t);
}

/// Layers through ties, for a rise of one length: they should not grow in number with the cells.
void print_ties(double step) {
  std::puts(
      "who,cells,s0 / xi,G_c / (J/m^2),layers,thickness / m,momentum,open by a tenth,residual");
  for (const double energy : {1.0, 3.0, 10.0}) {
    for (const double peak : {1.5, 2.5, 3.5}) {
      const Spall pulse{
          .peak = peak, .step = step, .front_length = 0.05, .fracture_energy = energy};
      for (const int cells : {150, 300, 600}) {
        Spall spall = pulse;
        spall.cells = cells;
        const SpallOutcome o = run_spall(spall);
        std::printf("sunder,%d,%g,%g,", cells, peak, energy);
        print_layers(o.thickness);
        std::printf(",%.12f\n", o.momentum);
        std::fflush(stdout);
      }
      for (const int cells : {150, 300, 600, 1200, 2400, 4800}) {
        const ChainSpallOutcome o = run_spall_on_chain(pulse, cells);
        std::printf("chain,%d,%g,%g,", cells, peak, energy);
        print_layers(o.thickness);
        std::printf(",%.12f,%zu,%.1e\n", o.momentum, o.live, o.residual);
        std::fflush(stdout);
      }
    }
  }
}

}  // namespace

int main(int count, char** words) {
  if (count > 1 && std::string_view(words[1]) == "--ties") {
    print_ties(count > 2 ? std::atof(words[2]) : Spall{}.step);
    return 0;
  }
  std::puts(
      "cells,s0 / xi,front / cells,step / (cell / c),viscosity,layers exact,layers,thickness exact "
      "/ m,thickness / m,speed,time,momentum");
  for (const double peak : {0.9, 1.5, 2.5, 3.5}) row({.peak = peak});
  for (const double peak : {1.5, 2.5}) row({.cells = 300, .peak = peak});
  for (const int across : {2, 3}) row({.across = across});
  for (const double front : {1.0, 4.0, 16.0}) row({.front = front});
  for (const double step : {0.0625, 1.0}) row({.step = step});
  for (const double viscosity : {0.0, 0.3}) row({.viscosity = viscosity});
}
