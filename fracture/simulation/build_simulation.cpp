// SPDX-License-Identifier: MIT
// From a scene's settings to its state at the start: one map, one set of columns for all bodies.
#include <fmt/format.h>

#include "fracture/breaking/partners.hpp"
#include "fracture/scene/check_scene.hpp"
#include "fracture/scene/scene_doubts.hpp"
#include "fracture/simulation/integrator_bounds.hpp"
#include "fracture/simulation/rubble/rigid_pieces.hpp"
#include "fracture/simulation/scene_loads.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "fracture/simulation/statics/statics.hpp"
#include "fracture/strength/draw_strength.hpp"
#include "fracture/strength/held_boxes.hpp"
#include "fracture/strength/make_cuts.hpp"
#include "mechanics/element/second_order.hpp"
#include "mechanics/rebuild.hpp"
#include "mechanics/state/living.hpp"
#include "topology/base/sort_unique.hpp"
#include "topology/mesh/build_map.hpp"
#include "topology/mesh/check.hpp"

namespace sunder {
namespace {

void append(std::vector<Finding>& all, std::vector<Finding> more) {
  for (Finding& f : more) all.push_back(std::move(f));
}

/// Everything that settings and meshes get wrong, before anything is built.
std::vector<Finding> check_input(const Scene& scene) {
  std::vector<Finding> findings;
  for (SettingFinding& f : check_scene(scene)) findings.push_back(std::move(f.finding));
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    std::vector<Finding> in_mesh = check_mesh(scene.bodies[b].mesh);
    for (Finding& f : in_mesh) f.text = fmt::format("bodies.{}.mesh: {}", b, f.text);
    append(findings, std::move(in_mesh));
  }
  return findings;
}

/// The bodies' meshes one after the other, and the rows of each body.
TetMesh join_meshes(const std::vector<BodySettings>& bodies, std::vector<BodyRows>& rows) {
  TetMesh all;
  for (const BodySettings& body : bodies) {
    const auto first_point = static_cast<std::uint32_t>(all.points.size());
    const std::size_t first_tetrahedron = all.tetrahedra.size();
    all.points.insert(all.points.end(), body.mesh.points.begin(), body.mesh.points.end());
    for (auto corners : body.mesh.tetrahedra) {
      for (std::uint32_t& c : corners) c += first_point;
      all.tetrahedra.push_back(corners);
    }
    rows.push_back({first_tetrahedron, all.tetrahedra.size(), first_point, all.points.size()});
  }
  return all;
}

Result<MechanicsState> make_columns(const Scene& scene, const std::vector<BodyRows>& bodies,
                                    const VolumeMap& map, const Components& labels) {
  std::vector<Vec3> rest;
  rest.reserve(map.vertices());
  for (std::size_t v = 0; v < map.vertices(); ++v) {
    const Point& p = map.point(VertexId{v});
    rest.emplace_back(p[0], p[1], p[2]);
  }
  std::vector<MaterialId> material(map.tetrahedra());
  std::vector<Material> materials;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const BodyMaterials own = materials_of(scene.bodies[b]);
    for (std::size_t t = bodies[b].first_tetrahedron; t < bodies[b].end_tetrahedron; ++t) {
      material[t] =
          MaterialId{materials.size() + own.of_tetrahedron[t - bodies[b].first_tetrahedron]};
    }
    materials.insert(materials.end(), own.materials.begin(), own.materials.end());
  }
  return make_state({.rest_positions = rest,
                     .corners = map.corners(),
                     .material = material,
                     .component = labels.of_tetrahedron,
                     .materials = materials});
}

/// Nodes of one body, ascending.
std::vector<VertexId> nodes_of_body(const Simulation& sim, std::size_t body) {
  const MechanicsState& m = sim.state->mechanics;
  const BodyRows& rows = sim.bodies[body];
  std::vector<VertexId> nodes;
  for (std::size_t t = rows.first_tetrahedron; t < rows.end_tetrahedron; ++t) {
    const ElementNodes own = nodes_of(m.elements, sim.state->cells.map.corners(), TetId{t});
    nodes.insert(nodes.end(), own.begin(), own.end());
  }
  sort_unique(nodes);
  return nodes;
}

/// Gives the edges of bodies of order 2 their nodes, with columns of their own. Nothing is held
/// yet.
void raise_orders(Simulation& sim) {
  ElementColumns& elements = sim.state->mechanics.elements;
  for (std::size_t b = 0; b < sim.bodies.size(); ++b) {
    if (sim.scene.bodies[b].order != 2) continue;
    const BodyRows& rows = sim.bodies[b];
    raise_order({sim.state->cells, sim.state->mechanics}, TetId{rows.first_tetrahedron},
                TetId{rows.end_tetrahedron});
  }
  if (!elements.edge_nodes.empty()) elements.corner_stress.resize(elements.size());
  for (std::array<Mat3, 4>& stress : elements.corner_stress) stress.fill(Mat3::Zero());
}

