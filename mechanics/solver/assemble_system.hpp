// SPDX-License-Identifier: MIT
// What building and extending a system share.
#pragma once

#include "mechanics/solver/component_system.hpp"

namespace sunder {

/// All of a system that follows from its order: `local_row`, shape, K, what it was made of. Needs
/// `order` and `free_count`.
void assemble_system(ComponentSystem& system, std::span<std::uint32_t> local_row,
                     const SystemInput& input);

}  // namespace sunder
