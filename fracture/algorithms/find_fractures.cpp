// SPDX-License-Identifier: MIT
// Candidates, their queue, and a fan for each.
#include "fracture/algorithms/find_fractures.hpp"

#include <algorithm>
#include <iterator>
#include <queue>

#include "fracture/algorithms/node_stress.hpp"
#include "fracture/algorithms/threshold_test.hpp"
#include "fracture/energy/tip_energy.hpp"
#include "topology/kernel/fan.hpp"
#include "topology/kernel/sort_unique.hpp"

namespace sunder {
namespace {

/// Overstresses that differ by less are tied: far above rounding and what a solver leaves, far
/// below what a mesh resolves.
constexpr double tie = 1e-6;
/// Change of a tensor over its norm that may turn its planes by about half a degree.
constexpr double changed_direction = 0.01;

/// A vertex that reaches its threshold, by how far: the most overstressed comes first.
struct Candidate {
  double overstress = 0;  // largest principal stress / threshold
  VertexId vertex;

  friend bool operator<(const Candidate& a, const Candidate& b) {
    if (a.overstress != b.overstress) return a.overstress < b.overstress;
    return a.vertex > b.vertex;
  }
};

/// One call at work.
struct Work {
  Cells& cells;
  MechanicsState& mechanics;
  const FractureSettings& settings;
  FractureScratch& scratch;
  ElementStress elements;
  FractureReport report = {};
  std::priority_queue<Candidate> queue = {};

