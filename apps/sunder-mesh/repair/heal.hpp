// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces that cross themselves, made into one closed surface by CGAL.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "apps/sunder-mesh/surface.hpp"
#include "topology/base/finding.hpp"

namespace sunder {

/// A closed surface that does not cross itself, and how it was made.
struct Healed {
  Surface surface;
  std::string method;         ///< "union" or "wrap"
  std::size_t shells = 1;     ///< closed parts of the input that a union joined
  std::size_t crossings = 0;  ///< shells whose own crossings were cut away
};

/// The union of closed shells that overlap; shells that look inward are cut out. A shell that
/// crosses itself has its crossings cut away first. Needs: triangles with an area. Errors:
/// not_united, with the reason.
Result<Healed> unite(const Surface& surface);

/// A closed surface around any triangles: nothing narrower than `alpha` is seen, and it lies
/// `offset` outside of them. Units of the points, both above 0. Errors: not_wrapped.
Result<Healed> wrap(const Surface& surface, double alpha, double offset);

}  // namespace sunder
