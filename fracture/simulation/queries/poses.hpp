// SPDX-License-Identifier: MIT
// Pieces as rigid bodies, and the contacts of a step: what a host draws and hears.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "fracture/simulation/simulation.hpp"
#include "mechanics/state/pose.hpp"

namespace sunder {

/// A piece as a rigid body. A vertex is drawn at centre + orientation (rest position -
/// `rest_centre`).
struct PiecePose {
  ComponentId id;
  std::size_t body = 0;             ///< row of its body
  ComponentId parent;               ///< the piece that it came off; none(): of the start
  double mass = 0;                  ///< kg
  Vec3 rest_centre = Vec3::Zero();  ///< m, in the mesh's coordinates
  Pose reference;                   ///< its rigid reference (section 3.2 of the paper)
  Pose drawn;                       ///< follows the reference smoothly (section 3.3)
  Vec3 velocity = Vec3::Zero();     ///< m/s, of its mass centre
};

/// All pieces, ascending by id. O(pieces).
std::vector<PiecePose> piece_poses(const Simulation& simulation);

/// A contact with an impulse. Each side is a piece, or an obstacle with `piece` none().
struct ContactEvent {
  struct Side {
    ComponentId piece;
    std::optional<std::uint32_t> obstacle;  ///< its row
  };
  Side a, b;
  Vec3 place = Vec3::Zero();    ///< m, world
  Vec3 impulse = Vec3::Zero();  ///< N s, on `a`; `b` gets the opposite
  double duration = 0;          ///< s, the part of a step in which it acted
};

/// The contacts with an impulse in the last step, without those of resting rubble. O(contacts).
std::vector<ContactEvent> contact_events(const Simulation& simulation);

}  // namespace sunder
