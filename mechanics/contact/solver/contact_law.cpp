// SPDX-License-Identifier: MIT
// Bounds, pushes and friction of contacts.
#include "mechanics/contact/solver/contact_law.hpp"

#include <algorithm>
#include <cmath>

namespace sunder {

bool contact_pushes(const Constraint& row, const RowResponse& response) {
  return row.contact().push > 0 && row.normal.dot(row.impulse) < response.push_most;
}

double contact_give(const Constraint& row, const RowResponse& response) {
  const bool at_work = contact_pushes(row, response);
  return row.compliance + (at_work ? row.contact().push / response.push_most : 0);
}

std::array<double, 2> contact_bounds(const Constraint& row, const RowResponse& response) {
  const ContactConstraint& contact = row.contact();
  if (!(contact.push > 0)) return {contact.least, contact.most};
  return contact_pushes(row, response)
             ? std::array{contact.least, std::min(contact.most, response.push_most)}
             : std::array{std::max(contact.least, response.push_most), contact.most};
}

Vec3 contact_kept(const Constraint& row, const RowResponse& response, const Vec3& impulse) {
  const auto [least, most] = contact_bounds(row, response);
  const double pressed = row.normal.dot(impulse);
  Vec3 friction = impulse - pressed * row.normal;
  const double length = friction.norm();
  if (length > response.disk) friction *= response.disk / length;
  return std::clamp(pressed, least, most) * row.normal + friction;
}

std::array<double, 2> contact_way(const Constraint& row, const RowResponse& response,
                                  const Vec3& change) {
  std::array<double, 2> most{1, 1};
  const double pressed = row.normal.dot(row.impulse), by = row.normal.dot(change);
  const auto [lowest, highest] = contact_bounds(row, response);
  if (by < 0) most[0] = std::min(most[0], (lowest - pressed) / by);
  if (by > 0) most[0] = std::min(most[0], (highest - pressed) / by);
  const Vec3 t = row.impulse - pressed * row.normal, d = change - by * row.normal;
  const double dd = d.squaredNorm(), td = t.dot(d);
  const double left = std::max(0.0, response.disk * response.disk - t.squaredNorm());
  if (dd > 0) most[1] = std::min(most[1], (std::sqrt(td * td + dd * left) - td) / dd);
  return {std::max(0.0, most[0]), std::max(0.0, most[1])};
}

double contact_wanted(const Constraint& row, const RowResponse& response, double before,
                      double gap) {
  const ContactConstraint& contact = row.contact();
  double wanted = before - gap / response.normal_response;
  if (contact.push > 0) {
    const double give = contact.push / response.push_most;
    const double pushed =
        before + (contact.push - gap - give * before) / (response.normal_response + give);
    wanted = std::max(wanted, std::min(pushed, response.push_most));
  }
  return std::clamp(wanted, contact.least, contact.most);
}

}  // namespace sunder
