// SPDX-License-Identifier: MIT
// Impulses on obstacles and held boxes, and works of loads: added up part by part.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "fracture/scene/scene.hpp"
#include "fracture/simulation/ledger/energy_ledger.hpp"
#include "fracture/strength/held_boxes.hpp"

namespace sunder {

/// Zeros, as many as the scene has obstacles, held boxes and loads.
ForceReport no_forces(const Scene& scene);

/// Finds the held boxes that hold a node. Looks each motion up once.
class HeldRegions {
 public:
  static constexpr std::size_t none = no_holder;

  HeldRegions(const Scene& scene, std::span<const BodyRows> bodies);

  /// Rows of `ForceReport::held`, one along each axis of the node's mesh, or `none`.
  Holders of(const MechanicsState& state, VertexId node);

 private:
  const Scene& scene_;
  std::span<const BodyRows> bodies_;
  std::vector<std::size_t> first_;  ///< row of a body's first box
  std::vector<std::optional<Holders>> of_motion_;
};

/// A held component with nodes that took the raised velocities of their supports.
struct RaisedComponent {
  const Component& component;
  const Impulse& given;             ///< on the whole component
  const std::vector<Vec3>& before;  ///< m/s, velocities of all nodes
};
/// Adds the impulses with which supports changed the velocities of a component's nodes.
void add_raised_forces(ForceReport& forces, HeldRegions& regions, const MechanicsState& state,
                       const RaisedComponent& raised);

/// Adds the impulses of an adopted part on obstacles and held boxes, and the works of its loads.
/// `supports`: its `support_impulses`. `end`: s, of the part. O(contacts + loads + held nodes), and
/// one pass over the tetrahedra of components that several boxes hold.
void add_part_forces(ForceReport& forces, HeldRegions& regions, const AdoptedPart& part,
                     std::span<const Impulse> supports, double end);

}  // namespace sunder
