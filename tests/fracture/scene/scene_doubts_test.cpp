// SPDX-License-Identifier: MIT
// A scene made odd in one way has that one warning, with its place and a remedy; a fine one none.
#include "fracture/scene/scene_doubts.hpp"

#include <catch2/catch.hpp>

#include "fracture/simulation/simulation.hpp"
#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;

namespace {

/// A beam of concrete, 0.8 x 0.4 x 0.4 m of cells of 0.1 m, that stands on the ground.
Scene fine() {
  Scene scene;
  scene.bodies.resize(1);
  scene.bodies[0].mesh = suite::kuhn_box({8, 4, 4}, 0.1);
  scene.obstacles = {{Plane{}}};
  return scene;
}

/// "code place" of every doubt after `change`, each with a remedy and a text that begins with its
/// place.
template <class Change>
std::vector<std::string> doubts(Change change) {
  Scene scene = fine();
  change(scene);
  std::vector<std::string> all;
  for (const SettingFinding& f : scene_doubts(scene)) {
    CHECK(f.finding.severity == Severity::warning);
    CHECK(f.finding.text.starts_with(f.place + " "));
    CHECK_FALSE(f.finding.remedy.empty());
    all.push_back(f.finding.code + " " + f.place);
  }
  return all;
}

using All = std::vector<std::string>;

}  // namespace

TEST_CASE("a fine scene has no doubts, and a built one passes its doubts on",
          "[fracture][settings]") {
  CHECK(doubts([](Scene&) {}) == All{});
  Scene scene = fine();
  scene.bodies[0].translation.z() = -0.05;
  const Result<Simulation> built = build_simulation(scene);
  REQUIRE(built);
  REQUIRE(built.findings.size() == 1);
  CHECK(built.findings[0].code == "overlap_at_start");
}

TEST_CASE("numbers in other units than SI are doubted", "[fracture][settings]") {
  CHECK(doubts([](Scene& s) { s.bodies[0].material.density = 2.4; }) ==
        All{"odd_unit bodies.0.material.density"});
  CHECK(doubts([](Scene& s) { s.bodies[0].material.density = 2.4e6; }) ==
        All{"odd_unit bodies.0.material.density"});
  // With 30 Pa waves crawl, and everything is stronger than a tenth of it.
  const All soft = doubts([](Scene& s) { s.bodies[0].material.young_modulus = 30; });
  CHECK(std::ranges::count(soft, "odd_unit bodies.0.material.young_modulus") == 1);
  CHECK(doubts([](Scene& s) { s.bodies[0].material.tensile_strength = 3; }) ==
        All{"odd_unit bodies.0.material.tensile_strength"});
  CHECK(doubts([](Scene& s) {
          s.bodies[0].mesh = suite::kuhn_box({4, 4, 4}, 0.1);
          s.bodies[0].material.tensile_strength = 4e9;
        }) == All{"odd_unit bodies.0.material.tensile_strength"});
  CHECK(doubts([](Scene& s) { s.bodies[0].material.toughness = 1; }) ==
        All{"odd_unit bodies.0.material.toughness"});
  CHECK(doubts([](Scene& s) { s.bodies[0].material.fracture_energy = 0.033; }) ==
        All{"odd_unit bodies.0.material.fracture_energy"});
  CHECK(doubts([](Scene& s) {
          s.bodies[0].strength.regions = {{.region = {"0"}, .tensile_strength = 2.0}};
        }) == All{"odd_unit bodies.0.strength.regions.0.tensile_strength"});
  CHECK(doubts([](Scene& s) {
          s.bodies[0].mesh = suite::kuhn_box({8, 4, 4}, 100);
        }) == All{"odd_unit bodies.0.mesh"});
  for (const double mass : {0.03, 3e5}) {
    CHECK(doubts([&](Scene& s) {
            s.obstacles.push_back({.shape = Sphere{{0, 0, 9}, 0.1}, .mass = mass});
          }) == All{"odd_unit obstacles.1.mass"});
  }
}

TEST_CASE("times and speeds that do not go together are doubted", "[fracture][settings]") {
  CHECK(doubts([](Scene& s) { s.integrator.time_step = 2; }) ==
        All{"step_over_duration time_step"});
  CHECK(doubts([](Scene& s) {
          s.duration = 1e-4;
          s.integrator.time_step = 1e-5;
        }) == All{"run_too_short duration"});
  CHECK(doubts([](Scene& s) {
          s.bodies[0].velocity = {0, 5000, 0};
        }) == All{"faster_than_waves bodies.0.velocity"});
  CHECK(doubts([](Scene& s) {
          s.bodies[0].spin = {0, 0, 1e4};
        }) == All{"faster_than_waves bodies.0.spin"});
  CHECK(doubts([](Scene& s) {
          s.bodies[0].held = {
              {.minimum = {0, 0, 0}, .maximum = {0, 1, 1}},
              {.minimum = {.8, 0, 0}, .maximum = {1, 1, 1}, .velocity = {4e3, 0, 0}}};
        }) == All{"faster_than_waves bodies.0.held.1.velocity"});
  CHECK(doubts([](Scene& s) {
          s.obstacles[0].velocity = {0, 0, 4e3};
        }) == All{"faster_than_waves obstacles.0.velocity"});
}

