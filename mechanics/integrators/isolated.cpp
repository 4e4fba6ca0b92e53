// SPDX-License-Identifier: MIT
// Projection, and one element by implicit Euler in the frame of its edges.
#include "mechanics/integrators/isolated.hpp"

#include <array>

#include "mechanics/element/strain_displacement.hpp"
#include "mechanics/frame/rigid_reference.hpp"
#include "mechanics/integrators/model_force.hpp"
#include "mechanics/state/dense_solve.hpp"
#include "mechanics/state/inertia.hpp"

namespace sunder {
namespace {

/// The four vertices of an isolated component at the start of a step, without weight.
struct Corner4 {
  std::array<std::size_t, 4> row;
  CornerVectors position, velocity;
};

/// Velocities including the impulses that contact has added to P and L since they were written; the
/// vertices' own velocities lack these.
Corner4 corners_at_start(const ComponentStep& step) {
  const Component& body = step.component;
  const VertexColumns& vertices = step.state.vertices;
  Corner4 c;
  Vec3 momentum = body.momentum, angular = body.angular_momentum;
  Mat3 inertia = Mat3::Zero();
  for (int a = 0; a < 4; ++a) {
    const std::size_t v = step.input.corners[body.tetrahedra.front().index()][a].index();
    c.row[static_cast<std::size_t>(a)] = v;
    c.position.col(a) = vertices.position[v];
    c.velocity.col(a) = vertices.velocity[v];
    const double m = vertices.mass[v];
    const Vec3 arm = vertices.position[v] - body.centre;
    momentum -= m * vertices.velocity[v];
    angular -= m * arm.cross(vertices.velocity[v]);
    add_inertia(inertia, m, arm);
  }
  const Vec3 spin = solve3(inertia, angular);
  for (int a = 0; a < 4; ++a) {
    const Vec3 arm = c.position.col(a) - body.centre;
    c.velocity.col(a) += momentum / body.mass + spin.cross(arm);
  }
  return c;
}

/// x and v at the end of the step; weight bends the path to a parabola.
void write_corners(const ComponentStep& step, const Corner4& end) {
  MechanicsScratch::Predicted& predicted = step.scratch.predicted;
  const double h = step.input.settings.time_step;
  const Vec3& g = step.input.loads.gravity;
  for (int a = 0; a < 4; ++a) {
    const std::size_t v = end.row[static_cast<std::size_t>(a)];
    predicted.position[v] = end.position.col(a) + 0.5 * h * h * g;
    predicted.velocity[v] = end.velocity.col(a) + h * g;
  }
  fit_prediction(step);
}

/// Columns e1, e2, e3 of the edges; false where they have no directions.
bool edge_frame(Mat3& frame, const CornerVectors& x) {
  const Vec3 first = x.col(1) - x.col(0);
  const Vec3 normal = first.cross(Vec3(x.col(2) - x.col(0)));
  if (!(first.norm() > 0 && normal.norm() > 1e-12 * first.squaredNorm())) return false;
  frame.col(0) = first.normalized();
  frame.col(2) = normal.normalized();
  frame.col(1) = frame.col(2).cross(frame.col(0));
  return true;
}

Vec3 force_on(const ComponentStep& step, std::size_t vertex) {
  return step.input.loads.force.empty() ? Vec3::Zero() : step.input.loads.force[vertex];
}

}  // namespace

void step_projected(const ComponentStep& step) {
  const Component& body = step.component;
  const VertexColumns& vertices = step.state.vertices;
  const double h = step.input.settings.time_step;
  Corner4 c = corners_at_start(step);
  std::vector<Vec3>& alone = step.scratch.predicted.position;
  for (int a = 0; a < 4; ++a) {
    const std::size_t v = c.row[static_cast<std::size_t>(a)];
    alone[v] =
        c.position.col(a) + h * (c.velocity.col(a) + h / vertices.mass[v] * force_on(step, v));
  }
  const Pose frame = rigid_reference(body, vertices, alone);
  for (int a = 0; a < 4; ++a) {
    const std::size_t v = c.row[static_cast<std::size_t>(a)];
    const Vec3 old = c.position.col(a);
    c.position.col(a) =
        frame.centre + frame.orientation * (vertices.rest_position[v] - body.rest_centre);
    c.velocity.col(a) = (c.position.col(a) - old) / h;
  }
  write_corners(step, c);
}

void step_edge_framed(const ComponentStep& step) {
  const Component& body = step.component;
  const VertexColumns& vertices = step.state.vertices;
  const ElementColumns& elements = step.state.elements;
  const TetId t = body.tetrahedra.front();
  const double h = step.input.settings.time_step;
  Corner4 c = corners_at_start(step);
  CornerVectors rest;
  for (int a = 0; a < 4; ++a) {
    rest.col(a) = vertices.rest_position[c.row[static_cast<std::size_t>(a)]] - body.rest_centre;
  }
  const CornerVectors ahead = c.position + h * c.velocity;
  Mat3 now, before;
  const bool framed = edge_frame(now, ahead) && edge_frame(before, rest);
  const Mat3 R = framed ? Mat3(now * before.transpose()) : body.orientation.toRotationMatrix();

  const ElementStiffness K =
      element_stiffness(elements.shape_gradient[t.index()], elements.rest_volume[t.index()],
                        lame(material_of(step.state, t)));
  // K feels no translation, but taken out it leaves no rounding of it.
  CornerVectors d = R.transpose() * (ahead.colwise() - ahead.col(0));
  d -= (rest.colwise() - rest.col(0)).eval();
  Eigen::Matrix<double, 12, 1> right = -h * (K * d.reshaped());
  ElementStiffness A = h * h * K;
  for (int a = 0; a < 4; ++a) {
    const std::size_t v = c.row[static_cast<std::size_t>(a)];
    right.segment<3>(3 * a) += h * (R.transpose() * force_on(step, v));
    A.diagonal().segment<3>(3 * a).array() += vertices.mass[v];
  }
  const Eigen::Matrix<double, 12, 1> change = A.llt().solve(right);
  // The momentum of the mass centre exactly: the solve has its rounding.
  Vec3 missing = Vec3::Zero();
  for (int a = 0; a < 4; ++a) {
    const std::size_t v = c.row[static_cast<std::size_t>(a)];
    missing += h * force_on(step, v) - vertices.mass[v] * (R * change.segment<3>(3 * a));
  }
  for (int a = 0; a < 4; ++a) {
    c.velocity.col(a) += R * change.segment<3>(3 * a) + missing / body.mass;
  }
  c.position += h * c.velocity;
  write_corners(step, c);
}

}  // namespace sunder