/// Places every component of a body, all of them as one rigid body.
void place_body(Simulation& sim, std::size_t body) {
  const BodySettings& settings = sim.scene.bodies[body];
  MechanicsState& m = sim.state->mechanics;
  const BodyRows& rows = sim.bodies[body];
  double mass = 0;
  Vec3 rest_centre = Vec3::Zero();
  std::vector<ComponentId> components;
  for (const Component& c : m.components) {
    if (c.tetrahedra.empty()) continue;
    const std::size_t t = c.tetrahedra.front().index();
    if (t < rows.first_tetrahedron || t >= rows.end_tetrahedron) continue;
    components.push_back(c.id);
    mass += c.mass;
    rest_centre += c.mass * c.rest_centre;
  }
  rest_centre /= mass;
  for (const ComponentId id : components) {
    const Vec3 arm = settings.rotation * (m.components[id.index()].rest_centre - rest_centre);
    place(m, id,
          {.orientation = settings.rotation,
           .translation = settings.translation,
           .velocity = settings.velocity + settings.spin.cross(arm),
           .spin = settings.spin});
  }
}

void start_display(SimulationState& state) {
  for (const Component& c : state.mechanics.components) {
    state.display.push_back({c.centre, c.orientation});
  }
  state.display_target = state.display;
}

/// A library without CGAL has no darts to make (`VolumeMap::set_kernel`).
std::optional<Finding> note_on_kernel(MapKernel wanted, MapKernel taken) {
  if (wanted == taken) return std::nullopt;
  return Finding{.code = "kernel_not_built",
                 .severity = Severity::note,
                 .text =
                     "topology.kernel lcc: this library was built without CGAL, so rows (dense) "
                     "hold the volume mesh; results are the same bytes",
                 .remedy = "give \"kernel\": \"dense\", or build with CGAL"};
}

}  // namespace

Simulation::Simulation() = default;
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

Result<Simulation> build_statics(Scene scene) {
  Result<Simulation> result;
  result.findings = check_input(scene);
  if (has_error(result.findings)) return result;

  std::vector<BodyRows> bodies;
  Result<VolumeMap> map =
      build_map(join_meshes(scene.bodies, bodies), Severity::error, scene.topology.kernel);
  if (!map) {
    append(result.findings, std::move(map.findings));
    return result;
  }
  if (std::optional<Finding> note = note_on_kernel(scene.topology.kernel, map->kernel())) {
    result.findings.push_back(std::move(*note));
  }
  std::vector<char> skin = boundary_of(*map);
  const auto sewn = map->neighbours();
  const std::vector<std::array<HalfFaceId, 4>> uncut(sewn.begin(), sewn.end());
  std::vector<CutFaces> cuts;
  append(result.findings, make_cuts(*map, scene.bodies, bodies, cuts));
  if (has_error(result.findings)) return result;
  const Components labels = label_components(*map);
  Result<MechanicsState> mechanics = make_columns(scene, bodies, *map, labels);
  append(result.findings, std::move(mechanics.findings));
  if (!mechanics) return result;

  Cells cells = make_cells(std::move(*map), *mechanics, std::move(skin));
  if (scene.fracture.crack != CrackMode::paper) label_cuts(cells, cuts);
  if (scene.fracture.crack == CrackMode::cohesive) cells.pieces = {cells.map.dense(), cells.labels};
  draw_strengths(cells, *mechanics, scene.bodies, bodies);
  Simulation sim;
  sim.scene = std::move(scene);
  sim.bodies = std::move(bodies);
  sim.state = Owned(std::make_unique<SimulationState>(
      SimulationState{.cells = std::move(cells), .mechanics = std::move(*mechanics)}));
  sim.scratch = Owned(std::make_unique<SimulationScratch>());
  sim.state->obstacles = sim.scene.obstacles;
  sim.state->contact.partners = partners_of_cuts(sim.state->cells.map, uncut);
  raise_orders(sim);
  for (std::size_t b = 0; b < sim.bodies.size(); ++b) {
    const BodySettings& body = sim.scene.bodies[b];
    hold_vertices(sim.state->mechanics, nodes_of_body(sim, b), body.held, body.rotation);
  }
  append(result.findings, make_scene_loads(sim));
  if (has_error(result.findings)) return result;
  const std::vector<ComponentId> living = living_components(sim.state->mechanics);
  rebuild(sim.state->mechanics, sim.state->cells.map.corners(), living, sim.scratch->mechanics);
  for (std::size_t b = 0; b < sim.bodies.size(); ++b) place_body(sim, b);
  StepReport nothing;
  harden_pieces(nothing, sim);
  start_display(*sim.state);
  append(result.findings,
         check_integrator_bounds(sim.scene, sim.state->mechanics, sim.scratch->mechanics));
  if (has_error(result.findings)) return result;
  for (SettingFinding& f : scene_doubts(sim.scene)) result.findings.push_back(std::move(f.finding));
  if (has_error(result.findings)) return result;
  result.value = std::move(sim);
  return result;
}

Result<Simulation> build_simulation(Scene scene) {
  Result<Simulation> refused;
  for (SettingFinding& f : second_order_findings(scene)) {
    refused.findings.push_back(std::move(f.finding));
  }
  return has_error(refused.findings) ? std::move(refused) : build_statics(std::move(scene));
}

}  // namespace sunder
