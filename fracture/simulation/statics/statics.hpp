// SPDX-License-Identifier: MIT
// A scene without time: the equilibrium of its bodies, and their natural frequencies.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fracture/simulation/simulation.hpp"

namespace sunder {

/// A largest value and its place.
struct Extreme {
  double value = 0;
  /// Row of the body's mesh points.
  std::size_t point = 0;
  /// Position on the undeformed body as the scene places it, m, world.
  Vec3 position = Vec3::Zero();
};

/// Reaction of one support, a box of constrained vertices.
struct SupportReaction {
  std::size_t vertices = 0;
  Vec3 force = Vec3::Zero();   ///< N, world, of the support on the body
  Vec3 moment = Vec3::Zero();  ///< N m, world, about the body's mass centre
};

/// Equilibrium of one body.
struct BodyEquilibrium {
  std::string name;
  std::size_t vertices = 0, nodes = 0, tetrahedra = 0;  ///< nodes: with those of edges
  double mass = 0;                                      ///< kg
  Extreme displacement;      ///< m, magnitude, from the place in the scene
  double strain_energy = 0;  ///< J
  Extreme principal_stress;  ///< Pa, largest eigenvalue of a node stress (eq. 6)
  Extreme strength_share;    ///< ratio to the vertex's tensile strength; from 1 on it breaks
  Vec3 load = Vec3::Zero();  ///< N, world: gravity, pressure and forces, also at supports
  std::vector<SupportReaction> supports;  ///< as the scene's `held`
  /// Largest unbalanced force at a free node, N: rounding.
  double residual = 0;
};

/// Equilibrium of all bodies of a scene.
struct Equilibrium {
  std::vector<BodyEquilibrium> bodies;  ///< row = body of the scene
  /// Stress at each vertex of the simulation, Pa, in the axes of the bodies' meshes. The scene
  /// chooses the averaging (`FractureSettings::node_stress`). With order 2 it is the mean over the
  /// tetrahedra at that place, and the nodes of edges follow the vertices.
  std::vector<Mat3> node_stress;
};

/// Builds a simulation for the functions below, as `build_simulation` does, but allows all settings
/// that are refused only for moving bodies of order 2 (`second_order_findings`).
Result<Simulation> build_statics(Scene scene);

/// Moves the bodies of `simulation` to the equilibrium at the end of a slow run of the scene:
/// gravity and loads fully raised, constrained vertices displaced by velocity times duration.
/// Obstacles and starting velocities have no effect, with a note for the latter. A warning names
/// parts that turn too far for the linear model. Nothing breaks. Requires: a simulation at its
/// start. Errors: "not_supported" with the body's name; "not_a_number". Cost: one factor and one
/// solve.
Result<Equilibrium> solve_scene(Simulation& simulation);

/// The lowest natural modes of one piece with its constrained vertices at rest.
struct PieceModes {
  ComponentId component;
  std::size_t body = 0;  ///< row of its body in the scene
  /// Number of modes that are rigid motions: 6 for a free piece, 0 for a supported one, and fewer
  /// than 6 if only one or two vertices, or vertices on a line, are constrained. They come first
  /// and have frequency 0.
  std::size_t rigid = 0;
  std::vector<double> frequency;  ///< Hz, ascending
  std::vector<VertexId> vertex;   ///< rows of the piece's vertices, ascending
  /// shape[k][i]: displacement of vertex[i] in mode k in the axes of the body's mesh, scaled so
  /// that the sum of m |shape|^2 over the vertices is 1 kg m^2; the entry of largest size is
  /// positive.
  std::vector<std::vector<Vec3>> shape;
};

/// The rigid modes and the `count` lowest other modes of every piece of `simulation`, without
/// gravity, loads and obstacles. Requires: a simulation at its start. Errors: "modes_not_found".
/// Cost: two factors and about 3 `count` solves per piece (docs/explanation/theory.md).
Result<std::vector<PieceModes>> scene_modes(Simulation& simulation, std::size_t count);

}  // namespace sunder
