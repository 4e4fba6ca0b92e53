// SPDX-License-Identifier: MIT
// From the next vertex in the queue to its fan.
#include "fracture/breaking/plan_fans.hpp"

#include "fracture/algorithms/choose_fan.hpp"
#include "fracture/algorithms/node_stress.hpp"
#include "fracture/algorithms/threshold_test.hpp"
#include "fracture/breaking/decide_sides.hpp"
#include "topology/kernel/fan.hpp"

namespace sunder {
namespace {

/// From now on the vertex waits until its stress changes: every plane leaves it whole.
void note_empty(FractureWork& work, VertexId v) {
  ++work.report.empty_fans;
  hold(work, v);
}

/// The fan of a vertex for its stress as it is, along the plane that suits that best; none where
/// every plane leaves it whole.
void plan_fan(std::vector<PlannedFan>& plans, FractureWork& work, PlannedFan plan,
              const PrincipalTension& tension) {
  const Cells& cells = work.body.cells;
  const MechanicsState& mechanics = work.body.mechanics;
  const VertexId v = plan.v.vertex;
  const ComponentId component = mechanics.vertices.component[v.index()];
  FanPlane plane =
      choose_fan(cells, plan.v, tension, mechanics.components[component.index()].rest_centre);
  if (plane.faces.empty()) return note_empty(work, v);
  plan.normal = plane.normal;
  plan.at = Vec3(cells.map.point(v).data());
  if (!work.has_objects()) plan.positive = std::move(plane.positive);
  plans.push_back(std::move(plan));
}

/// The fan of the next vertex in the queue, if it has one and does not wait.
void plan_vertex(std::vector<PlannedFan>& plans, FractureWork& work, VertexId v) {
  const PrincipalTension tension = principal_tension(work.stress(v));
  PlannedFan plan{vertex_star(work.body.cells.map, v), {}, tension.value, work.strength(v)};
  plan.untested = work.untested;
  const CrackChoice crack = crack_of(work, plan.v, tension);
  if (crack.step == CrackStep::waits) {
    work.scratch.flanks.push_back(v);
    return;
  }
  work.scratch.broken[v.index()] = 1;
  if (crack.step == CrackStep::starts) return plan_fan(plans, work, std::move(plan), tension);
  plan.crack = crack.crack;
  plan.normal = crack.plane.normal;
  plan.at = crack.plane.at;
  plans.push_back(std::move(plan));
}

}  // namespace

void measure(FractureWork& work, VertexId v) {
  const VolumeMap& map = work.body.cells.map;
  NodeStressField& field = work.scratch.node_stress;
  field.value[v.index()] = work.settings.node_stress == NodeStress::fit
                               ? fit_node_stress(field.fit, map, work.elements, v)
                               : node_stress_of_star(work.elements, vertex_star(map, v).corners);
}

void hold(FractureWork& work, VertexId v) {
  work.body.cells.empty_fans.push_back({v, work.stress(v) / work.stress(v).norm()});
}

CrackChoice crack_of(const FractureWork& work, const VertexStar& v,
                     const PrincipalTension& tension) {
  const Cells& cells = work.body.cells;
  if (!work.has_objects() || cells.cracks.cracks == 0) return {};
  const MechanicsState& mechanics = work.body.mechanics;
  const ComponentId component = mechanics.vertices.component[v.vertex.index()];
  return choose_crack(
      cells, v, tension,
      {mean_edge_length(mechanics.vertices, cells.map.corners(), v),
       mechanics.components[component.index()].rest_centre, mechanics.time, work.under_way});
}

namespace {

/// Whether the budget allows no fan besides those made and planned.
bool is_spent(const FractureWork& work, std::size_t planned) {
  if (work.settings.mode != FractureMode::budget) return false;
  const std::size_t pieces = work.body.cells.labels.size.size() - work.pieces_before;
  return work.report.fans.size() + planned >= work.settings.max_fans ||
         pieces >= work.settings.max_new_pieces;
}

}  // namespace

std::vector<PlannedFan> plan_fans(FractureWork& work, std::span<const VertexId> tied) {
  FractureReport& report = work.report;
  std::vector<PlannedFan> plans;
  for (const VertexId v : tied) {
    if (work.settings.node_stress == NodeStress::fit) measure(work, v);
    if (work.test(v) != ThresholdAnswer::reached) {
      ++report.relieved;
      continue;
    }
    if (is_spent(work, plans.size())) {
      work.body.cells.waits[v.index()] = 1;
      ++report.waiting;
      continue;
    }
    work.tell(v);
    plan_vertex(plans, work, v);
    work.tell(VertexId::none());
  }
  if (work.has_objects()) decide_sides(work.body.cells, work.body.mechanics, plans);
  return plans;
}

}  // namespace sunder
