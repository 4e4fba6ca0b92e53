// SPDX-License-Identifier: MIT
// Bodies of a part of a step, packed for explicit steps.
#include "mechanics/contact/waves/wave_bodies.hpp"

#include "mechanics/integrators/coefficients.hpp"
#include "mechanics/state/living.hpp"
#include "mechanics/state/supports.hpp"
#include "mechanics/state/wave_travel.hpp"

namespace sunder {
namespace {

void push(QuadColumn& column, const Vec3& value) {
  column.insert(column.end(), {value.x(), value.y(), value.z(), 0.0});
}

void add_stiffness(WaveBodies& waves, const MechanicsState& state, const StepInput& input,
                   TetId t) {
  const ElementNodes own = nodes_of(state.elements, input.corners, t);
  const std::array<double, 10> stiffness = stiffness_of_nodes(
      state.elements.shape_gradient[t.index()], state.elements.rest_volume[t.index()],
      lame(material_of(state, t)), own.count);
  for (std::size_t a = 0; a < own.count; ++a) {
    waves.nodes.stiffness[waves.node_of_vertex[own.row[a].index()]] +=
        waves.coupling[t.index()] * stiffness[a];
  }
}

/// Elements of a component, those of first order by fours.
void add_elements(WaveBodies& waves, const MechanicsState& state, const StepInput& input,
                  const Component& component) {
  std::size_t lane = 4;
  for (const TetId t : component.tetrahedra) {
    add_stiffness(waves, state, input, t);
    const ElementNodes own = nodes_of(state.elements, input.corners, t);
    const ShapeGradient& G = state.elements.shape_gradient[t.index()];
    const double volume = state.elements.rest_volume[t.index()];
    const Lame constants = lame(material_of(state, t));
    if (own.count == 10) {
      SecondOrderElement& element = waves.second.emplace_back();
      element.gradient = G;
      element.volume = volume;
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
    set_element(waves.blocks.back(), lane++, G,
                Lame{volume * constants.lambda, volume * constants.mu}, node);
  }
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
  body.first_block = waves.blocks.size();
  body.first_second = waves.second.size();
  body.first_held = waves.held.size();
  body.mass = component.mass;
  const RayleighDamping damping = wave_damping(input, cell_travel(state, component));
  body.viscosity = damping.stiffness_factor;
  body.mass_damping = damping.mass_factor;
  body.supported = component.supported;
  body.frame = {component.centre, component.orientation};
  if (component.supported) body.frame_velocity = component.frame_velocity;
  add_nodes(waves, state, input, component);
  add_elements(waves, state, input, component);
  body.end_node = waves.nodes.size();
  body.end_block = waves.blocks.size();
  body.end_second = waves.second.size();
  body.end_held = waves.held.size();
  waves.body_of_component[component.id.index()] = static_cast<std::uint32_t>(waves.bodies.size());
  waves.bodies.push_back(body);
}

}  // namespace

void pack_bodies(WaveBodies& waves, const MechanicsState& state, const StepInput& input) {
  const ElementColumns& elements = state.elements;
  for (std::size_t t = waves.coupling.size(); t < elements.size(); ++t) {
    const std::size_t nodes = is_second_order(elements, TetId{t}) ? 10 : 4;
    waves.coupling.push_back(coupling_of(elements.shape_gradient[t], elements.rest_volume[t],
                                         lame(material_of(state, TetId{t})), nodes));
  }
  WaveNodes& nodes = waves.nodes;
  for (QuadColumn* column : {&nodes.position, &nodes.velocity, &nodes.arm, &nodes.load}) {
    column->clear();
  }
  for (std::vector<double>* column : {&nodes.mass, &nodes.inverse_mass, &nodes.stiffness}) {
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
  nodes.argument.resize(4 * nodes.size());
  nodes.inner.resize(4 * nodes.size());
  nodes.is_held.assign(nodes.size(), 0);
  for (const HeldNode& held : waves.held) nodes.is_held[held.node] = 1;
}

}  // namespace sunder
