// SPDX-License-Identifier: MIT
// Troubles of a run: each kind is reported, with its steps and its size, and nothing where there is
// none.
#include "apps/sunder/run/report/run_warnings.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "apps/sunder/run/report/recorder_report.hpp"
#include "fracture/scene/choose_settings.hpp"
#include "mechanics/state/settings/material.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;

namespace {

Simulation falling_box() {
  Scene scene;
  scene.bodies.push_back(
      {.name = "box", .mesh = suite::kuhn_box({1, 1, 1}, 0.1), .material = {}, .held = {}});
  Result<Simulation> sim = build_simulation(std::move(scene));
  REQUIRE(sim);
  return std::move(*sim);
}

/// The codes of the warnings after these reports.
std::vector<std::string> codes(const Simulation& sim, const std::vector<StepReport>& reports) {
  RunTroubles troubles = begin_troubles(sim);
  for (const StepReport& report : reports) note_troubles(troubles, sim, report);
  std::vector<std::string> found;
  for (const Finding& f : warnings_of(troubles, sim.scene)) {
    CHECK(f.severity == Severity::warning);
    CHECK(!f.remedy.empty());
    found.push_back(f.code);
  }
  return found;
}

StepReport step(std::uint64_t number) {
  StepReport report;
  report.step = number;
  return report;
}

}  // namespace

TEST_CASE("a run without troubles has no warnings", "[run]") {
  Simulation sim = falling_box();
  RunTroubles troubles = begin_troubles(sim);
  for (int i = 0; i < 50; ++i) note_troubles(troubles, sim, advance(sim));
  CHECK(warnings_of(troubles, sim.scene).empty());
  // And the balance was looked at: it fell, and energy less work stayed where it was.
  CHECK(troubles.balance.most > 0);
  CHECK(std::abs(troubles.balance.level) < 1e-9 * troubles.balance.most);
}

TEST_CASE("each trouble of a step is a warning of its own", "[run]") {
  const Simulation sim = falling_box();
  StepReport left_out = step(3), unconverged = step(4), stopped = step(5), given_up = step(6);
  left_out.contact.left_out = 7;
  unconverged.contact.converged = false;
  unconverged.contact.residual = 2e-4;
  stopped.impact.stopped = true;
  given_up.status.solve.not_converged = 1;
  using Codes = std::vector<std::string>;
  CHECK(codes(sim, {stopped}) == Codes{"sub_steps_ran_out"});
  CHECK(codes(sim, {given_up}) == Codes{"integrator_not_converged"});
  // Edges of 0.1 m, face diagonals and the long one: 0.121 m in the mean.
  StepReport deep = step(7), touching = step(8);
  deep.contact.deepest = 0.0065;
  touching.contact.deepest = 0.005;
  CHECK(codes(sim, {deep}) == Codes{"deep_overlap"});
  CHECK(codes(sim, {touching}).empty());
  CHECK(codes(sim, {left_out, unconverged, stopped, given_up, deep}).size() == 5);
}

TEST_CASE("contacts left out are a warning, sweeps that ended early are where it matters",
          "[run]") {
  Simulation sim = falling_box();
  for (Vec3& v : sim.state->mechanics.vertices.velocity) v = {0, 0, 1};
  // A thousandth of the mean edge of 0.121 m, which is more than `allowed_penetration` here.
  const double allowed = 1.21e-4, tiny = sim.scene.contact.allowed_penetration;
  const auto off_by = [](double gap) {
    StepReport report = step(4);
    report.contact.converged = false;
    report.contact.residual = gap;
    return report;
  };
  StepReport left_out = step(3), deep = step(7), gain = step(8);
  left_out.contact.left_out = 7;
  deep.contact.deepest = 0.0065;
  gain.energy.kinetic = 0.1;
  using Codes = std::vector<std::string>;
  CHECK(codes(sim, {left_out}) == Codes{"contacts_left_out"});
  CHECK(codes(sim, {off_by(1.1 * allowed)}) == Codes{"contact_not_converged"});
  const StepReport little = off_by(0.9 * allowed), nothing = off_by(0.009 * tiny);
  CHECK(codes(sim, {little}).empty());
  CHECK(codes(sim, {little, deep}) == Codes{"contact_not_converged", "deep_overlap"});
  CHECK(codes(sim, {little, gain}) == Codes{"contact_not_converged", "energy_rises"});
  CHECK(codes(sim, {nothing, gain}) == Codes{"energy_rises"});
  // Without a ledger nobody knows whether energy rose.
  sim.scene.energy_ledger = false;
  CHECK(codes(sim, {little}) == Codes{"contact_not_converged"});
  CHECK(codes(sim, {nothing}).empty());
}

