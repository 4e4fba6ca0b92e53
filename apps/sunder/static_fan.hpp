// SPDX-License-Identifier: MIT
// What a fan at a vertex of a body in equilibrium would release: `sunder static --fan`.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "fracture/energy_release.hpp"
#include "fracture/simulation.hpp"

namespace sunder {

/// A fan asked for and what it would release.
struct FanAnswer {
  std::uint32_t point = 0;  ///< of the bodies' meshes, one after the other
  Vec3 normal = Vec3::Zero();
  std::size_t faces = 0;
  EnergyRelease release;
  /// J/m^2, of the material there; infinite without a toughness.
  double fracture_energy = 0;
};

/// What is wrong with V,NX,NY,NZ, empty when nothing is.
std::string check_fan_text(const std::string& list);

/// `sim`: as `solve_scene` leaves it; is not changed. `list`: V,NX,NY,NZ, the normal in the mesh's
/// own axes. Errors: those of `fan_faces` and `energy_release`.
Result<FanAnswer> fan_answer(Simulation& sim, const std::string& list);

/// Infinite numbers as null.
nlohmann::ordered_json to_json(const FanAnswer& answer);
std::string to_table(const FanAnswer& answer);

}  // namespace sunder
