// SPDX-License-Identifier: MIT
// Preconditioned conjugate gradients on the contacts that press or stick.
#include "mechanics/contact/solver/contact_subspace.hpp"

#include <algorithm>
#include <utility>

#include "mechanics/contact/solver/body_factor.hpp"
#include "mechanics/contact/solver/contact_law.hpp"
#include "mechanics/contact/solver/tie_row.hpp"
#include "mechanics/frame/rotation.hpp"

namespace sunder {
namespace {

using Impulses = std::vector<Vec3>;
using Arm = Eigen::Matrix<double, 3, 6>;  ///< from a twist of a body to motion at a row

/// The free directions of a row's impulse: a basis of them, columns orthonormal.
struct Free {
  Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 3> basis{3, 0};
  Mat3 inverse = Mat3::Zero();  ///< of D, on it
};

struct Subspace {
  std::span<Constraint> rows;
  std::span<const RowResponse> responses;
  std::span<RespondingBody> bodies;
  double step;
  std::vector<Free> free;
  std::vector<std::uint32_t> place;  ///< of bodies with rigid motions in the equations; or no_place
  BodyFactor factor;
  std::vector<BodyMotion> spare;  ///< |bodies|, scratch of each product
  int products = 0;
};

constexpr std::uint32_t no_place = 0xffffffffu;

bool is_free(const Free& free) { return free.basis.cols() > 0; }

Vec3 within(const Free& free, const Vec3& v) { return free.basis * (free.basis.transpose() * v); }

double dot(const Impulses& a, const Impulses& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k].dot(b[k]);
  return sum;
}

/// m: by how much a row gives way to an impulse.
Vec3 given_way(const Constraint& row, const RowResponse& response, const Vec3& impulse) {
  if (row.is_bond()) return bond_give(row) * impulse;
  return contact_give(row, response) * row.normal.dot(impulse) * row.normal;
}

/// Which parts of a row's impulse are free.
struct Parts {
  bool normal = false, friction = false;
};

/// Friction is free inside its disk. Along the rim a contact slips, and the next sweep turns its
/// friction. The normal part is free off its bounds.
Parts parts_of_contact(const Constraint& row, const RowResponse& response, double rounding) {
  const ContactConstraint& contact = row.contact();
  const double pressed = row.normal.dot(row.impulse);
  const bool presses = pressed > contact.least + rounding && pressed < contact.most - rounding;
  const double friction = (row.impulse - pressed * row.normal).norm();
  const bool sticks = response.tangential_response > 0 && response.disk > rounding &&
                      friction < (1 - 1e-9) * response.disk;
  return {response.normal_response > 0 && presses, sticks};
}

/// A bond is free as a whole, short of its bound.
Parts parts_of_bond(const Constraint& row) {
  const bool is_free = row.bond().response > 0 && bond_is_free(row);
  return {is_free, is_free};
}

Parts free_parts(const Constraint& row, const RowResponse& response, double rounding) {
  return row.is_bond() ? parts_of_bond(row) : parts_of_contact(row, response, rounding);
}

Free free_of(const Constraint& row, const RowResponse& response, const Parts& parts) {
  Free free;
  const Vec3& n = row.normal;
  free.basis.resize(3, (parts.normal ? 1 : 0) + (parts.friction ? 2 : 0));
  if (parts.normal) free.basis.col(0) = n;
  if (parts.friction) {
    const Vec3 u = n.unitOrthogonal();
    free.basis.rightCols<2>() << u, n.cross(u);
  }
  if (free.basis.cols() == 0) return free;
  // Contacts of rigid bodies give a little for the preconditioner's sake.
  Mat3 give = response.give;
  give += row.is_bond() ? bond_give(row) : Mat3(contact_give(row, response) * n * n.transpose());
  give.diagonal().array() += 1e-4 * response.response.trace();
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 3, 3> on_basis =
      free.basis.transpose() * give * free.basis;
  free.inverse = free.basis * on_basis.inverse() * free.basis.transpose();
  return free;
}

Arm arm_of(const RowSide& side) {
  Arm arm;
  arm.leftCols<3>() = side.weight * Mat3::Identity();
  arm.rightCols<3>() = -cross_matrix(side.arm);
  return arm;
}

bool is_rigid_side(const RowSide& side, const Subspace& s) {
  return s.place[side.body] != no_place && (side.weight != 0 || !side.arm.isZero(0));
}

/// W^-1 + G^T D^-1 G of the bodies that free rows act on, factored. False: it has no factor.
bool factor_bodies(Subspace& s) {
  s.place.assign(s.bodies.size(), no_place);
  std::vector<std::uint32_t> moved;
  for (std::size_t k = 0; k < s.rows.size(); ++k) {
    if (!is_free(s.free[k])) continue;
    for (std::uint32_t e = 0; e < s.rows[k].side_count; ++e) {
      const std::uint32_t b = s.rows[k].sides[e].body;
      if (s.place[b] != no_place || !(s.bodies[b].inverse_mass > 0)) continue;
      s.place[b] = static_cast<std::uint32_t>(moved.size());
      moved.push_back(b);
    }
  }
  s.factor.reset(moved.size());
  for (std::uint32_t k = 0; k < moved.size(); ++k) {
    const RespondingBody& body = s.bodies[moved[k]];
    BodyFactor::Block inertia = BodyFactor::Block::Zero();
    inertia.topLeftCorner<3, 3>().diagonal().setConstant(1 / (s.step * body.inverse_mass));
    inertia.bottomRightCorner<3, 3>() = body.inverse_inertia.inverse() / s.step;
    s.factor.add(k, k, inertia);
  }
  for (std::size_t k = 0; k < s.rows.size(); ++k) {
    if (!is_free(s.free[k])) continue;
    const Constraint& row = s.rows[k];
    for (std::uint32_t a = 0; a < row.side_count; ++a) {
      if (!is_rigid_side(row.sides[a], s)) continue;
      const std::uint32_t at = s.place[row.sides[a].body];
      const Eigen::Matrix<double, 6, 3> left = arm_of(row.sides[a]).transpose() * s.free[k].inverse;
      for (std::uint32_t b = 0; b < row.side_count; ++b) {
        if (!is_rigid_side(row.sides[b], s)) continue;
        const std::uint32_t to = s.place[row.sides[b].body];
        if (at >= to) s.factor.add(at, to, left * arm_of(row.sides[b]));
      }
    }
  }
  return s.factor.factor();
}

/// (D + G W G^T)^-1 on the free directions.
Impulses precondition(const Subspace& s, const Impulses& r) {
  Impulses result(r.size(), Vec3::Zero());
  Eigen::VectorXd twist = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(6 * s.factor.size()));
  const auto each = [&](auto visit) {
    for (std::size_t k = 0; k < r.size(); ++k) {
      if (!is_free(s.free[k])) continue;
      for (std::uint32_t e = 0; e < s.rows[k].side_count; ++e) {
        const RowSide& side = s.rows[k].sides[e];
        if (is_rigid_side(side, s)) visit(k, side, 6 * s.place[side.body]);
      }
    }
  };
  for (std::size_t k = 0; k < r.size(); ++k) {
    if (is_free(s.free[k])) result[k] = s.free[k].inverse * r[k];
  }
  if (twist.size() == 0) return result;
  each([&](std::size_t k, const RowSide& side, std::uint32_t at) {
    twist.segment<3>(at) += side.weight * result[k];
    twist.segment<3>(at + 3) += side.arm.cross(result[k]);
  });
  s.factor.solve(twist);
  Impulses back(r.size(), Vec3::Zero());
  each([&](std::size_t k, const RowSide& side, std::uint32_t at) {
    back[k] += side.weight * twist.segment<3>(at) + twist.segment<3>(at + 3).cross(side.arm);
  });
  for (std::size_t k = 0; k < r.size(); ++k) {
    if (is_free(s.free[k])) result[k] -= s.free[k].inverse * back[k];
  }
  return result;
}

