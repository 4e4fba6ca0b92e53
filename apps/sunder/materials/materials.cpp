// SPDX-License-Identifier: MIT
// A table of materials, for people and as JSON.
#include "apps/sunder/materials/materials.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <string>

#include "apps/scene/json_text.hpp"
#include "apps/scene/scene_text.hpp"
#include "apps/sunder/telling.hpp"
#include "mechanics/state/settings/named_materials.hpp"

namespace sunder {
namespace {

constexpr const char* materials_footer = R"(
A scene takes a name: "material": "glass", or {"name": "glass", "tensile_strength": 30e6}.
The fracture energy follows from the toughness: K_Ic^2 (1 - nu^2) / E.
Friction and Weibull's modulus are for the keys contact.friction and bodies[].strength.weibull, which
a name does not set. Real samples differ: strengths by half, moduli by a fifth.

The sources were read in copies of pages. Ranges are in the units of the table. Friction and
Weibull's modulus are typical where a source does not give them: ceramics have moduli of 5 to 20.

Exit codes: 0 done, 2 usage, 3 no material has the name.
)";

struct MaterialsArguments : Telling {
  std::string name;
};

nlohmann::ordered_json material_json(const NamedMaterial& m) {
  return {{"name", m.name},
          {"meaning", m.meaning},
          {"young_modulus", m.material.young_modulus},
          {"poisson_ratio", m.material.poisson_ratio},
          {"density", m.material.density},
          {"tensile_strength", m.material.tensile_strength},
          {"toughness", *m.material.toughness},
          {"fracture_energy", fracture_energy_of(m.material)},
          {"weibull_modulus", m.weibull},
          {"friction", m.friction},
          {"source", m.source}};
}

void print_table(std::span<const NamedMaterial> shown) {
  print("{:<10} {:>6} {:>5} {:>7} {:>9} {:>12} {:>7} {:>8} {:>8}  {}\n", "name", "E", "nu",
        "density", "strength", "toughness", "G_c", "Weibull", "friction", "kind");
  print("{:<10} {:>6} {:>5} {:>7} {:>9} {:>12} {:>7} {:>8} {:>8}\n", "", "GPa", "", "kg/m^3", "MPa",
        "MPa sqrt(m)", "J/m^2", "m", "");
  for (const NamedMaterial& m : shown) {
    print("{:<10} {:>6.4g} {:>5.2f} {:>7.0f} {:>9.4g} {:>12.3g} {:>7.3g} {:>8.3g} {:>8.2f}  {}\n",
          m.name, m.material.young_modulus / 1e9, m.material.poisson_ratio, m.material.density,
          m.material.tensile_strength / 1e6, *m.material.toughness / 1e6,
          fracture_energy_of(m.material), m.weibull, m.friction, m.meaning);
  }
  print("\nSources\n");
  for (const NamedMaterial& m : shown) print("{:<10} {}\n", m.name, m.source);
}

ExitCode show_materials(const MaterialsArguments& arguments) {
  std::span<const NamedMaterial> shown = named_materials();
  if (!arguments.name.empty()) {
    const NamedMaterial* named = find_material(arguments.name);
    if (named == nullptr) {
      tell({unknown_material(arguments.name)}, arguments);
      return ExitCode::bad_input;
    }
    shown = {named, 1};
  }
  if (!arguments.json) {
    print_table(shown);
    return ExitCode::fine;
  }
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const NamedMaterial& m : shown) list.push_back(material_json(m));
  print_json(list);
  return ExitCode::fine;
}

}  // namespace

Finding unknown_material(const std::string& name) {
  const std::vector<std::string> names = material_names();
  const std::string nearest = nearest_word(name, names);
  return {.code = "unknown_name",
          .text = fmt::format("{} is no material; known are {}", name, fmt::join(names, ", ")),
          .remedy = nearest.empty() ? "`sunder materials` lists them with their numbers"
                                    : fmt::format("did you mean {}?", nearest)};
}

void add_materials_command(CLI::App& program, ExitCode& exit_code) {
  CLI::App* command =
      program.add_subcommand("materials", "List the materials that scenes know by name");
  const auto arguments = std::make_shared<MaterialsArguments>();
  command->add_option("NAME", arguments->name, "Material; left out: all of them");
  command->add_flag("--json", arguments->json, "Print JSON instead of a table");
  command->footer(materials_footer);
  command->callback([=, &exit_code] { exit_code = show_materials(*arguments); });
}

}  // namespace sunder
