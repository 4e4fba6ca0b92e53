// SPDX-License-Identifier: MIT
// Which faces `sunder split` is to split, as the user names them.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "topology/base/finding.hpp"
#include "topology/kernel/fan.hpp"
#include "topology/kernel/volume_map.hpp"

namespace sunder {

/// One face to split.
struct FaceRequest {
  /// Rows of the file's points: as the user wrote them, else in rising order.
  std::array<std::uint32_t, 3> points;
  /// Its side in the lower tetrahedron of the intact map; none() where no tetrahedron has it.
  HalfFaceId face;
};

/// The faces that a text file lists, three rows of points a line; # begins a comment.
/// Errors: cannot_open, bad_face (with the line).
Result<std::vector<FaceRequest>> faces_of_file(const VolumeMap& map,
                                               const std::filesystem::path& path);

/// The fan of a file's point: of every vertex orbit there, where the point is pinched.
/// Errors: no_such_vertex, not_a_direction.
Result<std::vector<FaceRequest>> faces_of_fan(const VolumeMap& map, std::uint32_t point,
                                              const Point& normal);

/// The section of the plane {x : normal . x = offset}. Errors: not_a_direction.
Result<std::vector<FaceRequest>> faces_of_plane(const VolumeMap& map, const CuttingPlane& plane);

/// The requests in the order asked for; faces that are not interior stay behind the others, unless
/// everything stays as given.
void order_requests(const VolumeMap& map, FaceOrder order, std::vector<FaceRequest>& requests);

/// Why a face cannot be split, in words; empty when it can.
std::string refusal_of(const VolumeMap& map, const FaceRequest& request);

}  // namespace sunder
