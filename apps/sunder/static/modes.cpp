// SPDX-License-Identifier: MIT
// The command line of `sunder modes`, its table, JSON and VTU.
#include "apps/sunder/static/modes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/output/node_mesh.hpp"
#include "apps/scene/json_text.hpp"
#include "apps/scene/scene_json.hpp"
#include "apps/scene/words.hpp"
#include "apps/sunder/program.hpp"
#include "fracture/simulation/simulation_state.hpp"
#include "fracture/simulation/statics/statics.hpp"
#include "topology/io/files/printing.hpp"
#include "topology/io/mesh_file.hpp"

namespace sunder {
namespace {

using nlohmann::ordered_json;

constexpr const char* modes_footer = R"(
SCENE is a scene file as `sunder run` takes it, in SI units (docs/explanation/theory.md). The program
computes the N lowest natural frequencies (Hz) of every piece of every body. Held vertices are at
rest. Gravity, loads and obstacles are left out. A free piece has six more modes, its rigid motions,
listed first with frequency 0.
FILE.vtu holds the undeformed bodies with displacement columns mode_1, mode_2, ..., the rigid
motions included. The largest displacement of a piece in a mode is 1 m.

Exit codes: 0 done, 2 usage, 3 bad scene or mesh, 4 not written, 5 the modes were not found.

Examples:
  sunder modes beam.json --count 6
  sunder modes beam.json --count 3 --json -o beam_modes.vtu
)";

struct ModesArguments : Telling {
  std::filesystem::path scene, output;
  std::vector<std::string> settings;
  std::size_t count = 6;
  SceneReach reach = SceneReach::anywhere;
};

ordered_json answer_json(const Simulation& sim, const std::vector<PieceModes>& pieces) {
  ordered_json list = ordered_json::array();
  for (const PieceModes& piece : pieces) {
    const Component& component = sim.state->mechanics.components[piece.component.index()];
    list.push_back({{"body", piece.body},
                    {"name", sim.scene.bodies[piece.body].name},
                    {"component", piece.component.value},
                    {"tetrahedra", component.tetrahedra.size()},
                    {"mass", component.mass},
                    {"rigid_modes", piece.rigid},
                    {"frequencies", piece.frequency}});
  }
  return {{"scene", sim.scene.name}, {"pieces", list}};
}

void print_table(const Simulation& sim, const std::vector<PieceModes>& pieces) {
  for (const PieceModes& piece : pieces) {
    print("body {} {}, piece {}: {} rigid\n", piece.body,
          plain_line(sim.scene.bodies[piece.body].name), piece.component.value, piece.rigid);
    for (std::size_t k = 0; k < piece.frequency.size(); ++k) {
      print("  mode {:<4} {:.6g} Hz{}\n", k + 1, piece.frequency[k],
            k < piece.rigid ? " (rigid)" : "");
    }
  }
}

/// Column k of every piece, one row a vertex, world, largest displacement of a piece 1.
std::vector<Vec3> shape_column(const Simulation& sim, const std::vector<PieceModes>& pieces,
                               std::size_t k) {
  const MechanicsState& m = sim.state->mechanics;
  std::vector<Vec3> column(m.vertices.size(), Vec3::Zero());
  for (const PieceModes& piece : pieces) {
    if (k >= piece.frequency.size()) continue;
    const Component& component = m.components[piece.component.index()];
    double largest = 0;
    for (const Vec3& phi : piece.shape[k]) largest = std::max(largest, phi.norm());
    for (std::size_t i = 0; i < piece.vertex.size(); ++i) {
      column[piece.vertex[i].index()] = component.orientation * (piece.shape[k][i] / largest);
    }
  }
  return column;
}

std::vector<Finding> write_shapes(const std::filesystem::path& path, const Simulation& sim,
                                  const std::vector<PieceModes>& pieces) {
  FileMesh mesh = node_mesh(sim);
  std::size_t most = 0;
  for (const PieceModes& piece : pieces) most = std::max(most, piece.frequency.size());
  for (std::size_t k = 0; k < most; ++k) {
    add_node_column(mesh, fmt::format("mode_{}", k + 1), shape_column(sim, pieces, k));
  }
  return write_file_mesh(path, mesh, {.format = MeshFormat::vtu});
}

ExitCode run_modes(const ModesArguments& arguments) {
  Stages stages(arguments);
  Result<SceneFile> file = read_scene(arguments.scene, arguments.settings, arguments.reach);
  tell(file.findings, arguments);
  if (!file) return ExitCode::bad_input;
  stages.done(fmt::format("read {} with its meshes", arguments.scene.string()));
  Result<Simulation> sim = build_statics(file->scene);
  tell(sim.findings, arguments);
  if (!sim) return ExitCode::bad_input;
  stages.done(fmt::format("built the matrices, bodies: {}", file->scene.bodies.size()));
  const Result<std::vector<PieceModes>> pieces = scene_modes(*sim, arguments.count);
  tell(pieces.findings, arguments);
  if (!pieces) return ExitCode::failed;
  stages.done(fmt::format("found the modes, pieces: {}", pieces->size()));
  if (!arguments.output.empty()) {
    const std::vector<Finding> unwritten = write_shapes(arguments.output, *sim, *pieces);
    tell(unwritten, arguments);
    if (has_error(unwritten)) return ExitCode::not_written;
    stages.done(fmt::format("wrote {}", arguments.output.string()));
  }
  if (arguments.json) {
    print_json(answer_json(*sim, *pieces));
  } else {
    print_table(*sim, *pieces);
  }
  return ExitCode::fine;
}

}  // namespace

void add_modes_command(CLI::App& program, ExitCode& exit_code) {
  CLI::App* command =
      program.add_subcommand("modes", "Find natural frequencies and shapes of a scene's bodies");
  const auto arguments = std::make_shared<ModesArguments>();
  command->add_option("SCENE", arguments->scene, "Scene file (JSON)")->required();
  command
      ->add_option("--count", arguments->count,
                   "Modes of each piece besides its rigid motions; default 6")
      ->type_name("N")
      ->check(CLI::Range(1, 1000));
  command->add_option("-o,--output", arguments->output, "Write the shapes as VTU")
      ->type_name("FILE.vtu");
  command
      ->add_option("--set", arguments->settings,
                   "Change a value of the scene: bodies.0.material.density=2000; may be repeated")
      ->type_name("KEY=VALUE")
      ->take_all();
  add_confined_flag(*command, arguments->reach);
  add_telling_flags(*command, *arguments);
  command->add_flag("--json", arguments->json, "Print JSON instead of a table");
  command->footer(modes_footer);
  command->callback([=, &exit_code] { exit_code = run_modes(*arguments); });
}

}  // namespace sunder
