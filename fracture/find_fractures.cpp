// SPDX-License-Identifier: MIT
// Candidates, their queue, and a fan for each.
#include "fracture/find_fractures.hpp"

#include <queue>

#include "fracture/node_stress.hpp"
#include "fracture/threshold_test.hpp"
#include "topology/fan.hpp"

namespace sunder {
namespace {

/// A vertex that reaches its threshold, by how far: the most overstressed comes first.
struct Candidate {
  double overstress = 0;  // largest principal stress / threshold
  VertexId vertex;

  friend bool operator<(const Candidate& a, const Candidate& b) {
    if (a.overstress != b.overstress) return a.overstress < b.overstress;
    return a.vertex > b.vertex;
  }
};
using CandidateQueue = std::priority_queue<Candidate>;

ElementStress element_stress(const Cells& cells, const MechanicsState& mechanics,
                             StressWeight weight) {
  const ElementColumns& e = mechanics.elements;
  return {cells.map.corners(), e.stress, weight == StressWeight::volume ? e.rest_volume : e.mass};
}

Candidate make_candidate(const FractureScratch& scratch, const Cells& cells, VertexId v) {
  const PrincipalTension tension = principal_tension(scratch.node_stress[v.index()]);
  return {tension.value / cells.strength[v.index()], v};
}

/// Row = VertexId: whether it is looked at. Taken before anything splits.
void look_at(std::vector<char>& rows, const MechanicsState& mechanics, const StepMembers& members) {
  rows.resize(mechanics.vertices.size());
  for (std::size_t v = 0; v < rows.size(); ++v) {
    const ComponentId id = mechanics.vertices.component[v];
    rows[v] = members.has(id) && deforms(mechanics.components[id.index()].rung);
  }
}

/// The test chain over the vertices looked at: bound, exact test, eigenvalue. Stops at a NaN.
CandidateQueue find_candidates(const Cells& cells, const FractureScratch& scratch,
                               std::span<const char> rows, FractureReport& report) {
  CandidateQueue queue;
  for (std::size_t row = 0; row < cells.map.vertices(); ++row) {
    if (!rows[row]) continue;
    const VertexId v{row};
    const double xi = cells.strength[row];
    const Mat3& sigma = scratch.node_stress[row];
    ++report.tested;
    if (gershgorin_bound(sigma) < xi) continue;
    ++report.suspects;
    const ThresholdAnswer answer = test_threshold(sigma, xi);
    if (answer == ThresholdAnswer::not_a_number) {
      report.not_a_number = v;
      return {};
    }
    if (answer == ThresholdAnswer::below) continue;
    ++report.reached;
    queue.push(make_candidate(scratch, cells, v));
  }
  return queue;
}

/// Averages again what a fan changed and queues the copies of vertices whose turn is still to come.
void follow_fan(Cells& cells, const ElementStress& elements, const FanEvent& event,
                FractureScratch& scratch, std::vector<char>& broken, CandidateQueue& queue) {
  scratch.node_stress.resize(cells.map.vertices());
  broken.resize(cells.map.vertices(), 0);
  const auto average = [&](VertexId v) {
    scratch.node_stress[v.index()] = node_stress_of_star(elements, star(cells.map, v));
  };
  for (const FaceSplit& split : event.faces) {
    for (int i = 0; i < split.vertex_count; ++i) {
      const auto [old_row, new_row] = split.split_vertices[i];
      average(old_row);
      average(new_row);
      broken[new_row.index()] = broken[old_row.index()];
    }
  }
  for (const FaceSplit& split : event.faces) {
    for (int i = 0; i < split.vertex_count; ++i) {
      const VertexId v = split.split_vertices[i].new_row;
      if (broken[v.index()]) continue;
      if (test_threshold(scratch.node_stress[v.index()], cells.strength[v.index()]) ==
          ThresholdAnswer::reached) {
        queue.push(make_candidate(scratch, cells, v));
      }
    }
  }
}

/// Counts those that waited and are over their threshold no longer; forgets who waited.
void count_relieved(Cells& cells, const FractureScratch& scratch, std::span<const char> rows,
                    FractureReport& report) {
  cells.waits.resize(cells.map.vertices(), 0);
  for (std::size_t row = 0; row < cells.waits.size(); ++row) {
    if (!cells.waits[row] || !rows[row]) continue;
    cells.waits[row] = 0;
    report.relieved +=
        test_threshold(scratch.node_stress[row], cells.strength[row]) == ThresholdAnswer::below;
  }
}

}  // namespace

FractureReport find_fractures(Cells& cells, MechanicsState& mechanics,
                              const FractureSettings& settings, FractureScratch& scratch,
                              const StepMembers& members) {
  FractureReport report;
  if (settings.mode == FractureMode::off) return report;
  const ElementStress elements = element_stress(cells, mechanics, settings.weight);
  // Report each tetrahedron's stress to its vertices and average it.
  average_node_stress(scratch.node_stress, elements, cells.map.vertices(), scratch.weight);
  // Check where a fracture occurs.
  look_at(scratch.rows, mechanics, members);
  CandidateQueue queue = find_candidates(cells, scratch, scratch.rows, report);
  if (report.not_a_number) return report;
  count_relieved(cells, scratch, scratch.rows, report);

  std::vector<char>& broken = scratch.broken;
  broken.assign(cells.map.vertices(), 0);
  while (!queue.empty()) {
    const Candidate candidate = queue.top();
    queue.pop();
    const VertexId v = candidate.vertex;
    const PrincipalTension tension = principal_tension(scratch.node_stress[v.index()]);
    if (test_threshold(scratch.node_stress[v.index()], cells.strength[v.index()]) !=
        ThresholdAnswer::reached) {
      ++report.relieved;
      continue;
    }
    if (settings.mode == FractureMode::budget && report.fans.size() >= settings.max_fans) {
      cells.waits[v.index()] = 1;
      ++report.waiting;
      continue;
    }
    broken[v.index()] = 1;
    FanEvent event = split_fan(cells, mechanics, v, tension, settings, scratch.fan);
    if (event.faces.empty()) {
      ++(event.refused ? report.refused_fans : report.empty_fans);
      continue;
    }
    follow_fan(cells, elements, event, scratch, broken, queue);
    report.fans.push_back(std::move(event));
  }
  return report;
}

}  // namespace sunder
