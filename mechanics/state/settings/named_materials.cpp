// SPDX-License-Identifier: MIT
// A table. Units within the sources are those of `sunder materials`: GPa, MPa, MPa sqrt(m), kg/m^3.
#include "mechanics/state/settings/named_materials.hpp"

#include <algorithm>
#include <array>

namespace sunder {
namespace {

constexpr std::array<NamedMaterial, 10> materials = {{
    {"alumina",
     "dense alumina, 99.5 %",
     {.young_modulus = 372e9,
      .poisson_ratio = 0.22,
      .density = 3890,
      .tensile_strength = 262e6,
      .toughness = 4.0e6},
     0.4,
     10,
     "Dowling, Mechanical Behavior of Materials, tables 3.10, 5.2 and 8.2. Callister, table B.5, "
     "99.9 %: strength 282 to 551, toughness 4.2 to 5.9"},
    {"brick",
     "fired clay brick",
     {.young_modulus = 15e9,
      .poisson_ratio = 0.2,
      .density = 1900,
      .tensile_strength = 2.8e6,
      .toughness = 0.86e6},
     0.7,
     4.4,
     "Mohammed, Hughes and Danraka, IJMER: G_c 47.4, from which the toughness follows. "
     "material-properties.org: strength. Vermeltfoort (abstract): E is 400 times the compressive "
     "strength, here 37 MPa, and strengths scatter by 25 %. No source was read for nu"},
    {"cast_iron",
     "grey cast iron GJL-250",
     {.young_modulus = 110e9,
      .poisson_ratio = 0.26,
      .density = 7200,
      .tensile_strength = 250e6,
      .toughness = 15e6},
     0.3,
     25,
     "EN 1561, EN-GJL-250, by data sheets of foundries: E 103 to 118, nu, strength 250 to 350, "
     "toughness 15.2. MakeItFrom: density 7200 to 7500. physics.info: friction 0.3 to 0.7 on "
     "stone"},
    {"ceramic",
     "stoneware, as in mugs and tiles",
     {.young_modulus = 50e9,
      .poisson_ratio = 0.2,
      .density = 2300,
      .tensile_strength = 30e6,
      .toughness = 1.0e6},
     0.4,
     10,
     "ISO 13006, group BIb, by a catalogue: 30 or more in bending. The other numbers are typical, "
     "and no source was read for them"},
    {"concrete",
     "concrete C30/37",
     {.young_modulus = 30e9,
      .poisson_ratio = 0.2,
      .density = 2400,
      .tensile_strength = 3e6,
      .toughness = 1.0e6},
     0.6,
     12,
     "Eurocode 2, table 3.1 and 3.1.3: nu, strength 2.0 to 3.8, mean 2.9, E 33, 30 with limestone. "
     "Callister, table B.5: toughness 0.2 to 1.4. Dowling, table 8.2: toughness 1.19. Whole "
     "specimens give larger G_c"},
    {"glass",
     "soda-lime float glass, annealed",
     {.young_modulus = 70e9,
      .poisson_ratio = 0.2,
      .density = 2500,
      .tensile_strength = 45e6,
      .toughness = 0.75e6},
     0.3,
     7,
     "EN 572-1, by glass makers: E, nu, density, strength in bending. Callister, table B.5: "
     "toughness. Salek 2008, Strength of Glass: Weibull's modulus 3 to 8"},
    {"granite",
     "Westerly granite, of fine grain",
     {.young_modulus = 49.6e9,
      .poisson_ratio = 0.213,
      .density = 2640,
      .tensile_strength = 9.58e6,
      .toughness = 0.89e6},
     0.6,
     15,
     "Dowling, Mechanical Behavior of Materials, tables 3.10, 5.2 and 8.2. A table of a course "
     "(GEOL 615): friction 0.5 to 0.8 of rocks"},
    {"ice",
     "fresh water ice at -10 degrees C",
     {.young_modulus = 9.2e9,
      .poisson_ratio = 0.33,
      .density = 917,
      .tensile_strength = 1.5e6,
      .toughness = 0.10e6},
     0.05,
     5,
     "Petrovic 2003 (abstract): strength 0.7 to 3.1, toughness 0.05 to 0.15, Weibull's modulus. "
     "Gammon and others, Journal of Glaciology: E and nu, as the mean of all directions at -16 "
     "degrees C. physics.info: friction 0.02 to 0.09. No source was read for the density"},
    {"plaster",
     "cast gypsum plaster, dry",
     {.young_modulus = 5e9,
      .poisson_ratio = 0.2,
      .density = 1100,
      .tensile_strength = 2.5e6,
      .toughness = 0.15e6},
     0.5,
     10,
     "These numbers are typical, and no source was read for them. Vekinis, Ashby and Beaumont 1993 "
     "(abstract): they depend on porosity"},
    {"porcelain",
     "quartz porcelain, unglazed",
     {.young_modulus = 67e9,
      .poisson_ratio = 0.17,
      .density = 2300,
      .tensile_strength = 50e6,
      .toughness = 1.0e6},
     0.4,
     12,
     "MakeItFrom, engineering porcelain: E 67 to 150, nu, density 2300 to 3000, toughness 2.0. "
     "Journal of Dental Research 59 (1980) 1409, abstract: strength 29 to 40 in tension, 88 in "
     "bending. No source was read for a toughness of quartz porcelain"},
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
