// SPDX-License-Identifier: MIT
// The command line of `sunder export`, and OBJ.
#include "apps/sunder/export/export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <memory>

#include "apps/scene/json_text.hpp"
#include "apps/scene/words.hpp"
#include "apps/sunder/export/glb.hpp"
#include "apps/sunder/export/obstacle_tracks.hpp"
#include "apps/sunder/program.hpp"
#include "topology/base/counted.hpp"
#include "topology/io/files/output_file.hpp"
#include "topology/io/files/printing.hpp"
#include "topology/io/mesh_file.hpp"

namespace sunder {
namespace {

constexpr const char* export_footer = R"(
The ending of OUT chooses the format:
  .glb  glTF 2.0: one node per piece, moved by its rigid reference with one key per frame; materials
        for the body's own surface, cracks and obstacles; mass (kg) and birth_step as extras of each
        piece; one node per obstacle, except planes
  .obj  OUT_000000.obj and so on, one per frame: the pieces at the end of the run, one object each, at
        the place of their rigid references in that frame
  .msh  Gmsh MSH 4.1: the broken bodies at the end, deformed, with the columns of the last frame
The run needs frames: --frames of `sunder run`, or output.frames of its scene. With
output.frames_at_impacts tracks have a key at each impact.

Exit codes: 0 done, 2 usage, 3 no result of a run, 4 not written.

Examples:
  sunder run meshes/scenes/monolith.json -o out/monolith
  sunder export out/monolith monolith.glb
  sunder export out/monolith film/monolith.obj
  sunder export out/monolith broken.msh
)";

struct ExportArguments : Telling {
  std::filesystem::path result, out;
};

std::string obj_text(const std::vector<PieceTrack>& tracks, std::size_t frame) {
  std::string text = "# sunder export, m, z up\n";
  std::size_t first = 1;
  for (const PieceTrack& track : tracks) {
    fmt::format_to(std::back_inserter(text), "o {}\n", track.name);
    for (const Vec3& v : track.vertex) {
      const Vec3 x = track.orientation[frame] * v + track.centre[frame];
      fmt::format_to(std::back_inserter(text), "v {} {} {}\n", x[0], x[1], x[2]);
    }
    for (const auto& [triangles, material] :
         {std::pair{&track.outer, track.is_obstacle ? "obstacle" : "outside"},
          std::pair{&track.crack, "crack"}}) {
      if (!triangles->empty()) {
        fmt::format_to(std::back_inserter(text), "usemtl {}\n", material);
      }
      for (const auto& t : *triangles) {
        fmt::format_to(std::back_inserter(text), "f {} {} {}\n", first + t[0], first + t[1],
                       first + t[2]);
      }
    }
    first += track.vertex.size();
  }
  return text;
}

std::optional<Finding> write_obj(const std::filesystem::path& out,
                                 const std::vector<PieceTrack>& tracks, std::size_t frames) {
  for (std::size_t k = 0; k < frames; ++k) {
    const std::string name = fmt::format("{}_{:06}.obj", out.stem().string(), k);
    if (auto finding = write_file(out.parent_path() / name, obj_text(tracks, k))) return finding;
  }
  return std::nullopt;
}

ExitCode write_broken(const ExportArguments& arguments, const ResultFrame& last, Stages& stages) {
  const Result<FileMesh> mesh = read_file_mesh(last.file, {.simplices = true});
  std::vector<Finding> findings = mesh.findings;
  if (mesh) {
    for (Finding& f : write_file_mesh(arguments.out, *mesh)) findings.push_back(std::move(f));
  }
  tell(findings, arguments);
  if (has_error(findings)) return mesh ? ExitCode::not_written : ExitCode::bad_input;
  stages.done(fmt::format("wrote {}", arguments.out.string()));
  if (arguments.json) {
    print_json(nlohmann::ordered_json{{"written", arguments.out.string()},
                                      {"tetrahedra", last.tetrahedra.size()},
                                      {"points", last.position.size()},
                                      {"time", last.time},
                                      {"findings", findings_json(findings)}});
    return ExitCode::fine;
  }
  print("{}, {} at {:.6g} s\n", counted_tetrahedra(last.tetrahedra.size()),
        counted(last.position.size(), "point"), last.time);
  return ExitCode::fine;
}

ExitCode export_result(const ExportArguments& arguments) {
  const std::string ending = arguments.out.extension().string();
  if (ending != ".glb" && ending != ".obj" && ending != ".msh") {
    print(stderr, "sunder export: {} ends neither in .glb nor in .obj nor in .msh\n",
          arguments.out.string());
    return ExitCode::usage;
  }
  Stages stages(arguments);
  const Result<RunResult> run = read_run_result(arguments.result);
  tell(run.findings, arguments);
  if (!run) return ExitCode::bad_input;
  stages.done(fmt::format("read {}, frames: {}", arguments.result.string(), run->frames.size()));
  if (ending == ".msh") return write_broken(arguments, run->frames.back(), stages);
  std::vector<PieceTrack> tracks = piece_tracks(run->frames);
  const std::size_t pieces = tracks.size();
  std::ranges::move(obstacle_tracks(run->frames), std::back_inserter(tracks));
  stages.done(fmt::format("followed the pieces: {}", pieces));
  std::optional<Finding> finding;
  if (ending == ".glb") {
    std::vector<double> times;
    for (const ResultFrame& frame : run->frames) times.push_back(frame.time);
    finding = write_file(arguments.out, glb_bytes(tracks, times, run->pieces));
  } else {
    finding = write_obj(arguments.out, tracks, run->frames.size());
  }
  if (finding) {
    tell({*finding}, arguments);
    return ExitCode::not_written;
  }
  stages.done(fmt::format("wrote {}", arguments.out.string()));
  double departure = 0;
  for (const PieceTrack& track : tracks) departure = std::max(departure, track.departure);
  if (arguments.json) {
    print_json(nlohmann::ordered_json{{"written", arguments.out.string()},
                                      {"pieces", pieces},
                                      {"frames", run->frames.size()},
                                      {"largest_departure", departure},
                                      {"findings", findings_json(run.findings)}});
    return ExitCode::fine;
  }
  print("{}, {}; tracks within {:.1e} m of the rigid references\n", counted(pieces, "piece"),
        counted(run->frames.size(), "frame"), departure);
  return ExitCode::fine;
}

}  // namespace

void add_export_command(CLI::App& program, ExitCode& exit_code) {
  const auto arguments = std::make_shared<ExportArguments>();
  CLI::App* command = program.add_subcommand(
      "export", "Write a finished run as GLB or OBJ sequence, or its end as MSH");
  command->add_option("RESULT", arguments->result, "Folder of a run")->required();
  command->add_option("OUT", arguments->out, "File to write: *.glb, *.obj or *.msh")->required();
  add_telling_flags(*command, *arguments);
  command->add_flag("--json", arguments->json, "Print JSON instead of a line");
  command->footer(export_footer);
  command->callback([arguments, &exit_code] { exit_code = export_result(*arguments); });
}

}  // namespace sunder
