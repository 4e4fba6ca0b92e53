// SPDX-License-Identifier: MIT
// What one fan did.
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

/// What one fan did. Rows as they are after it; nothing is renumbered later.
struct FanEvent {
  /// The vertex that broke, its point in the body's mesh, and its rest position, m.
  VertexId vertex;
  std::uint32_t point = 0;
  Vec3 rest_position = Vec3::Zero();
  /// Normal of the fracture plane, rest frame, unit length.
  Vec3 normal = Vec3::Zero();
  /// Largest principal stress and the threshold it reached, Pa.
  double stress = 0;
  double strength = 0;
  /// Round of its search, counted from 0: fans of one round were decided on the same state.
  std::uint32_t round = 0;
  /// The crack that it is of, with `CrackMode::object`, its anchor (m, rest frame, a point of the
  /// plane) and the tetrahedra that the crack decided on with it.
  CrackId crack;
  Vec3 anchor = Vec3::Zero();
  std::vector<CrackLabel> labels;
  /// One entry a face, in the order in which they were split; empty when every tetrahedron lay on
  /// one side of the plane, or other fans have split them all: then nothing changed.
  std::vector<FaceSplit> faces;
  /// Nodes in the middles of edges that came apart with them, in bodies of second order.
  std::vector<VertexCopy> nodes;
  /// What the oracle predicted and what there was to find.
  ComponentUpdate components;
  /// Tetrahedra visited by splits, search and strengths: a measure of the cost without a clock.
  std::size_t visited = 0;
};

/// Told on which vertex's fan work goes on from now (choosing it, later splitting it), `none()`
/// when on no fan. For whoever measures time: no algorithm here reads a clock.
using FanWatch = std::function<void(VertexId)>;

}  // namespace sunder
