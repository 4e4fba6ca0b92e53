// SPDX-License-Identifier: MIT
// Rules and warnings of cohesive cracks.
#include "fracture/scene/cohesive_settings.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "mechanics/state/wave_travel.hpp"

namespace sunder {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

void refuse(fields::SettingsCheck& check, const char* key, const std::string& what,
            const std::string& remedy) {
  check.add("cohesive_not_supported", key, what + ", which fracture.crack cohesive cannot do",
            remedy);
}

void check_settings_of(fields::SettingsCheck& check, const Scene& scene) {
  const FractureSettings& f = scene.fracture;
  if (scene.integrator.integrator != Integrator::floating_frame) {
    refuse(check, "integrator.method", "is not floating_frame", "leave it out");
  }
  if (scene.contact.method != ContactMethod::impulses) {
    refuse(check, "contact.method", "is penalty", "take impulses");
  }
  if (!scene.impact.window) refuse(check, "impact.window", "is false", "leave it out");
  if (f.relax > 0) {
    refuse(check, "fracture.relax", "passes loads on within a step",
           "leave it out: ties pass them on in time");
  }
  if (f.criterion == FractureCriterion::energy) {
    refuse(check, "fracture.criterion", "is energy",
           "leave it out: ties take the fracture energy themselves");
  }
}

bool has_energy(const BodySettings& body) {
  const bool breaks = body.material.tensile_strength < infinite || !body.strength.field.empty() ||
                      !body.strength.regions.empty();
  return !breaks || fracture_energy_of(body.material) < infinite;
}

}  // namespace

double cell_of(const MechanicsState& mechanics, MaterialId material) {
  double volume = 0, count = 0;
  for (std::size_t t = 0; t < mechanics.elements.size(); ++t) {
    if (mechanics.elements.material[t] != material) continue;
    volume += mechanics.elements.rest_volume[t];
    ++count;
  }
  return count > 0 ? std::cbrt(6 * volume / count) : 0;
}

void check_cohesive(fields::SettingsCheck& check, const Scene& scene) {
  if (scene.fracture.crack != CrackMode::cohesive) return;
  check_settings_of(check, scene);
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    if (has_energy(scene.bodies[b])) continue;
    check.add("no_fracture_energy", fmt::format("bodies.{}.material", b),
              "has neither a fracture_energy nor a toughness, and cracks are to take energy",
              "give \"fracture_energy\" in J/m^2 (about 33 for concrete) or \"toughness\"");
  }
}

double softening_length(const Material& material) {
  return material.young_modulus * fracture_energy_of(material) /
         (material.tensile_strength * material.tensile_strength);
}

std::vector<Finding> judge_materials(const MechanicsState& mechanics) {
  std::vector<Finding> findings;
  for (std::size_t m = 0; m < mechanics.materials.size(); ++m) {
    const Material& material = mechanics.materials[m];
    if (!(material.tensile_strength < infinite)) continue;
    Material by_toughness = material;
    by_toughness.fracture_energy.reset();
    const double energy = fracture_energy_of(material), other = fracture_energy_of(by_toughness);
    if (std::isfinite(other) && std::abs(energy - other) > 0.05 * energy) {
      findings.push_back(
          {.code = "two_fracture_energies",
           .severity = Severity::warning,
           .ids = {static_cast<std::int64_t>(m)},
           .text = fmt::format("material {} has a fracture energy of {:.4g} J/m^2, and a toughness "
                               "that stands for {:.4g}: ties take the first, tips start by the "
                               "second",
                               m, energy, other),
           .remedy = "leave one of them out"});
    }
    const double cell = cell_of(mechanics, MaterialId{m}), length = softening_length(material);
    if (cell > 0 && length < 3 * cell) {
      findings.push_back(
          {.code = "tip_not_resolved",
           .severity = Severity::warning,
           .ids = {static_cast<std::int64_t>(m)},
           .text = fmt::format("cracks in material {} soften over {:.3g} m, and its cells are "
                               "{:.3g} m: they take the right energy, but how they start at a tip "
                               "is an estimate",
                               m, length, cell),
           .remedy = "take cells a third as long as that, if when a crack goes on matters"});
    }
  }
  return findings;
}

}  // namespace sunder
