// SPDX-License-Identifier: MIT
// Prints the table of three-point bending: node stresses over meshes, and slow runs in time.
#include <cstdio>
#include <cstdlib>

#include "tests/experiments/cases/bending.hpp"

using namespace sunder;
using namespace sunder::accuracy;

int main() {
  constexpr const char* names[] = {"volume", "mass", "fit"};
  std::printf(
      "static: load, surface stress over beam theory's; away in elements; angle in degrees\n");
  std::printf("%6s %9s %-7s %8s %8s %6s %6s %9s %9s %10s\n", "layers", "tets", "mode", "load",
              "surface", "away", "angle", "unfitted", "first ns", "ns/vertex");
  for (const int layers : {2, 4, 8, 12}) {
    const BendingTable table = bend_static(layers);
    for (int mode = 0; mode < 3; ++mode) {
      const BendingAnswer& a = table.modes[mode];
      std::printf("%6d %9zu %-7s %8.3f %8.3f %6.2f %6.2f %9zu %9.0f %10.1f\n", layers,
                  table.tetrahedra, names[mode], a.load, a.surface, a.away, a.angle, a.unfitted,
                  a.first_ns, a.ns);
    }
  }
  std::printf("\nin time: load raised over 10 s, steps of 20 ms; the step with the first fans\n");
  std::printf("%6s %-7s %8s %6s %6s %6s %7s %13s\n", "layers", "mode", "load", "away", "angle",
              "fans", "steps", "quasi-static");
  for (int mode = 0; mode < 3; ++mode) {
    const BendingRun r = bend_slowly(4, static_cast<NodeStress>(mode));
    std::printf("%6d %-7s %8.3f %6.2f %6.2f %6zu %7zu %13zu\n", 4, names[mode], r.load, r.away,
                r.angle, r.fans, r.steps, r.quasi_static);
  }
  return EXIT_SUCCESS;
}
