// SPDX-License-Identifier: MIT
// The scales of an impact: extents, wave speeds, thresholds.
#include "mechanics/contact/impact/impact.hpp"

namespace sunder {

bool is_blow(const MechanicsState& state, const Component& component, double speed, double strength,
             const ImpactSettings& settings) {
  if (component.rigid || component.tetrahedra.empty()) return false;
  const Material& material = material_of(state, component.tetrahedra.front());
  return material.density * compression_wave_speed(material) * speed >=
         settings.negligible * strength;
}

}  // namespace sunder
