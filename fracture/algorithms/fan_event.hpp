// SPDX-License-Identifier: MIT
// The result of one fan.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "fracture/cracks/crack_label.hpp"
#include "mechanics/state/vec3.hpp"
#include "topology/kernel/components.hpp"
#include "topology/kernel/split_face.hpp"

namespace sunder {

/// The effect of one fan. Rows are those after the fan and are never renumbered.
struct FanEvent {
  /// The vertex that broke, its point in the body's mesh, and its rest position, m.
  VertexId vertex;
  std::uint32_t point = 0;
  Vec3 rest_position = Vec3::Zero();
  /// Normal of the fracture plane, rest frame, unit length.
  Vec3 normal = Vec3::Zero();
  /// Largest principal stress, and the threshold that it reached, Pa.
  double stress = 0;
  double strength = 0;
  /// Round of the search, counted from 0. Fans of one round were chosen in the same state.
  std::uint32_t round = 0;
  /// The crack of the fan with `CrackMode::object`, its anchor (a point of the plane, m, rest
  /// frame), and the tetrahedra that the crack took a side for.
  CrackId crack;
  Vec3 anchor = Vec3::Zero();
  std::vector<CrackLabel> labels;
  /// One entry per face, in the order of the splits. Empty if all tetrahedra lay on one side of the
  /// plane, or other fans had split the faces: then nothing changed.
  std::vector<FaceSplit> faces;
  /// Nodes in the middles of edges that split with the faces, in bodies of order 2.
  std::vector<VertexCopy> nodes;
  /// Predictions of the oracle, and components found.
  ComponentUpdate components;
  /// Tetrahedra visited by splits, search and strengths: a measure of the cost that is the same on
  /// every machine.
  std::size_t visited = 0;
};

/// Called with the vertex of the fan that is chosen or split from this moment on, and with none()
/// between fans. It serves measurements of time, because no algorithm here reads a clock.
using FanWatch = std::function<void(VertexId)>;

}  // namespace sunder
