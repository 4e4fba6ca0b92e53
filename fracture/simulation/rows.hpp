// SPDX-License-Identifier: MIT
// The map and the columns of a running simulation: to read them, to split faces by a law of one's
// own, to check them.
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
  // A row a vertex.
  std::span<const Vec3> rest_position;  ///< m
  std::span<const Vec3> position;       ///< m, world
  std::span<const Vec3> velocity;       ///< m/s, world
  std::span<const double> mass;         ///< kg, a quarter of every tetrahedron of its star
  std::span<const double> strength;     ///< Pa, the threshold of its largest principal stress
  std::span<const ComponentId> component;
  // A row a tetrahedron.
  std::span<const Mat3> cell_stress;  ///< Pa, symmetric, body frame, tension positive
  std::span<const double> cell_mass;  ///< kg
  std::span<const ComponentId> cell_component;
};

SimulationRows rows_of(const Simulation& simulation);

/// The stress of every vertex, Pa, by the scene's `fracture.node_stress` (eq. 6). O(|T|).
std::vector<Mat3> vertex_stress(const Simulation& simulation);

/// Splits faces between two steps, in the order given, each with all that follows: vertices that
/// come apart get copies of every column, components are found anew, masses and frames of pieces
/// brought up to date (the end of algorithm 4). Faces on the boundary are passed over. The event
/// lists those that were split; its vertex and normal are those of the first of them, `stress` and
/// `strength` stay 0. Errors, with which nothing has changed: `no_such_face`; `ties_between_faces`
/// with the crack mode `cohesive`, where faces come apart only when their ties have taken their
/// energy. O(|T|).
Result<FanEvent> split_faces(Simulation& simulation, std::span<const HalfFaceId> faces);

/// Everything that is wrong with the topology of a simulation: what `check(const VolumeMap&)`
/// finds, and labels of components that a walk does not confirm. Each text begins with the step.
/// Empty after every step. O(|T|), about 5 us a tetrahedron.
std::vector<Finding> check_map(const Simulation& simulation);

}  // namespace sunder
