// SPDX-License-Identifier: MIT
// One contact, and the memory of contact from step to step.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mechanics/contact/shapes/partner.hpp"
#include "mechanics/state/mechanics_state.hpp"
#include "mechanics/ties/tie.hpp"

namespace sunder {

/// One unilateral contact with friction. Side A is a vertex, a point of a tetrahedron, a sphere, or
/// a corner or a point of an edge of another obstacle. Side B is an obstacle, a face or an edge of
/// a tetrahedron (its ball for `penalty`), or the vertex that was one with A before a crack
/// (`Partner`). The impulse on B acts at the place of A, so that no angular momentum is lost. The
/// corners of B share it by `weights`.
struct ContactPoint {
  static constexpr std::uint32_t none = 0xffffffffu;
  static constexpr std::uint8_t edge_place = 4;      ///< `place` of edge 0 (`edge_ends`)
  static constexpr std::uint8_t overlap_place = 16;  ///< and from here on: of overlaps
  VertexId vertex;                                   ///< A, or
  TetId tetrahedron_a;                               ///< A: `weights_a` of its corners, or
  std::uint32_t ball = none;      ///< A: row of a sphere, or of an obstacle with corners,
  std::uint32_t corner = none;    ///< and which of them (`corner_at`), or
  std::uint32_t edge_a = none;    ///< which of its edges (`edge_at`): `weights_a` of its two ends
  TetId tetrahedron;              ///< B, or
  std::uint32_t obstacle = none;  ///< B: row of an obstacle,
  std::uint32_t edge_b = none;    ///< and which of its edges, where one is met
  /// Of partners: the lowest crack face of A's side that the contact stands for; none() otherwise.
  HalfFaceId face;
  /// The feature of B's tetrahedron that is met: 0 to 3 its faces, from `edge_place` on its edges.
  std::uint8_t place = 0;
  std::uint8_t place_a = 0;                        ///< of A's tetrahedron, by the same numbers
  std::array<double, 4> weights_a = {0, 0, 0, 0};  ///< shares of the corners of A's tetrahedron
  /// Of the corners of B, in the point of the tetrahedron that is nearest to A as they touch.
  std::array<double, 4> weights = {0.25, 0.25, 0.25, 0.25};
  Vec3 normal{0, 0, 1};  ///< from B to A
  /// gap = normal . (point A - reference of B) + offset, m; the reference of B is its point of
  /// `weights`, or how a driven obstacle has moved in the step; a free one is the frame itself, as
  /// it is turned at the start.
  double offset = 0;
  double gap_start = 0;  ///< m, negative: overlapped already
  double friction = 0;
  Vec3 impulse{0, 0, 0};  ///< N s, on A; B gets the opposite

  bool is_body_a() const { return ball == none; }      ///< A: of a body, not of an obstacle
  bool is_body_b() const { return obstacle == none; }  ///< B: likewise
  bool is_of_overlap() const { return !tetrahedron.is_none() && place >= overlap_place; }
  /// A: a sphere; its path is that of its centre.
  bool is_sphere_a() const { return ball != none && corner == none && edge_a == none; }
};

/// The component that side A is of; none() for an obstacle.
inline ComponentId component_of_a(const ContactPoint& contact, const MechanicsState& state) {
  if (!contact.vertex.is_none()) return state.vertices.component[contact.vertex.index()];
  if (contact.tetrahedron_a.is_none()) return ComponentId::none();
  return state.elements.component[contact.tetrahedron_a.index()];
}

/// The component that side B is of; none() for an obstacle.
inline ComponentId component_of_b(const ContactPoint& contact, const MechanicsState& state) {
  if (contact.tetrahedron.is_none()) return ComponentId::none();
  return state.elements.component[contact.tetrahedron.index()];
}

/// Calls `visit(component)` for each side that is of a body.
template <class Visit>
void for_each_component(const ContactPoint& contact, const MechanicsState& state, Visit visit) {
  for (const ComponentId id : {component_of_a(contact, state), component_of_b(contact, state)}) {
    if (!id.is_none()) visit(id);
  }
}

/// The memory of contact from step to step; part of the saved state.
struct ContactMemory {
  /// A contact with the impulse that it last had, and the length of that step, s.
  struct Remembered {
    ContactPoint contact;
    double step = 0;
  };
  /// Where the next solve begins; sorted.
  std::vector<Remembered> last_contacts;
  /// Crack faces that still face each other, in the order in which they came apart. The code that
  /// unsews a face adds it.
  std::vector<Partner> partners;
  /// Crack faces that still hold, within components, in the order in which they came apart. The
  /// code that unsews a face adds it, and removes it once it is spent; the step notes how far
  /// corners have opened.
  std::vector<Tie> ties;
};

}  // namespace sunder