  const Mat3& stress(VertexId v) const { return scratch.node_stress[v.index()]; }
  ThresholdAnswer test(VertexId v) const {
    return test_threshold(stress(v), cells.strength[v.index()]);
  }
};

ElementStress element_stress(const Cells& cells, const MechanicsState& mechanics, NodeStress mode) {
  const ElementColumns& e = mechanics.elements;
  return {cells.map.corners(), e.stress, mode == NodeStress::mass ? e.mass : e.rest_volume};
}

/// Reports each tetrahedron's stress to its vertices.
void measure_all(FractureScratch& scratch, const VolumeMap& map, const ElementStress& elements,
                 NodeStress mode) {
  if (mode == NodeStress::fit) {
    return fit_node_stress(scratch.node_stress, scratch.fit, map, elements);
  }
  average_node_stress(scratch.node_stress, elements, map.vertices(), scratch.weight);
}

void measure(Work& work, VertexId v) {
  const VolumeMap& map = work.cells.map;
  work.scratch.node_stress[v.index()] =
      work.settings.node_stress == NodeStress::fit
          ? fit_node_stress(work.scratch.fit, map, work.elements, v)
          : node_stress_of_star(work.elements, star(map, v));
}

/// Row = VertexId: whether it is looked at. Taken before anything splits.
void look_at(std::vector<char>& rows, const MechanicsState& mechanics, const StepMembers& members) {
  rows.resize(mechanics.vertices.size());
  for (std::size_t v = 0; v < rows.size(); ++v) {
    const ComponentId id = mechanics.vertices.component[v];
    rows[v] = members.has(id) && deforms(mechanics.components[id.index()].rung);
  }
}

/// With the criterion `energy`: the threshold of a crack tip as it is deformed now.
void set_tip_strength(Work& work, VertexId v) {
  const RelaxedState& relaxed = work.scratch.relaxed;
  const bool opened = work.elements.stress.data() == relaxed.stress.data();
  const Deformed deformed{opened ? relaxed.displacement : work.mechanics.vertices.displacement,
                          work.elements.stress};
  work.cells.strength[v.index()] =
      tip_strength(work.cells, work.mechanics, deformed, {v, work.stress(v)});
}

void set_tip_strengths(Work& work) {
  const VolumeMap& map = work.cells.map;
  std::vector<char> cracked(map.vertices(), 0);
  for (std::size_t f = 0; f < 4 * map.tetrahedra(); ++f) {
    if (!is_crack_face(work.cells, HalfFaceId{f})) continue;
    for (std::size_t k = 1; k < 4; ++k)
      cracked[map.corners(TetId{f / 4})[(f % 4 + k) % 4].index()] = 1;
  }
  for (std::size_t row = 0; row < cracked.size(); ++row) {
    if (cracked[row] && work.scratch.rows[row]) set_tip_strength(work, VertexId{row});
  }
}

/// From now on the vertex waits until its stress changes.
void hold(Work& work, VertexId v) {
  work.cells.empty_fans.push_back({v, work.stress(v) / work.stress(v).norm()});
}

/// Takes vertices with empty or refused fans out of the rows until their stress changes.
void hold_empty_fans(Work& work) {
  std::erase_if(work.cells.empty_fans, [&](const EmptyFan& empty) {
    char& row = work.scratch.rows[empty.vertex.index()];
    if (!row) return false;  // not its time
    const Mat3& sigma = work.stress(empty.vertex);
    const double change = (sigma / sigma.norm() - empty.stress_direction).norm();
    // A change that is not a number is one.
    if (!(change <= changed_direction)) return true;
    if (work.test(empty.vertex) != ThresholdAnswer::reached) return true;
    row = 0;
    ++work.report.still_empty;
    return false;
  });
}

void enqueue(Work& work, VertexId v) {
  const double overstress =
      principal_tension(work.stress(v)).value / work.cells.strength[v.index()];
  work.scratch.queued[v.index()] = overstress;
  work.queue.push({overstress, v});
}

/// The test over the vertices looked at. Stops at a NaN.
void find_candidates(Work& work) {
  FractureReport& report = work.report;
  for (std::size_t row = 0; row < work.cells.map.vertices(); ++row) {
    if (!work.scratch.rows[row]) continue;
    const VertexId v{row};
    ++report.tested;
    const ThresholdAnswer answer = test_threshold(work.stress(v), work.cells.strength[row],
                                                  work.settings.test, report.suspects);
    if (answer == ThresholdAnswer::below) continue;
    if (answer == ThresholdAnswer::not_a_number) {
      report.not_a_number = v;
      return;
    }
    ++report.reached;
    enqueue(work, v);
  }
}

/// Counts those that waited and are over their threshold no longer; forgets who waited.
void count_relieved(Work& work) {
  std::vector<char>& waits = work.cells.waits;
  waits.resize(work.cells.map.vertices(), 0);
  for (std::size_t row = 0; row < waits.size(); ++row) {
    if (!waits[row] || !work.scratch.rows[row]) continue;
    waits[row] = 0;
    work.report.relieved += work.test(VertexId{row}) == ThresholdAnswer::below;
  }
}

/// Whether an entry of the queue still stands: later ones of the same vertex replace it.
bool stands(const Work& work, const Candidate& c) {
  return work.scratch.queued[c.vertex.index()] == c.overstress;
}

/// The most overstressed candidates, as far as each is tied with the one before.
void take_tied(std::vector<VertexId>& tied, Work& work) {
  tied.clear();
  double last = 0;
  while (!work.queue.empty()) {
    const Candidate c = work.queue.top();
    if (stands(work, c)) {
      if (!tied.empty() && c.overstress < last * (1 - tie)) return;
      last = c.overstress;
      work.scratch.queued[c.vertex.index()] = 0;
      tied.push_back(c.vertex);
    }
    work.queue.pop();
  }
}

/// Fans of the tied candidates on the state as it is; none for those that wait or cannot break.
std::vector<PlannedFan> plan_fans(Work& work, std::span<const VertexId> tied) {
  FractureReport& report = work.report;
  std::vector<PlannedFan> plans;
  for (const VertexId v : tied) {
    if (work.settings.node_stress == NodeStress::fit) measure(work, v);
    if (work.test(v) != ThresholdAnswer::reached) {
      ++report.relieved;
      continue;
    }
    if (work.settings.mode == FractureMode::budget &&
        report.fans.size() + plans.size() >= work.settings.max_fans) {
      work.cells.waits[v.index()] = 1;
      ++report.waiting;
      continue;
    }
    work.scratch.broken[v.index()] = 1;
    const ComponentId component = work.mechanics.vertices.component[v.index()];
    PlannedFan plan = plan_fan(work.cells, v, principal_tension(work.stress(v)),
                               work.mechanics.components[component.index()].rest_centre);
    if (plan.plane.faces.empty()) {
      ++report.empty_fans;
      hold(work, v);
      continue;
    }
    plans.push_back(std::move(plan));
  }
  return plans;
}

/// Rows that a fan split, old and new; copies of what has broken have broken.
void note_splits(Work& work, const FanEvent& event, std::vector<VertexId>& split_rows) {
  FractureScratch& scratch = work.scratch;
  const std::size_t rows = work.cells.map.vertices();
  scratch.node_stress.resize(rows);
  scratch.broken.resize(rows, 0);
  scratch.queued.resize(rows, 0);
  for (const FaceSplit& split : event.faces) {
    for (int i = 0; i < split.vertex_count; ++i) {
      const auto [old_row, new_row] = split.split_vertices[i];
      split_rows.push_back(old_row);
      split_rows.push_back(new_row);
      scratch.broken[new_row.index()] = scratch.broken[old_row.index()];
    }
  }
}

/// Lets what was split open, and adds the vertices whose stress that changes.
void relax(Work& work, std::vector<VertexId>& rows) {
  RelaxedState& relaxed = work.scratch.relaxed;
  relax_around(relaxed, work.cells, work.mechanics, work.settings.relax);
  const std::vector<char>& looked_at = work.scratch.rows;
  std::ranges::copy_if(relaxed.changed, std::back_inserter(rows), [&](VertexId v) {
    return v.index() < looked_at.size() && looked_at[v.index()];
  });
}

/// Measures what the fans of a tie split, and queues it anew.
void follow_splits(Work& work, std::vector<VertexId>& split_rows) {
  if (work.settings.relax > 0) relax(work, split_rows);
  sort_unique(split_rows);
  if (work.settings.node_stress == NodeStress::fit) follow_splits(work.scratch.fit, work.cells.map);
  std::erase_if(work.cells.empty_fans, [&](const EmptyFan& empty) {
    return std::binary_search(split_rows.begin(), split_rows.end(), empty.vertex);
  });
  for (const VertexId v : split_rows) {
    measure(work, v);
    if (work.scratch.broken[v.index()]) continue;
    if (work.settings.criterion == FractureCriterion::energy) set_tip_strength(work, v);
    double& queued = work.scratch.queued[v.index()];
    const bool stood = queued > 0;
    queued = 0;
    if (work.test(v) == ThresholdAnswer::reached) {
      enqueue(work, v);
    } else {
      work.report.relieved += stood;
    }
  }
}

}  // namespace

std::vector<Mat3> node_stress_of(const Cells& cells, const MechanicsState& mechanics,
                                 NodeStress mode) {
  FractureScratch scratch;
  measure_all(scratch, cells.map, element_stress(cells, mechanics, mode), mode);
  return std::move(scratch.node_stress);
}

FractureReport find_fractures(Cells& cells, MechanicsState& mechanics,
                              const FractureSettings& settings, FractureScratch& scratch,
                              const StepMembers& members) {
  if (settings.mode == FractureMode::off) return {};
  Work work{cells, mechanics, settings, scratch,
            element_stress(cells, mechanics, settings.node_stress)};
  measure_all(scratch, cells.map, work.elements, settings.node_stress);
  look_at(scratch.rows, mechanics, members);
  if (settings.node_stress == NodeStress::fit) {
    for (std::size_t row = 0; row < scratch.rows.size(); ++row) {
      work.report.unfitted += scratch.rows[row] && !scratch.fit.patches[row].fitted;
    }
  }
  if (settings.criterion == FractureCriterion::energy) set_tip_strengths(work);
  hold_empty_fans(work);
  scratch.broken.assign(cells.map.vertices(), 0);
  scratch.queued.assign(cells.map.vertices(), 0);
  find_candidates(work);
  if (work.report.not_a_number) return std::move(work.report);
  count_relieved(work);

  if (settings.relax > 0 && !work.queue.empty()) {
    start_relaxing(scratch.relaxed, mechanics);
    work.elements.stress = scratch.relaxed.stress;
  }
  std::vector<VertexId> tied, split_rows;
  for (std::uint32_t round = 0; !work.queue.empty(); ++round) {
    take_tied(tied, work);
    split_rows.clear();
    for (PlannedFan& plan : plan_fans(work, tied)) {
      FanEvent event = split_fan(cells, mechanics, std::move(plan), settings, scratch.fan);
      if (event.refused) {
        ++work.report.refused_fans;
        hold(work, event.vertex);
        continue;
      }
      if (event.faces.empty()) {
        ++work.report.relieved;  // its neighbours' fans had all of its faces
        continue;
      }
      event.round = round;
      if (settings.relax > 0) note_fan(scratch.relaxed, cells, mechanics, event);
      note_splits(work, event, split_rows);
      work.report.fans.push_back(std::move(event));
    }
    follow_splits(work, split_rows);
  }
  return std::move(work.report);
}

}  // namespace sunder
