// SPDX-License-Identifier: MIT
// Bodies of a part of a step, packed for explicit steps.
#include "mechanics/contact/waves/wave_bodies.hpp"

#include <algorithm>
#include <cmath>

#include "mechanics/state/living.hpp"
#include "mechanics/state/supports.hpp"
#include "mechanics/state/wave_travel.hpp"

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

/// Elements of a body, those of first order by fours.
void add_elements(WaveBodies& waves, const MechanicsState& state, const StepInput& input,
                  WaveBody& body, const std::vector<char>& is_scaled) {
  const Component& component = state.components[body.id.index()];
  const double of_fronts = input.part.viscosity * cell_travel(state, component);
  body.first_block = waves.blocks.size();
  body.first_second = waves.second.size();
  std::size_t lane = 4;
  for (const TetId t : component.tetrahedra) {
    const ElementNodes own = nodes_of(state.elements, input.corners, t);
    const double viscosity = viscosity_of(waves, input, own, of_fronts);
    note_viscosity(waves, own, t, viscosity, is_scaled[t.index()]);
    const ShapeGradient& G = state.elements.shape_gradient[t.index()];
    const double volume = state.elements.rest_volume[t.index()];
    const Lame constants = lame(material_of(state, t));
    if (own.count == 10) {
      SecondOrderElement& element = waves.second.emplace_back();
      element.gradient = G;
      element.volume = volume;
      element.viscosity = viscosity;
      element.lame = constants;
      for (std::size_t a = 0; a < own.count; ++a) {
        element.node[a] = waves.node_of_vertex[own.row[a].index()];
      }
      continue;
    }
    std::array<std::uint32_t, 4> node;
    for (std::size_t a = 0; a < 4; ++a) node[a] = waves.node_of_vertex[own.row[a].index()];
    if (lane == 4) {
      lane = 0;
      waves.blocks.emplace_back();
      // Places that stay empty have no stiffness: their nodes get no force.
      for (std::size_t k = 0; k < 4; ++k) {
        set_element(waves.blocks.back(), k, ShapeGradient::Zero(), Lame{0, 0}, node);
      }
    }
    set_element(waves.blocks.back(), lane, G,
                Lame{volume * constants.lambda, volume * constants.mu}, node);
    waves.blocks.back().viscosity[lane++] = viscosity;
  }
  body.end_block = waves.blocks.size();
  body.end_second = waves.second.size();
}

void add_nodes(WaveBodies& waves, const MechanicsState& state, const StepInput& input,
               const Component& component) {
  WaveNodes& nodes = waves.nodes;
  const VertexColumns& v = state.vertices;
  for (const VertexId id : component.vertices) {
    const std::size_t i = id.index();
    const auto node = static_cast<std::uint32_t>(nodes.size());
    waves.node_of_vertex[i] = node;
    nodes.vertex.push_back(id);
    nodes.mass.push_back(v.mass[i]);
    nodes.inverse_mass.push_back(is_held_whole(state, id) ? 0 : 1 / v.mass[i]);
    nodes.stiffness.push_back(0);
    nodes.damping.push_back(0);
    push(nodes.position, v.position[i]);
    push(nodes.arm, v.rest_position[i] - component.rest_centre);
    Vec3 load = input.loads.gravity, velocity = v.velocity[i];
    if (!input.loads.force.empty()) load += input.loads.force[i] / v.mass[i];
    push(nodes.load, load);
    if (!v.support[i].is_none()) {
      velocity = with_support(state, id, velocity, component.orientation);
      waves.held.push_back({node, held_axes(state, id), velocity});
    }
    push(nodes.velocity, velocity);
  }
}

void add_body(WaveBodies& waves, const MechanicsState& state, const StepInput& input,
              const Component& component) {
  WaveBody body;
  body.id = component.id;
  body.first_node = waves.nodes.size();
  body.first_held = waves.held.size();
  body.mass = component.mass;
  body.mass_damping = input.settings.damping.mass_factor;
  body.supported = component.supported;
  body.frame = {component.centre, component.orientation};
  if (component.supported) body.frame_velocity = component.frame_velocity;
  add_nodes(waves, state, input, component);
  for (const TetId t : component.tetrahedra) {
    add_to_nodes(waves.nodes.stiffness, waves, nodes_of(state.elements, input.corners, t), t, 1);
  }
  body.end_node = waves.nodes.size();
  body.end_held = waves.held.size();
  waves.body_of_component[component.id.index()] = static_cast<std::uint32_t>(waves.bodies.size());
  waves.bodies.push_back(body);
}

}  // namespace

void pack_bodies(WaveBodies& waves, const MechanicsState& state, const StepInput& input) {
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
  for (QuadColumn* column : {&nodes.position, &nodes.velocity, &nodes.arm, &nodes.load}) {
    column->clear();
  }
  for (std::vector<double>* column :
       {&nodes.mass, &nodes.inverse_mass, &nodes.stiffness, &nodes.damping}) {
    column->clear();
  }
  nodes.vertex.clear();
  waves.bodies.clear();
  waves.blocks.clear();
  waves.second.clear();
  waves.held.clear();
  waves.node_of_vertex.assign(state.vertices.size(), WaveBodies::no_node);
  waves.body_of_component.assign(state.components.size(), WaveBodies::no_node);
  waves.gravity = input.loads.gravity;
  waves.measures_work = input.measures_strain;
  waves.has_loads = !input.loads.force.empty();
  for_each_living(state, input.members, [&](const Component& component) {
    if (deforms_in_wave(component)) add_body(waves, state, input, component);
  });
  std::vector<char> is_scaled;
  choose_scaled_cells(waves, is_scaled, state, input);
  for (WaveBody& body : waves.bodies) add_elements(waves, state, input, body, is_scaled);
  nodes.displacement.resize(4 * nodes.size());
  nodes.rate.resize(4 * nodes.size());
  nodes.inner.resize(4 * nodes.size());
  nodes.is_held.assign(nodes.size(), 0);
  for (const HeldNode& held : waves.held) nodes.is_held[held.node] = 1;
}

}  // namespace sunder
