// SPDX-License-Identifier: MIT
// The outlook of a scene is estimated once; each key has a rule that reads it.
#include "fracture/scene/choose_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "fracture/scene/body_measures.hpp"
#include "fracture/scene/check_scene.hpp"

namespace sunder {
namespace {

/// The estimates that the rules use.
struct Outlook {
  Accuracy accuracy = Accuracy::good;
  /// m, the smallest mean cell of the bodies.
  double cell = 0;
  /// Node stress `fit` has no certificate.
  bool fits = false;
  /// Of all bodies.
  std::size_t tetrahedra = 0;
};

/// `measures`: of each body.
Outlook look_ahead(const Scene& scene, Accuracy accuracy, std::span<const BodyMeasures> measures) {
  Outlook o;
  o.accuracy = accuracy;
  o.cell = std::numeric_limits<double>::infinity();
  for (const BodyMeasures& m : measures) o.cell = std::min(o.cell, m.cell);
  for (const BodySettings& body : scene.bodies) o.tetrahedra += body.mesh.tetrahedra.size();
  o.fits = scene.fracture.node_stress == NodeStress::fit;
  return o;
}

/// A value and its reason.
struct Chosen {
  double value = 0;
  std::string reason;
};

struct Rule {
  std::string_view key;
  void (*set)(Scene&, double);
  Chosen (*choose)(const Outlook&);
  /// Names of the values 0, 1, ...; none: they are numbers.
  std::span<const std::string_view> words = {};
};

/// One of three, by accuracy.
double by(const Outlook& o, double preview, double good, double reference) {
  return std::array{preview, good, reference}[static_cast<std::size_t>(o.accuracy)];
}

Chosen iterations(const Outlook& o) {
  return {by(o, 100, 2000, 10000),
          "iterations end at the tolerance; stacks of unequal masses need a thousand"};
}

Chosen passes(const Outlook& o) {
  return {by(o, 3, 10, 20), "a step takes only the passes that it needs"};
}

Chosen tolerance(const Outlook& o) {
  return {by(o, 1e-3, 1e-5, 1e-6),
          "relative to the deepest overlap that a step without contact would have"};
}

Chosen contacts(const Outlook& o) {
  return {by(o, 64, 128, 512), "enough points for the patch between two bodies"};
}

Chosen penetration(const Outlook& o) {
  return {std::clamp(1e-5, 1e-5 * o.cell, 2e-3 * o.cell),
          fmt::format("1e-5 m, limited to 1e-5 to 2e-3 of the cell size {:.2g} m", o.cell)};
}

Chosen push_out(const Outlook& o) {
  return {
      std::clamp(1e-3, 1e-3 * o.cell, 0.2 * o.cell),
      fmt::format("1e-3 m/s, limited to 1e-3 to 0.2 of the cell size {:.2g} m per second", o.cell)};
}

Chosen negligible(const Outlook& o) {
  const double share = by(o, 1, 0.1, 0.01);
  return {share,
          fmt::format("impacts below {:.3g} % of the strength are not sub-stepped", 100 * share)};
}

Chosen rubble(const Outlook& o) {
  if (o.accuracy == Accuracy::preview && !o.fits) {
    return {2,
            "pieces move as rigid bodies in steps of 1/240 s until a blow could break them; "
            "faster, but "
            "later cracks differ"};
  }
  return {0, "later cracks depend on elastic impacts of small pieces"};
}

Chosen declared(const Outlook& o) {
  return {by(o, 0.02, 0, 0), "pieces up to this share of their body's mass never break again"};
}

/// Darts take 850 bytes per tetrahedron (docs/lab/kernel.md): up to 0.85 GB.
constexpr std::size_t most_with_darts = 1'000'000;

Chosen kernel(const Outlook& o) {
  if (o.tetrahedra <= most_with_darts) {
    return {1, "CGAL's darts hold the volume mesh; up to a million tetrahedra they fit in 0.85 GB"};
  }
  return {0,
          fmt::format("the darts of {} tetrahedra would take {:.2g} GB; rows give the same bytes",
                      o.tetrahedra, 850e-9 * static_cast<double>(o.tetrahedra))};
}

constexpr std::array<std::string_view, 3> rubble_words = {"off", "certified", "until_struck"};
constexpr std::array<std::string_view, 2> kernel_words = {"dense", "lcc"};

// A key more is a line more, and `chosen` in its description.
constexpr std::array<Rule, 10> rules = {{
    {"contact.max_iterations", [](Scene& s, double v) { s.contact.max_iterations = int(v); },
     iterations},
    {"contact.max_passes", [](Scene& s, double v) { s.contact.max_passes = int(v); }, passes},
    {"contact.tolerance", [](Scene& s, double v) { s.contact.tolerance = v; }, tolerance},
    {"contact.push_out_speed", [](Scene& s, double v) { s.contact.push_out_speed = v; }, push_out},
    {"contact.allowed_penetration", [](Scene& s, double v) { s.contact.allowed_penetration = v; },
     penetration},
    {"contact.max_contacts_per_pair",
     [](Scene& s, double v) { s.contact.max_contacts_per_pair = static_cast<std::uint32_t>(v); },
     contacts},
    {"impact.negligible", [](Scene& s, double v) { s.impact.negligible = v; }, negligible},
    {"ladder.rubble", [](Scene& s, double v) { s.ladder.rubble = static_cast<RubbleMode>(v); },
     rubble, rubble_words},
    {"ladder.declared_rubble", [](Scene& s, double v) { s.ladder.declared_rubble = v; }, declared},
    {"topology.kernel",
     [](Scene& s, double v) { s.topology.kernel = v == 1 ? MapKernel::lcc : MapKernel::dense; },
     kernel, kernel_words},
}};

/// Whether a key means anything in the scene.
bool is_used(const Scene& scene, std::string_view key) {
  const bool impulses = scene.contact.method == ContactMethod::impulses;
  if (key.starts_with("ladder.")) {
    return impulses && scene.integrator.integrator == Integrator::floating_frame;
  }
  if (key.starts_with("topology.")) return true;
  if (key.starts_with("contact.")) return impulses || key == "contact.max_contacts_per_pair";
  return scene.impact.window && impulses &&
         scene.integrator.integrator == Integrator::floating_frame;
}

/// Whether bodies of second order support all features that the scene uses.
bool takes_second_order(const Scene& scene) {
  return second_order_findings(scene).empty() && scene.fracture.node_stress != NodeStress::fit;
}

/// Second order for thin bodies that have few layers of cells and are small enough for its cost
/// (docs/lab/defaults.md has the charts). `measures`: of each body.
void choose_orders(std::vector<Choice>& choices, Scene& scene, Accuracy accuracy,
                   std::span<const std::string> given, std::span<const BodyMeasures> measures) {
  if (accuracy == Accuracy::preview) return;
  const std::size_t most = accuracy == Accuracy::good ? 2000 : 20000;
  constexpr double thin = 5;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    BodySettings& body = scene.bodies[b];
    const std::string key = fmt::format("bodies.{}.order", b);
    if (body.rigid || body.mesh.tetrahedra.size() > most ||
        std::ranges::find(given, key) != given.end()) {
      continue;
    }
    body.order = 1;
    const BodyMeasures& m = measures[b];
    if (m.slenderness < thin) continue;
    const double layers = layers_through(body, m);
    if (layers >= enough_layers) continue;
    body.order = 2;
    if (!takes_second_order(scene)) {
      body.order = 1;
      continue;
    }
    choices.push_back(
        {key, "2",
         fmt::format(
             "{:.2g} times as long as thick with {:.1f} layers of cells; order 1 would be at least "
             "{:.0f} % too stiff in bending, in a tenth of the time",
             m.slenderness, layers, 300 / (layers * layers))});
  }
}

/// Frames of their own for the tetrahedra of a held body that one frame would show too much strain,
/// where nothing strikes it and no time is measured: implicit Euler damps, and has no impact
/// windows.
void choose_model(std::vector<Choice>& choices, Scene& scene, Accuracy accuracy,
                  std::span<const std::string> given, std::span<const BodyMeasures> measures) {
  constexpr double too_much = 0.5, no_solid = 0.1;
  const bool is_given = std::ranges::any_of(given, [](const std::string& key) {
    return key == "model" || key.starts_with("integrator");
  });
  const bool is_chosen = scene.integrator.model == ElasticModel::corotational &&
                         scene.integrator.integrator == Integrator::implicit_euler;
  const bool is_left_out = scene.integrator.model == ElasticModel::rigid_reference &&
                           scene.integrator.integrator == Integrator::floating_frame;
  if (is_given || !(is_chosen || is_left_out)) return;
  scene.integrator.model = ElasticModel::rigid_reference;
  scene.integrator.integrator = Integrator::floating_frame;
  if (accuracy == Accuracy::preview || scene.bodies.size() != 1) return;
  const BodySettings& body = scene.bodies[0];
  if (body.held.empty() || !scene.obstacles.empty() || body.mesh.tetrahedra.size() < 2) return;
  IntegratorSettings wanted = scene.integrator;
  wanted.model = ElasticModel::corotational;
  wanted.integrator = Integrator::implicit_euler;
  const double share = false_strain(body, measures[0]);
  if (!(share > too_much) || !(measures[0].strength <= no_solid * body.material.young_modulus))
    return;
  const IntegratorSettings before = std::exchange(scene.integrator, wanted);
  if (!check_scene(scene).empty()) {
    scene.integrator = before;
    return;
  }
  std::string reason = fmt::format(
      "{:.2g} times as long as thick and held; bent until it breaks, rigid_reference would show "
      "{:.2g} times the true strain",
      measures[0].slenderness, 1 + share);
  choices.push_back({"model", "\"corotational\"", std::move(reason)});
  choices.push_back({"integrator.method", "\"implicit_euler\"",
                     "suits the corotational model under slow loads; damps vibrations"});
}

}  // namespace

