// SPDX-License-Identifier: MIT
// Colors as a stylesheet writes them, and the tints that tell pieces apart. No OpenGL here.
#pragma once

#include <cstdint>

namespace sunder::render {

/// A color, sRGB-encoded, each channel in [0, 1].
struct Color {
  float r = 0, g = 0, b = 0;
  friend bool operator==(const Color&, const Color&) = default;
};

/// The same color as amounts of light (IEC 61966-2-1), each channel in [0, 1].
Color to_linear(Color srgb);
/// Inverse of `to_linear`; channels outside [0, 1] are clamped.
Color to_srgb(Color linear);

/// `base` with the hue of piece number `piece`: neighbouring numbers get hues 137.5 degrees apart.
/// `amount` in [0, 1]: 0 gives `base`, 1 a clear tint. Lightness is kept: the tint is added in
/// Oklab (Ottosson 2020), where equal steps look equal.
Color tinted(Color base, std::uint32_t piece, float amount);

}  // namespace sunder::render
