// SPDX-License-Identifier: MIT
// Bonds of explicit steps.
#include "mechanics/contact/waves/lumped_bonds.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mechanics/contact/solver/tie_row.hpp"
#include "mechanics/ties/tie_law.hpp"
#include "topology/base/sort_unique.hpp"
#include "topology/base/union_find.hpp"

namespace sunder {
namespace {

Vec3 slip_of(const LumpedBond& bond, const WaveNodes& nodes) {
  return row_of(nodes.velocity, bond.a) - row_of(nodes.velocity, bond.b);
}

void strike(const LumpedBond& bond, const Vec3& impulse, WaveNodes& nodes) {
  push_node(nodes, bond.a, impulse);
  push_node(nodes, bond.b, -impulse);
}

/// J: the work of a bond's impulse on its nodes, and its part on held nodes.
std::array<double, 2> work_of(const LumpedBond& bond, const WaveBodies& waves) {
  const auto on = [&](std::uint32_t node, const Vec3& impulse) {
    return 0.5 *
           impulse.dot(row_of(waves.velocity_before, node) + row_of(waves.nodes.velocity, node));
  };
  const double a = on(bond.a, bond.row.impulse), b = on(bond.b, -bond.row.impulse);
  return {a + b, waves.nodes.is_held[bond.a] * a + waves.nodes.is_held[bond.b] * b};
}

/// A bond takes its impulse: that of its secant, which is known in closed form as the masses
/// respond alike in all directions, or as much of it as it bears. Where opening and sliding differ,
/// sweeps lead to the direction in which it gives way. Gives how far the bond was from its law,
/// over the opening that ends it.
double visit(LumpedBond& bond, WaveNodes& nodes, double step) {
  Constraint& row = bond.row;
  const double response = nodes.inverse_mass[bond.a] + nodes.inverse_mass[bond.b];
  if (!(response > 0)) return 0;
  const Vec3 opening = bond.opening / step + slip_of(bond, nodes);
  const Vec3 free = opening - response * row.impulse;
  const double along = row.normal.dot(free);
  const double give = along > 0 ? row.compliance : 0;
  const double sliding_give = row.compliance / row.bond().sliding_stiffness;
  const Vec3 unbounded = -along / (response + give) * row.normal -
                         (free - along * row.normal) / (response + sliding_give);
  Vec3 next = bond_kept(row, unbounded);
  if (next != unbounded && row.bond().sliding_stiffness != 1) next = bond_wanted(row, opening);
  const Vec3 change = next - row.impulse;
  if (change.isZero(0)) return 0;
  row.impulse += change;
  strike(bond, change, nodes);
  return step * response * change.norm() / bond.opening_end;
}

/// Sets the bound of a bond by its opening as the step ends. Gives the relative change of the
/// bound.
double set_bound(LumpedBond& bond, const TiePair& pair, const WaveNodes& nodes,
                 const RowStep& step) {
  const Vec3 end = bond.opening + step.length * slip_of(bond, nodes);
  double& most = bond.row.bond().most;
  const double before = most;
  most = step.share * step.length * tie_bound(pair, end) * mode_factor(pair, bond.row.impulse, end);
  return before > 0 ? std::abs(most / before - 1) : 0;
}

void find_sets(LumpedBonds& bonds, std::size_t nodes) {
  UnionFind joined(nodes);
  for (const LumpedBond& bond : bonds.bonds) joined.join(bond.a, bond.b);
  std::vector<std::uint32_t>& order = bonds.of_set;
  order.resize(bonds.bonds.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto root = [&](std::uint32_t k) { return joined.root(bonds.bonds[k].a); };
  std::ranges::stable_sort(order, {}, root);
  bonds.set_first.clear();
  for (std::uint32_t k = 0; k < order.size(); ++k) {
    if (k == 0 || root(order[k]) != root(order[k - 1])) bonds.set_first.push_back(k);
  }
  bonds.set_first.push_back(static_cast<std::uint32_t>(order.size()));
}

}  // namespace

void make_bonds(LumpedBonds& bonds, std::span<const TiePair> pairs, std::span<const Vec3> first,
                const WaveBodies& waves) {
  bonds.bonds.clear();
  bonds.opened_before.clear();
  bonds.report = {};
  bonds.numerical = 0;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const TiePair& pair = pairs[k];
    LumpedBond bond;
    bond.a = waves.node_of_vertex[pair.a.index()];
    bond.b = waves.node_of_vertex[pair.b.index()];
    const auto next = std::ranges::upper_bound(waves.bodies, bond.a, {}, &WaveBody::first_node);
    bond.body = static_cast<std::uint32_t>(next - waves.bodies.begin()) - 1;
    bond.row.normal = pair.normal;
    bond.row.impulse = first[k];
    bond.row.law = CohesiveBond{};
    bond.row.bond().sliding_stiffness = sliding_stiffness(pair.shear);
    bond.opening_end = opening_end_of(pair);
    bond.first_corner = static_cast<std::uint32_t>(bonds.opened_before.size());
    for (const TieCorner* corner : pair.corners) bonds.opened_before.push_back(corner->opened);
    bonds.bonds.push_back(bond);
  }
  find_sets(bonds, waves.nodes.size());
}

void begin_bonds(LumpedBonds& bonds, std::span<const TiePair> pairs, WaveNodes& nodes,
                 const RowStep& step) {
  const double time = step.share * step.length;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    LumpedBond& bond = bonds.bonds[k];
    Constraint& row = bond.row;
    bond.opening = row_of(nodes.position, bond.a) - row_of(nodes.position, bond.b);
    row.impulse *= step.growth;
    row.compliance = give_of(pairs[k], time) / step.length;
    const double stiffness = row.bond().sliding_stiffness;
    row.bond().response =
        std::max(1.0, stiffness) * (nodes.inverse_mass[bond.a] + nodes.inverse_mass[bond.b]) +
        row.compliance;
    strike(bond, row.impulse, nodes);
  }
  for (std::size_t k = 0; k < pairs.size(); ++k) set_bound(bonds.bonds[k], pairs[k], nodes, step);
}

