// SPDX-License-Identifier: MIT
// sRGB, linear light and Oklab, and the tint of a piece.
#include "apps/render/color.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace sunder::render {
namespace {

float decode(float v) { return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f); }

float encode(float v) {
  const float c = std::clamp(v, 0.0f, 1.0f);
  return c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1 / 2.4f) - 0.055f;
}

// Linear sRGB -> cone responses, and their cube roots -> Oklab.
Eigen::Matrix3f cones() {
  return Eigen::Matrix3f{{0.4122214708f, 0.5363325363f, 0.0514459929f},
                         {0.2119034982f, 0.6806995451f, 0.1073969566f},
                         {0.0883024619f, 0.2817188376f, 0.6299787005f}};
}
Eigen::Matrix3f opponents() {
  return Eigen::Matrix3f{{0.2104542553f, 0.7936177850f, -0.0040720468f},
                         {1.9779984951f, -2.4285922050f, 0.4505937099f},
                         {0.0259040371f, 0.7827717662f, -0.8086757660f}};
}

}  // namespace

Color to_linear(Color srgb) { return {decode(srgb.r), decode(srgb.g), decode(srgb.b)}; }

Color to_srgb(Color linear) { return {encode(linear.r), encode(linear.g), encode(linear.b)}; }

Color tinted(Color base, std::uint32_t piece, float amount) {
  if (amount <= 0) return base;
  const Color linear = to_linear(base);
  const Eigen::Vector3f response =
      (cones() * Eigen::Vector3f(linear.r, linear.g, linear.b)).unaryExpr([](float v) {
        return std::cbrt(v);
      });
  Eigen::Vector3f lab = opponents() * response;
  // The golden angle keeps any run of consecutive numbers far apart on the circle.
  const double turns = std::fmod(0.381966011250105 * piece, 1.0);
  const float angle = static_cast<float>(2 * std::numbers::pi * turns);
  const float chroma =
      0.11f * std::min(amount, 1.0f);  // the most that stays inside sRGB at L = 0.8
  lab += chroma * Eigen::Vector3f(0, std::cos(angle), std::sin(angle));
  const Eigen::Vector3f back = opponents().inverse() * lab;
  const Eigen::Vector3f rgb = cones().inverse() * Eigen::Vector3f(back.array().cube());
  return to_srgb({rgb.x(), rgb.y(), rgb.z()});
}

}  // namespace sunder::render
