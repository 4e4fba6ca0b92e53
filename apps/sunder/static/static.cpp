// SPDX-License-Identifier: MIT
// The command line of `sunder static`, its table, JSON and VTU.
#include "apps/sunder/static/static.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/output/frame.hpp"
#include "apps/scene/json_text.hpp"
#include "apps/scene/scene_json.hpp"
#include "apps/scene/words.hpp"
#include "apps/sunder/program.hpp"
#include "apps/sunder/static/static_fan.hpp"
#include "fracture/simulation/statics/statics.hpp"
#include "mechanics/rebuild.hpp"
#include "topology/base/counted.hpp"
#include "topology/io/files/printing.hpp"

namespace sunder {
namespace {

using nlohmann::ordered_json;

constexpr const char* static_footer = R"(
SCENE is a scene file as `sunder run` takes it, in SI units (docs/explanation/theory.md). Gravity and
the bodies' "loads" (Pa, N) act fully. "held" vertices are fixed, or moved by their velocity (m/s)
times the scene's "duration" (s). Every body needs three held vertices that are not on one line.
Obstacles are ignored, and do not support a body here. The key "order": 2 makes the tetrahedra of a
body quadratic, with nodes in the middle of edges, for bodies that bend.

Results per body and over all:
  largest displacement (m), with the point of the mesh (counted from 0) and its place (m)
  strain energy (J)
  largest principal stress of a vertex (Pa) and its share of the tensile strength, with its point
  force (N) and moment about the mass centre (N m) of each support
--fan V,NX,NY,NZ adds the release by one fan: faces, area (m^2), energy (J) and energy per area
(J/m^2). V counts the points of all bodies' meshes, one after the other, and the normal is in the
mesh's axes. The material's value is printed too if it has a toughness (docs/explanation/cracks.md).
Nothing is split.
--fans SHARE lists the same for the fan of every vertex with at least this share of its strength,
most energy per area first. Vertices with a share of 1 or more would break. Vertices on a crack front
also have the release of that front.
FILE.vtu holds the deformed bodies with displacement, node stress and largest principal stress.

Exit codes: 0 done, 2 usage, 3 bad scene or mesh or no equilibrium, 4 not written, 5 the result is
not finite.

Examples:
  sunder static beam.json
  sunder static beam.json --set gravity.acceleration=[0,0,0] --json -o beam.vtu
)";

struct StaticArguments : Telling {
  std::filesystem::path scene, output;
  std::vector<std::string> settings;
  std::string fan;
  std::optional<double> fans;
  SceneReach reach = SceneReach::anywhere;
};

ordered_json components_json(const Vec3& v) { return {v[0], v[1], v[2]}; }

ordered_json extreme_json(const Extreme& e) {
  return {{"value", e.value}, {"vertex", e.point}, {"position", components_json(e.position)}};
}

ordered_json body_json(const BodyEquilibrium& body) {
  ordered_json supports = ordered_json::array();
  for (const SupportReaction& s : body.supports) {
    supports.push_back({{"vertices", s.vertices},
                        {"force", components_json(s.force)},
                        {"moment", components_json(s.moment)}});
  }
  return {{"name", body.name},
          {"vertices", body.vertices},
          {"nodes", body.nodes},
          {"tetrahedra", body.tetrahedra},
          {"mass", body.mass},
          {"max_displacement", extreme_json(body.displacement)},
          {"strain_energy", body.strain_energy},
          {"max_principal_stress", extreme_json(body.principal_stress)},
          {"max_strength_share", extreme_json(body.strength_share)},
          {"load", components_json(body.load)},
          {"supports", supports},
          {"residual", body.residual}};
}

/// The largest of all bodies, with the body's row.
ordered_json largest(const Equilibrium& answer, Extreme BodyEquilibrium::*which) {
  std::size_t row = 0;
  for (std::size_t b = 1; b < answer.bodies.size(); ++b) {
    if ((answer.bodies[b].*which).value > (answer.bodies[row].*which).value) row = b;
  }
  ordered_json json = extreme_json(answer.bodies[row].*which);
  json["body"] = row;
  return json;
}

ordered_json answer_json(const std::string& scene, const Equilibrium& answer,
                         const std::vector<Finding>& findings) {
  ordered_json bodies = ordered_json::array();
  double energy = 0;
  for (const BodyEquilibrium& body : answer.bodies) {
    bodies.push_back(body_json(body));
    energy += body.strain_energy;
  }
  return {{"scene", scene},
          {"max_displacement", largest(answer, &BodyEquilibrium::displacement)},
          {"strain_energy", energy},
          {"max_principal_stress", largest(answer, &BodyEquilibrium::principal_stress)},
          {"max_strength_share", largest(answer, &BodyEquilibrium::strength_share)},
          {"bodies", bodies},
          {"findings", findings_json(findings)}};
}

std::string place(const Extreme& e) {
  return fmt::format("at vertex {} ({:.6g}, {:.6g}, {:.6g}) m", e.point, e.position[0],
                     e.position[1], e.position[2]);
}

void print_table(const Equilibrium& answer) {
  const auto row = [](const char* name, const std::string& value) {
    print("{:<18} {}\n", name, value);
  };
  for (std::size_t b = 0; b < answer.bodies.size(); ++b) {
    const BodyEquilibrium& body = answer.bodies[b];
    row("body",
        fmt::format("{} {} ({}, {}, {:.6g} kg)", b, plain_line(body.name),
                    counted_tetrahedra(body.tetrahedra), counted(body.nodes, "node"), body.mass));
    row("displacement",
        fmt::format("{:.6g} m {}", body.displacement.value, place(body.displacement)));
    row("strain energy", fmt::format("{:.6g} J", body.strain_energy));
    row("principal stress",
        fmt::format("{:.6g} Pa {}", body.principal_stress.value, place(body.principal_stress)));
    row("share of strength",
        fmt::format("{:.4g} {}", body.strength_share.value, place(body.strength_share)));
    for (const SupportReaction& s : body.supports) {
      row("support",
          fmt::format("{} {} with ({:.6g}, {:.6g}, {:.6g}) N",
                      counted(s.vertices, "vertex", "vertices"),
                      for_count(s.vertices, "pushes", "push"), s.force[0], s.force[1], s.force[2]));
    }
  }
}

ExitCode run_static(const StaticArguments& arguments) {
  Stages stages(arguments);
  Result<SceneFile> file = read_scene(arguments.scene, arguments.settings, arguments.reach);
  tell(file.findings, arguments);
  if (!file) return ExitCode::bad_input;
  stages.done(fmt::format("read {} with its meshes", arguments.scene.string()));
  Result<Simulation> sim = build_statics(file->scene);
  tell(sim.findings, arguments);
  if (!sim) return ExitCode::bad_input;
  stages.done(fmt::format("built the matrices, bodies: {}", file->scene.bodies.size()));
  const Result<Equilibrium> answer = solve_scene(*sim);
  tell(answer.findings, arguments);
  if (!answer) {
    return answer.findings.back().code == "not_a_number" ? ExitCode::failed : ExitCode::bad_input;
  }
  stages.done("solved for the equilibrium");
  if (!arguments.output.empty()) {
    const std::vector<Finding> unwritten = write_frame(arguments.output, *sim);
    tell(unwritten, arguments);
    if (has_error(unwritten)) return ExitCode::not_written;
    stages.done(fmt::format("wrote {}", arguments.output.string()));
  }
  std::optional<FanAnswer> fan;
  if (!arguments.fan.empty()) {
    const Result<FanAnswer> released = fan_answer(*sim, arguments.fan);
    tell(released.findings, arguments);
    if (!released) return ExitCode::usage;
    fan = *released;
    stages.done("found the energy of the fan");
  }
  std::vector<FanCandidate> candidates;
  if (arguments.fans) {
    Result<std::vector<FanCandidate>> found =
        fan_candidates(*sim, answer->node_stress, *arguments.fans);
    tell(found.findings, arguments);
    if (!found) return ExitCode::failed;
    candidates = std::move(*found);
    stages.done(fmt::format("found the energies of fans: {}", candidates.size()));
  }
  if (arguments.json) {
    ordered_json json = answer_json(sim->scene.name, *answer, answer.findings);
    if (fan) json["fan"] = to_json(*fan);
    if (arguments.fans) json["fans"] = to_json(candidates);
    print_json(json);
  } else {
    print_table(*answer);
    if (fan) print("{}", to_table(*fan));
    if (arguments.fans) print("{}", to_table(candidates));
  }
  return ExitCode::fine;
}

}  // namespace

