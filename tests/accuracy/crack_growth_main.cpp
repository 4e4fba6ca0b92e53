// SPDX-License-Identifier: MIT
// Prints what becomes of notched bars: one crack or many, by how stresses within a step are found.
#include <cstdio>

#include "tests/accuracy/crack_growth.hpp"

using namespace sunder;
using namespace sunder::accuracy;

namespace {

struct Named {
  const char* name;
  Material material;
};

void print(const char* name, NotchedBar bar, FractureCriterion criterion, std::uint32_t relax) {
  bar.fracture.criterion = criterion;
  bar.fracture.relax = relax;
  const GrowthAnswer a = pulled_apart(bar);
  std::printf("%-9s %5d %-7s %5u %6zu %6zu %6zu %7.3f %9.2g %7.2f %8.3g %7.3f %7.3f %7.2f\n", name,
              bar.cells, criterion == FractureCriterion::stress ? "stress" : "energy", relax,
              a.pieces, a.fans, a.steps, a.load / 1e6, a.separated, a.area, a.energy, a.farthest,
              a.smallest, a.worst_ms);
  std::fflush(stdout);
}

}  // namespace

int main() {
  const Named materials[] = {{"glass",
                              {.young_modulus = 70e9,
                               .poisson_ratio = 0.22,
                               .density = 2500,
                               .tensile_strength = 45e6,
                               .toughness = 0.75e6}},
                             {"concrete",
                              {.young_modulus = 30e9,
                               .poisson_ratio = 0.2,
                               .density = 2400,
                               .tensile_strength = 3e6,
                               .toughness = 1e6}}};
  std::printf("%-9s %5s %-7s %5s %6s %6s %6s %7s %9s %7s %8s %7s %7s %7s\n", "material", "b/h",
              "breaks", "relax", "pieces", "fans", "steps", "MPa", "s apart", "area", "J/m^2",
              "far/b", "smaller", "ms");
  for (const Named& m : materials) {
    for (const int cells : {8, 16}) {
      NotchedBar bar{.cells = cells, .material = m.material};
      for (const auto criterion : {FractureCriterion::stress, FractureCriterion::energy}) {
        for (const std::uint32_t relax : {0, 2, 4, 100}) print(m.name, bar, criterion, relax);
      }
    }
  }
}
