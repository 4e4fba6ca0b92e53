// SPDX-License-Identifier: MIT
// The energy that a crack's front would release at one of its vertices, from the deformation alone.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "fracture/algorithms/cells.hpp"

namespace sunder {

/// Displacements and their stresses, body frame.
struct Deformed {
  std::span<const Vec3> displacement;  ///< |V|, m
  std::span<const Mat3> stress;        ///< |T|, Pa
  /// |T|, Pa, of second order (see `ElementColumns`); empty: none is.
  std::span<const std::array<Mat3, 4>> corner_stress;
};

/// Over which tetrahedra the integral of `tip_energy` runs.
enum class TipDomain {
  star,       ///< the vertex's own: of a linear element's size, 10 to 40 per cent low
  two_rings,  ///< the ring around that; `star` where the front turns too much to be seen so
};

/// G, J/m^2: the energy released per area if the front of the crack went on in its plane at
/// `vertex`, by the domain integral J = sum V (H^T sigma - W I) grad q . e [Eshelby 1951; Li, Shih
/// and Needleman 1985] over the area that the front would sweep: e its direction, q one at the
/// vertex (and its star), falling to nothing over the tetrahedra around.
/// Nothing where no edge at the vertex is a front: one round which one side of a cracked face leads
/// to its other side. Never below zero. Loads and inertia within the domain are left out.
/// Exact as the stress field is; no solve. O(two rings), 12 us; 1 us where nothing is cracked.
std::optional<double> tip_energy(const Cells& cells, const ElementColumns& elements,
                                 const Deformed& deformed, VertexId vertex,
                                 TipDomain domain = TipDomain::two_rings);

/// A vertex and its node stress, Pa.
struct StressedVertex {
  VertexId vertex;
  const Mat3& stress;
};

/// The threshold of the criterion `energy`, Pa: the largest principal stress that a crack tip would
/// have if `tip_energy` were G_c = K_Ic^2 (1 - nu^2) / E, the least around it (stresses go with the
/// square root of the energy); infinite where nothing would be released. `vertex_strength` for all
/// other vertices, and where no material has a toughness.
double tip_strength(const Cells& cells, const MechanicsState& mechanics, const Deformed& deformed,
                    const StressedVertex& at);

}  // namespace sunder
