// SPDX-License-Identifier: MIT
// How fast overlaps are pushed out.
#pragma once

#include <algorithm>

#include "mechanics/contact/settings/contact_settings.hpp"

namespace sunder {

/// m: how far a step of `h` s pushes out an overlap that it begins with, at `push_out_speed` and
/// down to `allowed_penetration`. `gap_start`: m, negative in an overlap.
inline double push_out_distance(const ContactSettings& settings, double gap_start, double h) {
  return std::clamp(-settings.allowed_penetration - gap_start, 0.0, settings.push_out_speed * h);
}

}  // namespace sunder
