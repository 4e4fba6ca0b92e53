// SPDX-License-Identifier: MIT
// The inside of a simulation, for readers of its rows and for observers of its parts.
#pragma once

#include "fracture/simulation/simulation.hpp"
#include "fracture/simulation/state.hpp"

namespace sunder {

/// A part of a step as an observer sees it, right after it was taken and before anything breaks.
struct PartReport {
  Deformation deformation = Deformation::whole;
  double length = 0;  ///< s
  const ContactReport& contact;
};

}  // namespace sunder
