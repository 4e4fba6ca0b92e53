// SPDX-License-Identifier: MIT
// Candidates, their queue, and a fan for each.
#include "fracture/breaking/break_vertices.hpp"

#include <algorithm>
#include <iterator>
#include <optional>

#include "fracture/algorithms/node_stress.hpp"
#include "fracture/algorithms/piece_limits.hpp"
#include "fracture/algorithms/split_fan.hpp"
#include "fracture/algorithms/threshold_test.hpp"
#include "fracture/breaking/decide_sides.hpp"
#include "fracture/breaking/plan_fans.hpp"
#include "fracture/energy/tip_energy.hpp"
#include "topology/base/sort_unique.hpp"
#include "topology/kernel/fan.hpp"

namespace sunder {
namespace {

/// Overstresses that differ by less are tied: far above rounding and the error of a solver, far
/// below the resolution of a mesh.
constexpr double tie = 1e-6;
/// Change of a tensor over its norm that may turn its planes by about half a degree.
constexpr double changed_direction = 0.01;

/// Row = VertexId: whether it belongs to the search. Set before anything splits.
void look_at(std::vector<char>& rows, const MechanicsState& mechanics, const StepMembers& members) {
  rows.resize(mechanics.vertices.size());
  for (std::size_t v = 0; v < rows.size(); ++v) {
    const ComponentId id = mechanics.vertices.component[v];
    rows[v] = members.has(id) && deforms(mechanics.components[id.index()].rung);
  }
}

/// Row = VertexId: whether a face at it is cracked.
void look_for_cracks(std::vector<char>& cracked, const Cells& cells) {
  cracked.assign(cells.map.vertices(), 0);
  for (std::size_t f = 0; f < 4 * cells.map.tetrahedra(); ++f) {
    const HalfFaceId face{f};
    if (!is_crack_face(cells, face)) continue;
    for (const VertexId v : corners_of_face(cells.map.corners(tetrahedron_of(face)), face)) {
      cracked[v.index()] = 1;
    }
  }
}

/// Prepares the search, before any stress is known.
void prepare(FractureWork& work, const StepMembers& members) {
  FractureScratch& scratch = work.scratch;
  const Cells& cells = work.body.cells;
  const std::size_t vertices = cells.map.vertices();
  work.under_way = first_under_way(cells.cracks, work.body.mechanics.time);
  look_at(scratch.rows, work.body.mechanics, members);
  if (work.settings.criterion == FractureCriterion::energy) look_for_cracks(scratch.cracked, cells);
  scratch.held.assign(cells.empty_fans.empty() ? 0 : vertices, 0);
  for (std::uint32_t i = 0; i < cells.empty_fans.size(); ++i) {
    scratch.held[cells.empty_fans[i].vertex.index()] = i + 1;
  }
  scratch.broken.assign(vertices, 0);
  scratch.queued.assign(vertices, 0);
}

/// With the criterion `energy`: the threshold of a crack tip as it is deformed now.
void set_tip_strength(FractureWork& work, VertexId v) {
  const RelaxedState& relaxed = work.scratch.relaxed;
  const bool opened = work.elements.stress.data() == relaxed.stress.data();
  const Deformed deformed{opened ? relaxed.displacement : work.body.mechanics.vertices.displacement,
                          work.elements.stress, work.elements.corner_stress};
  work.body.cells.strength[v.index()] =
      tip_strength(work.body.cells, work.body.mechanics, deformed, {v, work.stress(v)});
}

/// Whether a held vertex goes on waiting: its stress has not changed.
bool stays_held(const FractureWork& work, const EmptyFan& empty) {
  const Mat3& sigma = work.stress(empty.vertex);
  const double change = (sigma / sigma.norm() - empty.stress_direction).norm();
  // A change that is not a number is one.
  return change <= changed_direction && work.test(empty.vertex) == ThresholdAnswer::reached;
}

/// With the criterion `energy`: `set_tip_strength` where a face at the vertex is cracked.
void update_tip_strength(FractureWork& work, VertexId v) {
  const bool by_energy = work.settings.criterion == FractureCriterion::energy;
  if (by_energy && work.scratch.cracked[v.index()]) set_tip_strength(work, v);
}

/// The empty or refused fan of a vertex; null: it has none.
EmptyFan* empty_fan_of(FractureWork& work, VertexId v) {
  const std::vector<std::uint32_t>& held = work.scratch.held;
  if (held.empty() || held[v.index()] == 0) return nullptr;
  return &work.body.cells.empty_fans[held[v.index()] - 1];
}

/// The threshold of a vertex that is looked at. Those with empty or refused fans are not until
/// their stress changes; then they are forgotten (a vertex of none, for `forget_released`).
std::optional<double> threshold_of(FractureWork& work, VertexId v) {
  FractureScratch& scratch = work.scratch;
  if (!scratch.rows[v.index()]) return std::nullopt;
  if (work.settings.node_stress == NodeStress::fit) {
    work.report.unfitted += !scratch.node_stress.fit.patches[v.index()].fitted;
  }
  update_tip_strength(work, v);
  if (EmptyFan* empty = empty_fan_of(work, v)) {
    if (stays_held(work, *empty)) {
      scratch.rows[v.index()] = 0;
      ++work.report.still_empty;
      return std::nullopt;
    }
    empty->vertex = VertexId::none();
  }
  return work.strength(v);
}

void forget_released(std::vector<EmptyFan>& empty_fans) {
  std::erase_if(empty_fans, [](const EmptyFan& empty) { return empty.vertex.is_none(); });
}

void enqueue(FractureWork& work, VertexId v, const PrincipalTension& tension) {
  const double overstress = tension.value / work.strength(v);
  work.scratch.queued[v.index()] = overstress;
  const VertexStar around = vertex_star(work.body.cells.map, v);
  const bool grows = crack_of(work, around, tension).step == CrackStep::grows;
  work.queue.push({overstress, v, grows});
}

/// Algorithm 3 up to the first vertex that is not left waiting.
struct FirstCandidate {
  FractureWork& work;
  bool& found;

