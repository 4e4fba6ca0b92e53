// SPDX-License-Identifier: MIT
// Loads on a body's surface and vertices, kept on corners of tetrahedra so that splits divide them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mechanics/state/mechanics_state.hpp"

namespace sunder {

struct Loads;

/// A force on one node of a tetrahedron. The force on a vertex is the sum over the corners of its
/// star. So when it splits every copy keeps the forces on its own side.
struct CornerLoad {
  CornerId corner;
  /// Place of the edge, with an end at the corner, on the middle of which it acts; -1: on the
  /// corner.
  int edge = -1;
  Vec3 force = Vec3::Zero();  ///< N, once fully raised; world, or the body frame where it turns
  /// Turns with the frame of the corner's component (pressure); else it keeps its direction.
  bool turns = false;
  double ramp_time = 0;  ///< s over which it is raised linearly; 0: at once
  static constexpr std::uint32_t no_load = 0xffffffffU;
  /// Its load of the scene: row of `BodySettings::loads`, body by body; or `no_load`.
  std::uint32_t load = 0;
};

/// The node on which a load acts. `corners`: |T|, the present ones.
VertexId node_of(const CornerLoad& load, const ElementColumns& elements,
                 std::span<const Corners> corners);

/// N, world, at `time` (s). `orientation`: of the component that the corner belongs to.
Vec3 force_at(const CornerLoad& load, double time, const Eigen::Quaterniond& orientation);

/// A pressure on the face of tetrahedron `t` opposite to `place`, as three equal loads in the body
/// frame, on its corners, or of second order in the middles of its edges, where an even traction
/// acts alone: p V grad N_place each, since the outward area vector is -3 V grad N_place.
/// `pressure`: Pa, pushes into the body; negative pulls.
std::array<CornerLoad, 3> face_pressure(const ElementColumns& elements, TetId t, int place,
                                        double pressure);

/// A force on vertex `v` as corner loads of its `star`, in the ratio of the tetrahedra's shares of
/// the vertex's mass. `force`: N, world. Appends to `loads`.
void add_vertex_force(std::vector<CornerLoad>& loads, const MechanicsState& state,
                      std::span<const CornerId> star, const Vec3& force);

/// Adds `loads` at `time` (s; infinite: fully raised) to `force` (N, world, |V| rows, resized with
/// zeros). `corners`: |T|, as they are now. O(loads).
void add_corner_loads(std::vector<Vec3>& force, std::span<const CornerLoad> loads,
                      const MechanicsState& state, std::span<const Corners> corners, double time);

/// The same, separated: loads that turn with their body go into `sum.turning` too.
void add_corner_loads(Loads& sum, std::span<const CornerLoad> loads, const MechanicsState& state,
                      std::span<const Corners> corners, double time);

}  // namespace sunder
