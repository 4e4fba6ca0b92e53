// SPDX-License-Identifier: MIT
// Frames of a finished run as the bodies of a picture.
#pragma once

#include <vector>

#include "apps/sunder/export/result_frames.hpp"
#include "apps/sunder/render/picture_scene.hpp"

namespace sunder {

/// A frame with the columns that `bodies` looks at.
struct FramePicture {
  std::vector<std::array<VertexId, 4>> corners;
  std::vector<ComponentId> component;
  PictureBodies bodies;
};

/// Shows the faces that `boundary_of(first)` does not have as those of cracks, near the planes of
/// their cracks where the frame has such moves. `explode`: each
/// piece, away from the mean of all, by so many times its distance from it; none moves down,
/// against `up` (unit). O(|T| log |T|).
FramePicture frame_picture(const ResultFrame& frame, const std::vector<char>& first_boundary,
                           double explode, const Vec3& up);

/// The box around the pieces of a frame that have a hundredth of all tetrahedra or more, as far as
/// it lies within a diagonal of `start` around that, m.
render::Bounds bounds_of_large(const ResultFrame& frame, const render::Bounds& start);

}  // namespace sunder
