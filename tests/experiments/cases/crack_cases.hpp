// SPDX-License-Identifier: MIT
// Cracks with closed forms: an edge crack in a pulled strip and a penny-shaped one in a block.
#pragma once

#include <cstdint>
#include <vector>

namespace sunder::accuracy {

/// Results at the crack tip of a cracked body, against the closed form.
struct CrackAnswer {
  int cells = 0;             ///< a / h: crack length over the elements at its tip
  std::size_t vertices = 0;  ///< of the body
  double tip_stress = 0;     ///< largest principal node stress (volume) at the tip / applied stress
  /// Energy released per area, over that of the closed form: by growing the whole front by one
  /// element, and the mean over its vertices of single fans.
  double front_release = 0, fan_release = 0;
  /// Energy of the domain integral at the front's vertices over the closed form's at the crack as
  /// it is: over the tip's star, over two rings; the mean, and the largest of the latter.
  double star_energy = 0, domain_energy = 0, most_energy = 0;
  /// Breaking load over the closed form's: by the tip threshold C K_Ic / sqrt(h), by the energy
  /// of the whole front, and by a strength without toughness that is right at a / h = 8.
  double load_toughness = 0, load_energy = 0, load_strength = 0;
  /// C of C K_Ic / sqrt(h) for which tip stress and energy of the front break at the same load.
  double factor = 0;
};

/// The division of a case into elements, and their order.
struct CrackMesh {
  int cells = 8;            ///< a / h
  std::uint32_t order = 1;  ///< of its tetrahedra
};

/// A strip 4 a wide and 12 a long, one element thick, nu = 0 (so plane stress and plane strain are
/// one), crack a at its edge: K_I = sigma sqrt(pi a) (1.122 - 0.231 s + 10.55 s^2 - 21.72 s^3 +
/// 30.39 s^4), s = a / W = 1/4 [Tada, Paris and Irwin: within 0.5 per cent].
CrackAnswer edge_crack(CrackMesh mesh);
std::vector<CrackAnswer> edge_cracks(const std::vector<int>& cells, std::uint32_t order = 1);

/// A penny-shaped crack of radius a in a cylinder of 5 a by 10 a, nu = 0.2, 32 elements round its
/// front: G = 4 (1 - nu^2) sigma^2 a / (pi E) [Sneddon 1946], meant over the area that is grown.
CrackAnswer penny_crack(CrackMesh mesh);

}  // namespace sunder::accuracy
