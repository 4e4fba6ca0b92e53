// SPDX-License-Identifier: MIT
// Bodies and contacts as the solver sees them: responses to impulses, no mesh.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <variant>
#include <vector>

#include "mechanics/state/columns.hpp"

namespace sunder {

/// Motion that a body has received in a solve so far.
struct BodyMotion {
  Vec3 velocity = Vec3::Zero();                        ///< m/s, change
  Vec3 spin = Vec3::Zero();                            ///< rad/s, change
  Eigen::VectorXd displacement;                        ///< 3k, m: change by E, own frame
  Vec3 impulse = Vec3::Zero(), moment = Vec3::Zero();  ///< on slots, own frame, N s and N s m
};

/// Displacement of a body's slots at the end of the step from impulses: a rigid part h (J/m + I^-1
/// T x arm) plus an elastic part between its slots,
///   turn (E + rest_arm x J0^-1 (rest_arm x .) - 1/m) turn^T.
/// The last two terms, over all slots at once, remove the rigid response that E contains. They are
/// kept apart so that neither a turn of the body nor other slots cost a pass over E.
struct RespondingBody {
  double inverse_mass = 0;              ///< 1/kg; 0: does not move
  Mat3 inverse_inertia = Mat3::Zero();  ///< 1/(kg m^2), world
  Eigen::MatrixXd elastic;              ///< E, 3k x 3k, m/(N s), the body's own frame; empty: rigid
  Mat3 turn = Mat3::Identity();         ///< from that frame to the world
  double rigid_mass = 0;                ///< 1/m of the elastic part, m/(N s)
  Mat3 rigid_inertia = Mat3::Zero();    ///< J0^-1 of the elastic part, 1/(N s m)
  BodyMotion motion;                    ///< motion accumulated by the solve
  /// Source of E for `merge_ends`, if not `elastic`: `cached_scale` times blocks of a larger
  /// matrix. Slot k takes the blocks at `cached_places[k]`, or none. Needed until then only.
  const Eigen::MatrixXd* cached = nullptr;
  std::vector<std::uint32_t> cached_places;
  double cached_scale = 1;
};

/// One of the points a contact acts on; the solver takes those of a body together (`RowSide`).
struct ContactEnd {
  static constexpr std::uint32_t no_slot = 0xffffffffu;
  std::uint32_t body = 0;
  std::uint32_t slot = no_slot;  ///< the vertex's place among those of its body
  double weight = 1;             ///< share of the impulse: sums to +1 on side A, -1 on side B
  Vec3 arm = Vec3::Zero();       ///< m, from the body's mass centre
  Vec3 rest_arm = Vec3::Zero();  ///< m, of the vertex at rest in the body's own frame
  VertexId vertex;               ///< none() for a whole isolated tetrahedron or a ball
  /// m, from the vertex (from the mass centre of an isolated tetrahedron) to where the contact
  /// acts. An impulse there turns the body by so much more.
  Vec3 lever = Vec3::Zero();
};

/// Everything that a contact acts on in one body: sums over its ends, each times its weight.
struct RowSide {
  std::uint32_t body = 0;
  std::uint32_t slot = ContactEnd::no_slot;  ///< its place in the body's elastic response, if any
  double weight = 1;                         ///< 0 where both sides are of one body
  Vec3 arm = Vec3::Zero();                   ///< m
  Vec3 rest_arm = Vec3::Zero();              ///< m
};

/// The law of a row that keeps two sides from overlapping: pressure within bounds, and friction.
struct ContactConstraint {
  double gap = 0;   ///< m: gap at the end of the step with the impulse as it is, less its target
  double push = 0;  ///< m, >= 0: how much more the gap should be, if that takes little impulse
  double friction = 0;  ///< no unit: Coulomb's coefficient
  double least = 0;     ///< N s: lower bound of the normal impulse
  double most = std::numeric_limits<double>::infinity();  ///< N s: upper bound
  /// N s: radius of the friction's disk. Each solve of a row begins with the radius that the last
  /// one ended with.
  double disk = 0;
};

/// The law of a row that holds two sides of a crack together: a tie as the solver sees it
/// (tie_row.hpp). The row's `slip` is then the whole opening, and its `compliance` the secant's.
struct CohesiveBond {
  double most = 0;               ///< N s: the effective pull that the bond bears (`bond_kept`)
  double sliding_stiffness = 1;  ///< no unit: across over along the normal (tie_law.hpp)
  /// m/(N s): `bond_response`, or a bound of it. A solve sets it, and measures of
  /// the row until the next solve need it (`measure_tie`).
  double response = 0;
};

/// One row of three unknowns: the impulse between two sides, by the law of the row.
struct Constraint {
  /// Side A has at most four corners of a tetrahedron, side B six nodes of a face of second order.
  std::array<ContactEnd, 10> ends;
  std::uint32_t end_count = 0;
  std::array<RowSide, 2> sides;  ///< of different bodies
  std::uint32_t side_count = 0;
  Vec3 normal{0, 0, 1};
  Vec3 slip{0, 0, 0};     ///< m: relative displacement over the step with the impulse as it is
  double compliance = 0;  ///< m/(N s): give of the row itself, without that of its bodies
  Vec3 impulse{0, 0, 0};  ///< N s; in: the present one, out: the solved one
  Vec3 guess{0, 0, 0};    ///< N s: a first change, such as the need of the last step
  std::variant<ContactConstraint, CohesiveBond> law;

  bool is_bond() const { return std::holds_alternative<CohesiveBond>(law); }
  /// Needs: `is_bond` is false.
  ContactConstraint& contact() { return *std::get_if<ContactConstraint>(&law); }
  const ContactConstraint& contact() const { return *std::get_if<ContactConstraint>(&law); }
  /// Needs: `is_bond` is true.
  CohesiveBond& bond() { return *std::get_if<CohesiveBond>(&law); }
  const CohesiveBond& bond() const { return *std::get_if<CohesiveBond>(&law); }
};

/// Sums up the ends of each row by body, and each body's E, given between its vertices, becomes
/// that between the sides of its rows, one slot for all that have the same ends. Exact.
void merge_ends(std::span<Constraint> rows, std::span<RespondingBody> bodies);

/// Displacement of side A against side B by the motions of the bodies, m.
Vec3 relative_displacement(const Constraint& row, std::span<const RespondingBody> bodies,
                           double step);

/// Adds an impulse of a row to the motions of its bodies. O(slots of the bodies).
void add_impulse(const Constraint& row, std::span<RespondingBody> bodies, const Vec3& impulse);

/// Adds one impulse a row at once: one product with each E. O(slots^2 of each body).
void add_impulses(std::span<const Constraint> rows, std::span<RespondingBody> bodies,
                  std::span<const Vec3> impulses);

/// Nothing got yet.
void set_to_rest(std::span<RespondingBody> bodies);

}  // namespace sunder
