// SPDX-License-Identifier: MIT
// Internal to the writers: the contents of a mesh that a format holds, and its losses.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "topology/io/format_traits.hpp"
#include "topology/mesh/boundary_surface.hpp"

namespace sunder::io {

/// The cells of a mesh that a format gets: the mesh itself, or its boundary, in kinds of cells that
/// the format has.
struct Written {
  const FileMesh& original;
  std::optional<BoundarySurface> surface;
  /// Where cells are dropped or have fewer nodes.
  std::optional<FileMesh> fitted;

  const FileMesh& whole() const { return surface ? surface->mesh : original; }
  const FileMesh& mesh() const { return fitted ? *fitted : whole(); }
};

Written written_of(const FileMesh& mesh, const FormatTraits& t);

/// The version that is meant: the usual one where none is named.
std::string version_of(const FormatTraits& t, const WriteOptions& options);

/// Losses and changes on writing: warnings; an error where no cell would be left. Needs: the
/// options name a format.
std::vector<Finding> losses_of(const Written& written, const WriteOptions& options);

}  // namespace sunder::io
