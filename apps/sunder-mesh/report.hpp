// SPDX-License-Identifier: GPL-3.0-or-later
// The figures of a mesh as text or JSON, and findings as lines.
#pragma once

#include <string>
#include <vector>

#include "apps/sunder-mesh/mesh_quality.hpp"
#include "topology/base/finding.hpp"
#include "topology/base/tet_mesh.hpp"

namespace sunder {

/// A table of counts, sizes and quality; lengths in m, angles in degrees.
std::string report_text(const TetMesh& mesh, const MeshQuality& quality);

/// The same as one JSON object.
std::string report_json(const TetMesh& mesh, const MeshQuality& quality);

/// "FILE:LINE: error: TEXT; REMEDY [CODE]", without the parts that a finding does not have.
std::string finding_line(const Finding& finding);

}  // namespace sunder
