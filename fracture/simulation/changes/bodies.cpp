// SPDX-License-Identifier: MIT
// A body alone is built as a scene of its own; its rows then join the others.
#include "fracture/simulation/changes/bodies.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "fracture/scene/overlaps.hpp"
#include "fracture/simulation/changes/state_rows.hpp"
#include "fracture/simulation/ledger/momentum_ledger.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "fracture/strength/draw_strength.hpp"
#include "mechanics/element/energy.hpp"

namespace sunder {
namespace {

std::optional<Finding> refused_for_replay(const Simulation& simulation) {
  if (!simulation.state->script) return std::nullopt;
  return Finding{.code = "is_replay",
                 .text = "the fans of this simulation are those of an earlier run, with its bodies",
                 .remedy = "change the bodies of a simulation of its own"};
}

bool is_of(const BodyRows& rows, const Component& c) {
  if (c.tetrahedra.empty()) return false;
  const std::size_t t = c.tetrahedra.front().index();
  return t >= rows.first_tetrahedron && t < rows.end_tetrahedron;
}

BodyChange measured(const Simulation& sim, std::size_t body) {
  BodyChange change{.body = body};
  const MechanicsState& m = sim.state->mechanics;
  for (const Component& c : m.components) {
    if (!is_of(sim.bodies[body], c)) continue;
    change.pieces.push_back(c.id);
    for (const VertexId v : c.vertices) {
      const std::size_t i = v.index();
      const Vec3 momentum = m.vertices.mass[i] * m.vertices.velocity[i];
      change.mass += m.vertices.mass[i];
      change.kinetic += 0.5 * momentum.dot(m.vertices.velocity[i]);
      change.momentum += impulse_at(m.vertices.position[i], momentum);
    }
    for (const TetId t : c.tetrahedra) change.strain += element_strain_energy(m, t);
  }
  return change;
}

/// All pieces as they are now, as one body at rest where its mesh is.
BodySettings pieces_as_body(const SimulationState& s) {
  BodySettings all;
  for (const Vec3& x : s.mechanics.vertices.position) all.mesh.points.push_back({x[0], x[1], x[2]});
  for (const Corners& corners : s.cells.map.corners()) {
    all.mesh.tetrahedra.push_back(
        {corners[0].value, corners[1].value, corners[2].value, corners[3].value});
  }
  return all;
}

/// A warning where the new body lies in pieces of others.
void look_for_overlap(std::vector<Finding>& findings, const Simulation& sim,
                      const BodySettings& body) {
  Scene pair;
  pair.bodies = {pieces_as_body(*sim.state), body};
  const std::vector<BodyMeasures> measures = {measure(pair.bodies[0]), measure(pair.bodies[1])};
  const double allowed = sim.scene.contact.allowed_penetration;
  for (const Overlap& overlap : overlaps_at_start(pair, measures, allowed)) {
    findings.push_back(
        {.code = "overlap_with_pieces",
         .severity = Severity::warning,
         .text = fmt::format("the body is put {:.3g} m deep into pieces: they are pushed apart at "
                             "contact.push_out_speed ({:.3g} m/s) at most",
                             overlap.depth, sim.scene.contact.push_out_speed),
         .remedy = "add it where there is room"});
  }
}

/// Random strengths depend on the body's row: drawn alone it would have those of the first.
void draw_by_row(Simulation& alone, std::size_t row) {
  if (!alone.scene.bodies.front().strength.weibull) return;
  std::vector<BodySettings> bodies(row);
  std::vector<BodyRows> rows(row);
  bodies.push_back(alone.scene.bodies.front());
  rows.push_back(alone.bodies.front());
  draw_strengths(alone.state->cells, alone.state->mechanics, bodies, rows);
}

Result<Simulation> built_alone(const Simulation& sim, BodySettings body) {
  Scene scene = sim.scene;
  scene.bodies.clear();
  scene.bodies.push_back(std::move(body));
  scene.obstacles = sim.state->obstacles;
  scene.topology.kernel = MapKernel::dense;
  Result<Simulation> alone = build_simulation(std::move(scene));
  if (alone) draw_by_row(*alone, sim.bodies.size());
  return alone;
}

std::uint32_t loads_of(const Scene& scene) {
  std::size_t count = 0;
  for (const BodySettings& body : scene.bodies) count += body.loads.size();
  return static_cast<std::uint32_t>(count);
}

/// Pieces at rest could hang in the air once a body is gone.
void wake_all(SimulationState& s) {
  for (Component& c : s.mechanics.components) {
    if (c.rung == Rung::asleep) c.rung = Rung::full;
  }
  std::ranges::fill(s.ladder.still, 0.0);
}

/// The rows of all bodies after those of one were dropped.
void close_rows(std::vector<BodyRows>& bodies, std::size_t body) {
  const BodyRows gone = bodies[body];
  bodies[body].end_tetrahedron = gone.first_tetrahedron;
  bodies[body].end_point = gone.first_point;
  for (std::size_t b = body + 1; b < bodies.size(); ++b) {
    bodies[b].first_tetrahedron -= gone.end_tetrahedron - gone.first_tetrahedron;
    bodies[b].end_tetrahedron -= gone.end_tetrahedron - gone.first_tetrahedron;
    bodies[b].first_point -= gone.end_point - gone.first_point;
    bodies[b].end_point -= gone.end_point - gone.first_point;
  }
}

}  // namespace

Result<BodyChange> add_body(Simulation& sim, BodySettings body) {
  SimulationState& s = *sim.state;
  if (std::optional<Finding> refused = refused_for_replay(sim)) return *refused;
  if (!s.mechanics.elements.edge_nodes.empty()) {
    return Finding{.code = "nodes_of_edges",
                   .text = "a body of order 2 is there: no body can be added behind its nodes",
                   .remedy = "remove it first, or give all bodies with the scene"};
  }
  Result<BodyChange> result;
  Result<Simulation> alone = built_alone(sim, std::move(body));
  result.findings = std::move(alone.findings);
  if (!alone) return result;
  look_for_overlap(result.findings, sim, alone->scene.bodies.front());

  const std::size_t components = s.mechanics.components.size();
  const std::size_t tetrahedra = s.cells.map.tetrahedra(), points = s.cells.map.points().size();
  for (CornerLoad& load : alone->state->loads) load.load += loads_of(sim.scene);
  const BodyRows own = alone->bodies.front();
  append_state(s, std::move(*alone->state));
  if (s.step > 0) {
    s.birth_step.resize(components, 0);
    s.birth_step.resize(s.mechanics.components.size(), s.step);
    s.pieces_before += s.mechanics.components.size() - components;
  }
  sim.bodies.push_back(
      {tetrahedra, tetrahedra + own.end_tetrahedron, points, points + own.end_point});
  sim.scene.bodies.push_back(std::move(alone->scene.bodies.front()));
  *sim.scratch = SimulationScratch{};
  result.value = measured(sim, sim.bodies.size() - 1);
  return result;
}

Result<BodyChange> remove_body(Simulation& sim, std::size_t body) {
  SimulationState& s = *sim.state;
  if (std::optional<Finding> refused = refused_for_replay(sim)) return *refused;
  const auto is_there = [](const BodyRows& b) { return b.first_tetrahedron < b.end_tetrahedron; };
  if (body >= sim.bodies.size() || !is_there(sim.bodies[body])) {
    return Finding{
        .code = "no_such_body",
        .ids = {static_cast<std::int64_t>(body)},
        .text = fmt::format("there is no body {}", body),
        .remedy = fmt::format("give the row of a body that is there, below {}", sim.bodies.size())};
  }
  if (std::ranges::count_if(sim.bodies, is_there) == 1) {
    return Finding{.code = "last_body",
                   .text = "a simulation keeps one body at least",
                   .remedy = "add another one first, or end the simulation"};
  }
  BodyChange change = measured(sim, body);
  std::vector<char> dropped(s.mechanics.components.size(), 0);
  for (const ComponentId id : change.pieces) dropped[id.index()] = 1;
  const BodyRows& rows = sim.bodies[body];
  std::vector<char> points(sim.bodies.back().end_point, 1);
  std::fill(points.begin() + static_cast<std::ptrdiff_t>(rows.first_point),
            points.begin() + static_cast<std::ptrdiff_t>(rows.end_point), char{0});
  const Renumbering by = drop_components(s, dropped, std::move(points));
  if (sim.spring) {
    sim.spring->vertex = by.of(sim.spring->vertex);
    if (sim.spring->vertex.is_none()) sim.spring.reset();
  }
  close_rows(sim.bodies, body);
  sim.scene.bodies[body].mesh = {};
  sim.scene.bodies[body].strength.painted = {};
  wake_all(s);
  *sim.scratch = SimulationScratch{};
  return change;
}

}  // namespace sunder
