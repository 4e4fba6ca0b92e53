// SPDX-License-Identifier: MIT
// Rows of explicit steps.
#include "mechanics/contact/waves/lumped_rows.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "mechanics/frame/rotation.hpp"

namespace sunder {
namespace {

template <class Visit>
void for_each_end(const LumpedSide& side, const LumpedContacts& contacts, Visit visit) {
  for (std::uint32_t e = side.first; e < side.first + side.count; ++e) visit(contacts.ends[e]);
}

Vec3 velocity_of(const LumpedSide& side, const LumpedContacts& contacts, const WaveNodes& nodes) {
  if (side.rigid != LumpedSide::none) {
    const WaveRigid& body = contacts.rigid[side.rigid];
    return body.velocity + body.spin.cross(side.arm);
  }
  Vec3 sum = side.velocity;
  for_each_end(side, contacts,
               [&](const LumpedEnd& end) { sum += end.weight * row_of(nodes.velocity, end.node); });
  return sum;
}

Vec3 place_of(const LumpedSide& side, const LumpedContacts& contacts, const WaveNodes& nodes,
              double elapsed) {
  if (side.rigid != LumpedSide::none) {
    const WaveRigid& body = contacts.rigid[side.rigid];
    return body.centre + side.arm + body.turned.cross(side.arm);
  }
  if (side.count == 0) return side.start + elapsed * side.velocity;
  Vec3 sum = Vec3::Zero();
  for_each_end(side, contacts,
               [&](const LumpedEnd& end) { sum += end.weight * row_of(nodes.position, end.node); });
  return sum;
}

/// `stirs`: whether the impulse counts as more than a rest of the sweeps.
void strike(const LumpedSide& side, const Vec3& impulse, bool stirs, LumpedContacts& contacts,
            WaveNodes& nodes) {
  if (side.rigid != LumpedSide::none) {
    WaveRigid& body = contacts.rigid[side.rigid];
    const Vec3 change = body.inverse_mass * impulse;
    const Vec3 turn = body.inverse_inertia * side.arm.cross(impulse);
    body.velocity += change;
    body.spin += turn;
    body.motion.sum += change.norm() + body.reach * turn.norm();
    body.motion.stirs += stirs;
    return;
  }
  const double size = impulse.norm();
  for_each_end(side, contacts, [&](const LumpedEnd& end) {
    push_node(nodes, end.node, end.weight * impulse);
    LumpedMotion& motion = contacts.node_motion[end.node];
    motion.sum += std::abs(end.weight) * nodes.inverse_mass[end.node] * size;
    motion.stirs += stirs;
  });
}

/// Of both sides of a row, since `forget_visits`.
LumpedMotion motion_of(const LumpedRow& row, const LumpedContacts& contacts) {
  LumpedMotion both;
  for (const LumpedSide& side : row.sides) {
    if (side.rigid != LumpedSide::none) {
      both.sum += contacts.rigid[side.rigid].motion.sum;
      both.stirs += contacts.rigid[side.rigid].motion.stirs;
      continue;
    }
    for_each_end(side, contacts, [&](const LumpedEnd& end) {
      both.sum += std::abs(end.weight) * contacts.node_motion[end.node].sum;
      both.stirs += contacts.node_motion[end.node].stirs;
    });
  }
  return both;
}

/// Whether a node of the row answers together with others, whose impulses move it unseen.
bool is_in_cluster(const LumpedRow& row, const LumpedContacts& contacts, const WaveNodes& nodes) {
  bool any = false;
  if (nodes.scaled.empty()) return any;
  for (const LumpedSide& side : row.sides) {
    for_each_end(side, contacts, [&](const LumpedEnd& end) {
      any = any || nodes.cluster[end.node] != ScaledCells::none;
    });
  }
  return any;
}

Vec3 slip_of(const LumpedRow& row, const LumpedContacts& contacts, const WaveNodes& nodes) {
  return velocity_of(row.sides[0], contacts, nodes) - velocity_of(row.sides[1], contacts, nodes);
}

void strike(const LumpedRow& row, const Vec3& impulse, bool stirs, LumpedContacts& contacts,
            WaveNodes& nodes) {
  strike(row.sides[0], impulse, stirs, contacts, nodes);
  strike(row.sides[1], -impulse, stirs, contacts, nodes);
}

/// m/s: the mean of a side's velocities before the step and now.
Vec3 mean_velocity_of(const LumpedSide& side, const LumpedContacts& contacts,
                      const WaveBodies& waves) {
  Vec3 before = side.velocity;
  if (side.rigid != LumpedSide::none) {
    const WaveRigid& body = contacts.rigid[side.rigid];
    before = body.velocity_before + body.spin_before.cross(side.arm);
  }
  for_each_end(side, contacts, [&](const LumpedEnd& end) {
    before += end.weight * row_of(waves.velocity_before, end.node);
  });
  return 0.5 * (before + velocity_of(side, contacts, waves.nodes));
}

/// Adds the work of a row's impulse to the sums.
void measure_row(const LumpedRow& row, LumpedContacts& contacts, const WaveBodies& waves) {
  std::array<Vec3, 2> velocity;
  RowWork& work = contacts.work;
  for (std::size_t k = 0; k < 2; ++k) {
    const LumpedSide& side = row.sides[k];
    const Vec3 own = k == 0 ? row.impulse : Vec3(-row.impulse);
    velocity[k] = mean_velocity_of(side, contacts, waves);
    if (side.is_component) work.contact += own.dot(velocity[k]);
    for_each_end(side, contacts, [&](const LumpedEnd& end) {
      if (!waves.nodes.is_held[end.node]) return;
      const Vec3 mean =
          0.5 * (row_of(waves.velocity_before, end.node) + row_of(waves.nodes.velocity, end.node));
      work.on_held += end.weight * own.dot(mean);
    });
  }
  const Vec3 slip = velocity[0] - velocity[1];
  const double along = row.normal.dot(slip), pressed = row.normal.dot(row.impulse);
  work.friction -= (row.impulse - pressed * row.normal).dot(slip);
  if ((row.push > 0 || row.gap < 0) && along > 0) work.push_out += pressed * along;
}

/// The impulse that a row should have in all, as velocities are now.
Vec3 wanted_impulse(const LumpedRow& row, const Vec3& slip, double step) {
  const double along = row.normal.dot(slip);
  const double pressed = row.normal.dot(row.impulse);
  const double gap = along + row.gap / step + row.give / step * pressed;
  const double response = row.normal_response + row.give / step;
  double wanted = pressed - gap / response;
  if (row.push > 0) {
    wanted = std::max(wanted, std::min(pressed + (row.push - gap) / response, row.push_most));
  }
  wanted = std::max(0.0, wanted);
  Vec3 friction =
      row.impulse - pressed * row.normal - (slip - along * row.normal) / row.tangential_response;
  const double most = row.friction * wanted, length = friction.norm();
  if (length > most) friction *= most / length;
  return wanted * row.normal + friction;
}

/// Sides count as moved from here on, and no row as visited.
void forget_visits(LumpedContacts& contacts, const WaveNodes& nodes) {
  contacts.seen.assign(contacts.rows.size(), {-1, 0});
  contacts.node_motion.assign(nodes.inverse_mass.size(), {});
  for (WaveRigid& body : contacts.rigid) body.motion = {};
}

/// Gives row k the impulse that it should have, and notes the visit. Gives by how much that changed
/// a velocity, m/s. Nothing: its sides are apart, and stay so. Changes above `counts` m/s stir the
/// sides.
std::optional<double> relax(LumpedContacts& contacts, WaveNodes& nodes, std::uint32_t k,
                            double step, double counts) {
  LumpedRow& row = contacts.rows[k];
  LumpedMotion& seen = contacts.seen[k];
  const Vec3 slip = slip_of(row, contacts, nodes);
  const double slack = row.normal.dot(slip) + row.gap / step - row.push;
  seen = motion_of(row, contacts);
  const bool is_seen = !is_in_cluster(row, contacts, nodes);
  if (row.impulse.isZero(0) && slack >= 0) {
    seen.sum = is_seen ? seen.sum + slack : -1;
    return {};
  }
  seen.sum = is_seen ? seen.sum + counts : -1;
  const Vec3 next = wanted_impulse(row, slip, step);
  const Vec3 change = next - row.impulse;
  const double moved = change.norm() * row.normal_response;
  row.impulse = next;
  if (moved > 0) strike(row, change, moved > counts, contacts, nodes);
  return moved;
}

/// Over all rows; notes those that press, or would overlap.
double sweep_all(LumpedContacts& contacts, WaveNodes& nodes, double step, double counts) {
  double largest = 0;
  contacts.pressed.clear();
  for (std::uint32_t k = 0; k < contacts.rows.size(); ++k) {
    const LumpedRow& row = contacts.rows[k];
    if (!(row.normal_response > 0)) continue;
    if (motion_of(row, contacts).sum <= contacts.seen[k].sum) {
      if (!row.impulse.isZero(0)) contacts.pressed.push_back(k);
      continue;
    }
    const std::optional<double> change = relax(contacts, nodes, k, step, counts);
    if (!change) continue;
    contacts.pressed.push_back(k);
    largest = std::max(largest, *change);
  }
  return largest;
}

/// Over the rows noted that have been stirred. Others may have come to overlap.
double sweep_stirred(LumpedContacts& contacts, WaveNodes& nodes, double step, double counts) {
  double largest = 0;
  for (const std::uint32_t k : contacts.pressed) {
    if (motion_of(contacts.rows[k], contacts).stirs == contacts.seen[k].stirs) continue;
    largest = std::max(largest, relax(contacts, nodes, k, step, counts).value_or(0));
  }
  return largest;
}

}  // namespace

std::array<double, 2> response_of(const LumpedSide& side, const LumpedContacts& contacts,
                                  const WaveNodes& nodes, const Vec3& normal) {
  if (side.rigid != LumpedSide::none) {
    const WaveRigid& body = contacts.rigid[side.rigid];
    const Mat3 arm = cross_matrix(side.arm);
    const Mat3 by_turn = -arm * body.inverse_inertia * arm;
    return {body.inverse_mass + normal.dot(by_turn * normal), body.inverse_mass + by_turn.trace()};
  }
  double along = 0, across = 0;
  for_each_end(side, contacts, [&](const LumpedEnd& end) {
    across += end.weight * end.weight * nodes.inverse_mass[end.node];
    for_each_end(side, contacts, [&](const LumpedEnd& other) {
      const Mat3 response = response_between(nodes, end.node, other.node);
      along += end.weight * other.weight * normal.dot(response * normal);
    });
  });
  return {along, across};
}

void measure_gaps(LumpedContacts& contacts, const WaveNodes& nodes, double elapsed) {
  for (LumpedRow& row : contacts.rows) {
    for (LumpedSide& side : row.sides) side.place = place_of(side, contacts, nodes, elapsed);
    const Vec3 way = row.sides[0].place - row.sides[1].place - row.apart;
    row.gap = row.gap_start + row.normal.dot(way);
  }
}

namespace {

/// Adds to the spin of a body the moments that it does not contain yet. Gives their work,
/// J.
double take_missed(WaveRigid& body) {
  const Vec3 change = body.inverse_inertia * body.missed;
  const double work = body.missed.dot(body.spin + 0.5 * change);
  body.spin += change;
  body.missed.setZero();
  return work;
}

/// Turns a body as it has turned since its last turn. Gives the turn, and adds to `work` (J) the
/// change of its energy.
Mat3 turn_of(WaveRigid& body, double& work) {
  const Vec3 momentum = body.angular_momentum + body.twist;
  const double energy = momentum.dot(body.inverse_inertia * momentum);
  // The spin was taken as constant: its change without a torque, to second order.
  const Vec3 gyration = body.inverse_inertia * body.spin.cross(momentum);
  Eigen::Quaterniond by =
      rotation_of(body.turned - 0.5 * body.since_turn * body.since_turn * gyration);
  Mat3 R = by.toRotationMatrix();
  const Mat3 before = body.inverse_inertia;
  body.inverse_inertia = R * before * R.transpose();
  body.spin = body.inverse_inertia * momentum;
  const double error = 0.5 * (momentum.dot(body.spin) - energy);
  // A turn by d changes the energy by d . (w x L).
  const Vec3 slope = body.spin.cross(momentum);
  if (body.twist != body.twist_at_turn) {
    work += error;
  } else if (std::abs(error) > 1e-15 * energy && slope.squaredNorm() > 0) {
    by = rotation_of(-error / slope.squaredNorm() * slope) * by;
    R = by.toRotationMatrix();
    body.inverse_inertia = R * before * R.transpose();
    body.spin = body.inverse_inertia * momentum;
  }
  body.twist_at_turn = body.twist;
  body.orientation = (by * body.orientation).normalized();
  return R;
}

}  // namespace

void turn_rigid(LumpedContacts& contacts, double least) {
  std::vector<Mat3>& turn = contacts.turn;
  turn.assign(contacts.rigid.size(), Mat3::Identity());
  bool any = false;
  for (std::size_t k = 0; k < contacts.rigid.size(); ++k) {
    WaveRigid& body = contacts.rigid[k];
    if (body.turned.norm() < least) continue;
    any = true;
    double work = take_missed(body);
    turn[k] = turn_of(body, work);
    if (body.inverse_mass > 0 && !body.component.is_none()) contacts.work.contact += work;
    body.turned.setZero();
    body.since_turn = 0;
  }
  if (!any) return;
  for (LumpedRow& row : contacts.rows) {
    for (LumpedSide& side : row.sides) {
      if (side.rigid != LumpedSide::none) side.arm = turn[side.rigid] * side.arm;
    }
  }
}

void begin_rows(LumpedContacts& contacts, WaveNodes& nodes, const RowStep& step) {
  contacts.node_motion.resize(nodes.inverse_mass.size());
  for (LumpedRow& row : contacts.rows) {
    if (row.impulse.isZero(0)) continue;
    row.impulse *= step.growth;
    strike(row, row.impulse, true, contacts, nodes);
  }
}

double sweep_rows(LumpedContacts& contacts, WaveNodes& nodes, double step) {
  forget_visits(contacts, nodes);
  return sweep_all(contacts, nodes, step, 0);
}

double relax_rows(LumpedContacts& contacts, WaveNodes& nodes, double step,
                  const SweepLimits& limits, int& sweeps) {
  const double counts = 0.25 * limits.tolerance;
  forget_visits(contacts, nodes);
  for (;;) {
    const double error = sweep_all(contacts, nodes, step, counts);
    if (++sweeps >= limits.most || error <= limits.tolerance) return error;
    while (sweeps < limits.most &&
           sweep_stirred(contacts, nodes, step, counts) > limits.tolerance) {
      ++sweeps;
    }
  }
}

void settle_rows(LumpedContacts& contacts, const WaveBodies& waves) {
  for (LumpedRow& row : contacts.rows) {
    if (row.impulse.isZero(0)) continue;
    if (waves.measures_work) measure_row(row, contacts, waves);
    const Vec3& place = row.sides[0].place;
    row.total += row.impulse;
    row.moment += place.cross(row.impulse);
    for (std::size_t k = 0; k < 2; ++k) {
      const LumpedSide& side = row.sides[k];
      const Vec3 own = k == 0 ? row.impulse : Vec3(-row.impulse);
      if (side.rigid != LumpedSide::none) {
        WaveRigid& body = contacts.rigid[side.rigid];
        body.impulse += own;
        const Vec3 moment = (place - body.centre).cross(own);
        body.twist += moment;
        body.missed += moment - side.arm.cross(own);
      } else if (side.body != LumpedSide::none) {
        contacts.twist[side.body] += (place - side.place).cross(own);
      }
    }
  }
}

}  // namespace sunder
