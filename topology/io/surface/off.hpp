// SPDX-License-Identifier: MIT
// Internal to topology/io: the OFF format of Geomview (.off).
#pragma once

#include <string>
#include <string_view>

#include "topology/io/draft.hpp"

namespace sunder::io {

/// Whether a file begins like OFF: with that word, or one that ends with it (COFF, STCNOFF, 4OFF).
bool is_off(std::string_view text);

/// Reads OFF, text or binary: points, and faces by the number of their corners, of two as edges, of
/// one as vertices; those of none are left out. Normals, colours and texture coordinates are left
/// out. The header word may be missing. Throws ReadFailure.
Draft read_off(std::string_view text);

/// The text of an OFF file with the points and faces.
std::string write_off(const FileMesh& mesh);

}  // namespace sunder::io
