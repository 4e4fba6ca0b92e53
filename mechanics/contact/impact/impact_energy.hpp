// SPDX-License-Identifier: MIT
// How much energy the contacts of a step could put into a component: whether a blow could break it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "mechanics/contact/contact_step.hpp"
#include "topology/base/union_find.hpp"

namespace sunder {

/// The verdict of an energy bound on a blow.
enum class Verdict {
  breaks,           ///< the energy at hand reaches the need of the component's weakest star
  spared_by_pair,   ///< it does not: the component meets one other, at too low a speed
  spared_by_island  ///< nor does the energy of all bodies that touch it, directly or through others
};

/// Bounds on the deformation energy that components can come to within a step from its contacts:
/// their present energy U + T_d, plus the smaller of
/// - the pair's bound, where the component meets one thing only: m v^2 / 2. m is the mass of the
///   lighter one, v the largest relative speed of the two surfaces (mass centres, spins with their
///   arms, a step of gravity). The largest loss, in a perfectly inelastic collision, is below the
///   kinetic energy of one body in the frame of the other. If the other body meets others too, they
///   may push it. Then m is the component's own mass and v counts twice the fastest of the island.
/// - the island's bound, over all bodies joined by contacts: kinetic energy, strain energy, and the
///   work of gravity in the step. The kinetic energy is relative to the obstacle or support that
///   the island touches, else to its mass centre. Obstacles that move differently can do any work:
///   no bound.
/// Needs: no surface loads on the judged component. Built in O(contacts), an island is summed once
/// at its first use.
class ImpactEnergy {
 public:
  ImpactEnergy(const ContactStep& step, std::span<const ContactPoint> contacts);

  /// Whether the component could come to `threshold` J.
  Verdict judge(ComponentId id, double threshold);

 private:
  static constexpr std::uint32_t none = 0xffffffffu;
  /// A component, a free ball, or a driven obstacle: in this order.
  struct Node {
    std::uint32_t other = none;  ///< the one it meets; none: meets nothing
    bool meets_several = false;
  };
  struct Island {
    std::vector<std::uint32_t> members;  ///< empty: not summed yet
    std::vector<std::uint32_t> held;     ///< held components that they touch
    double kinetic = 0, gravity = 0;     ///< J
    std::optional<double> strain;        ///< J, once it is asked for
    double fastest = 0;                  ///< m/s, of any surface against `velocity`
    Vec3 velocity = Vec3::Zero();        ///< m/s, of its ground, else of its mass centre
  };

  void join(std::uint32_t a, std::uint32_t b);
  bool is_driven(std::uint32_t node) const;
  /// kg; infinite for a driven or held node.
  double mass_of(std::uint32_t node) const;
  Vec3 velocity_of(std::uint32_t node) const;
  /// m/s, of the fastest point of its surface against its own velocity.
  double surface_speed_of(std::uint32_t node) const;
  double kinetic_against(std::uint32_t node, const Vec3& velocity) const;
  double strain_of(std::uint32_t node) const;
  /// The island of a node; without its strain energy.
  Island& island_of(std::uint32_t node);
  double strain_of_island(Island& island);
  /// Whether all the energy of a node's island is at least `least`, J. Motion is summed first: it
  /// is often enough, and costs less than strain.
  bool island_reaches(std::uint32_t node, double least);
  /// The same of a held component: its own energy and that of all islands that meet it.
  bool held_reaches(std::uint32_t node, double least);
  double pair_bound(std::uint32_t node);

  const ContactStep& step_;
  std::size_t components_ = 0;
  std::vector<Node> nodes_;
  UnionFind joined_;             ///< nodes of one island
  std::vector<Island> islands_;  ///< row = root
  /// Nodes that meet a driven or held node, each with that node.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> grounds_;
};

/// J in a component: strain energy, and kinetic energy of its deformation.
double deformation_energy(const MechanicsState& state, const Component& component);

/// Whether that is at least `least`, J. The sum stops as soon as it is.
bool deforms_by(const MechanicsState& state, const Component& component, double least);

}  // namespace sunder
