// SPDX-License-Identifier: MIT
// The columns of mechanics: one row a vertex or tetrahedron, plain arrays; no dart and no
// algorithm.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Dense>

#include "mechanics/state/vec3.hpp"
#include "topology/base/ids.hpp"

namespace sunder {

/// Vertex rows of one tetrahedron, positively oriented at rest.
using Corners = std::array<VertexId, 4>;
/// Rows of the nodes in the middles of a tetrahedron's edges, in the order of `edge_ends`.
using EdgeNodes = std::array<VertexId, 6>;
/// Gradients of the four linear shape functions, one a column, 1/m.
using ShapeGradient = Eigen::Matrix<double, 3, 4>;

/// Row of a material in `MechanicsState::materials`.
using MaterialId = Id<struct MaterialTag>;
/// Row of a prescribed motion in `MechanicsState::motions`.
using MotionId = Id<struct MotionTag>;

/// Which of the axes of the body frame.
using AxisSet = std::array<bool, 3>;

/// A velocity that is raised linearly from zero.
struct RaisedVelocity {
  Vec3 velocity = Vec3::Zero();  ///< m/s, world, once fully raised
  double ramp_time = 0;          ///< s; 0: at once
};

/// The motion of a held vertex: it is fixed (zero velocity) or moves along a straight line.
struct PrescribedMotion {
  /// m/s, world; nothing along axes that are free. While it is raised: its mean over the part of a
  /// step at hand.
  Vec3 velocity = Vec3::Zero();
  AxisSet axes = {true, true, true};  ///< along which it is held
  /// The parts that add up to `velocity`, if some of them are raised; empty: constant.
  std::vector<RaisedVelocity> raised = {};
};

/// |V| rows, a vertex each, then those of the nodes in the middles of edges, where a body has
/// second-order tetrahedra: the columns mean the same for them. They grow by appended copies at a
/// split (`append_copy`); rows never move.
struct VertexColumns {
  std::vector<Vec3> rest_position;  ///< m; the rest configuration, never changed
  std::vector<Vec3> position;       ///< m, world
  std::vector<Vec3> velocity;       ///< m/s, world
  std::vector<double> mass;         ///< kg; a share of every tetrahedron of its star (`node_share`)
  std::vector<ComponentId> component;
  /// Body frame of the component: position = centre + R (rest_position - rest_centre +
  /// displacement)
  std::vector<Vec3> displacement;               ///< m
  std::vector<Vec3> displacement_rate;          ///< m/s
  std::vector<Vec3> displacement_acceleration;  ///< m/s^2
  /// The motion that holds the vertex; none() where it is free.
  std::vector<MotionId> support;

  std::size_t size() const { return rest_position.size(); }
};

/// |T| rows; only `component` and `stress` change.
struct ElementColumns {
  std::vector<ShapeGradient> shape_gradient;  ///< 1/m, rest configuration
  std::vector<double> rest_volume;            ///< m^3, positive
  std::vector<double> mass;                   ///< kg
  std::vector<MaterialId> material;
  /// Written by the code that splits (fracture); `rebuild` carries it over to the vertices.
  std::vector<ComponentId> component;
  /// Pa, symmetric, body frame, tension positive; the mean over a tetrahedron of second order.
  std::vector<Mat3> stress;
  /// none() in tetrahedra of first order; empty where all are.
  std::vector<EdgeNodes> edge_nodes;
  /// Pa, at the four corners, linear between them; empty where all are of first order. Written with
  /// `stress`, which those of first order have at all corners.
  std::vector<std::array<Mat3, 4>> corner_stress;

  std::size_t size() const { return rest_volume.size(); }
};

/// The rows of a tetrahedron's nodes: its four corners; of one of second order then the six in the
/// middles of its edges.
struct ElementNodes {
  std::array<VertexId, 10> row;
  std::size_t count = 4;

  const VertexId* begin() const { return row.data(); }
  const VertexId* end() const { return row.data() + count; }
};

inline bool is_second_order(const ElementColumns& elements, TetId t) {
  return !elements.edge_nodes.empty() && !elements.edge_nodes[t.index()][0].is_none();
}

inline ElementNodes nodes_of(const ElementColumns& elements, std::span<const Corners> corners,
                             TetId t) {
  const Corners& c = corners[t.index()];
  ElementNodes nodes{{c[0], c[1], c[2], c[3]}};
  if (is_second_order(elements, t)) {
    std::ranges::copy(elements.edge_nodes[t.index()], nodes.row.begin() + 4);
    nodes.count = 10;
  }
  return nodes;
}

/// Appends a copy of row `from` with everything it has (rest position, position, velocity, flags)
/// and gives its row. The masses of both are stale until `rebuild`.
VertexId append_copy(VertexColumns& vertices, VertexId from);

}  // namespace sunder
