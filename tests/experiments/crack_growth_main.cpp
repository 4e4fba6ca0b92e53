// SPDX-License-Identifier: MIT
// `crack_growth [MESH...]`: notched bars, one crack or many, by the stresses used within a step and
// by the crack mode; bars of cubes, and MESHes of the box 0.8 x 0.4 x 0.1 m.
// `crack_growth --ways [MESH...]`: plain bars at bare clamps, by the criteria at a crack's edge.
#include <cstdio>
#include <stdexcept>
#include <string_view>

#include "tests/experiments/cases/crack_growth.hpp"
#include "topology/io/mesh_file.hpp"

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
  std::printf("%-9s %4s %8.3f %-7s %5u %6zu %6zu %6zu %7.3f %7.2f %8.3g %7.3f %7.2f\n", name,
              bar.cut ? "yes" : "no", bar.stress_rate * bar.time_step / 1e6,
              criterion == FractureCriterion::stress ? "stress" : "energy", relax, a.pieces, a.fans,
              a.steps, a.load / 1e6, a.area, a.energy, a.farthest, a.worst_ms);
  std::fflush(stdout);
}

void print(const char* mesh, const NotchedBar& bar, CrackMode mode) {
  NotchedBar pulled = bar;
  pulled.fracture.crack = mode;
  std::printf("%-24s %4s %-7s ", mesh, bar.cut ? "yes" : "no",
              mode == CrackMode::paper    ? "paper"
              : mode == CrackMode::object ? "object"
                                          : "cohesive");
  try {
    const GrowthAnswer a = pulled_apart(pulled);
    std::printf("%6zu %6zu %6zu %7.3f %7.2f %9.3f %7.2f %9.3f %7.3f %8.3f\n", a.pieces, a.fans,
                a.steps, a.load / 1e6, a.parted_area, a.parted_projected, a.area, a.projected,
                a.farthest, a.smallest);
  } catch (const std::runtime_error& error) {
    std::printf("%s\n", error.what());
  }
  std::fflush(stdout);
}

/// Bars of concrete at 0.3 MPa a step, on the stresses from before each step.
int print_modes(int count, char** files, const Material& concrete) {
  std::printf("%-24s %4s %-7s %6s %6s %6s %7s %17s %17s\n", "", "", "", "", "", "", "",
              "when parted", "20 steps later");
  std::printf("%-24s %4s %-7s %6s %6s %6s %7s %7s %9s %7s %9s %7s %8s\n", "mesh", "cut", "crack",
              "pieces", "fans", "steps", "MPa", "area", "projected", "area", "projected", "far/b",
              "smallest");
  NotchedBar bar{
      .height = 0.4, .thickness = 2, .material = concrete, .stress_rate = 3e8, .shake = 0.15};
  for (int k = count > 0 ? 0 : -1; k < count; ++k) {
    if (k >= 0) {
      Result<TetMesh> mesh = read_mesh(std::filesystem::path(files[k]));
      for (const Finding& f : mesh.findings) std::fprintf(stderr, "%s\n", f.text.c_str());
      if (!mesh) return 3;
      bar.mesh = std::move(*mesh);
    }
    for (const bool cut : {true, false}) {
      bar.cut = cut;
      // Without a notch a bar breaks at its clamps, where corners have no finite stress, and the
      // rest swings back to the same load a period later: grips, and two per cent of damping.
      bar.grip = cut || k < 0 ? 0 : 0.25;
      bar.damping = cut || k < 0 ? 0 : 5e-6;
      // Bars that are no cubes turn to dust in mode `paper`, at seconds per step.
      if (k < 0) print("cubes", bar, CrackMode::paper);
      print(k < 0 ? "cubes" : files[k], bar, CrackMode::object);
      // Ties need neither grips nor damping.
      bar.grip = bar.damping = 0;
      print(k < 0 ? "cubes" : files[k], bar, CrackMode::cohesive);
    }
  }
  return 0;
}

