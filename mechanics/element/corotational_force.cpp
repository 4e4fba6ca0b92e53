// SPDX-License-Identifier: MIT
// Rotations of elements and the forces in their frames.
#include "mechanics/element/corotational_force.hpp"

#include "mechanics/element/second_order.hpp"
#include "mechanics/frame/rotation.hpp"

namespace sunder {

Mat3 element_rotation(const Mat3& F, const Mat3& near) {
  Mat3 R = near;
  constexpr int most_iterations = 4;
  // Cubic, since Newton's error is proportional to the turn itself: 1e-12 after one of 1e-4.
  constexpr double converged = 1e-4;
  for (int i = 0; i < most_iterations; ++i) {
    const Mat3 P = R.transpose() * F;
    const Vec3 skew(P(2, 1) - P(1, 2), P(0, 2) - P(2, 0), P(1, 0) - P(0, 1));
    Mat3 G = -0.5 * (P + P.transpose());
    G.diagonal().array() += P.trace();
    // Near a rotation G is near 2 I; all other matrices take the safe way.
    if (!(G.diagonal().minCoeff() > 1 && std::abs(G(0, 1)) + std::abs(G(0, 2)) < 0.4 &&
          std::abs(G(1, 0)) + std::abs(G(1, 2)) < 0.4)) {
      break;
    }
    // The Cayley map of `turn` agrees with the exponential to third order: good enough on the way.
    const Vec3 half = 0.5 * (G.inverse() * skew);
    const Mat3 W = cross_matrix(half);
    const double square = half.squaredNorm();
    R = R * (Mat3::Identity() + 2 / (1 + square) * (W + W * W)).eval();
    if (square <= 0.25 * converged * converged) return R;
  }
  return refine_rotation(F, Eigen::Quaterniond(near)).toRotationMatrix();
}

namespace {

/// One matrix at the centre of a tetrahedron, or four at Gauss' points of one of second order.
struct AtPoints {
  std::array<Mat3, 4> value;
  std::size_t count;
};

/// sum_a x_a (grad N_a)^T of a tetrahedron, from a column of nodes; by differences, as gradients
/// add up to nothing: exact far from the origin too.
AtPoints gradients(const ElasticInput& input, std::span<const Vec3> column, TetId t) {
  const ElementColumns& elements = input.state.elements;
  const ShapeGradient& G = elements.shape_gradient[t.index()];
  if (!is_second_order(elements, t)) {
    return {{deformation_gradient(G, at_corners(column, input.corners[t.index()]))}, 1};
  }
  const ElementNodes nodes = nodes_of(elements, input.corners, t);
  NodeVectors d;
  for (std::size_t a = 0; a < d.size(); ++a) {
    d[a] = column[nodes.row[a].index()] - column[nodes.row[0].index()];
  }
  return {at_points(corner_gradients(G, d)), 4};
}

/// Adds `sign` times the integral of P grad N_a to the row of every node a. P: Pa, as `gradients`
/// has it.
void add_forces(std::span<Vec3> force, const ElasticInput& input, TetId t, const AtPoints& P,
                double sign) {
  const ElementColumns& elements = input.state.elements;
  const ShapeGradient& G = elements.shape_gradient[t.index()];
  const double volume = elements.rest_volume[t.index()];
  const ElementNodes nodes = nodes_of(elements, input.corners, t);
  if (nodes.count == 4) {
    const CornerVectors f = element_force(G, volume, P.value[0]);
    for (int a = 0; a < 4; ++a) {
      force[nodes.row[static_cast<std::size_t>(a)].index()] += sign * f.col(a);
    }
    return;
  }
  const std::array<Mat3, 4> at = at_corners_of(P.value);
  for (std::size_t a = 0; a < nodes.count; ++a) {
    force[nodes.row[a].index()] += sign * second_order_force(G, volume, at, a);
  }
}

/// The turn of a component's first element: near those of all where it is stiff, even where the
/// positions have turned since its orientation was taken.
Mat3 first_turn(const ElasticInput& input, const Component& component) {
  const AtPoints F = gradients(input, input.positions, component.tetrahedra.front());
  return element_rotation(F.value[0], component.orientation.toRotationMatrix());
}

}  // namespace

void corotational_forces(std::span<Vec3> force, const ElasticInput& input,
                         const Component& component) {
  const Mat3 near = first_turn(input, component);
  for (VertexId v : component.vertices) force[v.index()].setZero();
  for (TetId t : component.tetrahedra) {
    AtPoints at = gradients(input, input.positions, t);
    const Lame constants = lame(material_of(input.state, t));
    for (std::size_t q = 0; q < at.count; ++q) {
      const Mat3 R = element_rotation(at.value[q], near);
      const Mat3 sigma = corotational_stress(R, at.value[q], constants);
      at.value[q] = R * sigma;
    }
    add_forces(force, input, t, at, -1);
  }
}

void viscous_forces(std::span<Vec3> force, const ElasticInput& input,
                    std::span<const Vec3> velocities, const Component& component, double factor) {
  for (VertexId v : component.vertices) force[v.index()].setZero();
  for (TetId t : component.tetrahedra) {
    AtPoints at = gradients(input, input.positions, t);
    const AtPoints rate = gradients(input, velocities, t);
    const Lame constants = lame(material_of(input.state, t));
    for (std::size_t q = 0; q < at.count; ++q) {
      const Mat3 F = at.value[q];
      const Mat3 strain_rate = F.transpose() * rate.value[q];
      at.value[q] = factor * F * stress_of(strain_rate, constants);
    }
    add_forces(force, input, t, at, -1);
  }
}

void element_rotations(std::vector<Mat3>& rotation, const ElasticInput& input,
                       const Component& component) {
  const Mat3 near = first_turn(input, component);
  rotation.clear();
  for (TetId t : component.tetrahedra) {
    const AtPoints F = gradients(input, input.positions, t);
    for (std::size_t q = 0; q < F.count; ++q) {
      rotation.push_back(element_rotation(F.value[q], near));
    }
  }
}

void corotational_product(std::span<Vec3> product, const TurnedElements& elements,
                          std::span<const Vec3> u) {
  const ElasticInput& input = elements.input;
  for (VertexId v : elements.component.vertices) product[v.index()].setZero();
  const Mat3* R = elements.rotation.data();
  for (TetId t : elements.component.tetrahedra) {
    AtPoints at = gradients(input, u, t);
    const Lame constants = lame(material_of(input.state, t));
    for (std::size_t q = 0; q < at.count; ++q, ++R) {
      const Mat3 turned = R->transpose() * at.value[q];
      at.value[q] = *R * stress_of(turned, constants);
    }
    add_forces(product, input, t, at, 1);
  }
}

}  // namespace sunder
