// SPDX-License-Identifier: MIT
// The quantities that `sunder chart` judges a run by.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "fracture/simulation/simulation_state.hpp"

namespace sunder {

enum class Quantity {
  position,
  peak_stress,
  end_stress,
  energy,
  momentum,
  angular_momentum,
  first_fan_time,
  first_fan_place,
  fans,
  largest_piece,
  pieces,
  debris,
};

struct QuantityTraits {
  Quantity quantity;
  /// The name in the command line and files, the unit, and a description.
  std::string_view name, unit, text;
  bool is_vector = false;
  /// The divisor of errors, in words.
  std::string_view scale;
};

/// All of them, in the order of the enum.
std::span<const QuantityTraits> quantities();
const QuantityTraits& traits_of(Quantity quantity);

/// The quantity to measure, and its point.
struct Probe {
  Quantity quantity = Quantity::position;
  /// m, in the coordinates of the first body's mesh; `position` follows the material there.
  Vec3 point = Vec3::Zero();
  /// m^3: pieces below it are `debris`.
  double debris_volume = 0;
};

/// Follows one run. Call `see` before the first step, after each part of a step where
/// `watches_parts`, and after each step.
class Measure {
 public:
  /// Finds the tetrahedron of the first body that holds the point, or comes nearest to it. O(|T|).
  Measure(const Probe& probe, const Simulation& start);

  /// Whether the quantity is an extreme over time, for which a step alone is too coarse.
  bool watches_parts() const;
  void see_part(const Simulation& now);
  void see_step(const Simulation& now, const StepReport& report);

  /// The quantity at the end, a scalar in the first place; none where nothing broke.
  std::optional<Vec3> value(const Simulation& end) const;
  /// Errors of a run that should have given `reference` are divided by this: see QuantityTraits.
  double scale(const Vec3& reference) const;
  /// The same quantity at the start; zero for a quantity that only a run has, such as its fans.
  const Vec3& at_start() const { return at_start_; }

 private:
  Vec3 position(const Simulation& now) const;
  Vec3 state_value(const Simulation& now) const;

  Probe probe_;
  TetId holder_;
  Eigen::Vector4d weight_ = Eigen::Vector4d::Zero();
  Vec3 at_start_ = Vec3::Zero();
  double potential_at_start_ = 0, extent_ = 0, peak_ = 0, fans_ = 0;
  std::optional<Vec3> first_fan_;
};

}  // namespace sunder
