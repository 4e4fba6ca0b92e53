// SPDX-License-Identifier: MIT
// Cracks that are there before anything moves.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "fracture/algorithms/cells.hpp"
#include "fracture/strength/body_settings.hpp"
#include "topology/base/finding.hpp"

namespace sunder {

/// The faces of one cut, both sides of each, and which way they face: that of the plane, or the sum
/// of the listed faces' area vectors, each turned to the first.
struct CutFaces {
  std::vector<std::array<HalfFaceId, 2>> faces;
  Vec3 normal = Vec3::Zero();
  std::optional<CutPlane> plane;
};

/// Unsews the faces of every body's `cuts` in the map of all bodies, before there is any state: as
/// `sunder split --plane` and `--faces` do it. A face that two cuts name is cut once.
/// Errors, with the cut's place: nothing_cut (no interior face of the body in it), not_interior (a
/// listed face that cannot be cut). Needs: settings without errors. O(|T|) a cut.
/// `made`: gets an entry a cut.
std::vector<Finding> make_cuts(VolumeMap& map, std::span<const BodySettings> bodies,
                               std::span<const BodyRows> rows, std::vector<CutFaces>& made);

/// Makes each cut a crack (`CrackMode::object`): the tetrahedra on its faces get their sides, and
/// its vertices are anchors. If the cut is plane, they lie on its plane; elsewhere each has the
/// mean normal of its faces there. So the crack goes on where its edge passes, and holds back
/// starts next to it.
void label_cuts(Cells& cells, std::span<const CutFaces> cuts);

}  // namespace sunder
