// SPDX-License-Identifier: MIT
// A list of checks, each with a comment about its subject.
#include "fracture/scene/scene_doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <tuple>

#include "fracture/scene/body_measures.hpp"
#include "fracture/scene/cohesive_settings.hpp"
#include "fracture/scene/overlaps.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "topology/base/elementary.hpp"

namespace sunder {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// The one code that is an error.
constexpr const char* at_one_place = "bodies_at_one_place";

/// A scene as the checks see it.
struct Looked {
  const Scene& scene;
  std::span<const BodyMeasures> measures;
  fields::SettingsCheck& check;
  const std::vector<SettingFinding>& found;
  std::vector<double>& badness;  ///< of each that was found, to compare those of one code with

  void add(const char* code, const std::string& place, double how_bad, const std::string& what,
           const std::string& remedy) const {
    check.add(code, place, what, remedy);
    badness.resize(found.size());
    badness.back() = how_bad;
  }
  void body(std::size_t b, const char* code, const char* key, double how_bad,
            const std::string& what, const std::string& remedy) const {
    add(code, fmt::format("bodies.{}.{}", b, key), how_bad, what, remedy);
  }
};

/// A number of a material, and between which values all solids lie.
struct MaterialRange {
  const char* key;
  const char* unit;
  double low, high;
  const char* remedy;
};
constexpr std::array<MaterialRange, 5> material_ranges = {{
    {"density", "kg/m^3", 10, 3e4, "give kg/m^3: 2400, not 2.4, for concrete"},
    {"young_modulus", "Pa", 1e4, 2e12, "give Pa: 30e9, not 30, for concrete's 30 GPa"},
    {"tensile_strength", "Pa", 100, infinite, "give Pa: 3e6, not 3, for concrete's 3 MPa"},
    {"toughness", "Pa sqrt(m)", 100, 1e10, "give Pa sqrt(m): 1e6, not 1, for concrete"},
    {"fracture_energy", "J/m^2", 0.1, 1e8, "give J/m^2: 33, not 0.033, for concrete's 33 N/m"},
}};

std::array<std::optional<double>, 5> numbers_of(const Material& m) {
  return {m.density, m.young_modulus, m.tensile_strength, m.toughness, m.fracture_energy};
}

void look_at_material(const Looked& l, std::size_t b) {
  const Material& material = l.scene.bodies[b].material;
  const auto numbers = numbers_of(material);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const MaterialRange& range = material_ranges[i];
    if (!numbers[i] || (*numbers[i] >= range.low && *numbers[i] <= range.high)) continue;
    const bool is_low = *numbers[i] < range.low;
    l.body(b, "odd_unit", fmt::format("material.{}", range.key).c_str(),
           is_low ? range.low / *numbers[i] : *numbers[i] / range.high,
           fmt::format("is {:.4g} {}, {} than {:g} {} and than that of any solid", *numbers[i],
                       range.unit, is_low ? "less" : "more", is_low ? range.low : range.high,
                       range.unit),
           range.remedy);
  }
  const double strength = l.measures[b].strength, most = material.young_modulus / 10;
  if (strength < infinite && strength > most) {
    l.body(b, "odd_unit", "material.tensile_strength", strength / most,
           fmt::format("is {:.4g} Pa, more than a tenth of Young's modulus ({:.4g} Pa), which no "
                       "solid bears",
                       strength, material.young_modulus),
           "give both in Pa; for a body that never breaks set fracture.mode to off");
  }
}

void look_at_regions(const Looked& l, std::size_t b) {
  const std::vector<RegionStrength>& regions = l.scene.bodies[b].strength.regions;
  const MaterialRange& range = material_ranges[2];
  for (std::size_t r = 0; r < regions.size(); ++r) {
    if (!regions[r].tensile_strength || *regions[r].tensile_strength >= range.low) continue;
    l.body(b, "odd_unit", fmt::format("strength.regions.{}.tensile_strength", r).c_str(),
           range.low / *regions[r].tensile_strength,
           fmt::format("is {:.4g} Pa, less than that of any solid", *regions[r].tensile_strength),
           range.remedy);
  }
}

/// m: a mug in millimetres is longer, and nearly everything that is broken is shorter.
constexpr double longest_usual = 50;

