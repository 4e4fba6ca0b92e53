// SPDX-License-Identifier: MIT
// Prints the table of the crack cases: edge_crack and penny_crack over their meshes.
#include <cstdio>

#include "tests/experiments/cases/crack_cases.hpp"
#include "tests/experiments/cases/disc_crack.hpp"

using namespace sunder::accuracy;

namespace {

void print(const char* name, const std::vector<CrackAnswer>& answers) {
  std::printf("%s\n%5s %9s %10s %11s %9s %10s %9s %9s %7s %7s %7s %7s\n", name, "a/h", "vertices",
              "tip stress", "G front", "G fan", "load: C", "energy", "strength", "C", "star",
              "domain", "most");
  for (const CrackAnswer& a : answers) {
    std::printf("%5d %9zu %10.3f %11.3f %9.3f %10.3f %9.3f %9.3f %7.3f %7.3f %7.3f %7.3f\n",
                a.cells, a.vertices, a.tip_stress, a.front_release, a.fan_release, a.load_toughness,
                a.load_energy, a.load_strength, a.factor, a.star_energy, a.domain_energy,
                a.most_energy);
  }
}

void print(const DiscAnswer& a) {
  std::printf("%5d %9zu %8.3f %7.3f %7.2f %9.2f %7.2f %7.2f %8.3f %6zu\n", a.cells, a.vertices,
              a.tension, a.load, a.first, a.farthest, a.length, a.area, a.upright, a.fans);
}

}  // namespace

int main() {
  print("edge crack: G and loads over the closed form's", edge_cracks({8, 16, 32}));
  print("penny crack", {penny_crack({4}), penny_crack({8}), penny_crack({16})});
  print("edge crack, second order", edge_cracks({4, 8, 16}, 2));
  print("penny crack, second order", {penny_crack({2, 2}), penny_crack({4, 2})});
  std::printf("Brazilian disc\n%5s %9s %8s %7s %7s %9s %7s %7s %8s %6s\n", "D/h", "vertices",
              "tension", "load", "first", "farthest", "length", "area", "upright", "fans");
  for (const int cells : {18, 36}) print(brazilian_disc(cells));
}
