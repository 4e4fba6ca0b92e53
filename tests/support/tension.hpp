// SPDX-License-Identifier: MIT
// A body under uniform tension, ready for the fracture functions.
#pragma once

#include <vector>

#include "fracture/algorithms/cells.hpp"
#include "fracture/algorithms/node_stress.hpp"
#include "fracture/breaking/break_vertices.hpp"
#include "mechanics/element/strain_displacement.hpp"
#include "mechanics/rebuild.hpp"
#include "topology/mesh/build_map.hpp"
#include "topology/suite/fixtures/shapes.hpp"

namespace sunder::test {

struct Tension {
  sunder::Cells cells;
  MechanicsState state;

  ElementStress elements() const {
    return {cells.map.corners(), state.elements.stress, state.elements.rest_volume};
  }
};

/// Columns of a mesh that has not moved. Needs: a mesh without errors.
inline MechanicsState columns_of(const VolumeMap& map, const Material& material) {
  std::vector<Vec3> rest;
  for (std::size_t v = 0; v < map.vertices(); ++v) {
    const Point& p = map.point(VertexId{v});
    rest.emplace_back(p[0], p[1], p[2]);
  }
  const std::vector<Material> materials = {material};
  const Components labels = label_components(map);
  return std::move(*make_state({.rest_positions = rest,
                                .corners = map.corners(),
                                .material = {},
                                .component = labels.of_tetrahedron,
                                .materials = materials}));
}

/// Element stress (eq. 5) of a body of one material, from its displacements.
inline void set_stress(MechanicsState& state, const VolumeMap& map, const Material& material) {
  const Lame constants = lame(material);
  for (std::size_t t = 0; t < state.elements.size(); ++t) {
    const CornerVectors d = at_corners(state.vertices.displacement, map.corners(TetId{t}));
    state.elements.stress[t] =
        stress_of(displacement_gradient(state.elements.shape_gradient[t], d), constants);
  }
}

/// `mesh` stretched along the unit vector `axis` (rest frame) by the tension `stress` (Pa): the
/// displacement is linear, so every element has exactly this stress, to rounding.
inline Tension uniform_tension(const TetMesh& mesh, const Vec3& axis, double stress,
                               const Material& material = {}) {
  VolumeMap map = std::move(*build_map(mesh));
  MechanicsState state = columns_of(map, material);
  const Mat3 along = axis * axis.transpose();
  const Mat3 strain = stress / material.young_modulus *
                      (along - material.poisson_ratio * (Mat3::Identity() - along));
  for (std::size_t v = 0; v < state.vertices.size(); ++v) {
    state.vertices.displacement[v] = strain * state.vertices.rest_position[v];
  }
  set_stress(state, map, material);
  sunder::Cells cells = make_cells(std::move(map), state);
  return {std::move(cells), std::move(state)};
}

}  // namespace sunder::test
