// SPDX-License-Identifier: MIT
// Effects of row impulses on bodies, and of bodies on rows.
#include "mechanics/contact/solver/contact_rows.hpp"

#include <algorithm>

namespace sunder {
namespace {

/// A slot of a body is the weighted sum of some of its vertices' slots.
struct MergedSlot {
  std::array<std::uint32_t, 10> slots;
  std::array<double, 10> weights;
  std::uint32_t count = 0;
  friend bool operator==(const MergedSlot& a, const MergedSlot& b) {
    return std::equal(a.slots.begin(), a.slots.begin() + a.count, b.slots.begin(),
                      b.slots.begin() + b.count) &&
           std::equal(a.weights.begin(), a.weights.begin() + a.count, b.weights.begin(),
                      b.weights.begin() + b.count);
  }
};

RowSide& side_of(Constraint& row, std::uint32_t body) {
  for (std::uint32_t s = 0; s < row.side_count; ++s) {
    if (row.sides[s].body == body) return row.sides[s];
  }
  RowSide& side = row.sides[row.side_count++];
  side = {.body = body, .weight = 0};
  return side;
}

/// Rows of the same ends follow each other: it is enough to look at the last slot.
std::uint32_t place_of(std::vector<MergedSlot>& merged, const MergedSlot& slot) {
  if (merged.empty() || !(merged.back() == slot)) merged.push_back(slot);
  return static_cast<std::uint32_t>(merged.size() - 1);
}

void merge_slots(Constraint& row, RowSide& side, std::vector<MergedSlot>& merged) {
  MergedSlot slot;
  for (std::uint32_t e = 0; e < row.end_count; ++e) {
    const ContactEnd& end = row.ends[e];
    if (end.body != side.body || end.slot == ContactEnd::no_slot) continue;
    slot.slots[slot.count] = end.slot;
    slot.weights[slot.count++] = end.weight;
  }
  if (slot.count > 0) side.slot = place_of(merged, slot);
}

/// The columns of E, as `RespondingBody` has it before its slots are merged, summed up to one of a
/// merged slot.
void sum_columns(Eigen::Matrix<double, Eigen::Dynamic, 3>& sum, const RespondingBody& body,
                 const MergedSlot& slot) {
  sum.setZero();
  for (std::uint32_t f = 0; f < slot.count; ++f) {
    if (!body.cached) {
      sum += slot.weights[f] * body.elastic.middleCols<3>(3 * slot.slots[f]);
      continue;
    }
    const std::uint32_t column = body.cached_places[slot.slots[f]];
    if (column == ContactEnd::no_slot) continue;
    const double weight = body.cached_scale * slot.weights[f];
    for (std::size_t k = 0; k < body.cached_places.size(); ++k) {
      const std::uint32_t row = body.cached_places[k];
      if (row == ContactEnd::no_slot) continue;
      sum.middleRows<3>(static_cast<Eigen::Index>(3 * k)) +=
          weight * body.cached->block<3, 3>(3 * row, 3 * column);
    }
  }
}

/// P^T E P, each column of P a merged slot. E is symmetric.
Eigen::MatrixXd between(const std::vector<MergedSlot>& merged, const RespondingBody& body) {
  const auto size = static_cast<Eigen::Index>(3 * merged.size());
  Eigen::MatrixXd result(size, size);
  Eigen::Matrix<double, Eigen::Dynamic, 3> column(
      body.cached ? static_cast<Eigen::Index>(3 * body.cached_places.size()) : body.elastic.rows(),
      3);
  for (std::size_t b = 0; b < merged.size(); ++b) {
    sum_columns(column, body, merged[b]);
    for (std::size_t a = b; a < merged.size(); ++a) {
      Mat3 block = Mat3::Zero();
      for (std::uint32_t e = 0; e < merged[a].count; ++e) {
        block += merged[a].weights[e] * column.middleRows<3>(3 * merged[a].slots[e]);
      }
      const auto i = static_cast<Eigen::Index>(3 * a), j = static_cast<Eigen::Index>(3 * b);
      result.block<3, 3>(i, j) = block;
      if (a != b) result.block<3, 3>(j, i) = block.transpose();
    }
  }
  return result;
}

/// Motion of one side from the impulses on its body, m.
Vec3 side_displacement(const RowSide& side, const RespondingBody& body, double step) {
  const BodyMotion& got = body.motion;
  Vec3 moved = step * (side.weight * got.velocity + got.spin.cross(side.arm));
  if (side.slot != ContactEnd::no_slot) {
    const Vec3 turned = body.rigid_inertia * got.moment;
    moved += body.turn * (got.displacement.segment<3>(3 * side.slot) + side.rest_arm.cross(turned) -
                          side.weight * body.rigid_mass * got.impulse);
  }
  return moved;
}

/// Adds an impulse to the body, except for the part of E; gives the impulse in the body's own
/// frame.
Vec3 give_side(const RowSide& side, RespondingBody& body, const Vec3& impulse) {
  BodyMotion& got = body.motion;
  got.velocity += side.weight * body.inverse_mass * impulse;
  got.spin += body.inverse_inertia * side.arm.cross(impulse);
  if (side.slot == ContactEnd::no_slot) return Vec3::Zero();
  const Vec3 own = body.turn.transpose() * impulse;
  got.impulse += side.weight * own;
  got.moment += side.rest_arm.cross(own);
  return own;
}

}  // namespace

void merge_ends(std::span<Constraint> rows, std::span<RespondingBody> bodies) {
  std::vector<std::vector<MergedSlot>> merged(bodies.size());
  for (Constraint& row : rows) {
    row.side_count = 0;
    for (std::uint32_t e = 0; e < row.end_count; ++e) {
      const ContactEnd& end = row.ends[e];
      RowSide& side = side_of(row, end.body);
      side.weight += end.weight;
      side.arm += end.weight * end.arm;
      side.rest_arm += end.weight * end.rest_arm;
    }
    for (std::uint32_t s = 0; s < row.side_count; ++s) {
      merge_slots(row, row.sides[s], merged[row.sides[s].body]);
    }
  }
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (!merged[b].empty()) bodies[b].elastic = between(merged[b], bodies[b]);
    bodies[b].cached = nullptr;
  }
}

