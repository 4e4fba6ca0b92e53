// SPDX-License-Identifier: MIT
// The strained block (figure 7): gravity raised slowly breaks it at its own mesh's static limit.
#include <catch2/catch.hpp>

#include "fracture/algorithms/choose_fan.hpp"
#include "fracture/algorithms/node_stress.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "mechanics/statics/static_solve.hpp"
#include "topology/io/mesh_file.hpp"

using namespace sunder;

namespace {

/// meshes/monolith.msh (1 x 0.3 x 2 m) lying on its broad side, 2 m along x, thick along z.
Scene lying_block() {
  Result<TetMesh> mesh = read_mesh(SUNDER_MESHES "/monolith.msh");
  REQUIRE(mesh);
  Scene scene;
  BodySettings block;
  block.name = "block";
  block.mesh = std::move(*mesh);
  block.material = {
      .young_modulus = 3e8, .poisson_ratio = 0.2, .density = 2400, .tensile_strength = 8e4};
  // x <- z, y <- x, z <- y
  block.rotation = Eigen::AngleAxisd(2 * M_PI / 3, Vec3(1, 1, 1).normalized());
  block.translation = {-1, 0, 0.15};
  scene.bodies.push_back(std::move(block));
  scene.integrator.time_step = 2e-3;
  return scene;
}

/// Largest principal node stress among the vertices that can break, Pa: where the whole star lies
/// on one side of the plane no fan exists, however high the stress.
double largest_breaking_stress(const Simulation& sim) {
  const MechanicsState& m = sim.state->mechanics;
  const Cells& cells = sim.state->cells;
  std::vector<Mat3> stress;
  average_node_stress(stress, {cells.map.corners(), m.elements.stress, m.elements.rest_volume},
                      m.vertices.size());
  double largest = 0;
  for (std::size_t v = 0; v < stress.size(); ++v) {
    const PrincipalTension tension = principal_tension(stress[v]);
    const VertexStar star = vertex_star(cells.map, VertexId{v});
    if (tension.value <= largest || choose_fan(cells, star, tension).faces.empty()) continue;
    largest = tension.value;
  }
  return largest;
}

/// Gravity (as a share of the scene's) at which the first fan comes while it is raised; 0 if none.
double breaking_share(Scene scene) {
  Result<Simulation> sim = build_simulation(scene);
  REQUIRE(sim);
  while (sim->state->mechanics.time < scene.gravity.ramp_time) {
    const StepReport report = advance(*sim);
    REQUIRE(report.status.outcome == StepOutcome::fine);
    if (!report.fracture.fans.empty()) return report.time / scene.gravity.ramp_time;
  }
  return 0;
}

}  // namespace

TEST_CASE("a block held at its ends breaks at its mesh's static limit, gravity ramped",
          "[fracture][block]") {
  Scene scene = lying_block();
  // The mesh's own z is the block's length: hold a strip at both ends.
  scene.bodies[0].held = {{.minimum = {-1, -1, -0.01}, .maximum = {1, 1, 0.05}},
                          {.minimum = {-1, -1, 1.95}, .maximum = {1, 1, 2.01}}};
  // The limit by an independent static solve under the full weight, the stress being linear in it.
  Result<Simulation> still = build_simulation(scene);
  REQUIRE(still);
  MechanicsState& m = still->state->mechanics;
  const Loads loads{.gravity = scene.gravity.acceleration, .force = {}};
  const auto findings =
      solve_static(m, still->scratch->mechanics, still->state->cells.map.corners(), loads);
  REQUIRE(findings.empty());
  const double share = scene.bodies[0].material.tensile_strength / largest_breaking_stress(*still);
  INFO("static limit at " << share << " of gravity");
  // Twice the limit at the ramp's end; the ramp is 20 periods of the slowest bending mode or more.
  scene.gravity.acceleration *= 2 * share;
  scene.gravity.ramp_time = 2;
  const double broke = 2 * breaking_share(scene);
  CHECK(broke > 0.9);
  CHECK(broke < 1.1);
}

TEST_CASE("a block lying on two supports stands below its static limit and breaks above it",
          "[fracture][block]") {
  Scene scene = lying_block();
  scene.bodies[0].translation = {-1, 0, 0.75};
  scene.obstacles = {
      {.shape = Box{.center = {-0.9, 0, 0.3}, .half_extent = {0.15, 0.6, 0.3}}, .friction = 0.6},
      {.shape = Box{.center = {0.9, 0, 0.3}, .half_extent = {0.15, 0.6, 0.3}}, .friction = 0.6}};
  // A body held up by contact does not respond linearly to its weight. So the limit is found by
  // equilibrium under constant gravity: settled, its largest stress shows how far the threshold is.
  Scene calm = scene;
  calm.fracture.mode = FractureMode::off;
  calm.gravity.ramp_time = 0.5;
  double share = 1;
  for (int refine = 0; refine < 3; ++refine) {
    calm.gravity.acceleration = share * Vec3(0, 0, -9.81);
    Result<Simulation> sim = build_simulation(calm);
    REQUIRE(sim);
    while (sim->state->mechanics.time < 1) advance(*sim);
    share *= scene.bodies[0].material.tensile_strength / largest_breaking_stress(*sim);
  }
  INFO("static limit at " << share << " of gravity");
  scene.gravity.acceleration = 2 * share * Vec3(0, 0, -9.81);
  scene.gravity.ramp_time = 2;
  const double broke = 2 * breaking_share(scene);
  CHECK(broke > 0.9);
  CHECK(broke < 1.1);
}
