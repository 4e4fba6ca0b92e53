// SPDX-License-Identifier: MIT
// Internal to topology/io: the MEDIT format (.mesh).
#pragma once

#include <string>
#include <string_view>

#include "topology/io/draft.hpp"

namespace sunder::io {

/// Reads MEDIT ASCII. Throws ReadFailure.
Draft read_medit(std::string_view text);

/// The bytes of a MEDIT ASCII file of version 2 (doubles). Vertex cells are not written.
std::string write_medit(const FileMesh& mesh);

}  // namespace sunder::io
