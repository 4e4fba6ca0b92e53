// SPDX-License-Identifier: MIT
// `cohesive`: bars pulled apart through ties: what the crack takes against G_c times its area.
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "fracture/simulation/simulation_state.hpp"
#include "topology/suite/fixtures/shapes.hpp"
#include "tests/experiments/cases/crack_growth.hpp"

using namespace sunder;
using namespace sunder::accuracy;

int main(int argc, char** argv) {
  const double speed = argc > 1 ? std::atof(argv[1]) : 0.05;
  const double step = argc > 2 ? std::atof(argv[2]) : 1e-4;
  const bool cut = argc > 3 ? std::atoi(argv[3]) != 0 : true;
  const double Gc = argc > 4 ? std::atof(argv[4]) : 33;
  const double until = argc > 5 ? std::atof(argv[5]) : 0.01;
  const int verbose = argc > 6 ? std::atoi(argv[6]) : 1;
  const double b = 0.4;
  const int cells = 8;
  const double cell = b / cells, eps = 1e-3 * cell;
  Scene scene;
  BodySettings body;
  body.mesh = suite::kuhn_box({2 * cells, cells, 2}, cell);
  body.material = {.young_modulus = 30e9, .poisson_ratio = 0.2, .density = 2400,
                   .tensile_strength = 3e6};
  body.material.fracture_energy = Gc;
  body.held = {{.minimum = {-1, -1, -1}, .maximum = {eps, 9, 9}},
               {.minimum = {2 * b - eps, -1, -1}, .maximum = {9, 9, 9}, .velocity = {speed, 0, 0}}};
  body.unbreakable = {{RestBox{{-1, -1, -1}, {0.25 * b, 9, 9}}},
                      {RestBox{{2 * b - 0.25 * b, -1, -1}, {9, 9, 9}}}};
  if (cut)
    body.cuts = {{.faces = CutPlane{.point = {b, 0, 0}, .normal = {1, 0, 0}},
                  .box = RestBox{{-1, -1, -1}, {9, 0.25 * b + eps, 9}},
                  .ball = {}}};
  scene.bodies = {body};
  scene.gravity.acceleration.setZero();
  scene.integrator.time_step = step;
  scene.fracture.crack = CrackMode::cohesive;
  auto built = build_simulation(scene);
  for (const Finding& f : built.findings) std::printf("%s\n", f.text.c_str());
  if (!built) return 1;
  Simulation sim = std::move(*built);
  TieReport all;
  std::size_t released = 0, fans = 0;
  EnergyLedger ledger;
  const auto start = std::chrono::steady_clock::now();
  while (simulated_time(sim) < until) {
    const StepReport r = advance(sim);
    if (r.status.outcome != StepOutcome::fine) {
      std::printf("failed: outcome %d vertex %zu comp %zu disp %g\n", int(r.status.outcome), r.status.vertex.index(), r.status.component.index(), r.status.displacement);
      return 1;
    }
    add_part(all, r.ties);
    released += r.released;
    fans += r.fracture.fans.size();
    ledger.residual += r.energy.residual;
    ledger.moved += r.energy.moved;
    if (verbose && (r.ties.pairs || !r.fracture.fans.empty()))
      std::printf("t %.6f fans %zu flank %zu ties %zu pairs %u opening %u rel %zu comps %zu sub %u dt %.3g "
                  "it %d passes %d conv %d res %.2g tol %.2g work %.4g diss %.4g stored %.4g ledger %.2g\n",
                  r.time, r.fracture.fans.size(), r.fracture.on_flanks, sim.state->contact.ties.size(), r.ties.pairs,
                  r.ties.opening, r.released, r.components, r.impact.sub_steps,
                  sim.state->impact.sub_step, r.contact.iterations, r.contact.passes,
                  int(r.contact.converged), r.contact.residual, r.contact.tolerated, all.work,
                  all.dissipated, all.stored, r.energy.residual);
  }
  const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  const CrackArea area = crack_area(sim.state->cells);
  double open = 0, taken = 0;
  for (const Tie& tie : sim.state->contact.ties)
    for (const TieCorner& c : tie.corners) open += c.area;
  static_cast<void>(taken);
  const double section = b * cell * 2, left = section * (cut ? 0.75 : 1);
  std::printf("speed %g step %g G_c %g: fans %zu released %zu, work/(Gc section) %.4f dissipated %.4f "
              "crack raw %.3f proj %.3f tied %.3f ledger %.2e of %.2e, %.0f ms\n",
              speed, step, Gc, fans, released, all.work / (Gc * left), all.dissipated / (Gc * left),
              (area.raw - (cut ? 0.25 * section : 0)) / left,
              (area.projected - (cut ? 0.25 * section : 0)) / left, open / left, ledger.residual,
              ledger.moved, ms);
}
