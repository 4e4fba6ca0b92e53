// SPDX-License-Identifier: MIT
// Components after a split or a change of supports: members, masses, frames; and placing them.
#include "mechanics/rebuild.hpp"

#include <algorithm>

#include "mechanics/element/elastic_force.hpp"
#include "mechanics/element/second_order.hpp"
#include "mechanics/frame/fit_motion.hpp"
#include "mechanics/integrators/baseline_system.hpp"
#include "mechanics/integrators/scratch.hpp"
#include "mechanics/solver/component_system.hpp"
#include "mechanics/state/dense_solve.hpp"
#include "mechanics/state/supports.hpp"
#include "mechanics/state/wave_travel.hpp"
#include "topology/base/assert.hpp"

namespace sunder {
namespace {

/// Values of the old component that a piece remembers.
struct Parent {
  bool supported = false;
  Vec3 rest_centre = Vec3::Zero();
  Pose frame;
};

/// The parents of `touched`, before anything is overwritten. `rows` of `vertices.component` are
/// still those of before the split.
std::vector<Parent> remember_parents(const MechanicsState& state,
                                     std::span<const std::vector<TetId>> members,
                                     std::span<const Corners> corners) {
  std::vector<Parent> parents(members.size());
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (members[i].empty()) continue;
    const VertexId v = corners[members[i].front().index()][0];
    const ComponentId old = state.vertices.component[v.index()];
    if (old.is_none() || old.index() >= state.components.size()) continue;
    const Component& parent = state.components[old.index()];
    parents[i] = {parent.supported, parent.rest_centre, {parent.centre, parent.orientation}};
  }
  return parents;
}

/// Tetrahedra of each touched component, ascending.
std::vector<std::vector<TetId>> gather_members(const ElementColumns& elements,
                                               std::span<const ComponentId> touched,
                                               std::size_t component_count) {
  constexpr std::size_t untouched = static_cast<std::size_t>(-1);
  std::vector<std::size_t> place(component_count, untouched);
  for (std::size_t i = 0; i < touched.size(); ++i) place[touched[i].index()] = i;
  std::vector<std::vector<TetId>> members(touched.size());
  for (std::size_t t = 0; t < elements.size(); ++t) {
    const std::size_t id = elements.component[t].index();
    if (id < component_count && place[id] != untouched) members[place[id]].push_back(TetId{t});
  }
  return members;
}

/// Vertices, masses and other values that follow from rest positions. Shares of masses are added in
/// the order of tetrahedra, so that a vertex with an unchanged star keeps its mass to the bit.
void set_members(MechanicsState& state, Component& component, std::vector<TetId> tetrahedra,
                 std::span<const Corners> corners) {
  VertexColumns& vertices = state.vertices;
  component.tetrahedra = std::move(tetrahedra);
  component.vertices.clear();
  for (TetId t : component.tetrahedra) {
    for (VertexId v : nodes_of(state.elements, corners, t)) component.vertices.push_back(v);
  }
  std::sort(component.vertices.begin(), component.vertices.end());
  component.vertices.erase(std::unique(component.vertices.begin(), component.vertices.end()),
                           component.vertices.end());
  for (VertexId v : component.vertices) {
    vertices.mass[v.index()] = 0;
    vertices.component[v.index()] = component.id;
  }
  for (TetId t : component.tetrahedra) {
    const ElementNodes nodes = nodes_of(state.elements, corners, t);
    for (std::size_t k = 0; k < nodes.count; ++k) {
      vertices.mass[nodes.row[k].index()] +=
          node_share(nodes.count, k) * state.elements.mass[t.index()];
    }
  }
  component.mass = 0;
  component.rest_centre.setZero();
  for (VertexId v : component.vertices) {
    component.mass += vertices.mass[v.index()];
    component.rest_centre += vertices.mass[v.index()] * vertices.rest_position[v.index()];
  }
  component.rest_centre /= component.mass;
  component.rest_radius = 0;
  for (VertexId v : component.vertices) {
    component.rest_radius = std::max(
        component.rest_radius, (vertices.rest_position[v.index()] - component.rest_centre).norm());
  }
  component.cell_travel = component.tetrahedra.empty() ? 0 : mean_cell_travel(state, component);
  component.rest_inertia = rest_shape(vertices, component.vertices, component.rest_centre).inertia;
}

/// Whether the component is held, and by which motion. Held vertices take the velocity of their
/// motion. Needs: orientation.
void set_supports(MechanicsState& state, Component& component) {
  MotionId lowest = MotionId::none();
  component.partly_held = false;
  for (VertexId v : component.vertices) {
    const MotionId motion = state.vertices.support[v.index()];
    if (motion.is_none()) continue;
    SUNDER_ASSERT(motion.index() < state.motions.size(), "rebuild: a support without a motion");
    Vec3& velocity = state.vertices.velocity[v.index()];
    velocity = with_support(state, v, velocity, component.orientation);
    Vec3& acceleration = state.vertices.displacement_acceleration[v.index()];
    acceleration = free_part(state, v, acceleration);
    component.partly_held = component.partly_held || !is_held_whole(state, v);
    if (lowest.is_none() || motion < lowest) lowest = motion;
  }
  component.supported = !lowest.is_none();
  component.frame_velocity =
      component.supported ? state.motions[lowest.index()].velocity : Vec3::Zero();
  component.rigid = !component.supported && component.tetrahedra.size() == 1;
}

void adopt_motion(Component& component, const FittedMotion& motion) {
  component.centre = motion.frame.centre;
  component.orientation = motion.frame.orientation;
  component.momentum = motion.momentum;
  component.angular_momentum = motion.angular_momentum;
}

/// d'' of the parent's frame, turned into the new frame, without its rigid part there.
void carry_acceleration(MechanicsState& state, const Component& component,
                        const Eigen::Quaterniond& parent_orientation) {
  const Mat3 turn = (component.orientation.conjugate() * parent_orientation).toRotationMatrix();
  const RestShape shape = rest_shape(state.vertices, component.vertices, component.rest_centre);
  Eigen::Matrix3Xd field(3, shape.mass.size());
  for (Eigen::Index i = 0; i < field.cols(); ++i) {
    const std::size_t v = component.vertices[static_cast<std::size_t>(i)].index();
    field.col(i) = turn * state.vertices.displacement_acceleration[v];
  }
  project_acceleration(field, shape);
  for (Eigen::Index i = 0; i < field.cols(); ++i) {
    const std::size_t v = component.vertices[static_cast<std::size_t>(i)].index();
    state.vertices.displacement_acceleration[v] = field.col(i);
  }
}

double kinetic_energy_of(const MechanicsState& state, const Component& component) {
  double sum = 0;
  for (VertexId v : component.vertices) {
    sum += 0.5 * state.vertices.mass[v.index()] * state.vertices.velocity[v.index()].squaredNorm();
  }
  return sum;
}

/// Undeformed rows of a component in its present frame, moving with its P and L.
void set_rigid_rows(MechanicsState& state, const Component& component) {
  VertexColumns& vertices = state.vertices;
  const Mat3 R = component.orientation.toRotationMatrix();
  const Vec3 spin = R * solve3(component.rest_inertia, R.transpose() * component.angular_momentum);
  for (VertexId v : component.vertices) {
    const Vec3 arm = R * (vertices.rest_position[v.index()] - component.rest_centre);
    vertices.position[v.index()] = component.centre + arm;
    vertices.velocity[v.index()] = component.momentum / component.mass + spin.cross(arm);
    vertices.displacement[v.index()].setZero();
    vertices.displacement_rate[v.index()].setZero();
    vertices.displacement_acceleration[v.index()].setZero();
  }
}

/// Strain energy of a piece in the frame its rows still stand in, that of its parent; J.
double present_strain(const MechanicsState& state, std::span<const Corners> corners,
                      const Component& component) {
  const ElasticInput elastic{state, corners, state.vertices.position};
  return elastic_energy(elastic, component, state.vertices.displacement);
}

/// A piece that turns rigid: gives up its deformation; the kinetic energy in it, J.
double make_rigid(MechanicsState& state, const Component& component) {
  const double before = kinetic_energy_of(state, component);
  set_rigid_rows(state, component);
  for (TetId t : component.tetrahedra) {
    state.elements.stress[t.index()].setZero();
    if (!state.elements.corner_stress.empty()) {
      state.elements.corner_stress[t.index()].fill(Mat3::Zero());
    }
  }
  return before - kinetic_energy_of(state, component);
}

/// x and v decide; the frame follows.
void fit_component(MechanicsState& state, Component& component) {
  VertexColumns& vertices = state.vertices;
  const MotionInput motion{vertices, vertices.position, vertices.velocity};
  const DeformationOutput out{vertices.displacement, vertices.displacement_rate};
  const Pose present{component.centre, component.orientation};
  adopt_motion(component, component.supported ? express_motion(out, motion, component, present)
                                              : fit_motion(out, motion, component));
}

/// The frame of a supported component: the rotation of its parent about a new rest centre, so that
/// x = c + R (x0 - c0 + d) with d as it was. Held for the first time, it takes the frame it has by
/// shape matching.
void seat_frame(const MechanicsState& state, Component& component, const Parent& parent) {
  if (!parent.supported) {
    const Pose frame = rigid_reference(component, state.vertices, state.vertices.position);
    component.centre = frame.centre;
    component.orientation = frame.orientation;
    return;
  }
  const Vec3 shift = component.rest_centre - parent.rest_centre;
  component.centre = parent.frame.centre + parent.frame.orientation * shift;
}

/// Factors may serve on; those of a component that is gone do not. A system retired before, and not
/// used since, is still the reference.
void retire_system(ComponentSystems& systems, ComponentId id, bool gone) {
  if (id.index() >= systems.present.size()) return;
  std::unique_ptr<ComponentSystem>& system = systems.present[id.index()];
  std::unique_ptr<ComponentSystem>& retired = systems.retired[id.index()];
  if (system) retired = std::move(system);
  system.reset();
  if (gone) retired.reset();
}

}  // namespace

