// SPDX-License-Identifier: MIT
// Read the object, fill it, write the scene, run it, tell the outcome.
#include "apps/sunder/break/break_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "apps/scene/reading/length_unit.hpp"
#include "apps/sunder/break/blow.hpp"
#include "apps/sunder/break/fill.hpp"
#include "apps/sunder/break/outcome.hpp"
#include "apps/sunder/break/thing.hpp"
#include "apps/sunder/fragments/fragment_sizes.hpp"
#include "apps/sunder/materials/materials.hpp"
#include "apps/sunder/program.hpp"
#include "apps/sunder/run/run.hpp"
#include "topology/base/counted.hpp"
#include "topology/io/files/output_file.hpp"
#include "topology/io/files/printing.hpp"
#include "topology/io/mesh_file.hpp"

namespace sunder {
namespace {

namespace fs = std::filesystem;

constexpr const char* break_footer = R"(
THING is a closed surface (STL, OBJ, PLY, OFF and others) or a mesh of tetrahedra, in any format of
`sunder convert --formats`. A surface is checked and filled with tetrahedra by a mesher that is
installed: tetgen, gmsh or sunder-mesh. Each runs as a process of its own, for three minutes at most.
Lengths are numbers with a unit: 95mm, 3.5cm, 0.2m, 4in. Speeds are 20m/s or 30km/h.
Without --size and --units a longest side above 3 is taken as millimetres, else as metres.
The object is set down on the ground. One of --drop, --throw, --ball, --press and --bend breaks it.
The default is a drop from 1 m. A dropped object is tilted, since few things land flat.
DIR holds the scene and the mesh in metres, which you can change and run again, and DIR/run the files
of `sunder run`. An existing scene or mesh with other contents is replaced with --force only.
A large piece has a hundredth of the mass or more (docs/howto/break_an_object.md).

Exit codes: 0 done, 2 usage, 3 the object cannot be read or filled, 4 not written, 5 the simulation
failed, 130 interrupted by Ctrl-C.

Examples:
  sunder break mug.stl --material porcelain --drop 1m
  sunder break vase.obj --size 30cm --up y --ball 50mm@20m/s --tetrahedra 20000
  sunder break brick.msh --material brick --press --speed 0.2m/s
)";

struct BreakArguments : Telling {
  fs::path thing, folder;
  std::string material = "ceramic", units, size, cell, mesher, drop, hurl, ball, speed;
  UpAxis up = UpAxis::z;
  double tetrahedra = 5000;
  double tilt = 20;
  BreakTimes times;
  bool press = false, bend = false, scene_only = false, force = false;
};

Blow blow_of(const BreakArguments& a) {
  Blow blow;
  if (!a.speed.empty()) blow.speed = *speed_of(a.speed);
  if (!a.drop.empty()) blow.height = *length_of(a.drop);
  if (!a.hurl.empty()) {
    blow.kind = BlowKind::hurl;
    blow.speed = *speed_of(a.hurl);
  } else if (!a.ball.empty()) {
    blow.kind = BlowKind::strike;
    blow.ball = *ball_of(a.ball);
  } else if (a.press) {
    blow.kind = BlowKind::press;
  } else if (a.bend) {
    blow.kind = BlowKind::bend;
  } else {
    blow.tilt = a.tilt;
  }
  return blow;
}

/// A name for files: the thing's without its endings.
std::string name_of(const fs::path& thing) {
  std::string name = thing.filename().string();
  if (name.ends_with(".gz")) name.resize(name.size() - 3);
  name = fs::path(name).stem().string();
  return name.empty() || name == "." || name == ".." || name == "-" ? "thing" : name;
}

/// The tetrahedra of the thing in metres, on the ground; nothing after an error.
std::optional<TetMesh> mesh_of(const BreakArguments& a) {
  Result<Thing> thing = read_thing(a.thing);
  tell(thing.findings, a);
  if (!thing) return std::nullopt;
  std::optional<double> size;
  if (!a.size.empty()) size = length_of(a.size);
  const ThingScale scale = scale_of(*thing, size, a.units, a.thing.string());
  if (scale.guess) tell({*scale.guess}, a);
  TetMesh mesh;
  if (thing->is_solid()) {
    mesh = std::move(thing->solid);
    remark(fmt::format("{} has {}\n", a.thing.string(),
                       counted(mesh.tetrahedra.size(), "tetrahedron", "tetrahedra")),
           a);
  } else {
    double wanted = a.tetrahedra;
    if (!a.cell.empty() && thing->volume > 0) {
      const double cell = *length_of(a.cell) / scale.metres;
      wanted = std::max(1.0, 6 * thing->volume / (cell * cell * cell));
    }
    Result<Filled> filled = fill(*thing, wanted, a.mesher);
    for (Finding& f : filled.findings) f.file = a.thing.string();
    tell(filled.findings, a);
    if (!filled) return std::nullopt;
    mesh = std::move(filled->mesh);
    remark(fmt::format("{} filled it with {}, volume {:+.2g} %\n", filled->mesher,
                       counted(mesh.tetrahedra.size(), "tetrahedron", "tetrahedra"),
                       100 * filled->volume_error),
           a);
  }
  set_down(mesh, scale.metres, a.up);
  return mesh;
}

/// Whether a file is there with other contents.
bool differs(const fs::path& path, std::string_view text) {
  if (!file_exists(path)) return false;
  std::ifstream in(path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(in), {}) != text;
}

/// Writes scene and mesh. Nothing of the user's is replaced without --force.
std::optional<Finding> write_scene(const BreakArguments& a, const fs::path& scene,
                                   const std::string& text, const fs::path& file,
                                   const TetMesh& mesh) {
  const fs::path beside = fs::path(file).replace_extension(".new.msh");
  if (auto fault = make_folder(a.folder)) return fault;
  for (Finding& f : write_mesh(beside, mesh)) {
    if (f.severity == Severity::error) return f;
  }
  std::ifstream in(beside, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(in), {});
  in.close();
  std::error_code none;
  fs::remove(beside, none);
  for (const auto& [path, content] : {std::pair{file, &bytes}, std::pair{scene, &text}}) {
    if (!a.force && differs(path, *content)) {
      return Finding{.code = "in_the_way",
                     .text = fmt::format("{} is there with other contents", path.string()),
                     .remedy = "give another folder with -o, or replace it with --force",
                     .file = path.string()};
    }
  }
  if (auto fault = write_file(file, bytes)) return fault;
  return write_file(scene, text);
}

std::size_t line_count(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return static_cast<std::size_t>(
      std::count(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>(), '\n'));
}

/// The sentence about a finished run and the places of its files.
ExitCode tell_outcome(const BreakArguments& a, const fs::path& scene, const fs::path& run) {
  const Result<PieceColumns> pieces = read_fragments(run / "fragments.csv");
  tell(pieces.findings, a);
  if (!pieces) return ExitCode::failed;
  const std::size_t cracks =
      line_count(run / "cracks.csv");  // its first line has the names of columns
  print("\n{}\n", outcome_sentence(pieces->mass, cracks > 0 ? cracks - 1 : 0));
  print("Scene     {}\n", shell_word(scene.string()));
#if defined(SUNDER_HAS_RENDERER)
  print("Pictures  {}\n", shell_word((run / "picture_005.png").string()));
#else
  print("Frames    {}\n", shell_word((run / "frames.pvd").string()));
#endif
  return ExitCode::fine;
}

ExitCode break_thing(BreakArguments a) {
  const std::string name = name_of(a.thing);
  if (a.folder.empty()) a.folder = fs::path("out") / name;
  const std::optional<TetMesh> mesh = mesh_of(a);
  if (!mesh) return ExitCode::bad_input;
  const fs::path file = a.folder / (name + ".msh"), scene = a.folder / (name + ".json");
#if defined(SUNDER_HAS_RENDERER)
  constexpr bool with_pictures = true;
#else
  constexpr bool with_pictures = false;
#endif
  const Blow blow = blow_of(a);
  const nlohmann::ordered_json json =
      break_scene({name, file.filename().string(), *mesh, *find_material(a.material)}, blow,
                  a.times, with_pictures);
  if (const auto fault = write_scene(a, scene, json_text(json) + "\n", file, *mesh)) {
    tell({*fault}, a);
    return ExitCode::not_written;
  }
  remark(fmt::format("{} of {} is {}\n", name, a.material, blow_words(blow)), a);
  if (a.scene_only) {
    print("{} run {}\n", program_word(), shell_word(scene.string()));
    return ExitCode::fine;
  }
  RunArguments run{a};
  run.scene = scene;
  run.folder = a.folder / "run";
  run.force = true;
  const ExitCode code = run_scene(run);
  return code == ExitCode::fine ? tell_outcome(a, scene, run.folder) : code;
}

std::string check_material(const std::string& name) {
  if (find_material(name) != nullptr) return {};
  const Finding f = unknown_material(name);
  return fmt::format("{}; {}", f.text, f.remedy);
}

void add_object_options(CLI::App& command, BreakArguments& a) {
  command.add_option("THING", a.thing, "File of a closed surface or of tetrahedra")
      ->type_name("FILE")
      ->required();
  command
      .add_option("-o,--output", a.folder, "Folder for the files (default: out/ and THING's name)")
      ->type_name("DIR");
  command.add_option("--material", a.material, "Material; `sunder materials` lists them")
      ->type_name("NAME")
      ->capture_default_str()
      ->check(check_material);
  CLI::Option* size = command.add_option("--size", a.size, "Longest side of the object: scales it")
                          ->type_name("LENGTH")
                          ->check(check_length);
  std::vector<std::string> units;
  for (const LengthUnitTraits& unit : length_units) units.emplace_back(unit.name);
  command.add_option("--units", a.units, "Unit of THING's coordinates")
      ->type_name("m|cm|mm|um|in|ft")
      ->check(CLI::IsMember(units))
      ->excludes(size);
  const std::map<std::string, UpAxis> axes{{"x", UpAxis::x}, {"-x", UpAxis::minus_x},
                                           {"y", UpAxis::y}, {"-y", UpAxis::minus_y},
                                           {"z", UpAxis::z}, {"-z", UpAxis::minus_z}};
  command.add_option("--up", a.up, "Axis of THING that points up (default: z)")
      ->transform(CLI::CheckedTransformer(axes).description(""))
      ->type_name("x|y|z|-x|-y|-z");
  CLI::Option* number =
      command.add_option("--tetrahedra", a.tetrahedra, "Number of tetrahedra to come near to")
          ->type_name("N")
          ->capture_default_str()
          ->check(CLI::Range(1.0, 1e7));
  command
      .add_option("--cell", a.cell,
                  "Size of cells in place of their number: the edge of a cube of six")
      ->type_name("LENGTH")
      ->check(check_length)
      ->excludes(number);
  command
      .add_option("--mesher", a.mesher,
                  "Mesher to take (default: the first installed that succeeds)")
      ->type_name("NAME")
      ->check(CLI::IsMember(known_meshers()));
}

void add_blow_options(CLI::App& command, BreakArguments& a) {
  std::vector<CLI::Option*> blows = {
      command.add_option("--drop", a.drop, "Drop it from this height (default: 1 m)")
          ->type_name("HEIGHT")
          ->check(check_length),
      command.add_option("--throw", a.hurl, "Throw it at a wall with this speed")
          ->type_name("SPEED")
          ->check(check_speed),
      command
          .add_option("--ball", a.ball, "Strike it with a steel ball of this diameter and speed")
          ->type_name("DIAMETER@SPEED")
          ->check(check_ball),
      command.add_flag("--press", a.press, "Press it between ground and a plate"),
      command.add_flag("--bend", a.bend,
                       "Hold both ends of its longest side and drive the middle")};
  for (std::size_t i = 0; i < blows.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) blows[i]->excludes(blows[j]);
  }
  command.add_option("--speed", a.speed, "Speed of --press and --bend (default: 0.5 m/s)")
      ->type_name("SPEED")
      ->check(check_speed);
  command.add_option("--tilt", a.tilt, "Tilt of a dropped object about x, degrees")
      ->type_name("DEGREES")
      ->capture_default_str()
      ->check(CLI::Range(-180.0, 180.0));
  command
      .add_option("--time-step", a.times.step,
                  "Step of the run, s (default: chosen from the duration)")
      ->type_name("SECONDS")
      ->check(CLI::PositiveNumber);
  command
      .add_option("--duration", a.times.duration,
                  "Length of the run, s (default: chosen from the blow)")
      ->type_name("SECONDS")
      ->check(CLI::PositiveNumber);
}

}  // namespace

void add_break_command(CLI::App& program, ExitCode& exit_code) {
  CLI::App* command = program.add_subcommand(
      "break", "Break any object of a file: fill, drop or strike, and run it");
  const auto arguments = std::make_shared<BreakArguments>();
  add_object_options(*command, *arguments);
  add_blow_options(*command, *arguments);
  command->add_flag("--scene-only", arguments->scene_only,
                    "Write scene and mesh, and do not run them");
  command->add_flag("--force", arguments->force, "Replace a scene or mesh with other contents");
  add_telling_flags(*command, *arguments);
  command->footer(break_footer);
  command->callback([=, &exit_code] {
    if (!arguments->speed.empty() && !arguments->press && !arguments->bend) {
      throw CLI::ValidationError("--speed", "goes with --press or --bend");
    }
    exit_code = break_thing(*arguments);
  });
}

}  // namespace sunder
