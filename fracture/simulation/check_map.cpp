// SPDX-License-Identifier: MIT
// Holds the map of a running simulation, and its labels, against walks.
#include <fmt/format.h>

#include <optional>

#include "fracture/simulation/rows.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "topology/kernel/edge_nodes.hpp"

namespace sunder {
namespace {

/// The first tetrahedron with a label that disagrees with a walk about the tetrahedra connected to
/// it.
std::optional<std::size_t> first_wrong_label(const Components& labels, const Components& walked) {
  std::vector<ComponentId> label_of(walked.size.size()), walked_of(labels.size.size());
  for (std::size_t t = 0; t < labels.of_tetrahedron.size(); ++t) {
    const ComponentId label = labels.of_tetrahedron[t], part = walked.of_tetrahedron[t];
    if (label.index() >= walked_of.size()) return t;
    ComponentId &there = label_of[part.index()], &back = walked_of[label.index()];
    if (there.is_none()) there = label;
    if (back.is_none()) back = part;
    if (there != label || back != part) return t;
  }
  return std::nullopt;
}

template <Kernel K>
void check_labels(std::vector<Finding>& findings, const K& map, const Components& labels) {
  const std::optional<std::size_t> wrong = first_wrong_label(labels, label_components(map));
  if (!wrong) return;
  findings.push_back(
      {.code = "map_damaged",
       .ids = {static_cast<std::int64_t>(*wrong)},
       .text =
           fmt::format("the component of tetrahedron {} is not the one that a walk finds", *wrong),
       .remedy = "report this: no step leaves labels like this"});
}

std::vector<Finding> damage_of(const Cells& cells) {
  std::vector<Finding> findings = check(cells.map);
  if (!findings.empty()) return findings;  // a walk could lead nowhere
  if (!cells.pieces) {
    check_labels(findings, cells.map, cells.labels);
    return findings;
  }
  const DenseMap& tied = cells.pieces->map;
  const auto incident = tied.incident_tetrahedra();
  findings = check(VolumeMap(tied.rows(), {incident.begin(), incident.end()}));
  if (!findings.empty()) return findings;
  check_labels(findings, tied, cells.labels);
  check_labels(findings, tied, cells.pieces->labels);
  return findings;
}

}  // namespace

std::vector<Finding> check_map(const Simulation& simulation) {
  std::vector<Finding> findings = damage_of(simulation.state->cells);
  const std::vector<EdgeNodes>& edges = simulation.state->mechanics.elements.edge_nodes;
  if (findings.empty() && !edges.empty()) findings = check(edges, simulation.state->cells.map);
  for (Finding& f : findings) {
    f.text = fmt::format("after step {} (t = {:.6g} s): {}", simulation.state->step,
                         simulation.state->mechanics.time, f.text);
  }
  return findings;
}

}  // namespace sunder