RebuildReport rebuild(MechanicsState& state, std::span<const Corners> corners,
                      std::span<const ComponentId> touched, MechanicsScratch& scratch) {
  SUNDER_ASSERT(corners.size() == state.elements.size(), "rebuild: corners of another mesh");
  std::size_t count = state.components.size();
  for (ComponentId id : touched) count = std::max(count, id.index() + 1);
  for (std::size_t c = state.components.size(); c < count; ++c) {
    state.components.emplace_back().id = ComponentId{c};
  }
  std::vector<std::vector<TetId>> members = gather_members(state.elements, touched, count);
  const std::vector<Parent> parents = remember_parents(state, members, corners);

  RebuildReport report;
  for (std::size_t i = 0; i < touched.size(); ++i) {
    Component& component = state.components[touched[i].index()];
    retire_system(state.systems, touched[i], members[i].empty());
    if (touched[i].index() < scratch.baselines.size()) {
      scratch.baselines[touched[i].index()].reset();
    }
    if (members[i].empty()) {
      component = Component{};
      component.id = touched[i];
      continue;
    }
    const Parent& parent = parents[i];
    set_members(state, component, std::move(members[i]), corners);
    component.orientation = parent.frame.orientation;
    set_supports(state, component);
    component.rung = Rung::full;
    if (component.supported) seat_frame(state, component, parent);
    if (component.rigid) report.strain_released += present_strain(state, corners, component);
    fit_component(state, component);
    if (component.rigid) {
      report.energy_released += make_rigid(state, component);
    } else if (!component.supported) {
      carry_acceleration(state, component, parent.frame.orientation);
    }
  }
  report.energy_released += report.strain_released;
  return report;
}

