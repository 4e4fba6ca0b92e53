// SPDX-License-Identifier: MIT
// Vertices held along some axes: equilibria, motion, symmetric halves, ledgers, cracks, errors.
#include "fracture/strength/held_boxes.hpp"

#include <catch2/catch.hpp>
#include <map>

#include "fracture/saving/saved_state.hpp"
#include "fracture/scene/check_scene.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "fracture/simulation/statics/statics.hpp"
#include "mechanics/state/living.hpp"
#include "mechanics/state/supports.hpp"
#include "tests/support/same_state.hpp"
#include "tests/support/simulation.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

constexpr double wide = 1e3;

HeldBox held_where(const Vec3& minimum, const Vec3& maximum, std::vector<Axis> axes) {
  return {.minimum = minimum, .maximum = maximum, .axes = std::move(axes)};
}
HeldBox plane(int axis) {
  Vec3 high = Vec3::Constant(wide);
  high[axis] = 1e-6;
  return held_where(Vec3::Constant(-wide), high, {Axis(axis)});
}
HeldBox everywhere(Axis axis) {
  return held_where(Vec3::Constant(-wide), Vec3::Constant(wide), {axis});
}

/// A block of cubes of 0.1 m that does not break, without gravity.
Scene block(const suite::Cells& cells) {
  Scene scene;
  BodySettings body{.mesh = suite::kuhn_box(cells, 0.1)};
  body.material = {.young_modulus = 1e9, .poisson_ratio = 0.3, .density = 1000};
  scene.bodies = {body};
  scene.fracture.mode = FractureMode::off;
  scene.gravity.acceleration.setZero();
  scene.ladder = {.rigid = false, .quasi_static = false, .sleep = false};
  scene.integrator.time_step = 1e-4;
  return scene;
}

/// The energy residual of a run over the energy moved; the momentum given, and that by supports.
struct Ledgers {
  double energy = 0;
  Impulse given = Impulse::Zero(), supports = Impulse::Zero();
};
Ledgers run(Simulation& sim, int steps) {
  Ledgers sum;
  double residual = 0, moved = 0;
  for (int k = 0; k < steps; ++k) {
    const StepReport report = advance(sim);
    REQUIRE(report.status.outcome == StepOutcome::fine);
    residual += report.energy.residual;
    moved += report.energy.moved;
    const MomentumLedger& m = report.momentum;
    sum.supports += m.supports;
    sum.given += m.gravity + m.loads + m.obstacles + m.supports + m.sleep;
  }
  sum.energy = std::abs(residual) / moved;
  return sum;
}

Vec3 momentum_of(const Simulation& sim) {
  Vec3 sum = Vec3::Zero();
  const VertexColumns& v = sim.state->mechanics.vertices;
  for (std::size_t i = 0; i < v.size(); ++i) sum += v.mass[i] * v.velocity[i];
  return sum;
}

}  // namespace

TEST_CASE("the last box that holds an axis holds it, and motions combine boxes",
          "[fracture][held_axes]") {
  std::vector<HeldBox> boxes = {everywhere(Axis::z), plane(0),
                                held_where({-1, -1, -1}, {1e-6, 1e-6, 1}, {})};
  CHECK(holders_of(boxes, {0.2, 0, 0}) == Holders{no_holder, no_holder, 0});
  CHECK(holders_of(boxes, {0, 0.2, 0}) == Holders{1, no_holder, 0});
  CHECK(holders_of(boxes, {0, 0, 0}) == Holders{2, 2, 2});
  CHECK(is_partial(boxes[0]));
  CHECK_FALSE(is_partial(boxes[2]));
  CHECK_FALSE(is_partial(held_where({}, {}, {Axis::y, Axis::z, Axis::x})));
  Scene scene = block({2, 2, 1});
  boxes[1].velocity.x() = 3;
  scene.bodies[0].held = boxes;
  const Simulation sim = built(scene);
  const MechanicsState& m = sim.state->mechanics;
  CHECK(m.motions.size() == 4);
  for (std::size_t v = 0; v < m.vertices.size(); ++v) {
    const Vec3& x = m.vertices.rest_position[v];
    const bool left = x.x() < 1e-6, corner = left && x.y() < 1e-6;
    CHECK(held_axes(m, VertexId{v}) == AxisSet{left, corner, true});
    CHECK(m.vertices.velocity[v] == Vec3(left && !corner ? 3 : 0, 0, 0));
  }
}

