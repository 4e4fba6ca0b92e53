// SPDX-License-Identifier: MIT
// Internal to topology/io: reading VTU (VTK XML unstructured grids).
#pragma once

#include <string_view>

#include "topology/io/draft.hpp"

namespace sunder::io {

/// Reads the tetrahedra of every piece. Throws ReadFailure.
Draft read_vtu(std::string_view text);

}  // namespace sunder::io
