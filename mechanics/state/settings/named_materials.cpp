// SPDX-License-Identifier: MIT
// A table.
#include "mechanics/state/settings/named_materials.hpp"

#include <algorithm>
#include <array>

namespace sunder {
namespace {

constexpr std::array<NamedMaterial, 10> materials = {{
    {"alumina",
     "dense alumina, 99 %",
     {.young_modulus = 370e9,
      .poisson_ratio = 0.22,
      .density = 3850,
      .tensile_strength = 250e6,
      .toughness = 4.0e6},
     0.4,
     10,
     "IEC 60672-3, group C 799; Dowling, Mechanical Behavior of Materials, toughness"},
    {"brick",
     "fired clay brick",
     {.young_modulus = 15e9,
      .poisson_ratio = 0.2,
      .density = 1900,
      .tensile_strength = 2.5e6,
      .toughness = 1.0e6},
     0.7,
     8,
     "van der Pluijm 1999, Out-of-Plane Bending of Masonry: strength and fracture energy of "
     "bricks"},
    {"cast_iron",
     "grey cast iron GJL-250",
     {.young_modulus = 110e9,
      .poisson_ratio = 0.26,
      .density = 7200,
      .tensile_strength = 250e6,
      .toughness = 15e6},
     0.3,
     25,
     "EN 1561, EN-GJL-250"},
    {"ceramic",
     "stoneware, as in mugs and tiles",
     {.young_modulus = 50e9,
      .poisson_ratio = 0.2,
      .density = 2300,
      .tensile_strength = 30e6,
      .toughness = 1.0e6},
     0.4,
     10,
     "ISO 13006, group BIb: strength; the rest estimated between earthenware and porcelain"},
    {"concrete",
     "concrete C30/37",
     {.young_modulus = 30e9,
      .poisson_ratio = 0.2,
      .density = 2400,
      .tensile_strength = 3e6,
      .toughness = 1.0e6},
     0.6,
     12,
     "fib Model Code 2010; Callister, Materials Science, table B.5: toughness 0.2 to 1.4"},
    {"glass",
     "soda-lime float glass, annealed",
     {.young_modulus = 70e9,
      .poisson_ratio = 0.22,
      .density = 2500,
      .tensile_strength = 45e6,
      .toughness = 0.75e6},
     0.3,
     7,
     "EN 572-1; Callister, Materials Science, table B.5: toughness; ASTM E1300: Weibull's modulus"},
    {"granite",
     "granite of fine grain",
     {.young_modulus = 60e9,
      .poisson_ratio = 0.25,
      .density = 2650,
      .tensile_strength = 10e6,
      .toughness = 1.6e6},
     0.6,
     15,
     "Atkinson and Meredith 1987, in Fracture Mechanics of Rock: toughness 0.6 to 2.5"},
    {"ice",
     "fresh water ice at -10 degrees C",
     {.young_modulus = 9.5e9,
      .poisson_ratio = 0.33,
      .density = 917,
      .tensile_strength = 1.4e6,
      .toughness = 0.11e6},
     0.05,
     5,
     "Petrovic 2003, Mechanical properties of ice and snow: strength 0.7 to 3.1, toughness 0.05 to "
     "0.15"},
    {"plaster",
     "cast gypsum plaster, dry",
     {.young_modulus = 5e9,
      .poisson_ratio = 0.2,
      .density = 1100,
      .tensile_strength = 2.5e6,
      .toughness = 0.2e6},
     0.5,
     10,
     "Vekinis, Ashby and Beaumont 1993, Plaster of Paris as a model material"},
    {"porcelain",
     "quartz porcelain, unglazed",
     {.young_modulus = 60e9,
      .poisson_ratio = 0.2,
      .density = 2300,
      .tensile_strength = 50e6,
      .toughness = 1.0e6},
     0.4,
     12,
     "IEC 60672-3, group C 110; Quinn and others 2012, Dental Materials 28: feldspathic porcelain"},
}};

/// A letter of a name as names have it.
char plain(char c) {
  if (c >= 'A' && c <= 'Z') return static_cast<char>(c - 'A' + 'a');
  return c == '-' || c == ' ' ? '_' : c;
}

}  // namespace

std::span<const NamedMaterial> named_materials() { return materials; }

std::vector<std::string> material_names() {
  std::vector<std::string> names;
  for (const NamedMaterial& m : materials) names.emplace_back(m.name);
  return names;
}

const NamedMaterial* find_material(std::string_view name) {
  const auto found = std::ranges::find_if(materials, [&](const NamedMaterial& m) {
    return std::ranges::equal(name, m.name, {}, plain);
  });
  return found == materials.end() ? nullptr : &*found;
}

}  // namespace sunder