RebuildReport turn_rigid(MechanicsState& state, std::span<const Corners> corners, ComponentId id) {
  SUNDER_ASSERT(id.index() < state.components.size(), "turn_rigid: no such component");
  Component& component = state.components[id.index()];
  SUNDER_ASSERT(!component.supported, "turn_rigid: a component that is held");
  RebuildReport report;
  report.strain_released = present_strain(state, corners, component);
  fit_component(state, component);
  component.rigid = true;
  component.largest_turn = 0;
  component.strain_change = {};
  report.energy_released = report.strain_released + make_rigid(state, component);
  retire_system(state.systems, id, true);
  return report;
}

void reframe(MechanicsState& state, ComponentId id) {
  SUNDER_ASSERT(id.index() < state.components.size(), "reframe: no such component");
  Component& component = state.components[id.index()];
  fit_component(state, component);
  if (component.rigid) {
    set_rigid_rows(state, component);
  } else if (!component.supported) {
    carry_acceleration(state, component, component.orientation);
  }
}

void place(MechanicsState& state, ComponentId id, const Placement& placement) {
  SUNDER_ASSERT(id.index() < state.components.size(), "place: no such component");
  Component& component = state.components[id.index()];
  const Mat3 R = placement.orientation.normalized().toRotationMatrix();
  component.orientation = placement.orientation.normalized();
  component.centre = R * component.rest_centre + placement.translation;
  component.momentum = component.mass * placement.velocity;
  component.angular_momentum = R * component.rest_inertia * R.transpose() * placement.spin;
  set_rigid_rows(state, component);
  if (!component.supported) return;
  for (VertexId v : component.vertices) {
    Vec3& velocity = state.vertices.velocity[v.index()];
    velocity = with_support(state, v, velocity, component.orientation);
  }
  fit_component(state, component);
}

}  // namespace sunder