TEST_CASE("bodies that begin inside something are doubted, those that touch are not",
          "[fracture][settings]") {
  const All in_obstacle = {"overlap_at_start bodies.0.translation"};
  CHECK(doubts([](Scene& s) { s.bodies[0].translation.z() = -1e-3; }) == in_obstacle);
  CHECK(doubts([](Scene& s) { s.bodies[0].translation.z() = -1e-7; }) == All{});
  // A ball in a cell, off all vertices; one that only touches; a box that sticks in by its corner.
  const auto with = [](const Shape& shape) {
    return doubts([&](Scene& s) { s.obstacles.push_back({shape}); });
  };
  CHECK(with(Sphere{{0.43, 0.22, 0.16}, 0.01}) == in_obstacle);
  CHECK(with(Sphere{{0.43, 0.22, 0.41}, 0.02}) == in_obstacle);
  CHECK(with(Sphere{{0.43, 0.22, 0.5}, 0.1}) == All{});
  CHECK(with(Box{.center = {0.85, 0.2, 0.5}, .half_extent = {0.13, 0.13, 0.13}}) == in_obstacle);
  CHECK(with(Box{.center = {0.9, 0.2, 0.2}, .half_extent = {0.1, 0.1, 0.1}}) == All{});
  // Two bodies: in one place, one in the other's corner, side by side, apart.
  const auto second = [](const Eigen::Vector3d& at) {
    return doubts([&](Scene& s) {
      s.bodies.push_back(s.bodies[0]);
      s.bodies[1].translation = at;
    });
  };
  const All in_body = {"overlap_at_start bodies.1.translation"};
  CHECK(second({0, 0, 0}) == in_body);
  CHECK(second({0.77, 0.37, 0.37}) == in_body);
  CHECK(second({0, 0, 0.4}) == All{});
  CHECK(second({2, 0, 0}) == All{});
}

TEST_CASE("meshes too coarse or bodies too slender for what they bear are doubted",
          "[fracture][settings]") {
  const auto thin = [](int layers, auto change) {
    return doubts([&](Scene& s) {
      s.bodies[0].mesh = suite::kuhn_box({8, 8, layers}, 0.1);
      change(s);
    });
  };
  const All few = {"few_layers bodies.0.mesh"};
  CHECK(thin(1, [](Scene&) {}) == few);
  CHECK(thin(2, [](Scene&) {}) == few);
  CHECK(thin(3, [](Scene&) {}) == All{});
  CHECK(thin(1, [](Scene& s) { s.fracture.mode = FractureMode::off; }) == All{});
  CHECK(thin(1, [](Scene& s) { s.bodies[0].rigid = true; }) == All{});
  // A compact body deforms more in shear; a hollow one is not compact, whatever its outline.
  const auto cube = [](int n) {
    return doubts([&](Scene& s) { s.bodies[0].mesh = suite::kuhn_box({n, n, n}, 0.8 / n); });
  };
  CHECK(cube(1) == All{});
  CHECK(cube(2) == All{});
  CHECK(doubts([](Scene& s) {
          TetMesh& shell = s.bodies[0].mesh = suite::kuhn_box({6, 6, 6}, 0.1);
          std::erase_if(shell.tetrahedra, [&](const auto& t) {
            return std::ranges::all_of(t, [&](std::uint32_t corner) {
              return std::ranges::all_of(shell.points[corner],
                                         [](double x) { return x > 0.05 && x < 0.55; });
            });
          });
        }) == few);
  const auto slender = [](double strength) {
    Scene scene = fine();
    scene.bodies[0].mesh = suite::kuhn_box({150, 3, 3}, 0.01);
    scene.bodies[0].material.tensile_strength = strength;
    return scene_doubts(scene);
  };
  const auto some = slender(3e6), far = slender(3e8);
  REQUIRE(some.size() == 1);
  CHECK(some[0].finding.code == "slender_body");
  CHECK(some[0].finding.text.find("% of it") != std::string::npos);
  CHECK(some[0].finding.remedy.find("corotational") != std::string::npos);
  // More than all of it is no figure.
  REQUIRE(far.size() == 1);
  CHECK(far[0].finding.text.find("% of it") == std::string::npos);
  CHECK(far[0].finding.text.find("larger than the true one") != std::string::npos);
}

