// SPDX-License-Identifier: MIT
// The force of a pull, for the length of a step.
#pragma once

#include "fracture/simulation/simulation.hpp"

namespace sunder {

/// Adds the force of `Simulation::spring`, as it is when a step begins, behind the scene's loads,
/// and takes it away again. It is no load of the scene: reports of forces leave it out.
class SpringLoad {
 public:
  explicit SpringLoad(Simulation& simulation);
  ~SpringLoad();
  SpringLoad(const SpringLoad&) = delete;
  SpringLoad& operator=(const SpringLoad&) = delete;

 private:
  SimulationState& state_;
  std::size_t loads_;  ///< of the scene
};

}  // namespace sunder
