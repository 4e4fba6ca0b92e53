// SPDX-License-Identifier: MIT
// Which of a body's held boxes hold a vertex, axis by axis.
#pragma once

#include <array>
#include <limits>
#include <span>

#include "fracture/strength/body_settings.hpp"
#include "mechanics/state/mechanics_state.hpp"

namespace sunder {

/// Rows of the boxes that hold a vertex along x, y, z of its mesh.
using Holders = std::array<std::size_t, 3>;
inline constexpr std::size_t no_holder = std::numeric_limits<std::size_t>::max();

/// The axes of a box, by rows.
AxisSet axes_of(const HeldBox& box);

/// Whether a box leaves its vertices free along some axis.
bool is_partial(const HeldBox& box);

/// For each axis the last box that holds a vertex at rest at `rest` (m, mesh's own coordinates)
/// along it, or `no_holder`.
Holders holders_of(std::span<const HeldBox> boxes, const Vec3& rest);

/// Marks the vertices that the boxes hold, with one motion for each combination of boxes. Those of
/// single boxes come first, in their order. `vertices`: of one body. `rotation`: of the body.
void hold_vertices(MechanicsState& mechanics, std::span<const VertexId> vertices,
                   std::span<const HeldBox> boxes, const Eigen::Quaterniond& rotation);

}  // namespace sunder
