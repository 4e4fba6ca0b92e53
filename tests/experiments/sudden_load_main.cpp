// SPDX-License-Identifier: MIT
// `sudden_load`: a CSV of how steps of 1 to 1000 radians come to the static answer.
#include <cstdio>

#include "tests/experiments/cases/sudden_load.hpp"

using namespace sunder::accuracy;

int main() {
  std::puts("load,steps before,rho_infinity,w h,step,displacement error,stress error");
  for (const bool across : {false, true}) {
    for (const int before : {0, 1}) {
      for (const double rho : {0.0, 0.5}) {
        for (const double wh : {1.0, 3.0, 10.0, 30.0, 100.0, 1000.0}) {
          const auto steps = run_sudden_load({wh, across, before, rho}, 10);
          for (std::size_t k = 0; k < steps.size(); ++k) {
            std::printf("%s,%d,%g,%g,%zu,%.4f,%.4f\n", across ? "across" : "along", before, rho, wh,
                        k + 1, steps[k].displacement, steps[k].stress);
          }
        }
      }
    }
  }
}
