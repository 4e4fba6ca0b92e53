// SPDX-License-Identifier: MIT
// Keeping and putting back.
#include "fracture/simulation/attempt.hpp"

#include "fracture/breaking/overloaded.hpp"
#include "fracture/simulation/plan.hpp"
#include "topology/base/sort_unique.hpp"

namespace sunder {
namespace {

/// A first overstress of a tenth: which of the vertices within so much of the first one breaks
/// first is not yet decided by chance.
constexpr double most_overstress = 1.1;

bool can_break(const Scene& scene, const PlannedPart& part) {
  const bool is_long =
      part.part.deformation == Deformation::whole || part.part.deformation == Deformation::catch_up;
  return scene.fracture.crack == CrackMode::cohesive && is_long && part.moves &&
         part.part.impact != nullptr;
}

}  // namespace

std::optional<Attempt> begin_attempt(const Scene& scene, const PlannedPart& part,
                                     const SimulationState& s, const StepReport& report) {
  if (!can_break(scene, part)) return std::nullopt;
  const MechanicsState& m = s.mechanics;
  return Attempt{m.vertices, m.components, m.elements.stress, m.elements.corner_stress,
                 m.time,     s.obstacles,  s.contact,         report};
}

bool take_back(const Attempt& attempt, StepReport& report, SimulationState& s,
               const PartInput& input, FractureScratch& scratch, ContactStepResult& taken) {
  std::vector<ComponentId> struck = std::move(taken.ties.torn);
  const BreakableBody body{s.cells, s.mechanics};
  const std::vector<ComponentId> over =
      overloaded_components(body, input.scene.fracture, scratch, input.members, most_overstress);
  struck.insert(struck.end(), over.begin(), over.end());
  sort_unique(struck);
  Blows blows = struck_by_cracks(std::move(struck), s.mechanics);
  if (blows.struck.empty()) return false;  // rigid components have no window that could open
  s.mechanics.vertices = attempt.vertices;
  s.mechanics.components = attempt.components;
  s.mechanics.elements.stress = attempt.stress;
  s.mechanics.elements.corner_stress = attempt.corner_stress;
  s.mechanics.time = attempt.time;
  s.obstacles = attempt.obstacles;
  s.contact = attempt.contact;
  report = attempt.report;
  taken = {};
  taken.adopted = false;
  taken.blows = std::move(blows);
  taken.blows.time = 0;
  return true;
}

}  // namespace sunder