std::vector<std::string_view> chosen_keys() {
  std::vector<std::string_view> keys;
  for (const Rule& rule : rules) keys.push_back(rule.key);
  return keys;
}

std::vector<Choice> choose_settings(Scene& scene, Accuracy accuracy,
                                    std::span<const std::string> given) {
  std::vector<BodyMeasures> measures;
  for (const BodySettings& body : scene.bodies) measures.push_back(measure(body));
  const Outlook outlook = look_ahead(scene, accuracy, measures);
  std::vector<Choice> choices;
  // First, as it decides which of the keys are used.
  choose_model(choices, scene, accuracy, given, measures);
  for (const Rule& rule : rules) {
    if (std::ranges::find(given, rule.key) != given.end() || !is_used(scene, rule.key)) continue;
    Chosen chosen = rule.choose(outlook);
    // Three digits at most, so that the reported value is the one that is set.
    const std::string value = fmt::format("{:.4g}", chosen.value);
    rule.set(scene, std::strtod(value.c_str(), nullptr));
    const std::string word =
        rule.words.empty()
            ? value
            : fmt::format("\"{}\"", rule.words[static_cast<std::size_t>(chosen.value)]);
    choices.push_back({std::string(rule.key), word, std::move(chosen.reason)});
  }
  choose_orders(choices, scene, accuracy, given, measures);
  return choices;
}

}  // namespace sunder