void look_at_size(const Looked& l, std::size_t b) {
  const BodyMeasures& m = l.measures[b];
  if (m.extent > longest_usual) {
    l.body(b, "odd_unit", "mesh", m.extent,
           fmt::format("is {:.4g} m long: points in millimetres are read as metres", m.extent),
           "give \"units\": \"mm\" for the body if that is so");
  }
}

void look_at_speeds(const Looked& l, std::size_t b) {
  const BodySettings& body = l.scene.bodies[b];
  const double most = l.measures[b].wave_speed;
  const auto look = [&](double speed, const std::string& key, const char* what) {
    if (!(speed > most)) return;
    l.body(b, "faster_than_waves", key.c_str(), speed / most,
           fmt::format("{} {:.4g} m/s, faster than the waves in the body ({:.4g} m/s): linear "
                       "elasticity says nothing there",
                       what, speed, most),
           "give m/s and rad/s, or take it slower");
  };
  look(body.velocity.norm(), "velocity", "is");
  look(body.spin.norm() * l.measures[b].extent / 2, "spin", "moves the outermost vertex at");
  for (std::size_t k = 0; k < body.held.size(); ++k) {
    look(body.held[k].velocity.norm(), fmt::format("held.{}.velocity", k), "is");
  }
}

/// Pa, at the clamped end of a beam as long as the body that bends by its weight.
double stress_of_weight(const Scene& scene, const BodySettings& body, const BodyMeasures& m) {
  const double load = body.material.density * scene.gravity.acceleration.norm();
  return 3 * load * m.extent * m.slenderness;
}

/// The middle of the mesh's points in a box, in the mesh's own coordinates.
Vec3 middle_of(const TetMesh& mesh, const HeldBox& box) {
  const Eigen::AlignedBox3d inside(box.minimum, box.maximum);
  Vec3 sum = Vec3::Zero();
  double count = 0;
  for (const Point& p : mesh.points) {
    const Vec3 x(p[0], p[1], p[2]);
    if (!inside.contains(x)) continue;
    sum += x;
    ++count;
  }
  return count > 0 ? Vec3(sum / count) : Vec3((box.minimum + box.maximum) / 2);
}

/// Whether held boxes move against each other in another way than to and from each other.
bool is_led_sideways(const BodySettings& body) {
  for (const HeldBox& a : body.held) {
    for (const HeldBox& b : body.held) {
      const Vec3 speed = b.velocity - a.velocity;
      if (speed.isZero(0)) continue;
      const Vec3 apart = middle_of(body.mesh, b) - middle_of(body.mesh, a);
      if (speed.cross(apart).norm() > 0.01 * speed.norm() * apart.norm()) return true;
    }
  }
  return false;
}

/// Whether something in the scene can bend the body until it breaks: bodies or obstacles that it
/// may meet, loads, its spin, its weight or supports that go sideways. A body that is only pulled
/// lengthwise, or that flies alone, keeps straight.
bool can_be_bent(const Looked& l, std::size_t b) {
  const BodySettings& body = l.scene.bodies[b];
  if (!l.scene.obstacles.empty() || l.scene.bodies.size() > 1) return true;
  if (!body.loads.empty() || !body.spin.isZero(0) || is_led_sideways(body)) return true;
  return !body.held.empty() &&
         stress_of_weight(l.scene, body, l.measures[b]) > 0.1 * l.measures[b].strength;
}

/// Bending is less than half of the deflection of bodies shorter than 1.7 times their thickness
/// (the rest is shear: 2.4 (1 + nu) (t / L)^2 of it). The diagonal of such a body is shorter
/// than 2.2 times its thickness.
constexpr double compact = 2.2;

/// Four layers by cells as wide as thick, or, where these would be too many, by flat ones.
std::string layers_advice(const BodySettings& body, double layers) {
  const double finer = 4 / layers;
  const double needed = static_cast<double>(body.mesh.tetrahedra.size()) * finer * finer * finer;
  const std::string mesh =
      needed <= most_advised_tetrahedra
          ? fmt::format("a mesh of at least four layers (about {:.1g} tetrahedra)", needed)
          : std::string("flat cells in four layers (a \"shape\" plate has a number of \"layers\")");
  return fmt::format(
      "take \"order\": 2 for the body, or {}, where bending matters "
      "(docs/explanation/theory.md)",
      mesh);
}

