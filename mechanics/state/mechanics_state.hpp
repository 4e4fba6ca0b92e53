// SPDX-License-Identifier: MIT
// The evolving state: columns, components and their frames.
#pragma once

#include <vector>

#include "mechanics/state/columns.hpp"
#include "mechanics/state/component.hpp"
#include "mechanics/state/component_systems.hpp"
#include "mechanics/state/settings/material.hpp"

namespace sunder {

/// Everything that has to be saved to go on later. After every public operation the two
/// descriptions agree: position and velocity on one side, the frames of the components with
/// displacement and displacement_rate on the other.
struct MechanicsState {
  VertexColumns vertices;
  ElementColumns elements;
  std::vector<Material> materials;
  std::vector<PrescribedMotion> motions;
  /// Row = ComponentId. A component without tetrahedra is an id that was never given.
  std::vector<Component> components;
  double time = 0;  ///< s
  ComponentSystems systems;
};

/// The material of a tetrahedron.
inline const Material& material_of(const MechanicsState& state, TetId t) {
  return state.materials[state.elements.material[t.index()].index()];
}

}  // namespace sunder
