// SPDX-License-Identifier: MIT
// Rules and warnings of cohesive cracks.
#include "fracture/scene/cohesive_settings.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>

#include "fracture/scene/body_measures.hpp"
#include "fracture/strength/draw_strength.hpp"
#include "mechanics/state/wave_travel.hpp"
#include "topology/base/elementary.hpp"

namespace sunder {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

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
  const bool breaks = body.material.tensile_strength < infinity || !body.strength.field.empty() ||
                      !body.strength.regions.empty();
  return !breaks || fracture_energy_of(body.material) < infinity;
}

/// m, of the tetrahedra of one of a body's materials.
double cell_of(const TetMesh& mesh, const BodyMaterials& own, std::size_t material) {
  double volume = 0, count = 0;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    if (own.of_tetrahedron[t] != material) continue;
    std::array<Eigen::Vector3d, 4> x;
    for (std::size_t k = 0; k < 4; ++k) {
      const Point& p = mesh.points[mesh.tetrahedra[t][k]];
      x[k] = {p[0], p[1], p[2]};
    }
    volume += (x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]) / 6;
    ++count;
  }
  return count > 0 ? cube_root(6 * volume / count) : 0;
}

void judge_energies(fields::SettingsCheck& check, const std::string& place,
                    const Material& material) {
  Material by_toughness = material;
  by_toughness.fracture_energy.reset();
  const double energy = fracture_energy_of(material), other = fracture_energy_of(by_toughness);
  if (!std::isfinite(other) || std::abs(energy - other) <= 0.05 * energy) return;
  check.add("two_fracture_energies", place,
            fmt::format("has a fracture energy of {:.4g} J/m^2, and a toughness that stands for "
                        "{:.4g}: ties take the first, tips start by the second",
                        energy, other),
            "leave one of them out");
}

/// What to do about cells that are `factor` times too large. Advice that no computer can follow is
/// none.
std::string finer_mesh_advice(std::size_t tetrahedra, double factor, double cell) {
  const double needed = static_cast<double>(tetrahedra) * factor * factor * factor;
  if (needed <= most_advised_tetrahedra) {
    return fmt::format("take cells of {:.2g} m, if when a crack goes on matters", cell);
  }
  return fmt::format(
      "trust energies and sizes of large pieces, and not the moment at which a crack goes on: "
      "cells "
      "of {:.2g} m would be {:.1g} tetrahedra",
      cell, needed);
}

/// `tetrahedra`: of the body.
void judge_tip(fields::SettingsCheck& check, const std::string& place, const Material& material,
               double cell, std::size_t tetrahedra) {
  const double length = softening_length(material);
  if (!(cell > 0) || length >= 3 * cell) return;
  check.add("tip_not_resolved", place,
            fmt::format("lets cracks soften over {:.3g} m, and its cells are {:.3g} m: they take "
                        "the right energy, but how they start at a tip is an estimate",
                        length, cell),
            finer_mesh_advice(tetrahedra, 3 * cell / length, length / 3));
}

}  // namespace

double cell_of(const MechanicsState& mechanics, MaterialId material) {
  double volume = 0, count = 0;
  for (std::size_t t = 0; t < mechanics.elements.size(); ++t) {
    if (mechanics.elements.material[t] != material) continue;
    volume += mechanics.elements.rest_volume[t];
    ++count;
  }
  return count > 0 ? cube_root(6 * volume / count) : 0;
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

void judge_materials(fields::SettingsCheck& check, const Scene& scene) {
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const BodySettings& body = scene.bodies[b];
    const BodyMaterials own = materials_of(body);
    for (std::size_t m = 0; m < own.materials.size(); ++m) {
      if (!(own.materials[m].tensile_strength < infinity)) continue;
      const std::string place = m == 0 ? fmt::format("bodies.{}.material", b)
                                       : fmt::format("bodies.{}.strength.regions.{}", b, m - 1);
      judge_energies(check, place, own.materials[m]);
      judge_tip(check, place, own.materials[m], cell_of(body.mesh, own, m),
                body.mesh.tetrahedra.size());
    }
  }
}

}  // namespace sunder
