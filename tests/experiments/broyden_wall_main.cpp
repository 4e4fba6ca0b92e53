// SPDX-License-Identifier: MIT
// Command: iterations of Broyden's method in one step of a block, over the step;
// docs/lab/baselines.md.
#include <cmath>
#include <cstdio>

#include "mechanics/baselines/verlet.hpp"
#include "mechanics/integrators/component_step.hpp"
#include "tests/support/frequency.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

SolveReport iterate(const MechanicsState& start, const Body& body, IntegratorSettings settings) {
  MechanicsState state = start;
  return run(state, body, settings, 1).solve;
}

void print(const SolveReport& report) {
  if (report.not_converged > 0) {
    std::printf("%16s", "given up");
  } else {
    std::printf("%16llu", static_cast<unsigned long long>(report.iterations));
  }
}

}  // namespace

int main() {
  const Body body = kuhn_block({17, 9, 7}, Vec3(1, 0.5, 0.5));
  std::mt19937 random(5);
  MechanicsState start = state_of(body, {.young_modulus = 3e10});
  deform(start, 1e-6, random);
  const double limit = 2 / highest_frequency(start, body);
  std::printf("%zu tetrahedra, 30 GPa; explicit limit %.3g s, element bound %.2f of it\n",
              body.corners.size(), limit, explicit_step_bound(start) / limit);
  std::printf("%-12s%16s%16s%16s\n", "step/limit", "M, memory 20", "M, memory 200", "factor");
  for (const double part : {0.5, 0.8, 1.0, 1.3, 1.6, 2.0, 2.7, 6.7, 135.0, 2245.0}) {
    IntegratorSettings settings{.time_step = part * limit, .integrator = Integrator::broyden};
    std::printf("%-12g", part);
    for (const std::uint32_t memory : {20u, 200u}) {
      settings.broyden_memory = memory;
      print(iterate(start, body, settings));
    }
    settings.broyden_start = BroydenStart::factor;
    print(iterate(start, body, settings));
    std::printf("\n");
  }
}