void look_at_layers(const Looked& l, std::size_t b) {
  const BodySettings& body = l.scene.bodies[b];
  if (l.scene.fracture.mode == FractureMode::off || !(l.measures[b].strength < infinite)) return;
  if (body.order == 2 || body.rigid || !can_be_bent(l, b)) return;
  const double layers = layers_through(body, l.measures[b]);
  const double thickness = layers * l.measures[b].cell;
  if (layers >= too_few_layers || l.measures[b].extent < compact * thickness) return;
  l.body(b, "few_layers", "mesh", -layers,
         fmt::format("has {:.1f} layers of cells through its thickness (median of 200 rays): "
                     "linear tetrahedra show 22, 50, 79, 89 % of the deflection in bending "
                     "with 1, 2, 4, 6, and what breaks in bending breaks late",
                     layers),
         layers_advice(body, layers));
}

/// A twentieth of the strain it breaks at is still nothing (docs/explanation/theory.md).
void look_at_slenderness(const Looked& l, std::size_t b) {
  const BodyMeasures& m = l.measures[b];
  const double strain = m.strength / l.scene.bodies[b].material.young_modulus;
  const double share = false_strain(l.scene.bodies[b], m);
  const bool is_rigid = l.scene.integrator.model == ElasticModel::rigid_reference;
  if (!is_rigid || l.scene.bodies[b].rigid || l.scene.bodies[b].mesh.tetrahedra.size() < 2) return;
  if (!can_be_bent(l, b)) return;
  // A strength that no solid has is reported as such.
  if (!(strain <= 0.1) || !(share > 0.05)) return;
  const std::string false_strain =
      share < 1 ? fmt::format("a false strain of up to {:.0f} % of it", 100 * share)
                : "a false strain larger than the true one";
  l.body(
      b, "slender_body", "mesh", share,
      fmt::format("is {:.3g} times as long as thick and breaks at a strain of {:.3g}: bent so "
                  "far, one rigid reference sees {}",
                  m.slenderness, strain, false_strain),
      fmt::format(
          "where bending breaks it take \"model\": \"corotational\" (slower, without impact "
          "windows), for slow loads with \"integrator\": {{\"method\": \"implicit_euler\"}}, for a "
          "short blow with {{\"method\": \"sub_stepped\", \"damping\": {{\"stiffness_factor\": "
          "{:.1g}}}}} (s, about a tenth of a wave's way through the thickness: undamped it breaks "
          "too much); else read its bending stresses as too high",
          0.1 * m.extent / (m.slenderness * m.wave_speed)));
}

void look_at_obstacles(const Looked& l) {
  double slowest = infinite;
  for (const BodyMeasures& m : l.measures) slowest = std::min(slowest, m.wave_speed);
  for (std::size_t k = 0; k < l.scene.obstacles.size(); ++k) {
    const Obstacle& obstacle = l.scene.obstacles[k];
    const std::string place = fmt::format("obstacles.{}", k);
    const double speed = obstacle.velocity.norm();
    if (speed > slowest) {
      l.add("faster_than_waves", place + ".velocity", speed / slowest,
            fmt::format("is {:.4g} m/s, faster than the waves in what it could strike "
                        "({:.4g} m/s): linear elasticity says nothing there",
                        speed, slowest),
            "give m/s, or take it slower");
    }
    if (!obstacle.mass || !has_volume(obstacle.shape)) continue;
    const double volume = volume_of(obstacle.shape);
    const double density = *obstacle.mass / volume;
    if (density >= material_ranges[0].low && density <= material_ranges[0].high) continue;
    l.add("odd_unit", place + ".mass", std::abs(logarithm(density / material_ranges[0].low)),
          fmt::format("is {:.4g} kg in {:.4g} m^3: {:.4g} kg/m^3, which no solid has",
                      *obstacle.mass, volume, density),
          "give kg and m: 1000 kg are a tonne; a steel ball has 33e3 kg times its radius cubed");
  }
}

/// The body through which waves need longest.
void look_at_duration(const Looked& l) {
  std::size_t slowest = 0;
  double longest = 0;
  for (std::size_t b = 0; b < l.measures.size(); ++b) {
    const double way = l.measures[b].extent / l.measures[b].wave_speed;
    if (way > longest) slowest = b;
    longest = std::max(longest, way);
  }
  if (l.scene.duration >= longest) return;
  l.add("run_too_short", "duration", longest,
        fmt::format("is {:.4g} s, and a wave needs {:.4g} s through bodies.{}, which is {:.4g} m "
                    "long: what strikes one end is not known at the other",
                    l.scene.duration, longest, slowest, l.measures[slowest].extent),
        "take a longer duration, or look whether the mesh is in metres");
}

