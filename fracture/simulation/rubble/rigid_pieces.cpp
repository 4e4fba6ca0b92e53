// SPDX-License-Identifier: MIT
// Shares of mass, and turns of the ladder's lowest moving form.
#include "fracture/simulation/rubble/rigid_pieces.hpp"

#include "fracture/simulation/ladder.hpp"
#include "fracture/simulation/simulation_state.hpp"

namespace sunder {
namespace {

/// The masses of the scene's bodies, kg.
void note_masses(std::vector<double>& body_mass, const Simulation& sim) {
  if (!body_mass.empty()) return;
  for (const BodyRows& rows : sim.bodies) {
    double& mass = body_mass.emplace_back(0);
    for (std::size_t t = rows.first_tetrahedron; t < rows.end_tetrahedron; ++t) {
      mass += sim.state->mechanics.elements.mass[t];
    }
  }
}

bool has_rigid_bodies(const Scene& scene) {
  for (const BodySettings& body : scene.bodies) {
    if (body.rigid) return true;
  }
  return false;
}

}  // namespace

void note_unbreakable(std::vector<char>& unbreakable, std::vector<double>& body_mass,
                      const Simulation& sim) {
  const SimulationState& s = *sim.state;
  const LadderSettings& ladder = sim.scene.ladder;
  unbreakable.assign(s.mechanics.components.size(), static_cast<char>(Unbreakable::no));
  const bool declares = ladder.rubble != RubbleMode::off && ladder.declared_rubble > 0;
  if (!declares && !has_rigid_bodies(sim.scene)) return;
  note_masses(body_mass, sim);
  for (const Component& c : s.mechanics.components) {
    if (c.tetrahedra.empty()) continue;
    const std::size_t body = body_of(sim, c.tetrahedra.front());
    const double whole = body_mass[body];
    Unbreakable word = Unbreakable::no;
    if (sim.scene.bodies[body].rigid) {
      word = Unbreakable::rigid;
    } else if (declares && c.mass <= ladder.declared_rubble * whole &&
               c.mass < (1 - 1e-9) * whole) {
      word = Unbreakable::declared;
    }
    unbreakable[c.id.index()] = static_cast<char>(word);
  }
}

RebuildReport turn_pieces_rigid(Simulation& sim, std::span<const char> unbreakable) {
  SimulationState& s = *sim.state;
  RebuildReport all;
  std::vector<char>& tied = sim.scratch->rubble.tied;
  find_tied(tied, s);
  for (Component& c : s.mechanics.components) {
    if (c.tetrahedra.empty()) continue;
    const std::size_t k = c.id.index();
    const bool is_free = !c.supported && !tied[k];
    const bool wanted = is_free && (unbreakable[k] != 0 || c.tetrahedra.size() == 1);
    if (wanted == c.rigid || is_isolated(c)) continue;
    if (!wanted) {
      c.rigid = false;
      continue;
    }
    const RebuildReport given_up = turn_rigid(s.mechanics, s.cells.map.corners(), c.id);
    all.energy_released += given_up.energy_released;
    all.strain_released += given_up.strain_released;
    if (c.rung != Rung::asleep) c.rung = Rung::full;
    if (k < s.impact.quiet.size()) s.impact.quiet[k] = ImpactWindow::closed;
  }
  return all;
}

void harden_pieces(StepReport& report, Simulation& sim) {
  RubbleTickScratch& scratch = sim.scratch->rubble;
  note_unbreakable(scratch.declared, scratch.body_mass, sim);
  const RebuildReport given_up = turn_pieces_rigid(sim, scratch.declared);
  report.energy_released += given_up.energy_released;
  report.energy.strain -= given_up.strain_released;
}

}  // namespace sunder
