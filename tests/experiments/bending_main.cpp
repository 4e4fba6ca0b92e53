// SPDX-License-Identifier: MIT
// Prints the table of three-point bending: node stresses over meshes, and slow runs in time.
// `bending --ways [LAYERS]`: until the beam is apart, by the criteria at a crack's edge (4 layers).
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "tests/experiments/cases/bending.hpp"

using namespace sunder;
using namespace sunder::accuracy;

namespace {

constexpr const char* names[] = {"volume", "mass", "fit"};

void print(const SlowBend& bend) {
  const FractureSettings& f = bend.fracture;
  const BendingRun r = bend_slowly(bend);
  std::printf("%6d %-7s %-7s %9.2f %5u %7d %8.3f %8.4f | %7.3f %6zu %6zu %7.2f %9.2f %8.3f\n",
              bend.layers, names[static_cast<int>(f.node_stress)],
              f.criterion == FractureCriterion::stress ? "stress" : "energy",
              bend.toughness.value_or(0) / 1e6, f.relax, bend.divided, r.load, r.overload, r.parted,
              r.pieces, r.all_fans, r.area, r.projected, r.farthest);
  std::fflush(stdout);
}

/// Cracks as objects, with and without a toughness (MPa sqrt m; 0: none).
void print_ways(int layers) {
  std::printf("%6s %-7s %-7s %9s %5s %7s %8s %8s | %7s %6s %6s %7s %9s %8s\n", "layers", "mode",
              "breaks", "toughness", "relax", "divided", "load", "overload", "parted", "pieces",
              "fans", "area", "projected", "far/h");
  for (const NodeStress mode : {NodeStress::volume, NodeStress::fit}) {
    SlowBend bend{.layers = layers};
    bend.fracture.node_stress = mode;
    bend.fracture.crack = CrackMode::object;
    print(bend);
    bend.divided = 256;
    print(bend);
    bend.fracture.relax = 4;
    print(bend);
    bend.toughness = 5e5;
    print(bend);
    bend.fracture.relax = 0;
    for (const FractureCriterion criterion :
         {FractureCriterion::stress, FractureCriterion::energy}) {
      bend.fracture.criterion = criterion;
      for (const double toughness : {1e6, 5e5, 3e5}) {
        bend.toughness = toughness;
        print(bend);
      }
    }
  }
  // Toughness as a fracture energy.
  for (const NodeStress mode : {NodeStress::volume, NodeStress::fit}) {
    SlowBend bend{.layers = layers};
    bend.toughness = 1e6;
    bend.fracture.node_stress = mode;
    bend.fracture.crack = CrackMode::cohesive;
    print(bend);
  }
}

}  // namespace

int main(int count, char** words) {
  if (count > 1 && std::string_view(words[1]) == "--ways") {
    print_ways(count > 2 ? std::atoi(words[2]) : 4);
    return EXIT_SUCCESS;
  }
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
      const BendingRun r =
          bend_slowly({.fracture = {.node_stress = static_cast<NodeStress>(mode), .crack = crack}});
      std::printf(
          "%6d %-7s %-7s %8.3f %6.2f %6.2f %6zu %7zu %13zu | %7.3f %6zu %6zu %7.2f %9.2f %8.3f\n",
          4, names[mode], crack == CrackMode::paper ? "paper" : "object", r.load, r.away, r.angle,
          r.fans, r.steps, r.quasi_static, r.parted, r.pieces, r.all_fans, r.area, r.projected,
          r.farthest);
    }
  }
  return EXIT_SUCCESS;
}
