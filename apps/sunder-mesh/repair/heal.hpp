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

/// How a surface is wrapped. Lengths in the unit of the points, above 0.
struct WrapSettings {
  double alpha = 0;              ///< nothing narrower is seen
  double offset = 0;             ///< the wrap lies so far outside
  std::size_t triangles = 4000;  ///< to which it is simplified, as long as it does not cross itself
};

/// A closed surface around any triangles. Errors: not_wrapped.
Result<Healed> wrap(const Surface& surface, const WrapSettings& settings);

}  // namespace sunder
