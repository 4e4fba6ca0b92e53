// SPDX-License-Identifier: MIT
// Central differences, and the force of a tie from one half step to the next.
#include "tests/experiments/chain/chain.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace sunder::chain {
namespace {

/// Pa: mean of sigma (1 - d / d_c) over openings d from `from` to `to`, 0 beyond d_c.
double mean_softening(double sigma, double critical, double from, double to) {
  const auto energy = [&](double d) {
    const double x = std::min(d, critical);
    return sigma * x * (1 - x / (2 * critical));
  };
  if (to <= critical) return sigma * (1 - (from + to) / (2 * critical));
  return (energy(to) - energy(from)) / (to - from);
}

/// Pa/m of a tie that unloads; only where it has opened.
double secant(const ChainTie& tie, double critical) {
  return tie.strength * std::max(0.0, 1 - tie.largest / critical) / tie.largest;
}

/// Pa: mean of the law from the tie's opening to `to`, which is more than its largest.
double mean_law(const ChainTie& tie, double critical, double to) {
  const double loading = mean_softening(tie.strength, critical, tie.largest, to);
  if (tie.opening >= tie.largest) return loading;
  const double below = tie.largest - tie.opening, beyond = to - tie.largest;
  const double again = secant(tie, critical) * (tie.largest + tie.opening) / 2;
  return (below * again + beyond * loading) / (below + beyond);
}

/// m: the opening d = free - give f(d), f being the mean of the law from the tie's opening to d.
double opening_of(const ChainTie& tie, double critical, double give, double free) {
  if (tie.largest >= critical) return free;
  if (tie.largest == 0) {
    if (free <= give * tie.strength) return 0;
  } else {
    const double k = secant(tie, critical);
    const double to = (free - give * k * tie.opening / 2) / (1 + give * k / 2);
    if (to <= tie.largest) return to;
  }
  // d + give f(d) grows with d, for give sigma / d_c is far below 1.
  double low = tie.largest, high = free;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (middle + give * mean_law(tie, critical, middle) < free ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// J/m^2 in a tie: stored, and dissipated by the law.
std::pair<double, double> energy_of(const ChainTie& tie, double critical) {
  if (tie.largest == 0) return {0, 0};
  const double stored = secant(tie, critical) * tie.opening * tie.opening / 2;
  return {stored, tie.strength * std::min(tie.largest, critical) / 2};
}

}  // namespace

Chain::Chain(ChainSettings settings) : settings_(std::move(settings)) {
  const ChainSettings& s = settings_;
  const bool positive = s.young_modulus > 0 && s.density > 0 && s.fracture_energy > 0 &&
                        s.length > 0 && s.step > 0 && s.step < 1 && s.viscosity >= 0;
  if (!positive || s.strength.size() < 3) {
    throw std::invalid_argument("a chain wants three nodes, positive numbers and a step below 1");
  }
  const std::size_t n = s.strength.size();
  const bool ring = s.shape == Shape::ring;
  const std::size_t bars = ring ? n : n - 1;
  const double half_angle = ring ? std::acos(-1.0) / double(n) : 0;
  cell_ = ring ? 2 * std::sin(half_angle) : s.length / double(bars);
  along_ = std::cos(half_angle);
  outwards_ = std::sin(half_angle);
  time_step_ = s.step * cell_ / std::sqrt(s.young_modulus / s.density);
  left_.assign(n, {s.density * cell_ / 2});
  right_ = left_;
  if (!ring) left_.front().mass = right_.back().mass = 0;
  ties_.resize(n);
  stress_.assign(n, 0);
  viscous_ = stress_;
}

void Chain::set_along(std::size_t node, double displacement, double speed) {
  for (ChainSide* side : {&left_[node], &right_[node]}) {
    side->along = displacement;
    side->along_speed = speed;
  }
}

void Chain::set_outwards(std::size_t node, double displacement, double speed) {
  for (ChainSide* side : {&left_[node], &right_[node]}) {
    side->outwards = displacement;
    side->outwards_speed = speed;
  }
}

double Chain::stress(std::size_t node) const {
  const std::size_t next = node + 1 < nodes() ? node + 1 : 0;
  if (next == 0 && settings_.shape == Shape::bar) return 0;
  const ChainSide &from = right_[node], &to = left_[next];
  const double longer =
      along_ * (to.along - from.along) + outwards_ * (to.outwards + from.outwards);
  return settings_.young_modulus * longer / cell_;
}

double Chain::critical_opening(const ChainTie& tie) const {
  return 2 * settings_.fracture_energy / tie.strength;
}

/// Both sides of a node that has split, `pull` of each being its bar's, away from the node.
void Chain::move_tied(std::size_t node, double left_pull, double right_pull) {
  ChainSide &left = left_[node], &right = right_[node];
  ChainTie& tie = ties_[node];
  const double h = time_step_, critical = critical_opening(tie);
  const double gap = right.along - left.along;
  const double speed = right.along_speed - left.along_speed;
  // Both sides weigh the same, m: the opening goes as one mass m / 2 under the mean of the pulls.
  const double give = h * h / left.mass, mean_pull = (left_pull + right_pull) / 2;
  const double free = gap + h * speed / 2 + give * mean_pull;
  const ChainTie earlier = tie;
  tie.opening = opening_of(tie, critical, give, free);
  const bool shuts = 2 * tie.opening < gap;  // The gap at the step's end would be negative.
  if (shuts) tie.opening = gap / 2;
  tie.largest = std::max(tie.largest, tie.opening);
  const double force = (free - tie.opening) / give;
  if (shuts) {
    const auto [was_stored, was_lost] = energy_of(earlier, critical);
    const auto [stored, lost] = energy_of(tie, critical);
    contact_ += force * (tie.opening - earlier.opening) - (stored + lost - was_stored - was_lost);
  }
  left.along_speed += h / left.mass * (force - left_pull);
  right.along_speed += h / right.mass * (right_pull - force);
}

void Chain::step() {
  const std::size_t n = nodes();
  const bool ring = settings_.shape == Shape::ring;
  const double h = time_step_, share = time_ > 0 ? settings_.viscosity / settings_.step : 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double now = stress(k);
    damped_ += damped(k, now);
    viscous_[k] = share * (now - stress_[k]);
    stress_[k] = now;
  }
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t before = k > 0 ? k - 1 : n - 1;
    const double to_left = stress_[before] + viscous_[before];
    const double to_right = stress_[k] + viscous_[k];
    ChainSide &left = left_[k], &right = right_[k];
    const bool is_end = !ring && (k == 0 || k + 1 == n);
    const double mean = (to_left + to_right) / 2;
    ChainTie& tie = ties_[k];
    const double elastic = (stress_[before] + stress_[k]) / 2;
    if (!is_end && tie.strength == 0 && elastic >= settings_.strength[k]) {
      tie.strength = std::max(mean, elastic);
    }
    const bool apart = tie.strength > 0;
    if (apart) {
      move_tied(k, along_ * to_left, along_ * to_right);
    } else {
      const double change = h * along_ * (to_right - to_left) / (left.mass + right.mass);
      left.along_speed += change;
      right.along_speed += change;
    }
    if (ring) {  // Each side is pulled inwards by its own bar, by half of both while it is whole.
      left.outwards_speed -= h * outwards_ * (apart ? to_left : mean) / left.mass;
      right.outwards_speed -= h * outwards_ * (apart ? to_right : mean) / right.mass;
    }
    for (ChainSide* side : {&left, &right}) {
      side->along += h * side->along_speed;
      side->outwards += h * side->outwards_speed;
    }
  }
  if (time_ == 0) {
    const ChainEnergy e = energy();
    before_ = e.kinetic + e.strain + e.stored + e.dissipated + e.contact + e.damped;
  }
  time_ += h;
}

