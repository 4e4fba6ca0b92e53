// SPDX-License-Identifier: MIT
// Moves scenes by nothing, and runs them so.
#include "apps/bench/chart/chart_ensemble.hpp"

#include <fmt/format.h>

#include <cmath>
#include <random>

namespace sunder {
namespace {

constexpr double least_way = 1e-12, least_strength = 1e-6;

/// In [-1, 1), the same on every machine.
double even(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; }

void multiply_strengths(BodySettings& body, double factor) {
  body.material.tensile_strength *= factor;
  if (body.material.toughness) *body.material.toughness *= factor;
  for (double& strength : body.strength.painted) strength *= factor;
  for (RegionStrength& region : body.strength.regions) {
    if (region.tensile_strength) *region.tensile_strength *= factor;
    if (region.toughness) *region.toughness *= factor;
  }
}

}  // namespace

void move_by_nothing(Scene& scene, std::size_t member) {
  if (member == 0) return;
  std::mt19937_64 random(member);
  for (BodySettings& body : scene.bodies) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      body.translation[axis] += least_way * even(random);
      body.velocity[axis] += least_way * even(random);
    }
    multiply_strengths(body, 1 + least_strength * even(random));
  }
}

ChartBand band_of(std::span<const Vec3> values) {
  ChartBand band{Vec3::Zero(), values.front(), values.front(), 0};
  const auto n = static_cast<double>(values.size());
  for (const Vec3& value : values) {
    band.mean += value / n;
    band.low = band.low.cwiseMin(value);
    band.high = band.high.cwiseMax(value);
  }
  // Equal values are their own mean to the bit, which a sum of n-ths is not.
  if (band.low == band.high) band.mean = band.low;
  double squares = 0;
  for (const Vec3& value : values) squares += (value - band.mean).squaredNorm();
  if (values.size() > 1) band.deviation = std::sqrt(squares / (n - 1));
  return band;
}

ChartOutcome run_ensemble(const ChartRunner& runner, std::size_t members,
                          std::span<const std::string> changes, std::size_t mesh, bool timed) {
  ChartRunner moved = runner;
  ChartOutcome all = run_chart(moved, changes, mesh, timed);
  if (all.end != ChartEnd::fine) return all;
  all.values = {all.value};
  double scales = all.scale;
  for (moved.member = 1; moved.member < members; ++moved.member) {
    const ChartOutcome one = run_chart(moved, changes, mesh, false);
    if (one.end != ChartEnd::fine) {
      all.end = one.end;
      all.reason = fmt::format("run {} of {}: {}", moved.member + 1, members, one.reason);
      return all;
    }
    all.values.push_back(one.value);
    scales += one.scale;
  }
  all.value = band_of(all.values).mean;
  all.scale = scales / static_cast<double>(members);
  return all;
}

}  // namespace sunder
