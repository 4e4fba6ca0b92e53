// SPDX-License-Identifier: MIT
// Solves for equilibrium and modes, and measures them body by body.
#include "fracture/simulation/statics/statics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "fracture/algorithms/find_fractures.hpp"
#include "fracture/algorithms/fracture_plane.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "fracture/strength/held_boxes.hpp"
#include "mechanics/element/energy.hpp"
#include "mechanics/element/second_order.hpp"
#include "mechanics/state/supports.hpp"
#include "mechanics/statics/modes.hpp"
#include "mechanics/statics/static_solve.hpp"

namespace sunder {
namespace {

/// Held vertices to where their velocity takes them by the end of the run.
void displace_held(Simulation& sim) {
  MechanicsState& m = sim.state->mechanics;
  for (std::size_t v = 0; v < m.vertices.size(); ++v) {
    if (m.vertices.support[v].is_none()) continue;
    const PrescribedMotion& motion = m.motions[m.vertices.support[v].index()];
    const Vec3 way = sim.scene.duration * mean_velocity(motion, 0, sim.scene.duration);
    const Component& component = m.components[m.vertices.component[v].index()];
    m.vertices.displacement[v] = component.orientation.conjugate() * way;
  }
}

std::string body_name(const Simulation& sim, std::size_t body) {
  const std::string& name = sim.scene.bodies[body].name;
  return name.empty() ? fmt::format("bodies[{}]", body)
                      : fmt::format("bodies[{}] ({})", body, name);
}

std::size_t body_of(const Simulation& sim, const Component& component) {
  return body_of(sim, component.tetrahedra.front());
}

/// Which body of the scene each vertex belongs to, |V|.
std::vector<std::size_t> body_of_vertices(const Simulation& sim) {
  std::vector<std::size_t> body(sim.state->mechanics.vertices.size());
  for (const Component& component : sim.state->mechanics.components) {
    if (component.tetrahedra.empty()) continue;
    const std::size_t b = body_of(sim, component);
    for (VertexId v : component.vertices) body[v.index()] = b;
  }
  return body;
}

/// Adds to a refusal the name of its body, and that obstacles under the body do not hold it.
void explain(const Simulation& sim, Finding& finding) {
  if (finding.code != "not_supported") return;
  const auto id = static_cast<std::size_t>(finding.ids.front());
  const std::string body = body_name(sim, body_of(sim, sim.state->mechanics.components[id]));
  finding.text = fmt::format(
      "{}: its piece {} has no three held vertices off one line, nor axes held that fix it, so it "
      "has no equilibrium{}",
      body, id,
      sim.scene.obstacles.empty() ? "" : "; obstacles that carry a body are not supports here");
  finding.remedy =
      "hold a face of it: \"held\": [{\"minimum\": [...], \"maximum\": [...]}] in the "
      "body; for what rests on an obstacle let `sunder run` settle with damping";
}

std::vector<Finding> notes(const Simulation& sim) {
  std::vector<Finding> findings;
  for (std::size_t b = 0; b < sim.bodies.size(); ++b) {
    const BodySettings& body = sim.scene.bodies[b];
    if (body.velocity.isZero(0) && body.spin.isZero(0)) continue;
    findings.push_back({.code = "velocity_ignored",
                        .severity = Severity::note,
                        .text = body_name(sim, b) + ": its velocity and spin have no part in an "
                                                    "equilibrium",
                        .remedy = "leave them out, or use `sunder run`"});
  }
  return findings;
}

/// Of the breaking strain: stresses of a static answer are read as numbers.
constexpr double allowed_false_strain = 0.1;

void check_turn(const Simulation& sim, const Component& component, std::vector<Finding>& findings) {
  const Material& material = sim.scene.bodies[body_of(sim, component)].material;
  const double turn = component.largest_turn;
  const double valid = largest_valid_turn(material, allowed_false_strain);
  if (!(turn > valid)) return;
  findings.push_back(
      {.code = "turned_too_far",
       .severity = Severity::warning,
       .ids = {static_cast<std::int64_t>(component.id.value)},
       .text =
           fmt::format("{}: parts have turned by {:.3g} rad; the linear model is good to {:.3g}",
                       body_name(sim, body_of(sim, component)), turn, valid),
       .remedy =
           "read the answer as that of linear theory; take a smaller load or a stiffer body"});
}

/// Measures one body after another.
class Survey {
 public:
  Survey(const Simulation& sim, const Loads& loads, std::span<const Vec3> missing,
         std::span<const Mat3> node_stress)
      : sim_(sim), loads_(loads), missing_(missing), stress_(node_stress) {}