TEST_CASE("what was found on the way is told at the end, what the start had is not told again",
          "[run]") {
  const Simulation sim = falling_box();
  RunStatistics statistics =
      begin_statistics(sim, {{.code = "few_layers", .severity = Severity::warning},
                             {.code = "turned_too_far", .severity = Severity::warning}});
  statistics.ties.sum.residual = 1;
  const auto codes_of = [](const std::vector<Finding>& findings) {
    std::vector<std::string> found;
    for (const Finding& f : findings) found.push_back(f.code);
    return found;
  };
  CHECK(codes_of(warnings_on_the_way(statistics, sim.scene)) ==
        std::vector<std::string>{"turned_too_far", "ties_not_converged"});
  CHECK(codes_of(all_warnings(statistics, sim.scene)) ==
        std::vector<std::string>{"few_layers", "turned_too_far", "ties_not_converged"});
}

TEST_CASE("a warning tells the first and the last step and how bad it was", "[run]") {
  const Simulation sim = falling_box();
  RunTroubles troubles = begin_troubles(sim);
  for (const std::uint64_t k : {12u, 13u, 40u}) {
    StepReport report = step(k);
    report.contact.left_out = k;
    note_troubles(troubles, sim, report);
  }
  const std::string text = warnings_of(troubles, sim.scene).front().text;
  CHECK(text.find("65 contacts") != std::string::npos);
  CHECK(text.find("in 3 steps, from step 12 to 40") != std::string::npos);
}

TEST_CASE("energy that does not add up, or rises, is a warning", "[run]") {
  Simulation sim = falling_box();
  for (Vec3& v : sim.state->mechanics.vertices.velocity) v = {0, 0, 1};
  StepReport off = step(1);
  off.energy.moved = 1;
  off.energy.residual = 0.02;
  StepReport gain = step(2);
  gain.energy.kinetic = 0.1;
  using Codes = std::vector<std::string>;
  CHECK(codes(sim, {off}) == Codes{"energy_residual"});
  off.energy.residual = 0.009;
  CHECK(codes(sim, {off}).empty());
  CHECK(codes(sim, {gain}) == Codes{"energy_rises"});
  // Work from outside accounts for it.
  gain.energy.loads = 0.1;
  CHECK(codes(sim, {gain}).empty());
  // Energy may sink, and not rise from there.
  StepReport loss = step(3);
  loss.energy.kinetic = -0.1;
  StepReport back = step(4);
  back.energy.kinetic = 0.05;
  CHECK(codes(sim, {loss}).empty());
  CHECK(codes(sim, {loss, back}) == Codes{"energy_rises"});
  // A scene that keeps no ledger has nothing to say.
  sim.scene.energy_ledger = false;
  CHECK(codes(sim, {off, gain, loss, back}).empty());
}

