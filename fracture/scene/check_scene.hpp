// SPDX-License-Identifier: MIT
// Faults of a scene before anything is built, except those of its meshes (`check_mesh`).
#pragma once

#include <vector>

#include "fracture/scene/scene_fields.hpp"
#include "mechanics/state/settings/check_settings.hpp"
#include "topology/base/limits.hpp"

namespace sunder {

/// More steps than these no run takes.
inline double most_steps() { return static_cast<double>(limits().steps); }

/// All errors in a scene's settings, each with its place ("bodies.0.held.1"): numbers out of range
/// and the rules between keys below. The meshes may be faulty; a body without one is held to its
/// numbers alone.
std::vector<SettingFinding> check_scene(const Scene& scene);

/// second_order_in_motion: features of runs that bodies of order 2 do not support, where the scene
/// uses them.
std::vector<SettingFinding> second_order_findings(const Scene& scene);

/// bad_box: a minimum above its maximum. no_load: neither a pressure nor a force.
void check_together(fields::SettingsCheck& check, const HeldBox& box);
void check_together(fields::SettingsCheck& check, const LoadBox& box);
void check_together(fields::SettingsCheck& check, const RestBox& box);
/// nothing_held, nothing_loaded, nothing_unbreakable: a box without a vertex of the mesh.
/// mesh_size, too_far: coordinates that reals cannot distinguish. velocity_not_held: a velocity
/// along an axis on which its vertices are free. Also the findings of `check_strength`.
void check_together(fields::SettingsCheck& check, const BodySettings& body);
/// no_body; too_many_steps; axes_not_supported: features that do not go with vertices held along
/// some axes. fit_of_second_order: a node stress that is no average. free_not_supported,
/// rubble_not_supported: features that penalty contact does not support.
void check_together(fields::SettingsCheck& check, const Scene& scene);

}  // namespace sunder
