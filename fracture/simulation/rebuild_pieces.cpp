// SPDX-License-Identifier: MIT
// Pieces after fans.
#include "fracture/simulation/rebuild_pieces.hpp"

#include "fracture/breaking/partners.hpp"
#include "fracture/ties/insert_ties.hpp"
#include "topology/base/sort_unique.hpp"

namespace sunder {
namespace {

/// Components that fans divided, and pieces that came off them, ascending.
std::vector<ComponentId> touched_components(const Components& labels,
                                            std::span<const FanEvent> fans, std::size_t before) {
  std::vector<ComponentId> touched;
  for (const FanEvent& fan : fans) {
    // Every row a fan split belongs to a component of which the masses, at least, must be computed
    // again.
    for (const FaceSplit& split : fan.faces) {
      touched.push_back(labels.of_tetrahedron[tetrahedron_of(split.face).index()]);
      touched.push_back(labels.of_tetrahedron[tetrahedron_of(split.opposite).index()]);
    }
  }
  for (std::size_t id = before; id < labels.size.size(); ++id) {
    touched.emplace_back(id);
    touched.push_back(ancestor(labels, ComponentId{id}, before));
  }
  sort_unique(touched);
  return touched;
}

RebuildReport rebuild_touched(SimulationState& s, std::span<const ComponentId> touched,
                              MechanicsScratch& scratch) {
  const std::size_t before = s.display.size();
  std::vector<Vec3> old_rest_centre;
  std::vector<Pose> old_pose;
  for (std::size_t id = 0; id < before; ++id) {
    const Component& c = s.mechanics.components[id];
    old_rest_centre.push_back(c.rest_centre);
    old_pose.push_back({c.centre, c.orientation});
  }
  s.mechanics.elements.component = s.cells.labels.of_tetrahedron;
  const RebuildReport report = rebuild(s.mechanics, s.cells.map.corners(), touched, scratch);

  s.display.resize(s.cells.labels.size.size());
  s.display_target.resize(s.display.size());
  // New pieces are drawn where they were, moved along to this moment; the jump of their own
  // references is smoothed later. New ids first: their display state comes from the parent's, which
  // changes last.
  for (auto id = touched.rbegin(); id != touched.rend(); ++id) {
    const std::size_t old = ancestor(s.cells.labels, *id, before).index();
    const Component& c = s.mechanics.components[id->index()];
    const Pose drawn = carry(s.display[old], s.display_target[old], old_pose[old]);
    s.display[id->index()] = split_off(drawn, old_rest_centre[old], c.rest_centre);
    s.display_target[id->index()] = {c.centre, c.orientation};
  }
  inherit(s.impact.quiet, s.cells.labels);
  inherit(s.ladder.rubble.apart, s.cells.labels);
  return report;
}

}  // namespace

ComponentId ancestor(const Components& labels, ComponentId id, std::size_t count) {
  while (id.index() >= count) id = labels.parent[id.index()];
  return id;
}

RebuildReport rebuild_pieces(SimulationState& s, std::span<const FanEvent> fans,
                             MechanicsScratch& scratch) {
  const auto touched = touched_components(s.cells.labels, fans, s.display.size());
  s.fans += fans.size();
  if (s.cells.pieces) {
    add_ties(s.contact.ties, s.cells, s.mechanics, fans);
    const RebuildReport report = rebuild_touched(s, touched, scratch);
    begin_corners(s.contact.ties, s.cells, s.mechanics);
    return report;
  }
  open_cracks(s.cracks, {fans, s.fans - fans.size(), s.mechanics.time}, s.mechanics, s.cells);
  add_partners(s.contact.partners, s.cells.map, fans);
  return rebuild_touched(s, touched, scratch);
}

RebuildReport rebuild_released(SimulationState& s, MechanicsScratch& scratch) {
  return rebuild_touched(s, touched_components(s.cells.labels, {}, s.display.size()), scratch);
}

}  // namespace sunder
