// SPDX-License-Identifier: MIT
// What `CrackMode::cohesive` needs of a scene, and what it says of its materials.
#pragma once

#include <vector>

#include "fracture/scene/scene.hpp"
#include "mechanics/state/settings/check_settings.hpp"
#include "mechanics/state/mechanics_state.hpp"

namespace sunder {

/// Refuses what cannot go with ties: cohesive_not_supported, no_fracture_energy. Nothing in other
/// modes.
void check_cohesive(fields::SettingsCheck& check, const Scene& scene);

/// m: mean size of the cells of a material, the cube root of six of their mean volumes; 0 without
/// any.
double cell_of(const MechanicsState& mechanics, MaterialId material);

/// m: l_z = E G_c / sigma^2, over which the tip of a crack softens.
double softening_length(const Material& material);

/// Adds, for materials whose strength is finite: two_fracture_energies (toughness and G_c are given
/// and more than 5 per cent apart), tip_not_resolved (l_z is shorter than 3 cells: cracks take the
/// right energy, and where they begin at a tip is decided by `vertex_strength`).
/// Needs: a scene and meshes without errors.
void judge_materials(fields::SettingsCheck& check, const Scene& scene);

}  // namespace sunder
