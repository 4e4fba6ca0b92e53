// SPDX-License-Identifier: MIT
// Chosen settings follow from the scene; given ones stay; reported ones are those that are set.
#include "fracture/scene/choose_settings.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <set>

#include "fracture/scene/scene_fields.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;

namespace {

Scene falling(double speed) {
  Scene scene;
  scene.bodies.resize(1);
  scene.bodies[0].mesh = suite::kuhn_box({4, 4, 4}, 0.05);
  scene.bodies[0].velocity.z() = -speed;
  scene.obstacles = {{Plane{}}};
  scene.gravity.acceleration.setZero();
  return scene;
}

Scene chosen(Scene scene, Accuracy accuracy = Accuracy::good) {
  choose_settings(scene, accuracy, {});
  return scene;
}

/// The keys that descriptions mark as chosen, with their values in a scene.
class ChosenKeys {
 public:
  template <class T>
  void field(const fields::Key& key, T& member) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      if (key.chosen) values[in_ + std::string(key.name)] = static_cast<double>(member);
    } else if constexpr (requires { fields::describe(*this, member); }) {
      const std::string outer = in_;
      in_ += std::string(key.name) + ".";
      fields::describe(*this, member);
      in_ = outer;
    }
  }
  void direction(const fields::Key&, Eigen::Vector3d&) {}
  template <class T, class Variant>
  void alternative(const fields::Key&, const T&, Variant&) {}

  std::map<std::string, double> values;

 private:
  std::string in_;
};

std::map<std::string, double> values_of(Scene scene) {
  ChosenKeys keys;
  fields::describe(keys, scene);
  return keys.values;
}

}  // namespace

TEST_CASE("keys that are described as chosen are those that are", "[fracture][settings]") {
  std::set<std::string> described, looked_after;
  for (const auto& [key, value] : values_of(Scene{})) described.insert(key);
  for (const std::string_view key : chosen_keys()) looked_after.emplace(key);
  CHECK(described == looked_after);
}

TEST_CASE("what is told is what is set, and what is given stays", "[fracture][settings]") {
  for (const Accuracy accuracy : {Accuracy::preview, Accuracy::good, Accuracy::reference}) {
    Scene scene = falling(5);
    const std::vector<std::string> given = {"contact", "contact.max_passes", "impact.negligible"};
    scene.contact.max_passes = 77;
    scene.impact.negligible = 0.5;
    const std::vector<Choice> choices = choose_settings(scene, accuracy, given);
    CHECK(choices.size() == chosen_keys().size() - 2);
    CHECK(scene.contact.max_passes == 77);
    CHECK(scene.impact.negligible == 0.5);
    const auto values = values_of(scene);
    for (const Choice& c : choices) {
      INFO(c.key);
      const std::map<std::string, double> words = {{"\"off\"", 0},
                                                   {"\"certified\"", 1},
                                                   {"\"until_struck\"", 2},
                                                   {"\"dense\"", 0},
                                                   {"\"lcc\"", 1}};
      const double told = words.contains(c.value) ? words.at(c.value) : std::stod(c.value);
      CHECK(told == values.at(c.key));
      CHECK_FALSE(c.reason.empty());
    }
    Scene again = scene;
    choose_settings(again, accuracy, given);
    CHECK(values_of(again) == values);
  }
}

TEST_CASE("good has the structs' defaults, whether anything breaks or not",
          "[fracture][settings]") {
  const auto plain = values_of(Scene{});
  CHECK(values_of(chosen(falling(0))) == plain);
  CHECK(values_of(chosen(falling(50))) == plain);
  Scene held = falling(5);
  held.fracture.mode = FractureMode::off;
  CHECK(values_of(chosen(held)) == plain);
}

TEST_CASE("lengths follow the cell beyond the range of everyday bodies", "[fracture][settings]") {
  const auto of = [](double cell) {
    Scene scene = falling(0);
    scene.bodies[0].mesh = suite::kuhn_box({4, 4, 4}, cell);
    return chosen(scene).contact;
  };
  CHECK(of(0.05).allowed_penetration == 1e-5);
  CHECK(of(1e-3).allowed_penetration == 2e-6);
  CHECK(of(1e-3).push_out_speed == 2e-4);
  CHECK(of(10).allowed_penetration == 1e-4);
  CHECK(of(10).push_out_speed == 1e-2);
}

TEST_CASE("more accuracy is finer in everything, and what a scene does not use is left alone",
          "[fracture][settings]") {
  const Scene preview = chosen(falling(5), Accuracy::preview), good = chosen(falling(5)),
              reference = chosen(falling(5), Accuracy::reference);
  CHECK(preview.contact.tolerance > good.contact.tolerance);
  CHECK(good.contact.max_iterations < reference.contact.max_iterations);
  CHECK(good.contact.max_passes < reference.contact.max_passes);
  Scene penalty = falling(5);
  penalty.contact.method = ContactMethod::penalty;
  for (const Choice& c : choose_settings(penalty, Accuracy::good, {})) {
    if (c.key != "topology.kernel") CHECK(c.key == "contact.max_contacts_per_pair");
  }
}

