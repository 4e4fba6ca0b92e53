// SPDX-License-Identifier: MIT
// The scales of an impact: extents, wave speeds, thresholds; and the check of the settings.
#include "mechanics/contact/impact.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace sunder {
namespace {

Finding refused(std::string_view place, const char* key, double value, const char* allowed) {
  Finding finding;
  finding.code = "bad_impact_setting";
  finding.text = std::string(place) + "." + key + " is " + std::to_string(value) + "; allowed is " +
                 allowed + ".";
  finding.remedy = "Leave it out for the default.";
  return finding;
}

}  // namespace

std::vector<Finding> check(const ImpactSettings& settings, std::string_view place) {
  std::vector<Finding> findings;
  // Written so that a NaN fails each test.
  if (!(settings.fraction > 0 && settings.fraction <= 1)) {
    findings.push_back(
        refused(place, "fraction", settings.fraction, "a number above 0 and at most 1"));
  }
  if (!(settings.negligible > 0 && settings.negligible <= 1)) {
    findings.push_back(
        refused(place, "negligible", settings.negligible, "a number above 0 and at most 1"));
  }
  if (settings.max_sub_steps < 1) {
    findings.push_back(refused(place, "max_sub_steps", 0, "a whole number from 1 on"));
  }
  return findings;
}

double wave_sub_step(const MechanicsState& state, const Component& component,
                     const ImpactSettings& settings) {
  return std::max(settings.fraction * extent_travel(state, component),
                  0.5 * cell_travel(state, component));
}

bool is_blow(const MechanicsState& state, const Component& component, double speed,
             const ImpactSettings& settings) {
  if (component.isolated || component.tetrahedra.empty()) return false;
  const Material& material = material_of(state, component.tetrahedra.front());
  return material.density * compression_wave_speed(material) * speed >=
         settings.negligible * material.tensile_strength;
}

}  // namespace sunder
