// SPDX-License-Identifier: MIT
// Strengths of vertices besides those of materials: regions, painted fields, Weibull's law, and
// parts that never break.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fracture/algorithms/cells.hpp"
#include "fracture/strength/body_settings.hpp"
#include "mechanics/state/settings/check_settings.hpp"
#include "topology/base/finding.hpp"

namespace sunder {

/// Which point a strength is drawn for, and the volume it stands for (a quarter of the tetrahedra
/// around it), m^3.
struct DrawPlace {
  std::uint64_t body = 0;
  std::uint64_t point = 0;  ///< row in the body's own mesh
  double volume = 0;
};

/// (V0 / V)^(1/m) (-ln U)^(1/m), U uniform in (0, 1) from (seed, body, point) alone by splitmix64:
/// the same bytes on every machine and in every order. The least of strengths so drawn has the law
/// of the whole volume on any mesh: P(sigma) = 1 - exp(-(V / V0) (sigma / sigma_0)^m).
/// Needs: settings without errors, volume > 0.
double weibull_factor(const WeibullSettings& settings, const DrawPlace& place);

/// Number of the region called `name` in a mesh, by its name, else by its number; nothing where no
/// tetrahedron has it. A mesh without regions has the region 0.
std::optional<std::int32_t> find_region(const TetMesh& mesh, const RegionName& name);

/// Faults of a body's strengths and unbreakable parts, besides ranges: unknown_region,
/// repeated_region, painted_strength. Needs: a mesh with tetrahedra.
void check_strength(fields::SettingsCheck& check, const BodySettings& body);

/// Materials of a body: its own, then one for each entry of `strength.regions`; and for every
/// tetrahedron of its mesh which of them it has. Needs: settings without errors.
struct BodyMaterials {
  std::vector<Material> materials;
  std::vector<std::uint32_t> of_tetrahedron;
};
BodyMaterials materials_of(const BodySettings& body);

/// Fills `painted`, `flaw`, `unbreakable` and then `strength` (of crack tips too) of every vertex.
/// Unbreakable are all vertices of the tetrahedra of an unbreakable region, and those in a box.
/// Needs: settings without errors. O(|V| + |T|).
void draw_strengths(Cells& cells, const MechanicsState& mechanics,
                    std::span<const BodySettings> bodies, std::span<const BodyRows> rows);

}  // namespace sunder