void look_at_times(const Looked& l) {
  const double step = l.scene.integrator.time_step;
  if (step <= l.scene.duration) return;
  l.add("step_over_duration", "time_step", step,
        fmt::format("is {:.4g} s, longer than the whole run ({:.4g} s): its one step goes on "
                    "beyond the end",
                    step, l.scene.duration),
        "take a shorter time_step or a longer duration");
}

void look_at_places(const Looked& l) {
  double cell = infinite;
  for (const BodyMeasures& m : l.measures) cell = std::min(cell, m.cell);
  const double allowed = std::max(l.scene.contact.allowed_penetration, 1e-3 * cell);
  std::vector<std::size_t> whole(l.scene.bodies.size());
  for (const Overlap& o : overlaps_at_start(l.scene, l.measures, allowed)) {
    whole[o.body] += o.is_whole;
    const std::string other =
        fmt::format("{}.{}", o.with_obstacle ? "obstacles" : "bodies", o.other);
    l.body(o.body, "overlap_at_start", "translation", o.depth,
           fmt::format("puts the body {:.3g} m deep into {}: they are pushed apart at "
                       "contact.push_out_speed ({:.3g} m/s) at most, and what lies deep stays",
                       o.depth, other, l.scene.contact.push_out_speed),
           fmt::format("move one of them by {:.3g} m or more", o.depth));
  }
  for (std::size_t b = 0; b < whole.size(); ++b) {
    if (whole[b] <= most_whole_overlaps) continue;
    l.body(
        b, at_one_place, "translation", static_cast<double>(whole[b]),
        fmt::format("puts the body into more than {} others, middle in middle: contact of so many "
                    "at one place has no end",
                    most_whole_overlaps),
        "give each body a place of its own");
    return;  // the others have the same place
  }
}

void look_at_materials(const Looked& l) {
  if (l.scene.fracture.crack == CrackMode::cohesive) judge_materials(l.check, l.scene);
}

constexpr std::array<void (*)(const Looked&, std::size_t), 6> of_bodies = {
    look_at_size,   look_at_material, look_at_regions,
    look_at_speeds, look_at_layers,   look_at_slenderness};
constexpr std::array<void (*)(const Looked&), 5> of_scenes = {
    look_at_obstacles, look_at_duration, look_at_times, look_at_places, look_at_materials};

/// In the order of codes as they were found, of each code the worst first.
std::vector<SettingFinding> worst_first(const std::vector<SettingFinding>& found,
                                        std::span<const double> badness) {
  const auto code_row = [&](std::size_t i) {
    const auto is_same = [&](const SettingFinding& f) {
      return f.finding.code == found[i].finding.code;
    };
    return std::ranges::find_if(found, is_same) - found.begin();
  };
  // Findings that differ by rounding alone stay in order.
  std::vector<std::tuple<std::ptrdiff_t, float, std::size_t>> order;
  for (std::size_t i = 0; i < found.size(); ++i) {
    order.emplace_back(code_row(i), -static_cast<float>(badness[i]), i);
  }
  std::ranges::sort(order);
  std::vector<SettingFinding> sorted;
  for (const auto& [code, good, i] : order) sorted.push_back(found[i]);
  return sorted;
}

}  // namespace

std::vector<SettingFinding> scene_doubts(const Scene& scene) {
  std::vector<BodyMeasures> measures;
  for (const BodySettings& body : scene.bodies) measures.push_back(measure(body));
  std::vector<SettingFinding> found;
  fields::SettingsCheck check("", found);
  std::vector<double> badness;
  const Looked looked{scene, measures, check, found, badness};
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    for (const auto look : of_bodies) look(looked, b);
  }
  for (const auto look : of_scenes) look(looked);
  badness.resize(found.size());
  for (SettingFinding& f : found) {
    if (f.finding.code != at_one_place) f.finding.severity = Severity::warning;
  }
  return worst_first(found, badness);
}

}  // namespace sunder
