// SPDX-License-Identifier: MIT
// A pressure pulse that meets the free end of a flat bar and breaks layers off it.
#pragma once

#include <optional>
#include <vector>

namespace sunder::accuracy {

/// A bar of Kuhn cells, 1 m long, nu = 0, in which a sawtooth of compression runs towards a free
/// end: it rises to s0 over r = `front` cells and falls to nothing over the rest of its length l.
/// The reflected pulse is tension. Less the rest that still comes in, it is 2 s0 delta / (l - r) at
/// the depth delta. So the first layer comes off at (l - r) xi / (2 s0), at the speed (2 s0 - xi) /
/// (rho c). If the front is sharp, the remaining peak s0 - xi does the same: floor(s0 / xi) layers
/// of that thickness. If it rises over some cells, it does not. The part of the rise that passed
/// the crack before it opened runs ahead of the release. It meets less and less incoming
/// compression, and breaks on behind the first layer, however fine the mesh is.
struct Spall {
  int cells = 150, across = 1;
  double length = 0.4;      ///< l, m
  double peak = 1.5;        ///< s0 / xi
  double front = 8;         ///< cells
  double step = 0.25;       ///< of a wave's way through a cell
  double viscosity = 0.1;   ///< C = this (cell / c) K
  double front_length = 0;  ///< m: the rise where it is not to depend on the cells
  std::optional<double> fracture_energy = {};  ///< G_c, J/m^2: cohesive cracks
};

struct SpallOutcome {
  std::vector<double> thickness;  ///< m, of the layers, the first one first
  double exact_thickness = 0;     ///< (l - r) xi / (2 s0)
  std::size_t exact_layers = 0;   ///< floor(s0 / xi), of a sharp front
  double speed = 0;               ///< of the first layer; 0: none / ((2 s0 - xi) / (rho c))
  double time = 0;      ///< of the first crack / (time from the front's reflection, delta / c)
  double momentum = 0;  ///< at the end / that of the pulse
};

/// Runs until the pulse has gone.
SpallOutcome run_spall(const Spall& spall);

/// Results of the one-dimensional program (`chain::Chain`) for the same pulse.
struct ChainSpallOutcome {
  std::vector<double> thickness;  ///< m, of the layers, the first one first
  std::size_t live = 0;           ///< nodes open by more than a tenth of their critical opening
  double residual = 0;            ///< of the ledger / energy of the pulse
  double momentum = 0;            ///< at the end / that of the pulse
};

/// The same pulse, material and end on `cells` bars, in steps of `step` of a wave's way through
/// one. Needs a fracture energy and a `front_length`; the step and viscosity of `spall` do not
/// count.
ChainSpallOutcome run_spall_on_chain(const Spall& spall, int cells, double step = 0.1);

}  // namespace sunder::accuracy
