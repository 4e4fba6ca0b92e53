// SPDX-License-Identifier: MIT
// The map and the columns of a running simulation: reading them, splitting faces by a law of one's
// own, checking them.
#pragma once

#include <span>
#include <vector>

#include "fracture/algorithms/fan_event.hpp"
#include "fracture/simulation/simulation.hpp"
#include "topology/kernel/volume_map.hpp"

namespace sunder {

/// The 3-map of all bodies. With the kernel `lcc` (`Scene::topology`) its `darts()` are CGAL's, and
/// every topological answer of the run comes from them.
const VolumeMap& map_of(const Simulation& simulation);

/// Columns by the rows of `map_of`; valid until the simulation changes.
struct SimulationRows {
  // One row per vertex.
  std::span<const Vec3> rest_position;  ///< m
  std::span<const Vec3> position;       ///< m, world
  std::span<const Vec3> velocity;       ///< m/s, world
  std::span<const double> mass;         ///< kg, a quarter of every tetrahedron of its star
  std::span<const double> strength;     ///< Pa, the threshold of its largest principal stress
  std::span<const ComponentId> component;
  // One row per tetrahedron.
  std::span<const Mat3> cell_stress;  ///< Pa, symmetric, body frame, tension positive
  std::span<const double> cell_mass;  ///< kg
  std::span<const ComponentId> cell_component;
};

SimulationRows rows_of(const Simulation& simulation);

/// The stress of every vertex, Pa, by the scene's `fracture.node_stress` (eq. 6). O(|T|).
std::vector<Mat3> vertex_stress(const Simulation& simulation);

/// Splits faces between two steps, in the given order, with all consequences: vertices that split
/// get copies of every column, components are found, and masses and frames of pieces are updated
/// (the end of algorithm 4). Faces on the boundary are skipped. The event lists the split faces.
/// Its vertex and normal are those of the first one, and `stress` and `strength` stay 0. Errors,
/// which change nothing: `no_such_face`; `ties_between_faces` with the crack mode `cohesive`,
/// because its faces separate only after their ties have taken their energy. O(|T|).
Result<FanEvent> split_faces(Simulation& simulation, std::span<const HalfFaceId> faces);

/// Checks the topology of a simulation: the faults that `check(const VolumeMap&)` finds, and labels
/// of components that a walk does not confirm. Each text begins with the step. The result is empty
/// after every correct step. O(|T|), about 5 µs per tetrahedron.
std::vector<Finding> check_map(const Simulation& simulation);

}  // namespace sunder
