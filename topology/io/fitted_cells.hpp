// SPDX-License-Identifier: MIT
// Internal to the writers: cells in the kinds that a format has.
#pragma once

#include <optional>

#include "topology/io/format_traits.hpp"
#include "topology/mesh/file_mesh.hpp"

namespace sunder::io {

/// The kinds that a format holds of this mesh: those of its traits, but that TetGen's cells are of
/// one order, the first where the mesh has edges, triangles or tetrahedra of both.
KindSet kinds_held(const FileMesh& mesh, const FormatTraits& t);

/// How many volume cells that repeat a corner the format does not hold: OpenVolumeMesh knows cells
/// by their faces, which are not those of their kind then.
std::size_t collapsed_cells(const FileMesh& mesh, const FormatTraits& t);

/// The mesh without the cells that the format does not have; those that it has with fewer nodes are
/// made so. None where all are held.
std::optional<FileMesh> fitted_cells(const FileMesh& mesh, const FormatTraits& t);

}  // namespace sunder::io