  BodyEquilibrium of(std::size_t body) {
    const BodyRows& rows = sim_.bodies[body];
    BodyEquilibrium answer;
    answer.name = sim_.scene.bodies[body].name;
    answer.tetrahedra = rows.end_tetrahedron - rows.first_tetrahedron;
    answer.supports.resize(sim_.scene.bodies[body].held.size());
    const MechanicsState& m = sim_.state->mechanics;
    for (std::size_t t = rows.first_tetrahedron; t < rows.end_tetrahedron; ++t) {
      answer.strain_energy += element_strain_energy(m, TetId{t});
      answer.mass += sim_.state->mechanics.elements.mass[t];
    }
    const Vec3 centre = mass_centre(body);
    for (std::size_t v = 0; v < body_of_.size(); ++v) {
      if (body_of_[v] != body) continue;
      ++answer.nodes;
      if (!sim_.state->cells.map.is_node(VertexId{v})) {
        ++answer.vertices;
        see_vertex(answer, v);
      }
      add_node(answer, v, centre);
    }
    return answer;
  }

 private:
  Vec3 undeformed(std::size_t v) const {
    const VertexColumns& vertices = sim_.state->mechanics.vertices;
    const Component& c = sim_.state->mechanics.components[vertices.component[v].index()];
    return c.centre + c.orientation * (vertices.rest_position[v] - c.rest_centre);
  }

  Vec3 mass_centre(std::size_t body) const {
    Vec3 sum = Vec3::Zero();
    double mass = 0;
    for (std::size_t v = 0; v < body_of_.size(); ++v) {
      if (body_of_[v] != body) continue;
      mass += sim_.state->mechanics.vertices.mass[v];
      sum += sim_.state->mechanics.vertices.mass[v] * undeformed(v);
    }
    return sum / mass;
  }

  void see(Extreme& largest, double value, std::size_t v, const BodyEquilibrium& answer) const {
    // Of equal values the first stands; the first of all stands in any case.
    if (answer.vertices > 1 && !(value > largest.value)) return;
    const std::uint32_t point = sim_.state->cells.map.point_of_vertex(VertexId{v});
    largest = {value, point - sim_.bodies[body_of_[v]].first_point, undeformed(v)};
  }

  void see_vertex(BodyEquilibrium& answer, std::size_t v) const {
    const double stress = principal_tension(stress_[v]).value;
    see(answer.displacement, sim_.state->mechanics.vertices.displacement[v].norm(), v, answer);
    see(answer.principal_stress, stress, v, answer);
    see(answer.strength_share, stress / sim_.state->cells.strength[v], v, answer);
  }

  void add_node(BodyEquilibrium& answer, std::size_t v, const Vec3& centre) const {
    const MechanicsState& m = sim_.state->mechanics;
    answer.load += m.vertices.mass[v] * loads_.gravity;
    if (!loads_.force.empty()) answer.load += loads_.force[v];
    const BodySettings& settings = sim_.scene.bodies[body_of_[v]];
    const Holders holders = holders_of(settings.held, m.vertices.rest_position[v]);
    const Vec3 own = settings.rotation.conjugate() * missing_[v];
    answer.residual = std::max(answer.residual, free_part(m, VertexId{v}, own).norm());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (holders[axis] == no_holder) continue;
      SupportReaction& support = answer.supports[holders[axis]];
      const auto first = std::ranges::find(holders, holders[axis]) - holders.begin();
      support.vertices += first == std::ptrdiff_t(axis);
      const auto row = static_cast<Eigen::Index>(axis);
      const Vec3 force = settings.rotation * Vec3(own[row] * Vec3::Unit(row));
      support.force += force;
      support.moment += (undeformed(v) - centre).cross(force);
    }
  }

