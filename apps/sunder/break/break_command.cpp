// SPDX-License-Identifier: MIT
// The command line of `sunder break`.
#include "apps/sunder/break/break_command.hpp"

#include <fmt/format.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "apps/scene/reading/length_unit.hpp"
#include "apps/sunder/break/break_object.hpp"
#include "apps/sunder/break/fill.hpp"
#include "apps/sunder/materials/materials.hpp"

namespace sunder {
namespace {

constexpr const char* break_footer = R"(
THING is a closed surface (STL, OBJ, PLY, OFF and others) or a mesh of tetrahedra, in any format of
`sunder convert --formats`. A surface is checked and filled with tetrahedra by a mesher that is
installed: tetgen, gmsh or sunder-mesh. Each runs as a process of its own, for three minutes at most.
Faults of a surface are repaired, and each repair is reported. sunder-repair, a program of its own,
joins shells that overlap, and wraps surfaces that no other repair closes.
Lengths are numbers with a unit: 95mm, 3.5cm, 0.2m, 4in. Speeds are 20m/s or 30km/h.
Without --size and --units a longest side above 3 is taken as millimetres, else as metres.
The object is set down on the ground. One of --drop, --throw, --ball, --press and --bend breaks it.
The default is a drop from 1 m. A dropped object is tilted, since few things land flat.
DIR holds the scene and the mesh in metres, which you can change and run again, and DIR/run the files
of `sunder run`. An existing scene or mesh with other contents is replaced with --force only.
The film shows each step once, 25 in a second. Without ffmpeg, which encodes it, its pictures are kept.
A large piece has a hundredth of the mass or more (docs/howto/break_an_object.md).

Exit codes: 0 done, 2 usage, 3 the object cannot be read or filled, 4 not written, 5 the simulation
failed, 130 interrupted by Ctrl-C.

Examples:
  sunder break mug.stl --material porcelain --drop 1m
  sunder break vase.obj --size 30cm --up y --ball 50mm@20m/s --tetrahedra 20000
  sunder break brick.msh --material brick --press --speed 0.2m/s
  sunder break statue.ply --size 40cm --time-budget 2min
)";

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
  const std::map<std::string, Mending> mendings{
      {"none", Mending::none}, {"small", Mending::small}, {"wrap", Mending::wrap}};
  command
      .add_option("--repair", a.mending,
                  "Repair of a surface. none: refuse every fault; small (default): seams, doubled "
                  "and turned faces, small holes, overlapping shells; wrap: also close all holes")
      ->transform(CLI::CheckedTransformer(mendings).description(""))
      ->type_name("none|small|wrap");
  CLI::Option* number =
      command.add_option("--tetrahedra", a.tetrahedra, "Number of tetrahedra to come near to")
          ->type_name("N")
          ->capture_default_str()
          ->check(CLI::Range(1.0, 1e7));
  CLI::Option* cell =
      command
          .add_option("--cell", a.cell,
                      "Size of cells in place of their number: the edge of a cube of six")
          ->type_name("LENGTH")
          ->check(check_length)
          ->excludes(number);
  command
      .add_option("--time-budget", a.budget,
                  "Time that the whole command may take: chooses the number of tetrahedra")
      ->type_name("TIME")
      ->check(check_time)
      ->excludes(number)
      ->excludes(cell);
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
#if defined(SUNDER_HAS_RENDERER)
  command->add_flag("--no-film", arguments->no_film, "Make no film of the run");
#endif
  command->add_flag("--force", arguments->force, "Replace a scene or mesh with other contents");
  add_telling_flags(*command, *arguments);
  command->footer(break_footer);
  command->callback([=, &exit_code] {
    if (!arguments->speed.empty() && !arguments->press && !arguments->bend) {
      throw CLI::ValidationError("--speed", "goes with --press or --bend");
    }
    for (const char* name : {"--tetrahedra", "--cell", "--mesher", "--repair"}) {
      if (command->count(name) > 0) arguments->filling.emplace_back(name);
    }
    exit_code = break_object(*arguments);
  });
}

}  // namespace sunder
