// SPDX-License-Identifier: MIT
// The systems of all components, kept from step to step.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

namespace sunder {

struct ComponentSystem;

/// Matrices and factors of the components. They follow from the rest of the state to rounding only:
/// a factor that serves on after a split rounds otherwise than a new one, and entries of an inverse
/// otherwise in another order of columns. So they are state: copied and saved with it.
struct ComponentSystems {
  ComponentSystems();
  ComponentSystems(const ComponentSystems& other);
  ComponentSystems& operator=(const ComponentSystems& other);
  ComponentSystems(ComponentSystems&&) noexcept;
  ComponentSystems& operator=(ComponentSystems&&) noexcept;
  ~ComponentSystems();

  /// Row = ComponentId; null until needed. `retired`: the system before its last split, with
  /// factors that may serve on (`extend_system`).
  std::vector<std::unique_ptr<ComponentSystem>> present, retired;
  /// Row = VertexId: its place in `ComponentSystem::order`; valid for components with a system.
  std::vector<std::uint32_t> local_row;
};

}  // namespace sunder