/// The response of free rows to impulses of theirs, m; motions of the bodies stay.
Impulses response_to(Subspace& s, const Impulses& impulses) {
  ++s.products;
  const auto swap_motions = [&] {
    for (std::size_t b = 0; b < s.spare.size(); ++b) std::swap(s.spare[b], s.bodies[b].motion);
  };
  swap_motions();
  set_to_rest(s.bodies);
  add_impulses(s.rows, s.bodies, impulses);
  Impulses moved(impulses.size(), Vec3::Zero());
  for (std::size_t k = 0; k < moved.size(); ++k) {
    if (!is_free(s.free[k])) continue;
    const Constraint& row = s.rows[k];
    moved[k] =
        relative_displacement(row, s.bodies, s.step) + given_way(row, s.responses[k], impulses[k]);
  }
  swap_motions();
  return moved;
}

/// Gradient of the energy by the impulse of a contact: gap along the normal, slip across. `moved`:
/// m, of its sides.
Vec3 gradient_of_contact(const Constraint& row, const RowResponse& response, const Vec3& moved) {
  const Vec3& n = row.normal;
  const double pressed = n.dot(row.impulse);
  const double push = contact_pushes(row, response) ? row.contact().push : 0;
  const double gap =
      row.contact().gap - push + n.dot(moved) + contact_give(row, response) * pressed;
  const Vec3 total = row.slip + moved;
  return gap * n + total - n * n.dot(total);
}

