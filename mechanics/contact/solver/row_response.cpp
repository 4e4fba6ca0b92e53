// SPDX-License-Identifier: MIT
// Responses of rows to impulses of their own.
#include "mechanics/contact/solver/row_response.hpp"

#include <cmath>

#include "mechanics/frame/rotation.hpp"

namespace sunder {
namespace {

/// Largest eigenvalue of a response in the plane across `normal`: a safe divisor for both
/// directions.
double tangential_response(const Mat3& response, const Vec3& normal) {
  const Vec3 u = normal.unitOrthogonal();
  const Vec3 w = normal.cross(u);
  const double uu = u.dot(response * u);
  const double ww = w.dot(response * w);
  const double uw = 0.5 * (u.dot(response * w) + w.dot(response * u));
  return 0.5 * (uu + ww) + std::sqrt(0.25 * (uu - ww) * (uu - ww) + uw * uw);
}

}  // namespace

RowResponse own_response(const Constraint& row, std::span<const RespondingBody> bodies,
                         double step) {
  RowResponse own;
  for (std::uint32_t s = 0; s < row.side_count; ++s) {
    const RowSide& side = row.sides[s];
    const RespondingBody& body = bodies[side.body];
    const Mat3 arm = cross_matrix(side.arm);
    own.response -= step * arm * body.inverse_inertia * arm;
    own.response.diagonal().array() += step * side.weight * side.weight * body.inverse_mass;
    if (side.slot == ContactEnd::no_slot) continue;
    const Mat3 rest_arm = cross_matrix(side.rest_arm);
    Mat3 elastic = body.elastic.block<3, 3>(3 * side.slot, 3 * side.slot) +
                   rest_arm * body.rigid_inertia * rest_arm;
    elastic.diagonal().array() -= side.weight * side.weight * body.rigid_mass;
    own.give += body.turn * elastic * body.turn.transpose();
  }
  own.response += own.give;
  return own;
}

RowResponse response_of(const Constraint& row, std::span<const RespondingBody> bodies,
                        double step) {
  RowResponse own = own_response(row, bodies, step);
  if (row.is_bond()) return own;
  const ContactConstraint& contact = row.contact();
  own.normal_response = row.normal.dot(own.response * row.normal) + row.compliance;
  own.tangential_response = tangential_response(own.response, row.normal);
  // A push lifts bodies that rest: a hundred times the impulse that parts two free sides.
  own.push_most = own.normal_response > 0 ? 100 * contact.push / own.normal_response : 0;
  own.disk = contact.disk;
  return own;
}

}  // namespace sunder
