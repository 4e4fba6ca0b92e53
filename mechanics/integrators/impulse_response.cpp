// SPDX-License-Identifier: MIT
// Impulses on components and the compliance that contact solves with.
#include "mechanics/integrators/impulse_response.hpp"

#include <algorithm>

#include "mechanics/frame/mean_axis.hpp"
#include "mechanics/frame/rotation.hpp"
#include "mechanics/integrators/coefficients.hpp"
#include "mechanics/integrators/component_step.hpp"
#include "mechanics/state/dense_solve.hpp"
#include "mechanics/state/inertia.hpp"
#include "mechanics/state/supports.hpp"
#include "topology/base/assert.hpp"

namespace sunder {
namespace {

/// Velocity changes j / m (world) of a free component, turned into P, L and d'.
struct BodyBlow {
  const Component& component;
  std::span<const VertexImpulse> impulses;  ///< all of them at vertices of the component
};

/// P and L; the vertices' own velocities.
void add_momenta(MechanicsState& state, const BodyBlow& blow) {
  Component& component = state.components[blow.component.id.index()];
  for (const VertexImpulse& hit : blow.impulses) {
    const std::size_t v = hit.vertex.index();
    component.momentum += hit.impulse;
    component.angular_momentum +=
        (state.vertices.position[v] - component.centre).cross(hit.impulse);
    state.vertices.velocity[v] += hit.impulse / state.vertices.mass[v];
  }
}

/// Change of d' by the blow: j / m in the body frame less its rigid part.
void add_rates(MechanicsState& state, const BodyBlow& blow) {
  const Component& component = blow.component;
  VertexColumns& vertices = state.vertices;
  const RestShape shape = rest_shape(vertices, component.vertices, component.rest_centre);
  Eigen::Matrix3Xd q = shape.arm;
  Eigen::Matrix3Xd rate = Eigen::Matrix3Xd::Zero(3, shape.mass.size());
  for (Eigen::Index i = 0; i < rate.cols(); ++i) {
    q.col(i) += vertices.displacement[component.vertices[static_cast<std::size_t>(i)].index()];
  }
  const Mat3 back = component.orientation.toRotationMatrix().transpose();
  for (const VertexImpulse& hit : blow.impulses) {
    const auto place =
        std::lower_bound(component.vertices.begin(), component.vertices.end(), hit.vertex);
    rate.col(place - component.vertices.begin()) +=
        back * hit.impulse / vertices.mass[hit.vertex.index()];
  }
  project_rate(rate, shape, q);
  for (Eigen::Index i = 0; i < rate.cols(); ++i) {
    vertices.displacement_rate[component.vertices[static_cast<std::size_t>(i)].index()] +=
        rate.col(i);
  }
}

/// An isolated tetrahedron answers as a whole.
void set_rigid_velocities(MechanicsState& state, const Component& component) {
  const Mat3 R = component.orientation.toRotationMatrix();
  const Vec3 spin = R * solve3(component.rest_inertia, R.transpose() * component.angular_momentum);
  for (VertexId v : component.vertices) {
    const Vec3 arm = R * (state.vertices.rest_position[v.index()] - component.rest_centre);
    state.vertices.velocity[v.index()] = component.momentum / component.mass + spin.cross(arm);
  }
}

void apply_to_component(MechanicsState& state, const BodyBlow& blow) {
  const Component& component = blow.component;
  if (component.supported) {
    const Mat3 back = component.orientation.toRotationMatrix().transpose();
    for (const VertexImpulse& hit : blow.impulses) {
      const std::size_t v = hit.vertex.index();
      if (is_held_whole(state, hit.vertex)) continue;
      const Vec3 change = free_part(state, hit.vertex, back * hit.impulse / state.vertices.mass[v]);
      state.vertices.velocity[v] += back.transpose() * change;
      state.vertices.displacement_rate[v] += change;
    }
    return;
  }
  add_momenta(state, blow);
  if (component.rigid) {
    set_rigid_velocities(state, component);
  } else {
    add_rates(state, blow);
  }
}

/// h (I/M - [x_k - c] I(q)^-1 [x_l - c]) for every pair, world.
Eigen::MatrixXd rigid_response(const MechanicsState& state, const Component& component,
                               std::span<const VertexId> vertices, double time_step) {
  const Mat3 inverse = world_inertia(state, component).inverse();
  const auto k = static_cast<Eigen::Index>(vertices.size());
  Eigen::MatrixXd Y(3 * k, 3 * k);
  for (Eigen::Index a = 0; a < k; ++a) {
    const Mat3 arm_a = cross_matrix(
        state.vertices.position[vertices[static_cast<std::size_t>(a)].index()] - component.centre);
    for (Eigen::Index b = 0; b < k; ++b) {
      const Mat3 arm_b =
          cross_matrix(state.vertices.position[vertices[static_cast<std::size_t>(b)].index()] -
                       component.centre);
      Mat3 block = -arm_a * inverse * arm_b;
      block.diagonal().array() += 1 / component.mass;
      Y.block<3, 3>(3 * a, 3 * b) = time_step * block;
    }
  }
  return Y;
}

/// Free vertices of a request: their rows in it and in the component's system.
struct FreeVertices {
  std::vector<Eigen::Index> row;
  std::vector<std::uint32_t> local;
};

FreeVertices free_vertices(const MechanicsState& state, std::span<const VertexId> vertices) {
  FreeVertices free;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const std::size_t v = vertices[i].index();
    if (!state.vertices.support[v].is_none()) continue;
    free.row.push_back(static_cast<Eigen::Index>(i));
    free.local.push_back(state.systems.local_row[v]);
  }
  return free;
}

/// Adds R (c1 A^-1 + c2 M^-1, freed of the rigid answer unless supported) R^T.
void add_elastic_response(Eigen::MatrixXd& Y, ComponentSystem& system,
                          const ImpulseCoefficients& answer, const Component& component,
                          const FreeVertices& free) {
  const std::vector<std::uint32_t> places = touch_compliance(system, free.local);
  // A r = mu M r for rigid fields r, so the rigid part of A^-1 is that of M^-1 over mu.
  const double rigid_part =
      component.supported ? 0 : answer.inverse / system.step.matrix.mass + answer.mass;
  const Mat3 inverse_inertia = system.shape.inertia.inverse();
  const Mat3 R = component.orientation.toRotationMatrix();
  for (std::size_t a = 0; a < free.row.size(); ++a) {
    const Mat3 arm_a = cross_matrix(system.shape.arm.col(free.local[a]));
    for (std::size_t b = 0; b < free.row.size(); ++b) {
      const Mat3 arm_b = cross_matrix(system.shape.arm.col(free.local[b]));
      Mat3 block =
          answer.inverse * system.step.compliance.block<3, 3>(3 * places[a], 3 * places[b]) +
          rigid_part * arm_a * inverse_inertia * arm_b;
      block.diagonal().array() -= rigid_part / component.mass;
      if (a == b) block.diagonal().array() += answer.mass / system.shape.mass[free.local[a]];
      Y.block<3, 3>(3 * free.row[a], 3 * free.row[b]) += R * block * R.transpose();
    }
  }
}

}  // namespace

