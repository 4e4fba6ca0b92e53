// SPDX-License-Identifier: MIT
// Algorithm 3 without algorithm 4.
#include "fracture/breaking/overloaded.hpp"

#include "fracture/breaking/plan_fans.hpp"
#include "topology/base/sort_unique.hpp"
#include "topology/kernel/fan.hpp"

namespace sunder {
namespace {

/// Notes components in place of splitting.
struct Overload {
  FractureWork& work;
  const StepMembers& members;
  double most;
  std::vector<char>& waits;
  std::vector<ComponentId>& found;

  ComponentId component_of(VertexId v) const {
    return work.body.mechanics.vertices.component[v.index()];
  }
  std::optional<double> threshold(VertexId v) {
    const ComponentId id = component_of(v);
    const bool is_seen = !id.is_none() && members.has(id) && !waits[v.index()] &&
                         deforms(work.body.mechanics.components[id.index()].rung);
    return is_seen ? std::optional(most * work.strength(v)) : std::nullopt;
  }
  void split(VertexId v, const PrincipalTension& tension) {
    const VertexStar around = vertex_star(work.body.cells.map, v);
    if (crack_of(work, around, tension).step == CrackStep::waits) return;
    found.push_back(component_of(v));
  }
};

}  // namespace

std::vector<ComponentId> overloaded_components(BreakableBody body, const FractureSettings& settings,
                                               FractureScratch& scratch, const StepMembers& members,
                                               double most) {
  std::vector<ComponentId> found;
  if (settings.mode == FractureMode::off) return found;
  const FanWatch nobody;
  FractureWork work{body, settings, scratch, nobody,
                    element_stress(body.cells, body.mechanics, settings.node_stress)};
  work.under_way = first_under_way(body.cells.cracks, body.mechanics.time);
  std::vector<char> waits(body.cells.map.vertices(), 0);
  for (const EmptyFan& empty : body.cells.empty_fans) waits[empty.vertex.index()] = 1;
  find_fractures(work.report, scratch.node_stress, body.cells, work.elements, settings,
                 Overload{work, members, most, waits, found});
  sort_unique(found);
  return found;
}

}  // namespace sunder