  const Simulation& sim_;
  const Loads& loads_;
  std::span<const Vec3> missing_;
  std::span<const Mat3> stress_;
  std::vector<std::size_t> body_of_ = body_of_vertices(sim_);
};

Loads full_loads(const Simulation& sim) {
  Loads loads{.gravity = sim.scene.gravity.acceleration};
  if (!sim.state->loads.empty()) {
    add_corner_loads(loads.force, sim.state->loads, sim.state->mechanics,
                     sim.state->cells.map.corners(), std::numeric_limits<double>::infinity());
  }
  if (!sim.state->mechanics.elements.edge_nodes.empty()) {
    add_consistent_weight(loads.force, sim.state->mechanics, sim.state->cells.map.corners(),
                          loads.gravity);
  }
  return loads;
}

bool is_finite(const BodyEquilibrium& body) {
  bool finite = std::isfinite(body.displacement.value) && std::isfinite(body.strain_energy) &&
                std::isfinite(body.principal_stress.value) && std::isfinite(body.residual) &&
                body.load.allFinite();
  for (const SupportReaction& s : body.supports) finite = finite && s.force.allFinite();
  return finite;
}

Finding not_a_number(const Simulation& sim) {
  return {.code = "not_a_number",
          .text = fmt::format("{}: the equilibrium is not a finite number", sim.scene.name),
          .remedy = "look for loads, stiffnesses or sizes that are far too large"};
}

}  // namespace

Result<Equilibrium> solve_scene(Simulation& sim) {
  Result<Equilibrium> result;
  result.findings = notes(sim);
  displace_held(sim);
  const Loads loads = full_loads(sim);
  MechanicsState& m = sim.state->mechanics;
  const auto corners = sim.state->cells.map.corners();
  std::vector<Finding> refused = solve_static(m, sim.scratch->mechanics, corners, loads);
  for (Finding& f : refused) {
    explain(sim, f);
    result.findings.push_back(std::move(f));
  }
  if (!refused.empty()) return result;
  Equilibrium answer{{}, node_stress_of(sim.state->cells, m, sim.scene.fracture.node_stress)};
  const bool finite =
      std::ranges::all_of(answer.node_stress, [](const Mat3& s) { return s.allFinite(); });
  if (finite) {
    const std::vector<Vec3> missing = support_forces(sim.scratch->mechanics, m, corners, loads);
    Survey survey(sim, loads, missing, answer.node_stress);
    for (std::size_t b = 0; b < sim.bodies.size(); ++b) answer.bodies.push_back(survey.of(b));
  }
  if (!finite || !std::ranges::all_of(answer.bodies, is_finite)) {
    result.findings.push_back(not_a_number(sim));
    return result;
  }
  for (const Component& component : m.components) {
    if (!component.tetrahedra.empty()) check_turn(sim, component, result.findings);
  }
  result.value = std::move(answer);
  return result;
}

Result<std::vector<PieceModes>> scene_modes(Simulation& sim, std::size_t count) {
  MechanicsState& m = sim.state->mechanics;
  std::vector<PieceModes> pieces;
  for (const Component& component : m.components) {
    if (component.tetrahedra.empty()) continue;
    Result<Modes> modes = natural_modes(m, sim.state->cells.map.corners(), component.id, count);
    if (!modes) return std::move(modes.findings.front());
    PieceModes& piece = pieces.emplace_back();
    piece.component = component.id;
    piece.body = body_of(sim, component);
    piece.rigid = modes->rigid;
    piece.frequency = std::move(modes->frequency);
    piece.vertex = component.vertices;
    for (const auto& mode : modes->shape.colwise()) {
      std::vector<Vec3>& shape = piece.shape.emplace_back();
      for (Eigen::Index i = 0; i < mode.size(); i += 3) shape.push_back(mode.segment<3>(i));
    }
  }
  return pieces;
}

}  // namespace sunder
