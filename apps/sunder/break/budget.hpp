// SPDX-License-Identifier: MIT
// The number of cells for which a break takes a given time.
#pragma once

#include <functional>
#include <optional>

#include "fracture/scene/scene.hpp"
#include "topology/base/tet_mesh.hpp"

namespace sunder {

/// s of computing that pictures take on one core without a graphics card. `megapixels`: of one.
double drawing_time(double pictures, double megapixels, double tetrahedra);

/// A mesh, and s of computing that its break is expected to take.
struct Costed {
  TetMesh mesh;
  double seconds = 0;
};

/// Fills with about so many tetrahedra; none where that fails.
using CostedFill = std::function<std::optional<Costed>(double tetrahedra)>;

/// The fewest and the most tetrahedra that a budget leads to.
inline constexpr double fewest_cells = 300, most_cells = 100000;

/// The finest mesh that fits into `left()` s (which shrinks while meshes are made), or the cheapest
/// one where none does. Five meshes at most are made. None where the first cannot be made.
std::optional<Costed> finest_within(const std::function<double()>& left, const CostedFill& make);

}  // namespace sunder
