// SPDX-License-Identifier: MIT
// Troubles noted step by step, and warnings of them at the end.
#include "apps/sunder/run/report/run_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "mechanics/element/energy.hpp"
#include "topology/base/counted.hpp"

namespace sunder {
namespace {

/// Of the energy moved (`EnergyLedger::moved`), in the ledger of a step or of a run.
constexpr double allowed_residual = 0.01;
/// Of the penetration that contact leaves alone.
constexpr double allowed_violation = 0.01;
/// Of the mean edge.
constexpr double allowed_overlap = 0.05;
/// Errors of energy below this part of `energy_of_scene` are no error of a scheme but rounding
/// (1e-16 of it in each step) and errors of contact: gaps that are wrong by 1e-4 of
/// `allowed_penetration`, which is 2e-3 of a cell at most, lift a body by 2e-7 of its length.
/// Schemes that gain energy gain parts of a hundred, and go on.
constexpr double negligible_energy = 1e-6;

/// m, over all edges of all tetrahedra at rest.
double mean_edge(const SimulationState& state) {
  const std::vector<Vec3>& rest = state.mechanics.vertices.rest_position;
  double sum = 0;
  std::size_t count = 0;
  for (const Corners& c : state.cells.map.corners()) {
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < i; ++j, ++count) {
        sum += (rest[c[i].index()] - rest[c[j].index()]).norm();
      }
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

double energy_of_balls(const std::vector<Obstacle>& obstacles) {
  double sum = 0;
  for (const Obstacle& ball : obstacles) {
    if (!ball.mass) continue;
    sum += kinetic_energy(ball);
  }
  return sum;
}

/// m g L of bodies and free balls.
double energy_of_weight(const Simulation& start) {
  double mass_by_length = 0;
  const MechanicsState& m = start.state->mechanics;
  for (const Component& c : m.components) mass_by_length += c.mass * 2 * c.rest_radius;
  for (const Obstacle& o : start.state->obstacles) {
    if (o.mass && has_volume(o.shape)) mass_by_length += *o.mass * std::cbrt(volume_of(o.shape));
  }
  return start.scene.gravity.acceleration.norm() * mass_by_length;
}

std::vector<Vec3> centres_of_balls(const std::vector<Obstacle>& obstacles) {
  std::vector<Vec3> centres(obstacles.size(), Vec3::Zero());
  for (std::size_t k = 0; k < obstacles.size(); ++k) {
    if (obstacles[k].mass) centres[k] = pose_of(obstacles[k].shape).centre;
  }
  return centres;
}

/// J, the work from outside in a step: of bodies by their ledger, of balls by their way.
struct OutsideWork {
  double gravity = 0, driven = 0;  ///< `driven`: of loads, supports and obstacles with a velocity
};
OutsideWork work_from_outside(const EnergyBalance& before, std::span<const Vec3> centres,
                              const Simulation& now, const StepReport& report) {
  const EnergyLedger& ledger = report.energy;
  OutsideWork work{ledger.gravity, ledger.loads + ledger.supports};
  const Vec3 gravity = gravity_at(now.scene.gravity, report.time);
  for (std::size_t k = 0; k < centres.size(); ++k) {
    const Obstacle& obstacle = now.state->obstacles[k];
    if (obstacle.mass) {
      work.gravity += *obstacle.mass * gravity.dot(centres[k] - before.ball_centre[k]);
    } else {
      work.driven += report.contact.impulse_of(k).dot(obstacle.velocity);
    }
  }
  return work;
}

void note_energy(RunTroubles& troubles, const Simulation& now, const StepReport& report) {
  const EnergyLedger& ledger = report.energy;
  troubles.residual_size += std::abs(ledger.residual);
  troubles.moved += ledger.moved;
  if (std::abs(ledger.residual) > allowed_residual * ledger.moved) {
    troubles.residual.note(report.step);
    troubles.residual.size = std::max(troubles.residual.size, std::abs(ledger.residual));
  }
  EnergyBalance& balance = troubles.balance;
  const double balls = energy_of_balls(now.state->obstacles);
  std::vector<Vec3> centres = centres_of_balls(now.state->obstacles);
  const double change = ledger.kinetic + ledger.strain;
  const OutsideWork work = work_from_outside(balance, centres, now, report);
  balance.level +=
      change + balls - balance.ball_energy - work.gravity - work.driven - ledger.push_out;
  balance.work += std::abs(work.driven);
  balance.body_energy += change;
  balance.ball_energy = balls;
  balance.ball_centre = std::move(centres);
  balance.most = std::max(balance.most, balance.body_energy + balls);
  const double rise = balance.level - balance.lowest;
  balance.lowest = std::min(balance.lowest, balance.level);
  if (rise > std::max(balance.risen, negligible_energy * energy_of_scene(balance))) {
    troubles.risen.note(report.step);
    balance.risen = troubles.risen.size = rise;
  }
}

Finding warning(std::string code, std::string text, std::string remedy) {
  return {.code = std::move(code),
          .severity = Severity::warning,
          .text = std::move(text),
          .remedy = std::move(remedy)};
}

/// Whether sweeps that ended before their tolerance matter. Gaps that are off by less than
/// `allowed_penetration` or a thousandth of the mean edge did not change the cracks where no
/// contact was left out: the coarse monolith has 164.0 fans (standard deviation 0.8) with 40 sweeps
/// and 165.2 (1.0) with 200, gaps off by 9e-6 m. They matter where energy rose or something lay
/// deep, or where no ledger says whether energy rose.
bool sweeps_matter(const RunTroubles& t, const Scene& scene) {
  const double harmless = std::max(scene.contact.allowed_penetration, 1e-3 * t.mean_edge);
  return t.not_converged.size > harmless || !scene.energy_ledger || t.risen.steps > 0 ||
         t.overlaps.steps > 0;
}

/// "in 3 steps, from step 7 to 12": when a trouble was there.
std::string when(const Trouble& trouble) {
  if (trouble.steps == 1) return fmt::format("in step {}", trouble.first);
  return fmt::format("in {} steps, from step {} to {}", trouble.steps, trouble.first, trouble.last);
}

}  // namespace

double energy_of_scene(const EnergyBalance& balance) {
  return std::max({balance.most, balance.work, balance.weight});
}

RunTroubles begin_troubles(const Simulation& start) {
  RunTroubles troubles;
  const MechanicsState& m = start.state->mechanics;
  troubles.mean_edge = mean_edge(*start.state);
  EnergyBalance& balance = troubles.balance;
  balance.ball_energy = energy_of_balls(start.state->obstacles);
  balance.ball_centre = centres_of_balls(start.state->obstacles);
  balance.body_energy = kinetic_energy(m.vertices) + strain_energy(m);
  balance.most = balance.body_energy + balance.ball_energy;
  balance.weight = energy_of_weight(start);
  return troubles;
}

void note_troubles(RunTroubles& troubles, const Simulation& now, const StepReport& report) {
  const ContactReport& contact = report.contact;
  if (contact.left_out > 0) {
    troubles.left_out.note(report.step);
    troubles.left_out.size += static_cast<double>(contact.left_out);
  }
  const double harmless = allowed_violation * now.scene.contact.allowed_penetration;
  if (!contact.converged && contact.residual > harmless) {
    troubles.not_converged.note(report.step);
    troubles.not_converged.size = std::max(troubles.not_converged.size, contact.residual);
  }
  if (contact.deepest > allowed_overlap * troubles.mean_edge) {
    troubles.overlaps.note(report.step);
    troubles.overlaps.size = std::max(troubles.overlaps.size, contact.deepest);
  }
  if (report.impact.stopped) troubles.stopped.note(report.step);
  if (report.status.solve.not_converged > 0) troubles.given_up.note(report.step);
  if (now.scene.energy_ledger) note_energy(troubles, now, report);
}

std::vector<Finding> warnings_of(const RunTroubles& t, const Scene& scene) {
  std::vector<Finding> found;
  if (t.left_out.steps > 0) {
    found.push_back(warning(
        "contacts_left_out",
        fmt::format(
            "{} left out {}: pieces may overlap, gain energy and break otherwise",
            counted(static_cast<std::uint64_t>(t.left_out.size), "contact was", "contacts were"),
            when(t.left_out)),
        "take a shorter time_step, or raise contact.max_passes or contact.max_contacts_per_pair"));
  }
  if (t.not_converged.steps > 0 && sweeps_matter(t, scene)) {
    found.push_back(warning(
        "contact_not_converged",
        fmt::format("contact did not converge {}; the worst gap is off by {:.2g} m",
                    when(t.not_converged), t.not_converged.size),
        "take a shorter time_step; more of contact.max_iterations help where nothing is wedged"));
  }
  if (t.overlaps.steps > 0) {
    found.push_back(warning(
        "deep_overlap",
        fmt::format("pieces and obstacles overlapped by up to {:.2g} m, over a twentieth of the "
                    "mean edge, {}; they come apart at contact.push_out_speed at most",
                    t.overlaps.size, when(t.overlaps)),
        "take a shorter time_step; look for bodies that overlap at the start"));
  }
  if (t.stopped.steps > 0) {
    found.push_back(
        warning("sub_steps_ran_out",
                fmt::format("sub-steps of impacts ran out {}: blows there are stepped too coarsely "
                            "to say what they break",
                            when(t.stopped)),
                "raise impact.max_sub_steps, or take a shorter time_step"));
  }
  if (t.given_up.steps > 0) {
    found.push_back(
        warning("integrator_not_converged",
                fmt::format("the integrator gave its iterations up {}", when(t.given_up)),
                "take a shorter time_step or the method floating_frame"));
  }
  if (!scene.energy_ledger) return found;
  const double energy = energy_of_scene(t.balance);
  if (t.residual_size > std::max(allowed_residual * t.moved, negligible_energy * energy)) {
    found.push_back(warning(
        "energy_residual",
        fmt::format("the energy ledger does not close: {:.3g} of what moved is unaccounted for; "
                    "it is off by more than a hundredth {}",
                    t.residual_size / t.moved, when(t.residual)),
        "take a shorter time_step; speeds near the material's wave speed are outside the model"));
  }
  if (t.risen.steps > 0) {
    found.push_back(warning(
        "energy_rises",
        fmt::format("energy rose without work by {:.3g} J, {:.2g} of the scene's energy, {}",
                    t.risen.size, t.risen.size / energy, when(t.risen)),
        "take a shorter time_step; look for bodies that overlap at the start"));
  }
  return found;
}

}  // namespace sunder
