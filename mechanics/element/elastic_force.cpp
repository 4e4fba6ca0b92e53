// SPDX-License-Identifier: MIT
// Algorithm 1 of the paper, and the term that makes its force a gradient.
#include "mechanics/element/elastic_force.hpp"

#include "mechanics/element/second_order.hpp"
#include "mechanics/element/strain_displacement.hpp"
#include "mechanics/frame/rotation.hpp"

namespace sunder {
namespace {

void set_displacement(const ElasticOutput& output, const ElasticInput& input,
                      const Component& component, const Pose& frame) {
  const Mat3 R = frame.orientation.toRotationMatrix();
  for (VertexId v : component.vertices) {
    const Vec3 p = input.positions[v.index()] - frame.centre;
    const Vec3 p0 = R.transpose() * p;
    output.displacement[v.index()] =
        p0 - (input.state.vertices.rest_position[v.index()] - component.rest_centre);
  }
}

/// Adds K_e d_e of one tetrahedron of second order, body frame.
void add_second_order_forces(const ElasticOutput& output, const ElasticInput& input, TetId t) {
  const ElementColumns& elements = input.state.elements;
  std::array<Mat3, 4> sigma = corner_gradients(elements, input.corners, output.displacement, t);
  for (Mat3& at : sigma) at = stress_of(at, lame(material_of(input.state, t)));
  const ElementNodes nodes = nodes_of(elements, input.corners, t);
  for (std::size_t a = 0; a < nodes.count; ++a) {
    output.force[nodes.row[a].index()] += second_order_force(
        elements.shape_gradient[t.index()], elements.rest_volume[t.index()], sigma, a);
  }
}

/// K d, body frame.
void sum_element_forces(const ElasticOutput& output, const ElasticInput& input,
                        const Component& component) {
  const ElementColumns& elements = input.state.elements;
  for (VertexId v : component.vertices) output.force[v.index()].setZero();
  for (TetId t : component.tetrahedra) {
    const Corners& corners = input.corners[t.index()];
    const ShapeGradient& G = elements.shape_gradient[t.index()];
    if (is_second_order(elements, t)) {
      add_second_order_forces(output, input, t);
      continue;
    }
    const CornerVectors d = at_corners(output.displacement, corners);
    const Mat3 sigma = stress_of(displacement_gradient(G, d), lame(material_of(input.state, t)));
    const CornerVectors f = element_force(G, elements.rest_volume[t.index()], sigma);
    for (int a = 0; a < 4; ++a) output.force[corners[a].index()] += f.col(a);
  }
}

/// -R K d: the force on the vertices.
void turn_to_world(const ElasticOutput& output, const Component& component, const Pose& frame) {
  const Mat3 R = frame.orientation.toRotationMatrix();
  for (VertexId v : component.vertices) {
    const Vec3 inner = output.force[v.index()];
    output.force[v.index()] = -(R * inner);
  }
}

/// Turns the net torque of the body-frame forces K d into a term that cancels it: the effect of the
/// rotation R(x) itself on the energy.
void remove_torque(const ElasticOutput& output, const ElasticInput& input,
                   const Component& component) {
  const VertexColumns& vertices = input.state.vertices;
  Vec3 torque = Vec3::Zero();
  Mat3 S = Mat3::Zero();
  for (VertexId v : component.vertices) {
    const Vec3& d = output.displacement[v.index()];
    const Vec3 r0 = vertices.rest_position[v.index()] - component.rest_centre;
    torque += d.cross(output.force[v.index()]);
    S += vertices.mass[v.index()] * (r0 + d) * r0.transpose();
  }
  Mat3 G = -0.5 * (S + S.transpose());
  G.diagonal().array() += S.trace();
  const Eigen::LDLT<Mat3> solver(G);
  if (solver.info() != Eigen::Success || !(solver.rcond() > 1e-12)) return;
  const Vec3 y = solver.solve(torque);
  for (VertexId v : component.vertices) {
    const Vec3 r0 = vertices.rest_position[v.index()] - component.rest_centre;
    output.force[v.index()] -= vertices.mass[v.index()] * y.cross(r0);
  }
}

}  // namespace

Pose deformation_forces(const ElasticOutput& output, const ElasticInput& input,
                        const Component& component) {
  const Pose frame = rigid_reference(component, input.state.vertices, input.positions);
  set_displacement(output, input, component, frame);
  sum_element_forces(output, input, component);
  if (input.form == ElasticForce::conservative) remove_torque(output, input, component);
  turn_to_world(output, component, frame);
  return frame;
}

void deformation_forces_in(const Pose& frame, const ElasticOutput& output,
                           const ElasticInput& input, const Component& component) {
  set_displacement(output, input, component, frame);
  sum_element_forces(output, input, component);
  turn_to_world(output, component, frame);
}

double elastic_energy(const ElasticInput& input, const Component& component,
                      std::span<const Vec3> displacement) {
  const ElementColumns& elements = input.state.elements;
  double energy = 0;
  for (TetId t : component.tetrahedra) {
    if (is_second_order(elements, t)) {
      const std::array<Mat3, 4> H = corner_gradients(elements, input.corners, displacement, t);
      std::array<Mat3, 4> sigma;
      for (std::size_t c = 0; c < 4; ++c)
        sigma[c] = stress_of(H[c], lame(material_of(input.state, t)));
      energy += 0.5 * elements.rest_volume[t.index()] * mean_product(sigma, H);
      continue;
    }
    const CornerVectors d = at_corners(displacement, input.corners[t.index()]);
    const Mat3 H = displacement_gradient(elements.shape_gradient[t.index()], d);
    const Mat3 sigma = stress_of(H, lame(material_of(input.state, t)));
    energy += 0.5 * elements.rest_volume[t.index()] * sigma.cwiseProduct(H).sum();
  }
  return energy;
}

}  // namespace sunder
