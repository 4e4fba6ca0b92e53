// SPDX-License-Identifier: MIT
// Algorithm 2 of the paper, with masses.
#include "mechanics/frame/rigid_reference.hpp"

#include "mechanics/frame/rotation.hpp"

namespace sunder {

Pose rigid_reference(const Component& component, const VertexColumns& vertices,
                     std::span<const Vec3> positions) {
  Pose frame{Vec3::Zero(), component.orientation};
  double mass = 0;
  for (VertexId v : component.vertices) {
    frame.centre += vertices.mass[v.index()] * positions[v.index()];
    mass += vertices.mass[v.index()];
  }
  frame.centre /= mass;

  Mat3 A = Mat3::Zero();
  for (VertexId v : component.vertices) {
    const Vec3 p = positions[v.index()] - frame.centre;
    const Vec3 p0 = vertices.rest_position[v.index()] - component.rest_centre;
    A += vertices.mass[v.index()] * p * p0.transpose();
  }

  frame.orientation = refine_rotation(A, component.orientation);
  return frame;
}

}  // namespace sunder