void add_static_command(CLI::App& program, ExitCode& exit_code) {
  CLI::App* command =
      program.add_subcommand("static", "Find the equilibrium of a scene's bodies under its loads");
  const auto arguments = std::make_shared<StaticArguments>();
  command->add_option("SCENE", arguments->scene, "Scene file (JSON)")->required();
  command->add_option("-o,--output", arguments->output, "Write the equilibrium as VTU")
      ->type_name("FILE.vtu");
  command
      ->add_option("--set", arguments->settings,
                   "Change a value of the scene: gravity.ramp_time=2; may be repeated")
      ->type_name("KEY=VALUE")
      ->take_all();
  command->add_option("--fan", arguments->fan, "Compute the energy that this fan would release")
      ->type_name("V,NX,NY,NZ")
      ->check(CLI::Validator(check_fan_text, "", "fan"));
  command
      ->add_option("--fans", arguments->fans,
                   "Compute it for all vertices at this share of their strength or more")
      ->type_name("SHARE")
      ->check(CLI::NonNegativeNumber);
  add_confined_flag(*command, arguments->reach);
  add_telling_flags(*command, *arguments);
  command->add_flag("--json", arguments->json, "Print JSON instead of a table");
  command->footer(static_footer);
  command->callback([=, &exit_code] { exit_code = run_static(*arguments); });
}

}  // namespace sunder