Vec3 relative_displacement(const Constraint& row, std::span<const RespondingBody> bodies,
                           double step) {
  Vec3 sum = Vec3::Zero();
  for (std::uint32_t s = 0; s < row.side_count; ++s) {
    sum += side_displacement(row.sides[s], bodies[row.sides[s].body], step);
  }
  return sum;
}

void add_impulse(const Constraint& row, std::span<RespondingBody> bodies, const Vec3& impulse) {
  for (std::uint32_t s = 0; s < row.side_count; ++s) {
    const RowSide& side = row.sides[s];
    RespondingBody& body = bodies[side.body];
    const Vec3 own = give_side(side, body, impulse);
    if (side.slot == ContactEnd::no_slot) continue;
    body.motion.displacement.noalias() += body.elastic.middleCols<3>(3 * side.slot) * own;
  }
}

void add_impulses(std::span<const Constraint> rows, std::span<RespondingBody> bodies,
                  std::span<const Vec3> impulses) {
  std::vector<Eigen::VectorXd> own(bodies.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (impulses[k].isZero(0)) continue;
    for (std::uint32_t s = 0; s < rows[k].side_count; ++s) {
      const RowSide& side = rows[k].sides[s];
      const Vec3 impulse = give_side(side, bodies[side.body], impulses[k]);
      if (side.slot == ContactEnd::no_slot) continue;
      Eigen::VectorXd& all = own[side.body];
      if (all.size() == 0) all.setZero(bodies[side.body].elastic.rows());
      all.segment<3>(3 * side.slot) += impulse;
    }
  }
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (own[b].size() == 0) continue;
    bodies[b].motion.displacement.noalias() +=
        bodies[b].elastic.selfadjointView<Eigen::Lower>() * own[b];
  }
}

void set_to_rest(std::span<RespondingBody> bodies) {
  for (RespondingBody& body : bodies) {
    for (Vec3* part :
         {&body.motion.velocity, &body.motion.spin, &body.motion.impulse, &body.motion.moment}) {
      part->setZero();
    }
    body.motion.displacement.setZero(body.elastic.rows());
  }
}

}  // namespace sunder
