// SPDX-License-Identifier: MIT
// What a run writes about its state: frames for viewers, the tables of fragments and cracks.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "fracture/algorithms/cells.hpp"
#include "fracture/energy/settled_crack.hpp"
#include "fracture/simulation/scene.hpp"
#include "mechanics/state/mechanics_state.hpp"
#include "topology/kernel/finding.hpp"

namespace sunder {

/// Which body and region every tetrahedron came from, a row each: what splits do not change.
struct Origins {
  std::vector<std::int32_t> body;
  /// 0 where the mesh names no regions.
  std::vector<std::int32_t> region;
};

/// The rows of all bodies, one body's tetrahedra after the other's, as a simulation numbers them.
Origins origins(std::span<const BodySettings> bodies);

/// One connected piece.
struct Fragment {
  ComponentId id;
  std::int32_t body = 0;
  std::size_t tetrahedra = 0;
  std::size_t vertices = 0;
  /// kg; m^3 at rest.
  double mass = 0;
  double volume = 0;
  /// m^2 at rest: of all its boundary faces, and of those among them that cracks (cuts at the start
  /// too) have made; the difference was the body's own surface.
  double surface = 0;
  double crack_area = 0;
  /// What it came off, none() for what was there at the start, and the step in which it did.
  ComponentId parent;
  std::uint64_t birth_step = 0;
  /// Mass centre, m, its velocity, m/s, and the spin of the rigid motion with the same angular
  /// momentum, rad/s; all in the world, from the vertices.
  Vec3 center = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();
  Vec3 spin = Vec3::Zero();
  /// Moments of the solid (not of its lumped vertices) about the mass centre, kg m^2, world.
  Mat3 inertia = Mat3::Zero();
};

/// Every living piece in the order of the ids. `birth`: the step of each id's birth, where known.
/// O(|V| + |T|).
std::vector<Fragment> fragments(const Cells& cells, const MechanicsState& mechanics,
                                const Origins& origins, std::span<const std::uint64_t> birth = {});

/// The table of fragments as CSV (RFC 4180, one header line, SI units, numbers that read back
/// exactly), largest mass first, ties by id.
std::string fragments_csv(std::vector<Fragment> fragments);

/// What fans gave up, as CSV in the order of the fans: fan (`fan` in events.jsonl), time
/// (s), area (m^2), energy (J), energy_per_area (J/m^2).
std::string cracks_csv(std::vector<CrackEnergy> cracks);

/// Writes one frame as VTU: the present positions with every vertex as often as the map has it.
/// Point data: `displacement` (m, world: position minus rigid reference), `velocity` (m/s),
/// `node_stress` (Pa, world; six components XX, YY, ZZ, XY, YZ, XZ, VTK's order) and
/// `largest_principal_stress` (Pa). Cell data: `component`, `body`, `region`.
/// `node_stress`: |V|, Pa, rest frame. Errors: those of `write_vtu`.
std::vector<Finding> write_frame(const std::filesystem::path& path, const Cells& cells,
                                 const MechanicsState& mechanics, const Origins& origins,
                                 std::span<const Mat3> node_stress);

}  // namespace sunder
