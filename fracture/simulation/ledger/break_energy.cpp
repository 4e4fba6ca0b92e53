// SPDX-License-Identifier: MIT
// Lowest strengths and least energies to break.
#include "fracture/simulation/ledger/break_energy.hpp"

#include <algorithm>
#include <limits>

namespace sunder {

void note_lowest_strengths(std::vector<double>& strength, const MechanicsState& m,
                           const Cells& cells) {
  strength.assign(m.components.size(), std::numeric_limits<double>::infinity());
  for (std::size_t v = 0; v < m.vertices.size(); ++v) {
    double& lowest = strength[m.vertices.component[v].index()];
    lowest = std::min(lowest, cells.strength[v]);
  }
}

void note_break_energies(std::vector<double>& energy, const MechanicsState& m, const Cells& cells,
                         NodeStress node_stress, BreakEnergyScratch& scratch) {
  energy.assign(m.components.size(), std::numeric_limits<double>::infinity());
  auto& [modulus, density, star] = scratch;
  modulus.assign(m.components.size(), 0);
  density.assign(m.components.size(), 0);
  star.assign(m.vertices.size(), 0);
  for (std::size_t t = 0; t < m.elements.size(); ++t) {
    const std::size_t c = m.elements.component[t].index();
    const Material& material = material_of(m, TetId{t});
    const auto [lambda, mu] = lame(material);
    modulus[c] = std::max(modulus[c], lambda + 2 * mu);
    density[c] = std::max(density[c], material.density);
    for (VertexId v : cells.map.corners()[t]) ++star[v.index()];
  }
  const double share = node_stress == NodeStress::fit ? 1.0 / 16 : 1;
  for (std::size_t v = 0; v < m.vertices.size(); ++v) {
    if (star[v] < 2) continue;
    const std::size_t c = m.vertices.component[v].index();
    // Of second order a corner has m/36 of a tetrahedron, and reads four times the root mean square
    // of a linear field where that is least.
    const bool second = is_second_order(m.elements, m.components[c].tetrahedra.front());
    const double volume = (second ? 36 : 4) * m.vertices.mass[v] / density[c];
    const double part = second ? 1.0 / 16 : share;
    const double least = part * volume * cells.strength[v] * cells.strength[v] / (2 * modulus[c]);
    energy[c] = std::min(energy[c], least);
  }
}

}  // namespace sunder
