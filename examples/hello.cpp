// SPDX-License-Identifier: MIT
// A scene in C++ without a file: a beam of granite falls on the ground and breaks.
#include <cstdio>
#include <sunder/fragments.hpp>
#include <sunder/mesh.hpp>
#include <sunder/simulation.hpp>

int main() {
  sunder::BodySettings beam;
  beam.mesh = sunder::box_solid({0.8, 0.2, 0.2}, {12, 3, 3});
  beam.material = {.young_modulus = 50e9, .density = 2650, .tensile_strength = 8e6};
  beam.translation = {0, 0, 0.35};
  beam.rotation = Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY());
  beam.velocity = {0, 0, -8};

  sunder::Scene scene;
  scene.bodies = {beam};
  scene.obstacles = {{.shape = sunder::Plane{}, .friction = 0.5}};
  scene.gravity.acceleration = {0, 0, -9.81};
  scene.duration = 0.05;

  auto sim = sunder::build_simulation(scene);
  for (const sunder::Finding& f : sim.findings) std::fprintf(stderr, "%s\n", f.text.c_str());
  if (!sim) return 3;
  const auto steps = sunder::step_count(scene);
  while (sunder::steps_taken(*sim) < steps) {
    if (sunder::advance(*sim).status.outcome != sunder::StepOutcome::fine) return 5;
  }
  for (const sunder::Fragment& piece : sunder::fragments(*sim)) {
    std::printf("%.4f kg at (%.3f, %.3f, %.3f) m, %.2f m/s\n", piece.mass, piece.center[0],
                piece.center[1], piece.center[2], piece.velocity.norm());
  }
}
