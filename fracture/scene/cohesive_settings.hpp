// SPDX-License-Identifier: MIT
// Demands of `CrackMode::cohesive` on a scene, and its findings about materials.
#pragma once

#include <vector>

#include "fracture/scene/scene.hpp"
#include "mechanics/state/mechanics_state.hpp"
#include "mechanics/state/settings/check_settings.hpp"

namespace sunder {

/// Refuses features that cannot go with ties: cohesive_not_supported, no_fracture_energy. Nothing
/// in other modes.
void check_cohesive(fields::SettingsCheck& check, const Scene& scene);

/// m: mean size of the cells of a material, the cube root of six of their mean volumes; 0 without
/// any.
double cell_of(const MechanicsState& mechanics, MaterialId material);

/// m: l_z = E G_c / sigma^2, over which the tip of a crack softens.
double softening_length(const Material& material);

/// Adds findings for materials with a finite strength. two_fracture_energies: toughness and G_c are
/// given and more than 5 per cent apart. tip_not_resolved: l_z is shorter than 3 cells; cracks take
/// the right energy, but `vertex_strength` decides where they begin at a tip. Needs: a scene and
/// meshes without errors.
void judge_materials(fields::SettingsCheck& check, const Scene& scene);

}  // namespace sunder