TEST_CASE("thin bodies of few layers are of second order, unless told or large or in a hurry",
          "[fracture][settings]") {
  const auto order = [](const std::array<int, 3>& cells, Accuracy accuracy, auto change) {
    Scene scene = falling(5);
    scene.bodies[0].mesh = suite::kuhn_box(cells, 0.01);
    change(scene);
    const std::vector<Choice> choices = choose_settings(scene, accuracy, {});
    const bool told = std::ranges::any_of(
        choices, [](const Choice& c) { return c.key == "bodies.0.order" && c.value == "2"; });
    CHECK(told == (scene.bodies[0].order == 2));
    CHECK(choose_settings(scene, accuracy, {}).size() == choices.size());
    CHECK(told == (scene.bodies[0].order == 2));
    return scene.bodies[0].order;
  };
  const auto as_it_is = [](Scene&) {};
  CHECK(order({10, 10, 1}, Accuracy::good, as_it_is) == 2);
  CHECK(order({20, 2, 2}, Accuracy::good, as_it_is) == 2);
  CHECK(order({10, 10, 1}, Accuracy::reference, as_it_is) == 2);
  CHECK(order({10, 10, 1}, Accuracy::preview, as_it_is) == 1);
  CHECK(order({4, 4, 4}, Accuracy::good, as_it_is) == 1);  // compact
  CHECK(order({3, 3, 1}, Accuracy::good, as_it_is) == 1);  // compact
  CHECK(order({28, 4, 4}, Accuracy::reference, as_it_is) == 2);
  CHECK(order({33, 6, 6}, Accuracy::reference, as_it_is) == 1);  // six layers
  CHECK(order({20, 20, 1}, Accuracy::good, as_it_is) == 1);      // 2 400 tetrahedra
  CHECK(order({20, 20, 1}, Accuracy::reference, as_it_is) == 2);
  CHECK(order({10, 10, 1}, Accuracy::good, [](Scene& s) { s.bodies[0].rigid = true; }) == 1);
  CHECK(order({10, 10, 1}, Accuracy::good,
              [](Scene& s) { s.integrator.isolated = IsolatedTetrahedra::qr; }) == 1);
  CHECK(order({10, 10, 1}, Accuracy::good,
              [](Scene& s) { s.fracture.node_stress = NodeStress::fit; }) == 1);
  Scene told = falling(5);
  told.bodies[0].mesh = suite::kuhn_box({10, 10, 1}, 0.01);
  CHECK(choose_settings(told, Accuracy::good, std::vector<std::string>{"bodies.0.order"}).size() ==
        chosen_keys().size());
  CHECK(told.bodies[0].order == 1);
}

TEST_CASE("a held body too slender for one frame has a frame for each of its tetrahedra",
          "[fracture][settings]") {
  const auto model = [](const std::vector<std::string>& given, Accuracy accuracy, auto change) {
    Scene scene = falling(0);
    scene.obstacles.clear();
    BodySettings& body = scene.bodies[0];
    body.mesh = suite::kuhn_box({40, 1, 1}, 0.01);
    body.held = {{.minimum = Vec3::Constant(-1e-9), .maximum = Vec3(1e-9, 1, 1)}};
    body.material.tensile_strength = 1e-3 * body.material.young_modulus;  // share: 0.8
    change(scene);
    const std::vector<Choice> choices = choose_settings(scene, accuracy, given);
    const auto told = std::ranges::count_if(
        choices, [](const Choice& c) { return c.key == "model" || c.key == "integrator.method"; });
    const bool is_corotational = scene.integrator.model == ElasticModel::corotational;
    CHECK(told == (given.empty() && is_corotational ? 2 : 0));
    CHECK(choose_settings(scene, accuracy, given).size() == choices.size());
    CHECK(is_corotational == (scene.integrator.model == ElasticModel::corotational));
    if (given.empty()) {
      CHECK((scene.integrator.integrator == Integrator::implicit_euler) == is_corotational);
    }
    return scene.integrator.model;
  };
  constexpr ElasticModel one = ElasticModel::rigid_reference, each = ElasticModel::corotational;
  const auto as_it_is = [](Scene&) {};
  CHECK(model({}, Accuracy::good, as_it_is) == each);
  CHECK(model({}, Accuracy::reference, as_it_is) == each);
  CHECK(model({}, Accuracy::preview, as_it_is) == one);
  CHECK(model({"model"}, Accuracy::good, as_it_is) == one);
  CHECK(model({"integrator.damping.mass_factor"}, Accuracy::good, as_it_is) == one);
  CHECK(model({}, Accuracy::good, [](Scene& s) { s.bodies[0].held.clear(); }) == one);
  CHECK(model({}, Accuracy::good, [](Scene& s) { s.obstacles = falling(0).obstacles; }) == one);
  CHECK(model({}, Accuracy::good, [](Scene& s) { s.bodies.push_back(s.bodies[0]); }) == one);
  CHECK(model({}, Accuracy::good, [](Scene& s) {
          s.bodies[0].material.tensile_strength /= 2;  // share: 0.4
        }) == one);
  CHECK(model({}, Accuracy::good,
              [](Scene& s) { s.bodies[0].held[0].axes = std::vector<Axis>{Axis::x}; }) == one);
  CHECK(model({}, Accuracy::good, [](Scene& s) { s.fracture.crack = CrackMode::cohesive; }) == one);
}
