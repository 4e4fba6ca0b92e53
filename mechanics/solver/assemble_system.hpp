// SPDX-License-Identifier: MIT
// Common parts of building and extending a system.
#pragma once

#include "mechanics/solver/component_system.hpp"

namespace sunder {

/// All parts of a system that follow from its order: `local_row`, shape, K, and its input. Needs
/// `order` and `free_count`.
void assemble_system(ComponentSystem& system, std::span<std::uint32_t> local_row,
                     const SystemInput& input);

}  // namespace sunder
