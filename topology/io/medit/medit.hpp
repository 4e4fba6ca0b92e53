// SPDX-License-Identifier: MIT
// Internal to topology/io: the MEDIT format (.mesh, .meshb).
#pragma once

#include <string>
#include <string_view>

#include "topology/io/draft.hpp"

namespace sunder::io {

/// Whether a file begins like MEDIT: with MeshVersionFormatted, or binary with the number 1 in
/// either byte order.
bool is_medit(std::string_view text);

/// Reads MEDIT, text or binary (versions 1 to 4, either byte order). Throws ReadFailure.
Draft read_medit(std::string_view text);

/// The bytes of a MEDIT file with doubles: text (version 2) or binary (version 3). Vertex cells are
/// not written.
std::string write_medit(const FileMesh& mesh, bool is_binary);

}  // namespace sunder::io