/// The same by the impulse of a bond: its opening, and its own give.
Vec3 gradient_of_bond(const Constraint& row, const Vec3& moved) {
  return opening_of(row, moved) + bond_give(row) * row.impulse;
}

/// Gradient of the energy, m.
Impulses gradient_of(const Subspace& s) {
  Impulses gradient;
  for (std::size_t k = 0; k < s.rows.size(); ++k) {
    const Constraint& row = s.rows[k];
    const Vec3 moved = relative_displacement(row, s.bodies, s.step);
    gradient.push_back(row.is_bond() ? gradient_of_bond(row, moved)
                                     : gradient_of_contact(row, s.responses[k], moved));
  }
  return gradient;
}

/// Preconditioned conjugate gradients: the least energy over the free directions.
Impulses least_energy(Subspace& s, const Impulses& gradient, int most) {
  Impulses found(gradient.size(), Vec3::Zero()), residual(gradient.size());
  for (std::size_t k = 0; k < residual.size(); ++k) residual[k] = -within(s.free[k], gradient[k]);
  Impulses z = precondition(s, residual), direction = z;
  double rz = dot(residual, z);
  // The later sweeps find the other free rows: a thousandth of the error is enough.
  const double enough = 1e-6 * rz;
  // Where contacts are more than the independent motions of their bodies, only rounding is left.
  constexpr double rounding = 1e-9;
  double square = rz;  // of the direction, measured by the preconditioner's inverse
  while (rz > enough && s.products < most) {
    const Impulses moved = response_to(s, direction);
    const double curvature = dot(direction, moved);
    if (!(curvature > rounding * square)) break;
    const double length = rz / curvature;
    for (std::size_t k = 0; k < found.size(); ++k) {
      found[k] += length * direction[k];
      residual[k] -= length * within(s.free[k], moved[k]);
    }
    z = precondition(s, residual);
    const double before = std::exchange(rz, dot(residual, z));
    const double share = rz / before;
    square = rz + share * share * square;
    for (std::size_t k = 0; k < found.size(); ++k) direction[k] = z[k] + share * direction[k];
  }
  return found;
}

/// The impulse inside its bounds that is nearest.
Vec3 inside_bounds(const Constraint& row, const RowResponse& response, const Vec3& impulse) {
  return row.is_bond() ? bond_kept(row, impulse) : contact_kept(row, response, impulse);
}

/// Takes back, from the bodies too, the parts of impulses outside the present bounds: disks have
/// shrunk.
void keep_bounds(const Subspace& s) {
  Impulses back;
  for (std::size_t k = 0; k < s.rows.size(); ++k) {
    Constraint& row = s.rows[k];
    const Vec3 kept = inside_bounds(row, s.responses[k], row.impulse);
    back.push_back(kept - row.impulse);
    row.impulse = kept;
  }
  add_impulses(s.rows, s.bodies, back);
}

