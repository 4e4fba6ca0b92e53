// SPDX-License-Identifier: MIT
// `free_flight`: a CSV of momenta and stress after 10 s of flight at 50 rad/s.
#include <cstdio>

#include "tests/experiments/cases/free_flight.hpp"

using namespace sunder::accuracy;

int main() {
  std::puts("ladder,step / ms,P drift,L drift,energy drift,least stress,most stress,fans,failure");
  for (const bool ladder : {false, true}) {
    for (const double step : {1e-3, 10e-3, 16.7e-3}) {
      const FlightDrift d = run_free_flight({.time_step = step, .ladder = ladder});
      std::printf("%s,%g,%.1e,%.1e,%.1e,%.5f,%.5f,%zu,%s\n", ladder ? "yes" : "no", 1e3 * step,
                  d.momentum, d.angular_momentum, d.energy, d.least_stress, d.most_stress, d.fans,
                  d.failure.c_str());
      std::fflush(stdout);
    }
  }
}
