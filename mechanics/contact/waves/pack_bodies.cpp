// SPDX-License-Identifier: MIT
// Bodies of a part of a step, packed for explicit steps.
#include "mechanics/contact/waves/wave_bodies.hpp"

#include <algorithm>
#include <cmath>

#include "mechanics/contact/waves/longest_step.hpp"
#include "mechanics/state/living.hpp"
#include "mechanics/state/supports.hpp"

namespace sunder {
namespace {

void push(QuadColumn& column, const Vec3& value) {
  column.insert(column.end(), {value.x(), value.y(), value.z(), 0.0});
}

/// Share of critical damping that the viscosity of wave fronts reaches at most, in the fastest
/// motion that the elements around a node allow: bad cells would set a far shorter step else.
constexpr double largest_damping = 0.5;

/// Adds the stiffness of an element, times a factor, to a sum at its nodes.
void add_to_nodes(std::vector<double>& sum, const WaveBodies& waves, const ElementNodes& own,
                  TetId t, double factor) {
  for (std::size_t a = 0; a < own.count; ++a) {
    sum[waves.node_of_vertex[own.row[a].index()]] += factor * waves.stiffness[t.index()][a];
  }
}

/// s: the viscosity of an element, the user's and that of wave fronts (`StepPart::viscosity`).
double viscosity_of(const WaveBodies& waves, const StepInput& input, const ElementNodes& own,
                    double of_fronts) {
  for (std::size_t a = 0; a < own.count; ++a) {
    const std::uint32_t node = waves.node_of_vertex[own.row[a].index()];
    const double squared = waves.nodes.stiffness[node] * waves.nodes.inverse_mass[node];
    of_fronts = std::min(of_fronts, 2 * largest_damping / std::sqrt(squared));
  }
  return input.settings.damping.stiffness_factor + of_fronts;
}

/// Notes the viscosity of a cell: at its nodes, or in its cluster where it is scaled.
void note_viscosity(WaveBodies& waves, const ElementNodes& own, TetId t, double viscosity,
                    bool is_scaled) {
  if (!is_scaled) return add_to_nodes(waves.nodes.damping, waves, own, t, viscosity);
  const std::uint32_t node = waves.node_of_vertex[own.row[0].index()];
  waves.nodes.scaled[waves.nodes.cluster[node]].viscosity.push_back(viscosity);
}

/// Puts an element into the next free place of the last block, or of a new one.
template <std::size_t count>
void add_element(BlockColumn<count>& blocks, std::size_t place, const WaveBodies& waves,
                 const ElementNodes& own, const ShapeGradient& gradient, const Lame& scaled,
                 double viscosity) {
  std::array<std::uint32_t, count> node;
  for (std::size_t a = 0; a < count; ++a) node[a] = waves.node_of_vertex[own.row[a].index()];
  const std::size_t lane = place % 4;
  if (lane == 0) {
    blocks.emplace_back();
    // Places that stay empty have no stiffness: their nodes get no force.
    for (std::size_t k = 0; k < 4; ++k) {
      set_element(blocks.back(), k, ShapeGradient::Zero(), Lame{0, 0}, node);
    }
  }
  set_element(blocks.back(), lane, gradient, scaled, node);
  blocks.back().viscosity[lane] = viscosity;
}

/// Elements of a body, by fours.
void add_elements(WaveBodies& waves, const MechanicsState& state, const StepInput& input,
                  WaveBody& body) {
  const Component& component = state.components[body.id.index()];
  const double of_fronts = input.part.viscosity * component.cell_travel;
  body.first_block = waves.blocks.size();
  body.first_second = waves.second.size();
  std::size_t place = 0;
  for (const TetId t : component.tetrahedra) {
    const ElementNodes own = nodes_of(state.elements, input.corners, t);
    const double viscosity = viscosity_of(waves, input, own, of_fronts);
    note_viscosity(waves, own, t, viscosity, waves.is_scaled[t.index()]);
    const ShapeGradient& G = state.elements.shape_gradient[t.index()];
    const double volume = state.elements.rest_volume[t.index()];
    const Lame constants = lame(material_of(state, t));
    const Lame scaled{volume * constants.lambda, volume * constants.mu};
    if (own.count == 10) {
      add_element(waves.second, place++, waves, own, G, scaled, viscosity);
    } else {
      add_element(waves.blocks, place++, waves, own, G, scaled, viscosity);
    }
  }
  body.end_block = waves.blocks.size();
  body.end_second = waves.second.size();
}

/// kg^-1: 0 where a node is held whole.
double inverse_mass_of(const MechanicsState& state, VertexId v) {
  return is_held_whole(state, v) ? 0 : 1 / state.vertices.mass[v.index()];
}

/// The nodes and elements of a body. Each part reads their motion (`read_motion`).
void add_body(WaveBodies& waves, const MechanicsState& state, const StepInput& input,
              const Component& component) {
  WaveNodes& nodes = waves.nodes;
  const VertexColumns& v = state.vertices;
  WaveBody body;
  body.id = component.id;
  body.mass = component.mass;
  body.mass_damping = input.settings.damping.mass_factor;
  body.supported = component.supported;
  body.first_node = nodes.size();
  body.first_held = waves.held.size();
  for (const VertexId id : component.vertices) {
    const std::size_t i = id.index();
    const auto node = static_cast<std::uint32_t>(nodes.size());
    waves.node_of_vertex[i] = node;
    nodes.vertex.push_back(id);
    nodes.mass.push_back(v.mass[i]);
    nodes.inverse_mass.push_back(inverse_mass_of(state, id));
    push(nodes.arm, v.rest_position[i] - component.rest_centre);
    if (!v.support[i].is_none()) waves.held.push_back({node, held_axes(state, id), Vec3::Zero()});
  }
  body.end_node = nodes.size();
  body.end_held = waves.held.size();
  nodes.stiffness.resize(nodes.size(), 0);
  nodes.damping.resize(nodes.size(), 0);
  for (const TetId t : component.tetrahedra) {
    add_to_nodes(nodes.stiffness, waves, nodes_of(state.elements, input.corners, t), t, 1);
  }
  body.first_cell = waves.cells.size();
  waves.cells.insert(waves.cells.end(), component.tetrahedra.begin(), component.tetrahedra.end());
  body.end_cell = waves.cells.size();
  waves.body_of_component[component.id.index()] = static_cast<std::uint32_t>(waves.bodies.size());
  waves.bodies.push_back(body);
}

/// Frame, places, velocities and loads of a body as the part begins; no work yet.
void read_motion(WaveBodies& waves, WaveBody& body, const MechanicsState& state,
                 const StepInput& input) {
  WaveNodes& nodes = waves.nodes;
  const VertexColumns& v = state.vertices;
  const Component& component = state.components[body.id.index()];
  body.frame = {component.centre, component.orientation};
  if (component.supported) body.frame_velocity = component.frame_velocity;
  body.weight_place.setZero();
  body.loads.setZero();
  body.kicked = {};
  body.work = {};
  for (std::size_t node = body.first_node; node < body.end_node; ++node) {
    const std::size_t i = nodes.vertex[node].index();
    row_of(nodes.position, node) = v.position[i];
    row_of(nodes.velocity, node) = v.velocity[i];
    Vec3 load = input.loads.gravity;
    if (!input.loads.force.empty()) load += input.loads.force[i] / v.mass[i];
    row_of(nodes.load, node) = load;
  }
  for (std::size_t k = body.first_held; k < body.end_held; ++k) {
    HeldNode& held = waves.held[k];
    auto velocity = row_of(nodes.velocity, held.node);
    velocity = with_support(state, nodes.vertex[held.node], velocity, component.orientation);
    held.velocity = velocity;
  }
}

/// Node `a` of an element of a body, by its place among the body's elements.
std::uint32_t packed_node(const WaveBodies& waves, const WaveBody& body, std::size_t element,
                          std::size_t a) {
  const std::size_t block = element / 4, lane = element % 4;
  if (body.first_second < body.end_second) {
    return waves.second[body.first_second + block].node[a][lane];
  }
  return waves.blocks[body.first_block + block].node[a][lane];
}

/// Whether a body consists of the same nodes and elements as when it was packed.
bool is_packed(const WaveBodies& waves, const WaveBody& body, const MechanicsState& state,
               const StepInput& input) {
  const WaveNodes& nodes = waves.nodes;
  const Component& component = state.components[body.id.index()];
  const auto cells = std::span(waves.cells).subspan(body.first_cell);
  if (body.supported != component.supported || body.mass != component.mass ||
      body.end_node - body.first_node != component.vertices.size() ||
      body.end_cell - body.first_cell != component.tetrahedra.size()) {
    return false;
  }
  for (std::size_t k = 0; k < component.vertices.size(); ++k) {
    const VertexId v = component.vertices[k];
    const std::size_t node = body.first_node + k;
    if (nodes.vertex[node] != v || nodes.mass[node] != state.vertices.mass[v.index()] ||
        nodes.inverse_mass[node] != inverse_mass_of(state, v)) {
      return false;
    }
  }
  for (std::size_t k = 0; k < component.tetrahedra.size(); ++k) {
    const TetId t = component.tetrahedra[k];
    if (cells[k] != t) return false;
    const ElementNodes own = nodes_of(state.elements, input.corners, t);
    for (std::size_t a = 0; a < own.count; ++a) {
      if (nodes.vertex[packed_node(waves, body, k, a)] != own.row[a]) return false;
    }
  }
  return true;
}

/// Whether all bodies are packed as the part needs them.
bool are_packed(const WaveBodies& waves, const MechanicsState& state, const StepInput& input) {
  if (waves.damping.mass_factor != input.settings.damping.mass_factor ||
      waves.damping.stiffness_factor != input.settings.damping.stiffness_factor ||
      waves.of_fronts != input.part.viscosity) {
    return false;
  }
  std::size_t next = 0;
  bool same = true;
  for_each_living(state, input.members, [&](const Component& c) {
    if (!same || !deforms_in_wave(c)) return;
    same = next < waves.bodies.size() && waves.bodies[next].id == c.id &&
           is_packed(waves, waves.bodies[next], state, input);
    ++next;
  });
  return same && next == waves.bodies.size();
}

/// Packs the members that deform. Some microseconds for each tetrahedron that is met for the first
/// time.
void pack(WaveBodies& waves, const MechanicsState& state, const StepInput& input) {
  const ElementColumns& elements = state.elements;
  for (std::size_t t = waves.stiffness.size(); t < elements.size(); ++t) {
    const std::size_t nodes = is_second_order(elements, TetId{t}) ? 10 : 4;
    const ShapeGradient& G = elements.shape_gradient[t];
    const double volume = elements.rest_volume[t];
    const Lame constants = lame(material_of(state, TetId{t}));
    const double coupling = coupling_of(G, volume, constants, nodes);
    waves.stiffness.push_back(stiffness_of_nodes(G, volume, constants, nodes));
    for (double& k : waves.stiffness.back()) k *= coupling;
  }
  WaveNodes& nodes = waves.nodes;
  for (std::vector<double>* column :
       {&nodes.mass, &nodes.inverse_mass, &nodes.stiffness, &nodes.damping}) {
    column->clear();
  }
  nodes.arm.clear();
  nodes.vertex.clear();
  waves.bodies.clear();
  waves.cells.clear();
  waves.blocks.clear();
  waves.second.clear();
  waves.held.clear();
  waves.node_of_vertex.assign(state.vertices.size(), WaveBodies::no_node);
  waves.body_of_component.assign(state.components.size(), WaveBodies::no_node);
  waves.damping = input.settings.damping;
  waves.of_fronts = input.part.viscosity;
  for_each_living(state, input.members, [&](const Component& component) {
    if (deforms_in_wave(component)) add_body(waves, state, input, component);
  });
  choose_scaled_cells(waves, waves.is_scaled, state, input);
  for (WaveBody& body : waves.bodies) add_elements(waves, state, input, body);
  for (QuadColumn* column : {&nodes.position, &nodes.velocity, &nodes.load, &nodes.displacement,
                             &nodes.rate, &nodes.inner}) {
    column->assign(4 * nodes.size(), 0);
  }
  nodes.is_held.assign(nodes.size(), 0);
  for (const HeldNode& held : waves.held) nodes.is_held[held.node] = 1;
  waves.longest_step = longest_step(waves);
}

}  // namespace

void pack_bodies(WaveBodies& waves, const MechanicsState& state, const StepInput& input) {
  waves.gravity = input.loads.gravity;
  waves.measures_work = input.measures_strain;
  waves.has_loads = !input.loads.force.empty();
  if (!are_packed(waves, state, input)) pack(waves, state, input);
  // Vertices and components may have come that no packed body has.
  waves.node_of_vertex.resize(state.vertices.size(), WaveBodies::no_node);
  waves.body_of_component.resize(state.components.size(), WaveBodies::no_node);
  for (WaveBody& body : waves.bodies) read_motion(waves, body, state, input);
}

}  // namespace sunder
