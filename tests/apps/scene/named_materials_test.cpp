// SPDX-License-Identifier: MIT
// The table of materials: sound numbers, in order, found by name.
#include "mechanics/state/settings/named_materials.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "mechanics/state/settings/check_settings.hpp"

using namespace sunder;

TEST_CASE("each named material is a valid one of a kind that exists", "[materials]") {
  REQUIRE(named_materials().size() >= 9);
  CHECK(std::ranges::is_sorted(material_names()));
  for (const NamedMaterial& m : named_materials()) {
    INFO(m.name);
    CHECK(check_settings(m.material, "material").empty());
    CHECK_FALSE(m.meaning.empty());
    CHECK_FALSE(m.source.empty());
    REQUIRE(m.material.toughness);
    CHECK_FALSE(m.material.fracture_energy);
    // Brittle: Irwin's length is from tenths of millimetres to a metre.
    const double length = *m.material.toughness * *m.material.toughness /
                          (m.material.tensile_strength * m.material.tensile_strength);
    CHECK(length > 1e-4);
    CHECK(length < 1);
    // Strains at which brittle solids break, and speeds of sound in them.
    CHECK(m.material.tensile_strength / m.material.young_modulus > 5e-5);
    CHECK(m.material.tensile_strength / m.material.young_modulus < 3e-3);
    CHECK(bar_wave_speed(m.material) > 1500);
    CHECK(bar_wave_speed(m.material) < 12000);
    CHECK(m.friction > 0);
    CHECK(m.friction < 1);
    CHECK(m.weibull > 2);
  }
}

TEST_CASE("fracture energies of named materials are those of their sources", "[materials]") {
  // Mohammed, Hughes and Danraka: 47.4 J/m^2 of full scale bricks.
  CHECK(fracture_energy_of(find_material("brick")->material) == Approx(47.4).epsilon(0.01));
  // Dowling's Westerly granite: K_Ic^2 (1 - nu^2) / E.
  CHECK(fracture_energy_of(find_material("granite")->material) == Approx(15.2).epsilon(0.01));
}

TEST_CASE("materials are found whatever the case of their name and its spaces", "[materials]") {
  for (const NamedMaterial& m : named_materials()) CHECK(find_material(m.name) == &m);
  CHECK(find_material("Glass") == find_material("glass"));
  REQUIRE(find_material("cast iron") != nullptr);
  CHECK(find_material("cast iron") == find_material("cast_iron"));
  CHECK(find_material("Cast-Iron") == find_material("cast_iron"));
  for (const char* name : {"", "glas", "glass ", "wood"}) CHECK(find_material(name) == nullptr);
}
