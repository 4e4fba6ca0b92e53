// SPDX-License-Identifier: MIT
// Internal to topology/io: the MEDIT format (.mesh).
#pragma once

#include <string_view>

#include "topology/io/draft.hpp"

namespace sunder::io {

/// Reads MEDIT ASCII of any MeshVersionFormatted, Dimension 3. Throws ReadFailure.
Draft read_medit(std::string_view text);

}  // namespace sunder::io
