// SPDX-License-Identifier: MIT
// Releases of fans at vertices of a body in equilibrium: `sunder static --fan`, `--fans`.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fracture/energy/energy_release.hpp"
#include "fracture/simulation/simulation_state.hpp"

namespace sunder {

/// A fan asked for and the energy that it would release.
struct FanAnswer {
  std::uint32_t point = 0;  ///< of the bodies' meshes, one after the other
  Vec3 normal = Vec3::Zero();
  std::size_t faces = 0;
  EnergyRelease release;
  /// J/m^2, of the material there; infinite without a toughness.
  double fracture_energy = 0;
};

/// The fault of a text V,NX,NY,NZ, empty when there is none.
std::string check_fan_text(const std::string& list);

/// `sim`: as `solve_scene` leaves it; is not changed. `list`: V,NX,NY,NZ, the normal in the mesh's
/// own axes. Errors: those of `fan_faces` and `energy_release`.
Result<FanAnswer> fan_answer(Simulation& sim, const std::string& list);

/// A vertex near its threshold and the energy that its fan would release.
struct FanCandidate {
  FanAnswer fan;
  double share = 0;  ///< largest principal stress over the strength
  /// J/m^2: release of the crack's front there (`tip_energy`), where the vertex is on one.
  std::optional<double> front;
};

/// The fan, if there is one, of every vertex with a largest principal stress of at least `share` of
/// its strength, by falling energy per area. `sim`: as `solve_scene` leaves it; is not changed;
/// `node_stress`: |V|. Errors: those of `energy_release`. Cost: one of those a vertex.
Result<std::vector<FanCandidate>> fan_candidates(Simulation& sim, std::span<const Mat3> node_stress,
                                                 double share);

/// Infinite numbers as null.
nlohmann::ordered_json to_json(const FanAnswer& answer);
nlohmann::ordered_json to_json(const std::vector<FanCandidate>& candidates);
std::string to_table(const FanAnswer& answer);
std::string to_table(const std::vector<FanCandidate>& candidates);

}  // namespace sunder
