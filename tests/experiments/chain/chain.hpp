// SPDX-License-Identifier: MIT
// A one-dimensional cohesive program: bars between masses, with nodes that split at their strength.
// It includes nothing of Sunder, so that Sunder can be compared with it.
#pragma once

#include <cstddef>
#include <vector>

namespace sunder::chain {

/// A closed ring of radius 1 m with masses that move along it and outwards, or a straight bar.
enum class Shape { ring, bar };

/// The settings of a chain. All numbers > 0.
struct ChainSettings {
  Shape shape = Shape::bar;
  double young_modulus = 30e9;  ///< E, Pa
  double density = 2400;        ///< rho, kg/m^3
  double fracture_energy = 33;  ///< G_c, J/m^2
  double length = 1;            ///< m, of a bar; a ring has 2 pi
  double step = 0.1;            ///< of a wave's way through a cell, < 1
  /// The stress of a bar is E times the strain plus E times this (cell / c) times the rate of
  /// strain. The former decides about strength. >= 0, and with the step: step^2 + 2 step viscosity
  /// < 1.
  double viscosity = 0;
  /// Pa, of each node: `cells` of a ring, `cells` + 1 of a bar with ends that do not split.
  std::vector<double> strength;
};

/// A node that has split, or not yet.
struct ChainTie {
  double strength = 0;  ///< sigma, Pa: the stress at which it split; 0: it has not
  double opening = 0;   ///< m, mean over the last step
  double largest = 0;   ///< m, of those
};

/// One side of a node: the mass on the bar to its left or on the one to its right.
struct ChainSide {
  double mass = 0;                 ///< kg/m^2 of cross-section
  double along = 0, outwards = 0;  ///< m, displacements; outwards is along the ring's radius
  double along_speed = 0, outwards_speed = 0;  ///< m/s, half a step earlier
};

/// Per m^2 of cross-section, J. `before` is the sum that all the others should have.
struct ChainEnergy {
  double before = 0;  ///< after the first step
  double kinetic = 0, strain = 0;
  double stored = 0;      ///< in ties that have opened in part
  double dissipated = 0;  ///< by the law, up to the largest openings
  double contact = 0;     ///< in impacts of the two sides of a node, and of closing ties
  double damped = 0;      ///< in bars, by viscosity
};

/// Masses between bars with central differences, strain linear in displacements. A node splits into
/// two masses when its mean stress reaches its strength, tied by the linear irreversible law
/// [Camacho and Ortiz 1996]: sigma (1 - d / d_c) opening, d_c = 2 G_c / sigma; through the origin
/// unloading and loading again; when shut, a contact that does not bounce. The force of a tie is
/// the mean of the law from one half-step opening to the next, solved for at each node alone. So no
/// tie limits the step, and kinetic energy at half steps, strain energy (of products of successive
/// strains), ties and contact add up to rounding.
class Chain {
 public:
  /// Throws std::invalid_argument where a number of the settings is not as they say.
  explicit Chain(ChainSettings settings);

  /// Displacement (m) and speed (m/s) of a node that has not split; outwards is a ring's.
  void set_along(std::size_t node, double displacement, double speed);
  void set_outwards(std::size_t node, double displacement, double speed);

  /// One step. The first one takes the energy that all later ones are compared with.
  void step();

  double time() const { return time_; }
  double time_step() const { return time_step_; }
  double cell() const { return cell_; }
  std::size_t nodes() const { return ties_.size(); }
  /// Pa, in the bar to the right of a node.
  double stress(std::size_t node) const;
  const ChainSide& left(std::size_t node) const { return left_[node]; }
  const ChainSide& right(std::size_t node) const { return right_[node]; }
  const ChainTie& tie(std::size_t node) const { return ties_[node]; }
  /// m: the opening that ends the tie of a node.
  double critical_opening(const ChainTie& tie) const;
  /// Nodes that have come apart for good, in their order.
  std::vector<std::size_t> broken() const;
  /// Nodes that are tied and have opened by more than `share` of their critical opening.
  std::size_t live(double share) const;
  /// Ledger of the last step.
  ChainEnergy energy() const;
  /// kg/(m s) along a bar: sum of masses times speeds.
  double momentum() const;

 private:
  double damped(std::size_t bar, double now) const;
  void move_tied(std::size_t node, double left_pull, double right_pull);

  ChainSettings settings_;
  double cell_ = 0, time_ = 0, time_step_ = 0;
  double along_ = 1, outwards_ = 0;  ///< cosine and sine of half the angle of a bar
  std::vector<ChainSide> left_, right_;
  std::vector<ChainTie> ties_;
  std::vector<double> stress_;   ///< Pa, of bars, where the masses were a step before
  std::vector<double> viscous_;  ///< Pa, of bars, in the last step
  double before_ = 0, contact_ = 0, damped_ = 0;
};

}  // namespace sunder::chain