TEST_CASE("bodies that nothing bends are not doubted for how they bend", "[fracture][settings]") {
  // A bar of glass as in meshes/scenes/bar.json, two cells thick, alone.
  const auto bar = [](auto change) {
    return doubts([&](Scene& s) {
      s.obstacles.clear();
      s.bodies[0].mesh = suite::kuhn_box({30, 4, 2}, 0.03);
      s.bodies[0].material = {.young_modulus = 70e9, .tensile_strength = 45e6};
      change(s, s.bodies[0]);
    });
  };
  const auto pull = [](BodySettings& b, const Eigen::Vector3d& velocity) {
    b.held = {{.minimum = {0, 0, 0}, .maximum = {0, 1, 1}},
              {.minimum = {0.89, 0, 0}, .maximum = {1, 1, 1}, .velocity = velocity}};
  };
  const All bent = {"few_layers bodies.0.mesh", "slender_body bodies.0.mesh"};
  CHECK(bar([](Scene&, BodySettings&) {}) == All{});
  CHECK(bar([&](Scene&, BodySettings& b) { pull(b, {3e-3, 0, 0}); }) == All{});
  CHECK(bar([&](Scene&, BodySettings& b) { pull(b, {-3e-3, 0, 0}); }) == All{});
  CHECK(bar([&](Scene&, BodySettings& b) { pull(b, {3e-3, 0, 3e-4}); }) == bent);
  CHECK(bar([](Scene& s, BodySettings&) { s.obstacles = {{Plane{}}}; }) == bent);
  CHECK(bar([](Scene&, BodySettings& b) { b.spin = {0, 0, 1}; }) == bent);
  CHECK(bar([](Scene&, BodySettings& b) {
          b.loads = {{.minimum = {0.8, 0, 0}, .maximum = {1, 1, 1}, .force = {0, 0, 1}}};
        }) == bent);
  // Weight: two hundredths of the strength are little, two fifths are much.
  CHECK(bar([&](Scene& s, BodySettings& b) {
          pull(b, {3e-3, 0, 0});
          s.gravity.acceleration *= 20;
        }) == bent);
}

TEST_CASE("of several bodies with one doubt the worst comes first", "[fracture][settings]") {
  const All found = doubts([](Scene& s) {
    for (int b = 1; b < 4; ++b) {
      s.bodies.push_back(s.bodies[0]);
      s.bodies.back().translation.x() = 2 * b;
      s.bodies.back().mesh = suite::kuhn_box({8, 8, b == 2 ? 1 : 2}, 0.1);
    }
    s.duration = 1e-4;
    s.integrator.time_step = 1e-5;
  });
  CHECK(found == All{"few_layers bodies.2.mesh", "few_layers bodies.1.mesh",
                     "few_layers bodies.3.mesh", "run_too_short duration"});
}

TEST_CASE("advice never asks for a mesh that no computer bears", "[fracture][settings]") {
  const auto remedy = [](const std::string& code, auto change) {
    Scene scene = fine();
    change(scene);
    std::string text;
    for (const SettingFinding& f : scene_doubts(scene)) {
      if (f.finding.code == code) text = f.finding.remedy;
    }
    REQUIRE_FALSE(text.empty());
    return text;
  };
  const auto plate = [&](int cells) {
    return remedy("few_layers", [&](Scene& s) {
      s.bodies[0].mesh = suite::kuhn_box({cells, cells, 1}, 0.8 / cells);
    });
  };
  CHECK(plate(4).find("a mesh of at least four layers (about 6e+03 tetrahedra)") !=
        std::string::npos);
  const std::string large = plate(40);
  CHECK(large.find("flat cells in four layers") != std::string::npos);
  CHECK(large.find("at least four") == std::string::npos);
  const auto tip = [&](double energy) {
    return remedy("tip_not_resolved", [&](Scene& s) {
      s.fracture.crack = CrackMode::cohesive;
      s.bodies[0].material.fracture_energy = energy;
    });
  };
  CHECK(tip(30).starts_with("take cells of"));
  CHECK(tip(0.3).find("take cells of") == std::string::npos);
  CHECK(tip(0.3).find("trust energies") == 0);
}

TEST_CASE("a mug in millimetres is doubted, a house in metres is not", "[fracture][settings]") {
  const auto of_size = [](double cell) {
    Scene scene = fine();
    scene.bodies[0].mesh = suite::kuhn_box({8, 4, 4}, cell);
    scene.duration = 1;
    return scene_doubts(scene);
  };
  CHECK(of_size(1).empty());
  const auto mug = of_size(11);
  REQUIRE(mug.size() == 1);
  CHECK(mug[0].finding.code == "odd_unit");
  CHECK(mug[0].finding.remedy.find("\"units\": \"mm\"") != std::string::npos);
}

TEST_CASE("cohesive cracks that the cells do not resolve are doubted by body",
          "[fracture][settings]") {
  const auto with = [](auto change) {
    return doubts([&](Scene& s) {
      s.fracture.crack = CrackMode::cohesive;
      s.bodies[0].material.fracture_energy = 100;  // l_z is a third of a metre
      change(s.bodies[0].material);
    });
  };
  CHECK(with([](Material&) {}) == All{});
  CHECK(with([](Material& m) { m.fracture_energy = 30; }) ==
        All{"tip_not_resolved bodies.0.material"});
  CHECK(with([](Material& m) { m.toughness = 1e6; }) ==
        All{"two_fracture_energies bodies.0.material"});
}