/// A plain bar of concrete with each of them, cracks as objects.
void print_ways(const char* mesh, const NotchedBar& plain) {
  const auto print_way = [&](const char* way, const auto& change) {
    NotchedBar bar = plain;
    bar.fracture.crack = CrackMode::object;
    change(bar);
    std::printf("%-24s %-9s ", mesh, way);
    try {
      const GrowthAnswer a = pulled_apart(bar);
      std::printf("%6zu %6zu %7.3f %7.2f %9.3f %7.2f %9.3f %7.3f\n", a.pieces, a.fans, a.load / 1e6,
                  a.parted_area, a.parted_projected, a.area, a.projected, a.farthest);
    } catch (const std::runtime_error& error) {
      std::printf("%s\n", error.what());
    }
    std::fflush(stdout);
  };
  const auto tough = [](double toughness, auto further) {
    return [=](NotchedBar& bar) {
      bar.material.toughness = toughness;
      further(bar);
    };
  };
  const auto bare = [](auto further) {
    return [=](NotchedBar& bar) {
      bar.material.toughness.reset();
      further(bar);
    };
  };
  const auto nothing = [](NotchedBar&) {};
  const auto energy = [](NotchedBar& bar) { bar.fracture.criterion = FractureCriterion::energy; };
  const auto fit = [](NotchedBar& bar) { bar.fracture.node_stress = NodeStress::fit; };
  const auto relax = [](NotchedBar& bar) { bar.fracture.relax = 2; };
  const auto shorter = [](NotchedBar& bar) { bar.time_step /= 10; };
  const auto damped = [](NotchedBar& bar) { bar.damping = 5e-6; };
  print_way("bare", bare(nothing));
  print_way("K 1.0", tough(1e6, nothing));
  print_way("K 0.5", tough(5e5, nothing));
  print_way("K 0.3", tough(3e5, nothing));
  print_way("G 0.5", tough(5e5, energy));
  print_way("fit", bare(fit));
  print_way("relax", bare(relax));
  print_way("relax 0.5", tough(5e5, relax));
  print_way("step/10", bare(shorter));
  print_way("damp", bare(damped));
}

int print_ways(int count, char** files, const Material& concrete) {
  std::printf("%-24s %-9s %6s %6s %7s %17s %17s\n", "", "", "", "", "", "when parted",
              "20 steps later");
  std::printf("%-24s %-9s %6s %6s %7s %7s %9s %7s %9s %7s\n", "mesh", "way", "pieces", "fans",
              "MPa", "area", "projected", "area", "projected", "far/b");
  NotchedBar bar{.height = 0.4, .material = concrete, .stress_rate = 3e8, .shake = 0.15};
  bar.cut = false;
  bar.in_vain = 1.5;
  for (int k = -1; k < count; ++k) {
    if (k >= 0) {
      Result<TetMesh> mesh = read_mesh(std::filesystem::path(files[k]));
      for (const Finding& f : mesh.findings) std::fprintf(stderr, "%s\n", f.text.c_str());
      if (!mesh) return 3;
      bar.mesh = std::move(*mesh);
    }
    print_ways(k < 0 ? "cubes" : files[k], bar);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
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
  const Material& concrete = materials[1].material;
  if (argc > 1 && std::string_view(argv[1]) == "--ways") {
    return print_ways(argc - 2, argv + 2, concrete);
  }
  if (argc > 1) return print_modes(argc - 1, argv + 1, concrete);
  std::printf("%-9s %4s %8s %-7s %5s %6s %6s %6s %7s %7s %8s %7s %7s\n", "material", "cut",
              "MPa/step", "breaks", "relax", "pieces", "fans", "steps", "MPa", "area", "J/m^2",
              "far/b", "ms");
  for (const Named& m : materials) {
    NotchedBar bar{.height = 0.4, .cells = 16, .material = m.material, .shake = 0.15};
    for (const double rate : {3e6, 1e8, 3e8}) {
      bar.stress_rate = rate;
      for (const std::uint32_t relax : {0, 2, 4}) {
        print(m.name, bar, FractureCriterion::stress, relax);
      }
      for (const std::uint32_t relax : {0, 2}) {
        print(m.name, bar, FractureCriterion::energy, relax);
      }
    }
  }
  NotchedBar whole{.height = 0.4, .material = concrete, .shake = 0.15, .cut = false};
  whole.stress_rate = 3e8;
  for (const std::uint32_t relax : {0, 2, 4}) {
    print("concrete", whole, FractureCriterion::stress, relax);
  }
  return print_modes(0, nullptr, concrete);
}