std::vector<std::size_t> Chain::broken() const {
  std::vector<std::size_t> nodes;
  for (std::size_t k = 0; k < ties_.size(); ++k) {
    if (ties_[k].strength > 0 && ties_[k].largest >= critical_opening(ties_[k])) nodes.push_back(k);
  }
  return nodes;
}

std::size_t Chain::live(double share) const {
  return static_cast<std::size_t>(
      std::count_if(ties_.begin(), ties_.end(), [&](const ChainTie& tie) {
        const double critical = tie.strength > 0 ? critical_opening(tie) : 0;
        return tie.largest < critical && tie.largest > share * critical;
      }));
}

/// The energy that the viscous stress of the last step has taken, if the stress is now `now`.
double Chain::damped(std::size_t bar, double now) const {
  if (!(settings_.viscosity > 0)) return 0;
  const double last = viscous_[bar] * settings_.step / settings_.viscosity;
  return cell_ / settings_.young_modulus * viscous_[bar] * (now - stress_[bar] + last) / 2;
}

ChainEnergy Chain::energy() const {
  ChainEnergy e{.before = before_, .contact = contact_, .damped = damped_};
  for (std::size_t k = 0; k < nodes(); ++k) {
    for (const ChainSide* side : {&left_[k], &right_[k]}) {
      const double squared =
          side->along_speed * side->along_speed + side->outwards_speed * side->outwards_speed;
      e.kinetic += side->mass * squared / 2;
    }
    e.strain += cell_ / (2 * settings_.young_modulus) * stress_[k] * stress(k);
    e.damped += damped(k, stress(k));
    if (ties_[k].strength == 0) continue;
    const auto [stored, lost] = energy_of(ties_[k], critical_opening(ties_[k]));
    e.stored += stored;
    e.dissipated += lost;
  }
  return e;
}

double Chain::momentum() const {
  double sum = 0;
  for (std::size_t k = 0; k < nodes(); ++k) {
    sum += left_[k].mass * left_[k].along_speed + right_[k].mass * right_[k].along_speed;
  }
  return sum;
}

}  // namespace sunder::chain