TEST_CASE("a bar with one axis held has the stress of plane strain, turned or not",
          "[fracture][held_axes]") {
  const double pull = 1e6;
  for (const double angle : {0.0, 0.7}) {
    Scene scene = block({4, 2, 2});
    BodySettings& body = scene.bodies[0];
    body.rotation = Eigen::AngleAxisd(angle, Vec3(1, 2, 3).normalized());
    body.held = {everywhere(Axis::z), plane(0), plane(1)};
    body.loads = {{.minimum = {0.4 - 1e-6, -wide, -wide},
                   .maximum = Vec3::Constant(wide),
                   .pressure = -pull}};
    Simulation sim = built(scene);
    const Result<Equilibrium> answer = solve_scene(sim);
    REQUIRE(answer);
    const Mat3 expected = Vec3(pull, 0, 0.3 * pull).asDiagonal();
    for (const Mat3& stress : sim.state->mechanics.elements.stress) {
      CHECK((stress - expected).norm() < 1e-9 * pull);
    }
    const BodyEquilibrium& found = answer->bodies[0];
    CHECK(found.residual < 1e-9 * pull);
    const Vec3 x = body.rotation * Vec3::UnitX();
    CHECK((found.supports[1].force + 0.04 * pull * x).norm() < 1e-6 * pull);
    // z is pressed from both sides, so the box's force along z is none.
    CHECK(found.supports[0].force.norm() < 1e-6 * pull);
    CHECK(found.supports[0].vertices == 45);
  }
}

TEST_CASE("axes that leave a motion free are no support of an equilibrium",
          "[fracture][held_axes]") {
  Scene scene = block({2, 2, 2});
  scene.bodies[0].held = {everywhere(Axis::z), plane(0)};
  Simulation slides = built(scene);
  CHECK(solve_scene(slides).findings.back().code == "not_supported");
  scene.bodies[0].held.push_back(plane(1));
  Simulation stands = built(scene);
  CHECK(solve_scene(stands));
  CHECK(scene_modes(stands, 3).findings.back().code == "axes_not_supported");
}

namespace {

/// The block [-0.3, 0.3] x [0, 0.2] x [0, 0.1] of two mirrored halves, or its half x > 0.
Scene pulled_halves(bool whole) {
  Scene scene = block({3, 2, 1});
  BodySettings& body = scene.bodies[0];
  TetMesh& mesh = body.mesh;
  if (whole) {
    const TetMesh half = mesh;
    std::map<std::size_t, std::uint32_t> image;
    for (std::size_t p = 0; p < half.points.size(); ++p) {
      const Point& x = half.points[p];
      image[p] = x[0] < 1e-9 ? std::uint32_t(p) : std::uint32_t(mesh.points.size());
      if (x[0] > 1e-9) mesh.points.push_back({-x[0], x[1], x[2]});
    }
    for (const auto& t : half.tetrahedra) {
      mesh.tetrahedra.push_back({image[t[1]], image[t[0]], image[t[2]], image[t[3]]});
    }
  }
  body.held = {plane(1)};
  body.held[0].axes = {Axis::y, Axis::z};
  if (!whole) body.held.push_back(plane(0));
  body.loads = {
      {.minimum = {0.3 - 1e-6, -wide, -wide}, .maximum = Vec3::Constant(wide), .pressure = -1e5}};
  if (whole) {
    body.loads.push_back(
        {.minimum = Vec3::Constant(-wide), .maximum = {-0.3 + 1e-6, wide, wide}, .pressure = -1e5});
  }
  return scene;
}

}  // namespace