void apply_impulses(MechanicsState& state, std::span<const VertexImpulse> impulses) {
  // Grouped by component, in the order given within each.
  std::vector<VertexImpulse> sorted(impulses.begin(), impulses.end());
  const auto component_of = [&](const VertexImpulse& hit) {
    SUNDER_ASSERT(hit.vertex.index() < state.vertices.size(), "apply_impulses: no such vertex");
    return state.vertices.component[hit.vertex.index()];
  };
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const auto& a, const auto& b) { return component_of(a) < component_of(b); });
  for (auto first = sorted.begin(); first != sorted.end();) {
    const ComponentId id = component_of(*first);
    const auto last =
        std::find_if(first, sorted.end(), [&](const auto& hit) { return component_of(hit) != id; });
    apply_to_component(state, {state.components[id.index()], {first, last}});
    first = last;
  }
}

Mat3 world_inertia(const MechanicsState& state, const Component& component) {
  Mat3 inertia = Mat3::Zero();
  for (VertexId v : component.vertices) {
    const Vec3 arm = state.vertices.position[v.index()] - component.centre;
    add_inertia(inertia, state.vertices.mass[v.index()], arm);
  }
  return inertia;
}

void apply_push(MechanicsState& state, ComponentId id, const Vec3& impulse) {
  if (impulse.isZero(0)) return;
  Component& component = state.components[id.index()];
  component.momentum += impulse;
  set_rigid_velocities(state, component);
}

void apply_twist(MechanicsState& state, ComponentId id, const Vec3& twist) {
  Component& component = state.components[id.index()];
  if (component.supported || twist.isZero(0)) return;
  component.angular_momentum += twist;
  if (component.rigid) return set_rigid_velocities(state, component);
  const Vec3 spin = solve3(world_inertia(state, component), twist);
  for (VertexId v : component.vertices) {
    state.vertices.velocity[v.index()] +=
        spin.cross(state.vertices.position[v.index()] - component.centre);
  }
}

Eigen::MatrixXd end_of_step_response(MechanicsState& state, const StepInput& input,
                                     const StruckVertices& struck) {
  const Component& component = state.components[struck.component.index()];
  const auto k = static_cast<Eigen::Index>(struck.vertices.size());
  const double h = input.settings.time_step;
  if (component.rigid) return rigid_response(state, component, struck.vertices, h);
  Eigen::MatrixXd Y = Eigen::MatrixXd::Zero(3 * k, 3 * k);
  if (is_explicit(input.settings.integrator)) {
    for (Eigen::Index i = 0; i < k; ++i) {
      const std::size_t v = struck.vertices[static_cast<std::size_t>(i)].index();
      if (!state.vertices.support[v].is_none()) continue;
      Y.diagonal().segment<3>(3 * i).setConstant(h / state.vertices.mass[v]);
    }
    return Y;
  }
  if (!component.supported) Y = rigid_response(state, component, struck.vertices, h);
  ComponentSystem& system = prepared_system(state, input, component);
  const ImpulseCoefficients answer = impulse_coefficients(settings_of(input, state, component));
  add_elastic_response(Y, system, answer, component, free_vertices(state, struck.vertices));
  return Y;
}

}  // namespace sunder