namespace {

/// Codes of the warnings about energy of a run of so many steps; a run that fails ends there.
std::vector<std::string> energy_warnings(Scene scene, int steps) {
  scene.fracture.mode = FractureMode::off;
  Result<Simulation> sim = build_simulation(std::move(scene));
  REQUIRE(sim);
  RunTroubles troubles = begin_troubles(*sim);
  for (int i = 0; i < steps; ++i) {
    const StepReport report = advance(*sim);
    note_troubles(troubles, *sim, report);
    if (report.status.outcome != StepOutcome::fine) break;
  }
  UNSCOPED_INFO("residuals " << troubles.residual_size << " J of " << troubles.moved << ", risen "
                             << troubles.balance.level - troubles.balance.lowest
                             << ", most that there was " << troubles.balance.most
                             << ", the scene's " << energy_of_scene(troubles.balance));
  std::vector<std::string> found;
  for (const Finding& f : warnings_of(troubles, sim->scene)) {
    if (f.code.starts_with("energy_")) found.push_back(f.code);
  }
  return found;
}

/// A box of 2 x 3 x 2 cells, `length` m each, with the settings of contact for that length; its
/// weight strains it by about 1 / `stiffness`.
Scene box_of_cells(double length, double stiffness = 1e6) {
  Scene scene;
  scene.bodies.push_back({.name = "box", .mesh = suite::kuhn_box({2, 3, 2}, length)});
  Material& material = scene.bodies[0].material;
  material.young_modulus = stiffness * material.density * 9.81 * length;
  choose_settings(scene, Accuracy::good, std::vector<std::string>{"bodies.0.order"});
  scene.integrator.time_step = 0.04 * std::sqrt(length);  // a fall by 0.008 cells
  return scene;
}

bool has(const std::vector<std::string>& found, const char* code) {
  return std::ranges::count(found, code) == 1;
}

}  // namespace

TEST_CASE("rounding and what contact leaves are no warning about energy, at every scale",
          "[run][energy]") {
  const double length = GENERATE(1e-6, 1e-3, 1.0, 1e3);
  const double stiffness = GENERATE(1e4, 1e7, 1e10);
  const bool rigid = GENERATE(false, true);
  INFO("cells of " << length << " m, stiffness " << stiffness << ", rigid " << rigid);
  Scene rests = box_of_cells(length, stiffness);
  rests.bodies[0].rigid = rigid;
  rests.obstacles = {{Plane{}}};
  CHECK(energy_warnings(rests, 300) == std::vector<std::string>{});
  Scene spins = box_of_cells(length, stiffness);
  spins.bodies[0].rigid = rigid;
  spins.gravity.acceleration.setZero();
  spins.bodies[0].spin = Vec3(0.01, 1, 0.02) / std::sqrt(length);
  CHECK(energy_warnings(spins, 300) == std::vector<std::string>{});
}

TEST_CASE("energy that a scheme gains or loses is a warning, at every scale", "[run][energy]") {
  const double length = GENERATE(1e-6, 1e-3, 1.0, 1e3);
  INFO("cells of " << length << " m");
  // Explicit steps beyond the critical one: vibrations grow.
  Scene rings = box_of_cells(length);
  rings.integrator.integrator = Integrator::verlet;
  rings.integrator.time_step = length / compression_wave_speed(rings.bodies[0].material);
  rings.obstacles = {{Plane{}}};
  CHECK(has(energy_warnings(rings, 60), "energy_rises"));
  // Implicit Euler brakes a spinning body: by a twentieth in these steps.
  Scene brakes = box_of_cells(length);
  brakes.integrator.integrator = Integrator::implicit_euler;
  brakes.gravity.acceleration.setZero();
  brakes.bodies[0].spin = Vec3(0, 2.5, 0) / std::sqrt(length);
  CHECK(has(energy_warnings(brakes, 10), "energy_residual"));
  // A body that begins in the ground and is thrown out.
  Scene apart = box_of_cells(length);
  apart.obstacles = {{Plane{}}};
  apart.bodies[0].translation.z() = -0.1 * length;
  apart.contact.push_out_speed = std::sqrt(length);
  CHECK(has(energy_warnings(apart, 10), "energy_rises"));
}
