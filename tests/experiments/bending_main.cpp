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
  std::printf(
      "\nin time: load raised by 0.0028 a step of 20 ms; the step with the first fans | until it "
      "is apart\n");
  std::printf("%6s %-7s %-7s %8s %6s %6s %6s %7s %13s | %7s %6s %6s %7s %9s %8s\n", "layers",
              "mode", "crack", "load", "away", "angle", "fans", "steps", "quasi-static", "parted",
              "pieces", "fans", "area", "projected", "far/h");
  for (const CrackMode crack : {CrackMode::paper, CrackMode::object}) {
    for (int mode = 0; mode < 3; ++mode) {
      const BendingRun r = bend_slowly(4, static_cast<NodeStress>(mode), crack);
      std::printf(
          "%6d %-7s %-7s %8.3f %6.2f %6.2f %6zu %7zu %13zu | %7.3f %6zu %6zu %7.2f %9.2f %8.3f\n",
          4, names[mode], crack == CrackMode::paper ? "paper" : "object", r.load, r.away, r.angle,
          r.fans, r.steps, r.quasi_static, r.parted, r.pieces, r.all_fans, r.area, r.projected,
          r.farthest);
    }
  }
  return EXIT_SUCCESS;
}
