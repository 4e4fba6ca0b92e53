// SPDX-License-Identifier: MIT
// `hertz`: a round block on a rigid wall against Hertz, over cells, speed and Poisson's ratio.
#include <cstdio>
#include <initializer_list>

#include "tests/experiments/cases/hertz.hpp"

using namespace sunder::accuracy;

namespace {

void row(const HertzImpact& impact) {
  const HertzOutcome o = run_hertz(impact);
  std::printf("%d,%g,%g,%g,%zu,%.2f,%.3f,%.3f,%.3f,%.3f,%.3f,%.3f\n", impact.cells, impact.smallest,
              impact.speed, impact.poisson_ratio, o.vertices, o.radius_cells, o.contact_time,
              o.force, o.radius, o.law, o.pressure, o.rebound);
  std::fflush(stdout);
}

}  // namespace

int main() {
  std::puts(
      "cells,smallest / m,speed / (m/s),nu,vertices,a / cell,time,force,radius,force of "
      "radius,pressure,rebound");
  for (const int cells : {6, 8, 12, 16}) row({.cells = cells});
  for (const double smallest : {0.03, 0.012}) row({.cells = 12, .smallest = smallest});
  row({.smallest = 0.008, .speed = 0.3});
  row({.smallest = 0.03, .speed = 8});
  for (const double nu : {0.0, 0.4}) row({.poisson_ratio = nu});
}
