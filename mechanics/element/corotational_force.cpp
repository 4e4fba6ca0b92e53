// SPDX-License-Identifier: MIT
// Rotations of elements and the forces in their frames.
#include "mechanics/element/corotational_force.hpp"

#include "mechanics/frame/rotation.hpp"

namespace sunder {

Mat3 element_rotation(const Mat3& F, const Mat3& near) {
  Mat3 R = near;
  constexpr int most_iterations = 4;
  // Cubic, as what Newton leaves out is proportional to the turn itself: 1e-12 after one of 1e-4.
  constexpr double converged = 1e-4;
  for (int i = 0; i < most_iterations; ++i) {
    const Mat3 P = R.transpose() * F;
    const Vec3 skew(P(2, 1) - P(1, 2), P(0, 2) - P(2, 0), P(1, 0) - P(0, 1));
    Mat3 G = -0.5 * (P + P.transpose());
    G.diagonal().array() += P.trace();
    // Near a rotation G is near 2 I; what is not goes the safe way.
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

/// The turn of a component's first element: near those of all where it is stiff, even where the
/// positions have turned since its orientation was taken.
Mat3 first_turn(const ElasticInput& input, const Component& component) {
  const TetId t = component.tetrahedra.front();
  const CornerVectors x = at_corners(input.positions, input.corners[t.index()]);
  return element_rotation(deformation_gradient(input.state.elements.shape_gradient[t.index()], x),
                          component.orientation.toRotationMatrix());
}

}  // namespace

void corotational_forces(std::span<Vec3> force, const ElasticInput& input,
                         const Component& component) {
  const ElementColumns& elements = input.state.elements;
  const Mat3 near = first_turn(input, component);
  for (VertexId v : component.vertices) force[v.index()].setZero();
  for (TetId t : component.tetrahedra) {
    const Corners& corners = input.corners[t.index()];
    const ShapeGradient& G = elements.shape_gradient[t.index()];
    const Mat3 F = deformation_gradient(G, at_corners(input.positions, corners));
    const Mat3 R = element_rotation(F, near);
    const Mat3 sigma = corotational_stress(R, F, lame(material_of(input.state, t)));
    const CornerVectors f = element_force(G, elements.rest_volume[t.index()], R * sigma);
    for (int a = 0; a < 4; ++a) force[corners[a].index()] -= f.col(a);
  }
}

void element_rotations(std::vector<Mat3>& rotation, const ElasticInput& input,
                       const Component& component) {
  const Mat3 near = first_turn(input, component);
  rotation.clear();
  for (TetId t : component.tetrahedra) {
    const CornerVectors x = at_corners(input.positions, input.corners[t.index()]);
    const ShapeGradient& G = input.state.elements.shape_gradient[t.index()];
    rotation.push_back(element_rotation(deformation_gradient(G, x), near));
  }
}

void corotational_product(std::span<Vec3> product, const TurnedElements& elements,
                          std::span<const Vec3> u) {
  const ElasticInput& input = elements.input;
  const ElementColumns& columns = input.state.elements;
  for (VertexId v : elements.component.vertices) product[v.index()].setZero();
  for (std::size_t e = 0; e < elements.rotation.size(); ++e) {
    const TetId t = elements.component.tetrahedra[e];
    const Corners& corners = input.corners[t.index()];
    const ShapeGradient& G = columns.shape_gradient[t.index()];
    const Mat3& R = elements.rotation[e];
    const Mat3 turned = R.transpose() * deformation_gradient(G, at_corners(u, corners));
    const Mat3 sigma = stress_of(turned, lame(material_of(input.state, t)));
    const CornerVectors f = element_force(G, columns.rest_volume[t.index()], R * sigma);
    for (int a = 0; a < 4; ++a) product[corners[a].index()] += f.col(a);
  }
}

}  // namespace sunder
