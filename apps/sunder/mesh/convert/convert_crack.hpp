// SPDX-License-Identifier: MIT
// The cracks that `sunder convert` opens: which faces the user names, and the list of pairs.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "topology/base/finding.hpp"
#include "topology/mesh/file_mesh.hpp"

namespace sunder {

struct CrackOptions {
  /// Three rows of points a line; empty for none.
  std::filesystem::path faces;
  /// "NX,NY,NZ,D"; empty for none.
  std::string plane;
  /// "A,B", numbers or names; empty for none.
  std::string regions;
  /// Where the list of pairs goes; empty for nowhere.
  std::filesystem::path pairs;
};

/// Adds the options to `sunder convert`.
void add_crack_options(CLI::App& command, CrackOptions& options);

/// The result of opening a crack.
struct NamedCrack {
  /// Notes with counts, or the errors for which the mesh is as it was.
  std::vector<Finding> findings;
  /// The content of the file of pairs.
  std::string pairs;
};

/// Opens the crack that the options name; nothing happens where they name none.
NamedCrack open_named_crack(FileMesh& mesh, const CrackOptions& options);

}  // namespace sunder
