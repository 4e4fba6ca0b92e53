// SPDX-License-Identifier: MIT
// Troubles of a run: each kind is told, with its steps and its size, and nothing where there is
// none.
#include "apps/sunder/run/report/run_warnings.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

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
  unconverged.contact.residual = 1e-4;
  stopped.impact.stopped = true;
  given_up.status.solve.not_converged = 1;
  using Codes = std::vector<std::string>;
  CHECK(codes(sim, {left_out}) == Codes{"contacts_left_out"});
  CHECK(codes(sim, {unconverged}) == Codes{"contact_not_converged"});
  StepReport nearly = unconverged;
  nearly.contact.residual = 0.009 * sim.scene.contact.allowed_penetration;
  CHECK(codes(sim, {nearly}).empty());
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