  std::optional<double> threshold(VertexId v) {
    if (found || !work.scratch.rows[v.index()]) return std::nullopt;
    update_tip_strength(work, v);
    const EmptyFan* empty = empty_fan_of(work, v);
    return empty && stays_held(work, *empty) ? std::nullopt : std::optional(work.strength(v));
  }
  void split(VertexId v, const PrincipalTension& tension) {
    found = crack_of(work, vertex_star(work.body.cells.map, v), tension).step != CrackStep::waits;
  }
};

/// The search of algorithm 3: candidates wait for their turn.
struct Candidates {
  FractureWork& work;

  std::optional<double> threshold(VertexId v) { return threshold_of(work, v); }
  void split(VertexId v, const PrincipalTension& tension) { enqueue(work, v, tension); }
};

/// Counts waiting vertices that are below their threshold now, and clears the list of waiting
/// vertices.
void count_relieved(FractureWork& work) {
  std::vector<char>& waits = work.body.cells.waits;
  waits.resize(work.body.cells.map.vertices(), 0);
  for (std::size_t row = 0; row < waits.size(); ++row) {
    if (!waits[row] || !work.scratch.rows[row]) continue;
    waits[row] = 0;
    work.report.relieved += work.test(VertexId{row}) == ThresholdAnswer::below;
  }
}

/// Whether an entry of the queue still stands: later ones of the same vertex replace it.
bool stands(const FractureWork& work, const BreakCandidate& c) {
  return work.scratch.queued[c.vertex.index()] == c.overstress;
}

/// The most overstressed candidates, as far as each is tied with the one before.
void take_tied(std::vector<VertexId>& tied, FractureWork& work) {
  tied.clear();
  BreakCandidate last;
  while (!work.queue.empty()) {
    const BreakCandidate c = work.queue.top();
    if (stands(work, c)) {
      const bool is_tied = c.grows == last.grows && c.overstress >= last.overstress * (1 - tie);
      if (!tied.empty() && !is_tied) return;
      last = c;
      work.scratch.queued[c.vertex.index()] = 0;
      tied.push_back(c.vertex);
    }
    work.queue.pop();
  }
}

/// Whether the limits on pieces refuse a fan.
bool is_refused(FractureWork& work, const PlannedFan& plan) {
  if (!limits_pieces(work.settings)) return false;
  const Cells& cells = work.body.cells;
  const auto faces = breakable_fan(cells, plan.v, plan.positive);
  return exceeds_limits(cells, work.body.mechanics, faces, work.settings, work.scratch.components);
}

/// Rows that a fan split, old and new; copies of broken vertices count as broken.
void note_splits(FractureWork& work, const FanEvent& event, std::vector<VertexId>& split_rows) {
  FractureScratch& scratch = work.scratch;
  const std::size_t rows = work.body.cells.map.vertices();
  scratch.node_stress.value.resize(rows);
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

/// Splits one fan of a round, if the limits allow it and others have left it a face.
void split(FractureWork& work, const PlannedFan& plan, std::uint32_t round,
           std::vector<VertexId>& split_rows) {
  work.tell(plan.v.vertex);
  if (is_refused(work, plan)) {
    work.tell(VertexId::none());
    ++work.report.refused_fans;
    return hold(work, plan.v.vertex);
  }
  FanEvent event = split_planned(work.body, plan, work.settings, work.scratch.components);
  work.tell(VertexId::none());
  if (event.faces.empty()) {
    ++work.report.relieved;  // its neighbours' fans had all of its faces
    return;
  }
  event.round = round;
  if (work.settings.relax > 0) {
    note_fan(work.scratch.relaxed, work.body.cells, work.body.mechanics, event);
  }
  note_splits(work, event, split_rows);
  work.report.fans.push_back(std::move(event));
}

/// Lets the split faces open, and adds the vertices with a changed stress.
void relax(FractureWork& work, std::vector<VertexId>& rows) {
  RelaxedState& relaxed = work.scratch.relaxed;
  relax_around(relaxed, work.body.cells, work.body.mechanics, work.settings.relax);
  const std::vector<char>& looked_at = work.scratch.rows;
  std::ranges::copy_if(relaxed.changed, std::back_inserter(rows), [&](VertexId v) {
    return v.index() < looked_at.size() && looked_at[v.index()];
  });
}

/// Measures the vertices that the fans of a tie split, and queues them again.
void follow_splits(FractureWork& work, std::vector<VertexId>& split_rows) {
  if (work.settings.relax > 0) relax(work, split_rows);
  sort_unique(split_rows);
  if (work.settings.node_stress == NodeStress::fit) {
    follow_splits(work.scratch.node_stress.fit, work.body.cells.map);
  }
  std::erase_if(work.body.cells.empty_fans, [&](const EmptyFan& empty) {
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
      enqueue(work, v, principal_tension(work.stress(v)));
    } else {
      work.report.relieved += stood;
    }
  }
}

/// Queues the vertices around fans of cracks again: the front may pass through them now.
void follow_fronts(FractureWork& work, std::span<const PlannedFan> fans) {
  std::vector<VertexId> around;
  const VolumeMap& map = work.body.cells.map;
  for (const PlannedFan& fan : fans) {
    for (const CornerId c : fan.v.corners) {
      const Corners& rows = map.corners(tetrahedron_of(c));
      around.insert(around.end(), rows.begin(), rows.end());
    }
  }
  sort_unique(around);
  const std::vector<char>& looked_at = work.scratch.rows;
  for (const VertexId v : around) {
    const bool is_seen = v.index() >= looked_at.size() || looked_at[v.index()];
    if (!is_seen || work.scratch.broken[v.index()]) continue;
    if (work.test(v) == ThresholdAnswer::reached) {
      enqueue(work, v, principal_tension(work.stress(v)));
    }
  }
}

/// Splits the queued vertices, tie by tie.
void split_in_order(FractureWork& work) {
  std::vector<VertexId> tied, split_rows;
  for (std::uint32_t round = 0; !work.queue.empty(); ++round) {
    take_tied(tied, work);
    split_rows.clear();
    const std::vector<PlannedFan> plans = plan_fans(work, tied);
    for (const PlannedFan& plan : plans) split(work, plan, round, split_rows);
    follow_splits(work, split_rows);
    if (work.has_objects()) follow_fronts(work, plans);
  }
}

/// Those on flanks that have not broken after all.
std::size_t count_flanks(FractureWork& work) {
  std::vector<VertexId>& flanks = work.scratch.flanks;
  sort_unique(flanks);
  std::erase_if(flanks, [&](VertexId v) { return work.scratch.broken[v.index()] != 0; });
  return flanks.size();
}

}  // namespace

bool any_breaks(BreakableBody body, const FractureSettings& settings, FractureScratch& scratch,
                const StepMembers& members) {
  if (settings.mode == FractureMode::off) return false;
  const FanWatch nobody;
  FractureWork work{body, settings, scratch, nobody,
                    element_stress(body.cells, body.mechanics, settings.node_stress)};
  prepare(work, members);
  bool found = false;
  find_fractures(work.report, scratch.node_stress, body.cells, work.elements, settings,
                 FirstCandidate{work, found});
  // A stress that is not a number is for the search to report.
  return found || work.report.not_a_number;
}

FractureReport break_vertices(BreakableBody body, const FractureSettings& settings,
                              FractureScratch& scratch, const StepMembers& members,
                              const FanWatch& watch, double untested) {
  if (settings.mode == FractureMode::off) return {};
  FractureWork work{body, settings, scratch, watch,
                    element_stress(body.cells, body.mechanics, settings.node_stress)};
  prepare(work, members);
  work.untested = untested;
  work.pieces_before = body.cells.labels.size.size();
  find_fractures(work.report, scratch.node_stress, body.cells, work.elements, settings,
                 Candidates{work});
  forget_released(body.cells.empty_fans);
  if (work.report.not_a_number) return std::move(work.report);
  count_relieved(work);
  if (settings.relax > 0 && !work.queue.empty()) {
    start_relaxing(scratch.relaxed, body.mechanics);
    work.elements.stress = scratch.relaxed.stress;
    work.elements.corner_stress = scratch.relaxed.corner_stress;
  }
  scratch.flanks.clear();
  split_in_order(work);
  work.report.on_flanks = count_flanks(work);
  return std::move(work.report);
}

FanEvent split_planned(BreakableBody body, const PlannedFan& fan, const FractureSettings& settings,
                       ComponentScratch& scratch) {
  FanEvent event = split_fan(body, fan.v, fan.normal, fan.positive, settings, scratch);
  event.stress = fan.stress;
  event.strength = fan.strength;
  // A fan without any face left leaves nothing, not even labels of its crack: it has no event.
  if (!fan.crack.is_none() && !event.faces.empty()) {
    note_crack(body.cells, body.mechanics, fan, event);
  }
  return event;
}

}  // namespace sunder
