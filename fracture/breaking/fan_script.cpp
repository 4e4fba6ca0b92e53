// SPDX-License-Identifier: MIT
// Making the fans of a script, each checked first against the body as it is.
#include "fracture/breaking/fan_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sunder {
namespace {

void depart(FanScript& script, std::size_t fan, std::string reason) {
  script.departure = {fan, std::move(reason)};
}

/// Why a fan cannot be planned; empty where it can.
std::string misfit(const Cells& cells, const ScriptedFan& fan) {
  if (fan.vertex.index() >= cells.map.vertices()) {
    return fmt::format("vertex {} is not there yet: the highest is {}", fan.vertex.value,
                       cells.map.vertices() - 1);
  }
  if (!fan.crack.is_none() && fan.crack.index() > cells.cracks.cracks + cells.map.vertices()) {
    return fmt::format("crack {} is not there: there are {}", fan.crack.value, cells.cracks.cracks);
  }
  if (!(std::abs(fan.normal.norm() - 1) < 1e-9)) {
    return fmt::format("the normal of the fan at vertex {} is not of length 1", fan.vertex.value);
  }
  return {};
}

/// Sides by the labels of the fan's crack, known ones and new ones; without a crack by the plane.
std::vector<char> signs_of(const Cells& cells, const PlannedFan& plan, const ScriptedFan& fan) {
  if (fan.crack.is_none()) {
    return plane_signs(cells.map, plan.v, {fan.normal.x(), fan.normal.y(), fan.normal.z()});
  }
  std::vector<char> positive;
  for (const CornerId c : plan.v.corners) {
    const TetId t = tetrahedron_of(c);
    const auto label = std::ranges::find(fan.labels, t, &CrackLabel::tetrahedron);
    positive.push_back(label != fan.labels.end()
                           ? label->positive
                           : side_of(cells.cracks, fan.crack, t) == Side::positive);
  }
  return positive;
}

/// Plans the fans from the script's next up to `end` on the state as it is.
std::vector<PlannedFan> plan_round(Cells& cells, const FractureSettings& settings,
                                   FanScript& script, std::size_t end) {
  std::vector<PlannedFan> plans;
  for (std::size_t row = script.next; row < end; ++row) {
    const ScriptedFan& fan = script.fans[row];
    std::string reason = misfit(cells, fan);
    if (!reason.empty()) {
      depart(script, row, std::move(reason));
      break;
    }
    while (!fan.crack.is_none() && cells.cracks.cracks <= fan.crack.value) {
      add_crack(cells.cracks, cells.map.tetrahedra());
    }
    const bool by_energy = settings.criterion == FractureCriterion::energy;
    PlannedFan plan{vertex_star(cells.map, fan.vertex), fan.normal, fan.stress,
                    by_energy ? fan.strength : cells.strength[fan.vertex.index()]};
    plan.crack = fan.crack;
    plan.at = fan.anchor;
    plan.positive = signs_of(cells, plan, fan);
    plans.push_back(std::move(plan));
  }
  return plans;
}

std::size_t end_of_round(const FanScript& script) {
  const ScriptedFan& first = script.fans[script.next];
  std::size_t end = script.next;
  while (end < script.fans.size() && script.fans[end].place == first.place &&
         script.fans[end].round == first.round) {
    ++end;
  }
  return end;
}

}  // namespace

std::vector<FanEvent> make_fans(BreakableBody body, const FractureSettings& settings,
                                FanScript& script, SearchPlace place, ComponentScratch& scratch,
                                double untested, const FanWatch& watch) {
  const auto tell = [&](VertexId v) {
    if (watch) watch(v);
  };
  std::vector<FanEvent> made;
  while (script.next < script.fans.size() && script.fans[script.next].place <= place) {
    const SearchPlace wanted = script.fans[script.next].place;
    if (wanted < place) {
      depart(
          script, script.next,
          fmt::format("step {} has no search for fractures number {}", wanted.step, wanted.part));
      return made;
    }
    const std::uint32_t round = script.fans[script.next].round;
    for (PlannedFan& plan : plan_round(body.cells, settings, script, end_of_round(script))) {
      plan.untested = untested;
      tell(plan.v.vertex);
      FanEvent event = split_planned(body, plan, settings, scratch);
      tell(VertexId::none());
      if (event.faces.empty()) {
        depart(script, script.next,
               fmt::format("no face is left to split at vertex {} along this normal",
                           event.vertex.value));
        return made;
      }
      event.round = round;
      made.push_back(std::move(event));
      ++script.next;
    }
    if (script.departure) return made;
  }
  return made;
}

}  // namespace sunder
