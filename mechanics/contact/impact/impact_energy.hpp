// SPDX-License-Identifier: MIT
// How much energy what meets in a step could put into a component: whether a blow could break it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "mechanics/contact/contact_step.hpp"
#include "topology/base/union_find.hpp"

namespace sunder {

/// What an energy bound says of a blow.
enum class Verdict {
  breaks,           ///< the energy at hand reaches what the component's weakest star needs
  spared_by_pair,   ///< it does not: the component meets one other, at too low a speed
  spared_by_island  ///< nor does all the energy of what touches it, directly or through others
};

/// Bounds on the energy of deformation that components can come to within a step, from what meets
/// in it. What is in it already, U + T_d, and the smaller of
/// - the pair's, where it meets one thing only: m v^2 / 2, m the mass of the lighter one, v the
///   largest speed of the two surfaces against each other (mass centres, spins with their arms, a
///   step of gravity). What is lost at most, as they go on as one rigid body, is less than the
///   energy of one in the motion of the other. Where the other one meets others too, they may push
///   it: then m is the component's own mass and v counts twice the fastest of the island.
/// - the island's, of all that is joined by contacts: kinetic energy against the obstacle or
///   support that it touches, or against its mass centre where it touches none, strain energy, and
///   the work of gravity in the step. Obstacles that move differently can do any work: no bound.
/// Needs: no surface loads on what is judged. Built in O(contacts), an island is summed once when
/// it is asked for.
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
  /// kg; infinite for what is driven or held.
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
  /// What meets a node that is driven or held, and that node.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> grounds_;
};

/// J in a component: strain energy, and kinetic energy of its deformation.
double deformation_energy(const MechanicsState& state, const Component& component);

/// Whether that is at least `least`, J. The sum stops as soon as it is.
bool deforms_by(const MechanicsState& state, const Component& component, double least);

}  // namespace sunder
