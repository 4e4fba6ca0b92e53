// SPDX-License-Identifier: MIT
// Internal to topology/io: Gmsh's MSH format.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "topology/io/draft.hpp"

namespace sunder::io {

/// Whether a file begins like one of MSH: with a section's name.
bool is_msh(std::string_view text);

/// Reads MSH 1, 2.x, 4.0 or 4.1, text or binary. Throws ReadFailure.
Draft read_msh(std::string_view text);

/// The bytes of an MSH file: `version` 10, 22, 40 or 41. In versions 4 one block of nodes, and one
/// of elements for each run of one entity. Needs: version 1 is text.
std::string write_msh(const FileMesh& mesh, int version, bool is_binary);

/// Which of a mesh's own numbers an MSH file can hold: positive, each only once (cells of all
/// dimensions together), below 2^31 before version 4.1 (41), and given for every point or cell.
struct HeldNumbers {
  bool points = false;
  bool cells = false;
};
HeldNumbers msh_holds(const FileMesh& mesh, int version);

}  // namespace sunder::io