std::array<double, 2> sweep_bonds(LumpedBonds& bonds, std::span<const TiePair> pairs,
                                  WaveNodes& nodes, const RowStep& step, double tolerance,
                                  int most) {
  // Bounds follow the openings that the sweeps lead to, and sweeps follow them.
  constexpr int rounds_of_bounds = 6;
  std::array<double, 2> off{};
  for (std::size_t set = 0; set + 1 < bonds.set_first.size(); ++set) {
    const std::span<const std::uint32_t> own =
        std::span(bonds.of_set)
            .subspan(bonds.set_first[set], bonds.set_first[set + 1] - bonds.set_first[set]);
    double largest = 0;
    bool is_first = true;
    for (int round = 0; round < rounds_of_bounds; ++round) {
      for (int sweep = 0; sweep < most; ++sweep) {
        largest = 0;
        for (const std::uint32_t k : own) {
          largest = std::max(largest, visit(bonds.bonds[k], nodes, step.length));
        }
        if (is_first) off[0] = std::max(off[0], largest);
        is_first = false;
        if (largest <= tolerance) break;
      }
      double moved = 0;
      for (const std::uint32_t k : own) {
        moved = std::max(moved, set_bound(bonds.bonds[k], pairs[k], nodes, step));
      }
      if (moved <= tolerance) break;
    }
    off[1] = std::max(off[1], largest);
  }
  return off;
}

void settle_bonds(LumpedBonds& bonds, std::span<TiePair> pairs, const WaveBodies& waves,
                  LumpedContacts& contacts, const RowStep& step) {
  const double before = bonds.report.work;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    LumpedBond& bond = bonds.bonds[k];
    if (waves.measures_work) {
      const auto [work, on_held] = work_of(bond, waves);
      bonds.numerical -= work;
      contacts.work.on_held += on_held;
    }
    if (step.drifts) {
      const Vec3 end = bond.opening + step.length * slip_of(bond, waves.nodes);
      const Vec3 force = bond.row.impulse / (step.share * step.length);
      const bool opens = settle_tie(bonds.report, pairs[k], {bond.opening, end}, force);
      bond.opens = bond.opens || opens;
    }
    bond.total += bond.row.impulse;
    contacts.twist[bond.body] -= bond.opening.cross(bond.row.impulse);
  }
  if (waves.measures_work) bonds.numerical -= bonds.report.work - before;
}

TieReport report_of(LumpedBonds& bonds, std::span<const TiePair> pairs, const WaveBodies& waves) {
  TieReport report = std::move(bonds.report);
  report.pairs = static_cast<std::uint32_t>(pairs.size());
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const LumpedBond& bond = bonds.bonds[k];
    report.opening += bond.opens;
    const std::span<const double> before =
        std::span(bonds.opened_before).subspan(bond.first_corner, pairs[k].corners.size());
    if (has_torn(pairs[k], before)) report.torn.push_back(waves.bodies[bond.body].id);
  }
  sort_unique(report.torn);
  return report;
}

}  // namespace sunder