TEST_CASE("a half held along the mirror's axis goes as the whole does", "[fracture][held_axes]") {
  Simulation half = built(pulled_halves(false)), whole = built(pulled_halves(true));
  double farthest = 0;
  for (int k = 0; k < 200; ++k) {
    REQUIRE(advance(half).status.outcome == StepOutcome::fine);
    REQUIRE(advance(whole).status.outcome == StepOutcome::fine);
    const VertexColumns &a = half.state->mechanics.vertices, &b = whole.state->mechanics.vertices;
    double worst = 0;
    for (std::size_t v = 0; v < a.size(); ++v) {
      worst = std::max(worst, (a.position[v] - b.position[v]).norm());
      farthest = std::max(farthest, (a.position[v] - a.rest_position[v]).norm());
    }
    REQUIRE(worst < 1e-13);
  }
  CHECK(farthest > 1e-5);
}

TEST_CASE("what slides along free axes goes on for ever, and its ledgers close",
          "[fracture][held_axes]") {
  Scene scene = block({2, 2, 1});
  scene.bodies[0].held = {everywhere(Axis::z)};
  scene.bodies[0].velocity = {30, 0, 0};
  scene.gravity.acceleration = {0, -10, -5};
  scene.integrator.time_step = 1e-3;
  Simulation sim = built(scene);
  const Vec3 before = momentum_of(sim);
  const double mass = 1000 * 0.2 * 0.2 * 0.1;
  // 3 m: twenty radii of the body, and its frame has to follow.
  const Ledgers ledgers = run(sim, 100);
  // E d^2 times a length, 10^5 J for the 3 cm of a step, has to vanish: to some 1e-11 J per step.
  CHECK(ledgers.energy < 1e-8);
  CHECK((momentum_of(sim) - before - ledgers.given.head<3>()).norm() < 1e-9 * before.norm());
  CHECK(std::abs(ledgers.supports[2] - 0.1 * 5 * mass) < 1e-9);
  const VertexColumns& v = sim.state->mechanics.vertices;
  for (std::size_t i = 0; i < v.size(); ++i) {
    CHECK(std::abs(v.position[i].x() - v.rest_position[i].x() - 3) < 1e-9);
    CHECK(v.position[i].z() == v.rest_position[i].z());
    // Generalised-alpha begins without an acceleration: half a step's is missing ever after.
    CHECK(std::abs(v.velocity[i].y() + 1 - 0.5e-3 * 10) < 1e-6);
  }
  CHECK(sim.state->mechanics.components[0].centre.x() > 2);
}

TEST_CASE("an axis that is driven does work, and the ledger closes", "[fracture][held_axes]") {
  Scene scene = block({3, 2, 1});
  HeldBox driven = plane(0);
  driven.velocity = {2, 0, 0};
  scene.bodies[0].held = {everywhere(Axis::z), driven};
  Simulation sim = built(scene);
  double work = 0;
  for (int k = 0; k < 50; ++k) work += advance(sim).energy.supports;
  CHECK(run(sim, 50).energy < 1e-10);
  CHECK(work > 0);
  const VertexColumns& v = sim.state->mechanics.vertices;
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (v.rest_position[i].x() < 1e-6) CHECK(v.velocity[i].x() == 2);
  }
}

TEST_CASE("a block held along z falls on a floor as in a plane", "[fracture][held_axes]") {
  Scene scene = block({2, 2, 1});
  scene.bodies[0].held = {everywhere(Axis::z)};
  scene.bodies[0].velocity = {1, -2, 0};
  scene.bodies[0].translation = {0, 0.01, 0};
  scene.obstacles = {{.shape = Plane{.normal = {0, 1, 0}, .offset = 0}}};
  scene.gravity.acceleration = {0, -10, 0};
  Simulation sim = built(scene);
  const Vec3 before = momentum_of(sim);
  Ledgers ledgers;
  double deepest = 0;
  ledgers = run(sim, 300);
  const VertexColumns& v = sim.state->mechanics.vertices;
  for (std::size_t i = 0; i < v.size(); ++i) {
    CHECK(v.position[i].z() == v.rest_position[i].z());
    deepest = std::min(deepest, v.position[i].y());
  }
  CHECK(deepest > -1e-4);
  CHECK(ledgers.energy < 1e-6);
  CHECK((momentum_of(sim) - before - ledgers.given.head<3>()).norm() < 1e-9 * before.norm());
  CHECK(momentum_of(sim).y() > before.y() + 1);
}

