// SPDX-License-Identifier: MIT
// The words for a scene.
#include "apps/sunder/run/report/scene_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "fracture/scene/scene_fields.hpp"
#include "topology/base/counted.hpp"
#include "topology/io/files/printing.hpp"

namespace sunder {
namespace {

/// 6145 as "6 145".
std::string grouped(std::uint64_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t end = digits.size(); end > 3; end -= 3) digits.insert(end - 3, " ");
  return digits;
}

std::string in_groups(std::uint64_t number, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", grouped(number), for_count(number, one, many));
}

/// 6e5 as "600 kPa"; a range where the values differ.
std::string pascals(const std::vector<double>& values) {
  constexpr std::array<std::pair<double, std::string_view>, 4> units = {
      {{1e9, "GPa"}, {1e6, "MPa"}, {1e3, "kPa"}, {1, "Pa"}}};
  const auto [least, most] = std::ranges::minmax(values);
  const auto* unit = std::ranges::find_if(units, [&](const auto& u) { return most >= u.first; });
  if (unit == units.end()) --unit;
  const std::string high = fmt::format("{:.4g}", most / unit->first);
  const std::string low = fmt::format("{:.4g}", least / unit->first);
  return low == high ? fmt::format("{} {}", high, unit->second)
                     : fmt::format("{} to {} {}", low, high, unit->second);
}

/// The speeds other than 0: "5 m/s", "up to 5 m/s" where they differ; empty where nothing moves.
std::string speeds(std::vector<double> values, std::string_view unit) {
  std::erase(values, 0.0);
  if (values.empty()) return {};
  const auto [least, most] = std::ranges::minmax(values);
  return fmt::format("{}{:.4g} {}", most - least > 1e-6 * most ? "up to " : "", most, unit);
}

/// Materials of the bodies that deform.
std::vector<std::string> material_words(const Scene& scene) {
  std::vector<double> stiffness, strength;
  for (const BodySettings& body : scene.bodies) {
    if (body.rigid) continue;
    stiffness.push_back(body.material.young_modulus);
    strength.push_back(body.material.tensile_strength);
  }
  if (stiffness.empty()) return {"rigid"};
  std::vector<std::string> words = {"E " + pascals(stiffness)};
  if (scene.fracture.mode != FractureMode::off) words.push_back("strength " + pascals(strength));
  return words;
}

/// Whether every body that moves does so along gravity, to 30 degrees.
bool falls(const Scene& scene) {
  const Vec3& g = scene.gravity.acceleration;
  return g.norm() > 0 && std::ranges::all_of(scene.bodies, [&](const BodySettings& body) {
           return body.velocity.dot(g) >= std::cos(0.5236) * body.velocity.norm() * g.norm();
         });
}

/// The causes of the bodies' motion: speeds, obstacles, supports, loads; else gravity.
std::vector<std::string> motion_words(const Scene& scene) {
  std::vector<double> of_bodies, spins, of_supports, of_obstacles;
  std::size_t loads = 0;
  for (const BodySettings& body : scene.bodies) {
    of_bodies.push_back(body.velocity.norm());
    spins.push_back(body.spin.norm());
    loads += body.loads.size();
    for (const HeldBox& box : body.held) of_supports.push_back(box.velocity.norm());
  }
  for (const Obstacle& o : scene.obstacles) of_obstacles.push_back(o.velocity.norm());
  const auto moving = static_cast<std::uint64_t>(
      std::ranges::count_if(of_obstacles, [](double speed) { return speed > 0; }));
  std::vector<std::string> words;
  const auto add = [&](std::string_view before, const std::string& speed) {
    if (!speed.empty()) words.push_back(fmt::format("{} {}", before, speed));
  };
  const bool one = scene.bodies.size() == 1;
  add(falls(scene) ? (one ? "falls at" : "falling at") : (one ? "moves at" : "moving at"),
      speeds(of_bodies, "m/s"));
  add(one ? "spins at" : "spinning at", speeds(spins, "rad/s"));
  add(in_groups(moving, "obstacle at", "obstacles at"), speeds(of_obstacles, "m/s"));
  add("supports move at", speeds(of_supports, "m/s"));
  if (loads > 0) words.emplace_back("loaded");
  const bool is_driven = !words.empty();
  const bool stands =
      !of_supports.empty() && std::ranges::all_of(of_supports, [](double v) { return v == 0; });
  if (stands) words.emplace_back("held");
  const double gravity = scene.gravity.acceleration.norm();
  if (!is_driven && gravity > 0) words.push_back(fmt::format("gravity {:.4g} m/s^2", gravity));
  if (words.empty()) words.emplace_back("at rest");
  return words;
}

std::string_view word_of(CrackMode mode) {
  for (const auto& [value, word] : fields::names_of(mode)) {
    if (value == mode) return word;
  }
  return {};
}

}  // namespace

std::string scene_line(const Scene& scene) {
  std::size_t tetrahedra = 0;
  for (const BodySettings& body : scene.bodies) tetrahedra += body.mesh.tetrahedra.size();
  std::vector<std::string> words = {
      fmt::format("{} of {}", in_groups(scene.bodies.size(), "body", "bodies"),
                  in_groups(tetrahedra, "tetrahedron", "tetrahedra"))};
  std::ranges::move(material_words(scene), std::back_inserter(words));
  std::ranges::move(motion_words(scene), std::back_inserter(words));
  const std::string cracks = scene.fracture.mode == FractureMode::off
                                 ? std::string("nothing breaks")
                                 : fmt::format("cracks: {}", word_of(scene.fracture.crack));
  // A name may hold anything; the line is one, and moves no cursor.
  return plain_line(fmt::format("{}: {}; {:.4g} s in {}, {}",
                                scene.name.empty() ? "scene" : scene.name, fmt::join(words, ", "),
                                scene.duration, in_groups(step_count(scene), "step", "steps"),
                                cracks));
}

}  // namespace sunder