/// How far a row may go before it is at a bound, in [0, 1]. A bond goes as a whole.
std::array<double, 2> way_to_bounds(const Constraint& row, const RowResponse& response,
                                    const Vec3& change) {
  if (change.isZero(0)) return {1, 1};
  if (row.is_bond()) return {bond_way(row, change), 1};
  return contact_way(row, response, change);
}

/// How far, in [0, 1], all may go before the first is at a bound. Those that would be within half
/// of the way are free no more: without them one may go farther.
double go_to_bounds(std::vector<Parts>& parts, const Subspace& s, const Impulses& change) {
  constexpr double soon = 0.5;
  double share = 1;
  for (std::size_t k = 0; k < change.size(); ++k) {
    const auto [normal, friction] = way_to_bounds(s.rows[k], s.responses[k], change[k]);
    share = std::min({share, normal, friction});
    parts[k].normal = parts[k].normal && normal >= soon;
    parts[k].friction = parts[k].friction && friction >= soon;
  }
  return share;
}

/// All the way, and back to the bounds.
Impulses go_all_the_way(const Subspace& s, const Impulses& change) {
  Impulses bounded;
  for (std::size_t k = 0; k < change.size(); ++k) {
    const Constraint& row = s.rows[k];
    bounded.push_back(inside_bounds(row, s.responses[k], row.impulse + change[k]) - row.impulse);
  }
  return bounded;
}

/// The free parts of each row, with the impulses as they are.
std::vector<Parts> free_parts(const Subspace& s) {
  double largest = 0;
  for (const Constraint& row : s.rows) largest = std::max(largest, row.impulse.norm());
  std::vector<Parts> parts;
  for (std::size_t k = 0; k < s.rows.size(); ++k) {
    parts.push_back(free_parts(s.rows[k], s.responses[k], 1e-12 * largest));
  }
  return parts;
}

/// The change of impulses that lowers the energy, as far as it was found; none where nothing does.
Impulses least_change(Subspace& s, int most, bool again) {
  std::vector<Parts> parts = free_parts(s);
  const Impulses gradient = gradient_of(s);
  Impulses change(s.rows.size(), Vec3::Zero());
  double least = 0;
  const int first = again ? most / 2 : most;
  for (bool more = true; more && s.products + 2 < most;) {
    s.free.clear();
    for (std::size_t k = 0; k < s.rows.size(); ++k) {
      s.free.push_back(free_of(s.rows[k], s.responses[k], parts[k]));
    }
    if (!factor_bodies(s)) break;
    Impulses whole = least_energy(s, gradient, std::min(most - 1, s.products + first));
    Impulses bounded = go_all_the_way(s, whole);
    if (dot(bounded, gradient) + 0.5 * dot(bounded, response_to(s, bounded)) < 0) return bounded;
    const double share = go_to_bounds(parts, s, whole);
    more = again && share < 0.1;
    // Conjugate gradients: the response's part is half of the gradient's.
    const double energy = share * (1 - 0.5 * share) * dot(whole, gradient);
    if (energy >= least) continue;
    least = energy;
    for (Vec3& c : whole) c *= share;
    change = std::move(whole);
  }
  return change;
}

/// Gives bodies and rows the same impulses, after the bounds.
void take(const Subspace& s, Impulses change) {
  for (std::size_t k = 0; k < change.size(); ++k) {
    Constraint& row = s.rows[k];
    const Vec3 kept = inside_bounds(row, s.responses[k], row.impulse + change[k]);
    change[k] = kept - row.impulse;
    row.impulse = kept;
  }
  add_impulses(s.rows, s.bodies, change);
}

}  // namespace

int solve_subspace(const RowSolve& solve, int most, bool again) {
  Subspace s{solve.rows, solve.responses, solve.bodies, solve.step, {}, {}, {}, {}, 0};
  s.spare.resize(s.bodies.size());
  keep_bounds(s);
  take(s, least_change(s, most, again));
  return s.products;
}

}  // namespace sunder