TEST_CASE("cracks leave copies and pieces with the axes of their vertices",
          "[fracture][held_axes]") {
  Scene scene;
  BodySettings bar{.name = "bar", .mesh = suite::kuhn_box({12, 6, 1}, 0.05)};
  bar.material.fracture_energy = 33;
  HeldBox left = plane(0), right = held_where({0.6 - 1e-6, -1, -1}, {9, 9, 9}, {Axis::x});
  right.velocity = {0.5, 0, 0};
  bar.held = {everywhere(Axis::z), left, right};
  bar.cuts = {{.faces = CutPlane{.point = {0.3, 0, 0}, .normal = {1, 0, 0}},
               .box = RestBox{{-1, -1, -1}, {9, 0.1 + 1e-6, 9}},
               .ball = {}}};
  scene.bodies = {bar};
  scene.gravity.acceleration.setZero();
  scene.integrator.time_step = 2e-5;
  scene.fracture.crack = CrackMode::cohesive;
  Simulation sim = built(scene), again = built(scene);
  double residual = 0, moved = 0;
  for (int k = 0; k < 60; ++k) {
    const StepReport report = advance(sim);
    REQUIRE(report.status.outcome == StepOutcome::fine);
    // Parted pieces meet again, and contact of supported pieces closes to 1e-4 only.
    if (report.components == 1) residual += report.energy.residual;
    moved += report.energy.moved;
    if (k == 20) again = std::move(*restore(saved_state(sim)));
    if (k > 20) advance(again);
  }
  CHECK(first_difference(sim, again).empty());
  CHECK(std::abs(residual) < 1e-9 * moved);
  const MechanicsState& m = sim.state->mechanics;
  CHECK(m.vertices.size() > sim.state->cells.map.points().size() + 10);
  CHECK(living_components(m).size() > 1);
  for (std::size_t v = 0; v < m.vertices.size(); ++v) {
    CHECK(held_axes(m, VertexId{v})[2]);
    CHECK(m.vertices.position[v].z() == m.vertices.rest_position[v].z());
  }
}

TEST_CASE("what cannot be held along some axes is refused", "[fracture][held_axes]") {
  Scene scene = block({2, 2, 1});
  scene.bodies[0].held = {everywhere(Axis::z)};
  const auto code = [](const Scene& wrong) { return build_simulation(wrong).findings.at(0).code; };
  Scene moved = scene;
  moved.bodies[0].held[0].velocity = {1, 0, 0};
  CHECK(code(moved) == "velocity_not_held");
  moved.bodies[0].rotation = Eigen::AngleAxisd(M_PI / 2, Vec3::UnitY());
  CHECK(build_simulation(moved));
  for (const Integrator integrator :
       {Integrator::verlet, Integrator::implicit_euler, Integrator::modal, Integrator::newton_cg}) {
    Scene other = scene;
    other.integrator.integrator = integrator;
    CHECK(code(other) == "axes_not_supported");
    other.bodies[0].held[0].axes = {Axis::x, Axis::y, Axis::z};
    CHECK(check_scene(other).empty());
  }
  Scene relaxed = scene;
  relaxed.fracture.relax = 2;
  CHECK(code(relaxed) == "axes_not_supported");
  Scene by_energy = scene;
  by_energy.fracture.criterion = FractureCriterion::energy;
  CHECK(code(by_energy) == "axes_not_supported");
  Scene pressed = scene;
  pressed.contact.method = ContactMethod::penalty;
  CHECK(code(pressed) == "axes_not_supported");
}
