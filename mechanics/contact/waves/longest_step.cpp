// SPDX-License-Identifier: MIT
// Shares of the masses, and the steps that they allow.
#include "mechanics/contact/waves/longest_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace sunder {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrix63 = Eigen::Matrix<double, 6, 3>;

/// (V C)^1/2 B_a of a node with gradient g, in Mandel's notation: K_e,ab is the product of those of
/// a and b.
Matrix63 root_of_node(const Vec3& g, double lambda, double mu) {
  const double shear = std::sqrt(2 * mu);
  const double bulk = (std::sqrt(3 * lambda + 2 * mu) - shear) / 3;
  const double half = std::sqrt(mu);
  Matrix63 E = Matrix63::Zero();
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) E(i, j) = bulk * g[j];
    E(j, j) += shear * g[j];
    const int k = (j + 1) % 3, l = (j + 2) % 3;
    E(3 + l, j) = half * g[k];
    E(3 + k, j) = half * g[l];
  }
  return E;
}

/// At least the largest eigenvalue of a positive matrix, by the trace of its 16th power.
double largest_eigenvalue_bound(Matrix6 S) {
  constexpr int squarings = 4;
  std::array<double, squarings + 1> trace{};
  for (int k = 0;; ++k) {
    trace[static_cast<std::size_t>(k)] = S.trace();
    if (k == 0 && !(trace[0] > 0)) return 0;
    S /= trace[static_cast<std::size_t>(k)];
    if (k == squarings) break;
    const Matrix6 before = S;
    S.noalias() = before.lazyProduct(before);
  }
  double root = trace.back();
  for (int k = squarings - 1; k >= 0; --k) {
    root = trace[static_cast<std::size_t>(k)] * std::sqrt(root);
  }
  return root;
}

/// Elements of a body that take part: place in the body, block and lane.
template <class Visit>
void for_each_unscaled(const WaveBodies& waves, const WaveBody& body, Visit visit) {
  for (std::size_t k = body.first_cell; k < body.end_cell; ++k) {
    if (waves.is_scaled[waves.cells[k].index()]) continue;
    const std::size_t place = k - body.first_cell;
    visit(waves.cells[k], waves.blocks[body.first_block + place / 4], place % 4);
  }
}

bool is_first_order(const WaveBody& body) { return body.first_second == body.end_second; }

/// Row = node: the sum of the claims of its elements, each `claim` times c k_a.
std::vector<double> sums_of_claims(const WaveBodies& waves, const std::vector<double>& claim) {
  std::vector<double> sums(waves.nodes.size(), 0);
  for (const WaveBody& body : waves.bodies) {
    if (!is_first_order(body)) continue;
    for_each_unscaled(waves, body, [&](TetId t, const FirstOrderBlock& block, std::size_t lane) {
      for (std::size_t a = 0; a < 4; ++a) {
        sums[block.node[a][lane]] += claim[t.index()] * waves.stiffness[t.index()][a];
      }
    });
  }
  return sums;
}

/// Highest eigenvalue, 1/s^2, of an element with its share of the masses. Computed once for the
/// same masses.
double highest_of_share(WaveBodies& waves, TetId t, std::size_t round, const FirstOrderBlock& block,
                        std::size_t lane, double claim, const std::vector<double>& sums) {
  std::array<double, 4> inverse;
  for (std::size_t a = 0; a < 4; ++a) {
    const std::uint32_t node = block.node[a][lane];
    const double own = claim * waves.stiffness[t.index()][a];
    inverse[a] = waves.nodes.inverse_mass[node] * sums[node] / own;
  }
  WaveBodies::KnownHighest& known = waves.highest[t.index()][round];
  if (known.inverse != inverse) known = {inverse, highest_of_element(block, lane, inverse)};
  return known.value;
}

}  // namespace

double highest_of_element(const FirstOrderBlock& block, std::size_t lane,
                          const std::array<double, 4>& inverse) {
  Matrix6 S = Matrix6::Zero();
  Vec3 first = Vec3::Zero();
  for (std::size_t a = 4; a-- > 0;) {
    Vec3 g = -first;
    for (std::size_t j = 0; a > 0 && j < 3; ++j) {
      g[static_cast<Eigen::Index>(j)] = block.gradient[3 * (a - 1) + j][lane];
    }
    first += g;
    const Matrix63 E = root_of_node(g, block.lambda[lane], block.mu[lane]);
    S += inverse[a] * E.lazyProduct(E.transpose());
  }
  return largest_eigenvalue_bound(S);
}

double longest_step(WaveBodies& waves) {
  constexpr std::size_t rounds = std::tuple_size_v<decltype(waves.highest)::value_type>;
  constexpr double infinite = std::numeric_limits<double>::infinity();
  std::vector<double> claim(waves.stiffness.size(), 1);
  std::vector<double> allowed(waves.bodies.size());
  waves.highest.resize(waves.stiffness.size());
  for (std::size_t round = 0; round < rounds; ++round) {
    const std::vector<double> sums = sums_of_claims(waves, claim);
    allowed.assign(waves.bodies.size(), infinite);
    for (std::size_t b = 0; b < waves.bodies.size(); ++b) {
      if (!is_first_order(waves.bodies[b])) continue;
      const auto visit = [&](TetId t, const FirstOrderBlock& block, std::size_t lane) {
        double& own = claim[t.index()];
        const double highest = highest_of_share(waves, t, round, block, lane, own, sums);
        if (!(highest > 0)) return;
        own *= highest;
        allowed[b] = std::min(allowed[b], step_of(highest, highest * block.viscosity[lane]));
      };
      for_each_unscaled(waves, waves.bodies[b], visit);
    }
  }
  double longest = infinite;
  for (std::size_t b = 0; b < waves.bodies.size(); ++b) {
    const double bound = stable_step(waves, waves.bodies[b]);
    // Nearer to the limit waves are still stable, but break a few per cent less.
    constexpr double accurate = 5.0 / 6;
    const bool is_known = is_first_order(waves.bodies[b]);
    longest = std::min(longest, is_known ? std::max(bound, accurate * allowed[b]) : bound);
  }
  return longest;
}

}  // namespace sunder
