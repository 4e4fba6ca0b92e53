// SPDX-License-Identifier: MIT
// A connected component as mechanics sees it: its rows, its mass and the state of its frame.
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "mechanics/state/columns.hpp"
#include "mechanics/state/rung.hpp"

namespace sunder {

/// Change of a component's strain energy by a measure of element stresses, J.
struct StrainChange {
  double before = 0, after = 0;
  double difference = 0;  ///< Dd . K Dd: twice the energy of the difference of the stresses
};

/// A component and its rigid reference (section 3.2): the reference of vertex i is
/// centre + R (rest_position_i - rest_centre), R = orientation.
/// All sums over vertices are weighted with the lumped masses.
struct Component {
  ComponentId id;
  std::vector<VertexId> vertices;  ///< ascending
  std::vector<TetId> tetrahedra;   ///< ascending
  double mass = 0;                 ///< kg
  Vec3 rest_centre =
      Vec3::Zero();  ///< m, mass centre of its REST positions: its own, not the body's
  Mat3 rest_inertia = Mat3::Zero();  ///< kg m^2, of the lumped vertices about `rest_centre`
  double rest_radius = 0;            ///< m, farthest rest position from `rest_centre`
  /// s, the time of a compression wave's way through a mean cell: the mean of (6 V)^(1/3) / c.
  double cell_travel = 0;

  Vec3 centre = Vec3::Zero();  ///< c, m; the mass centre unless supported
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< R, body to world
  Vec3 momentum = Vec3::Zero();                                     ///< P, kg m/s, world
  Vec3 angular_momentum = Vec3::Zero();                             ///< L about c, kg m^2/s, world

  bool supported = false;              ///< holds a vertex with a prescribed motion
  bool partly_held = false;            ///< holds one that is held along one or two axes only
  Vec3 frame_velocity = Vec3::Zero();  ///< m/s; the frame of a supported component moves with it
  /// A rigid body at all times, of its rest shape, with six degrees of freedom and no finite
  /// elements. It is one free tetrahedron, or a component changed by `turn_rigid`.
  bool rigid = false;
  Rung rung = Rung::full;
  /// rad: largest turn of a tetrahedron against the frame when its stress was last computed (size
  /// of the skew part of the displacement gradient).
  double largest_turn = 0;
  StrainChange strain_change;  ///< then, where asked for (`StepInput::measures_strain`); else 0
};

/// Whether a component is one free tetrahedron of first order (`IntegratorSettings::isolated`); one
/// of second order is a rigid body like larger ones.
inline bool is_isolated(const Component& component) {
  return component.rigid && component.tetrahedra.size() == 1 && component.vertices.size() == 4;
}

}  // namespace sunder
