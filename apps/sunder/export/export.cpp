// SPDX-License-Identifier: MIT
// The command line of `sunder export`, and OBJ.
#include "apps/sunder/export/export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <memory>

#include "apps/scene/words.hpp"
#include "apps/sunder/export/glb.hpp"
#include "topology/io/output_file.hpp"

namespace sunder {
namespace {

constexpr const char* footer = R"(
OUT decides by its ending:
  .glb  glTF 2.0: a node a piece, moved by its rigid reference with a key a frame; materials for the
        body's own surface and for cracks; mass (kg) and birth_step as extras of each node
  .obj  OUT_000000.obj and so on, one a frame: the pieces at the end of the run, an object each, where
        their rigid references are in that frame
The run needs frames: --frames of `sunder run`, or output.frames of its scene.

Exit codes: 0 done, 2 usage, 3 no result of a run, 4 not written.

Examples:
  sunder run meshes/scenes/monolith.json -o out/monolith
  sunder export out/monolith monolith.glb
  sunder export out/monolith film/monolith.obj
)";

struct ExportArguments {
  std::filesystem::path result, out;
};

std::string obj_text(const std::vector<PieceTrack>& tracks, std::size_t frame) {
  std::string text = "# sunder export, m, z up\n";
  std::size_t first = 1;
  for (const PieceTrack& track : tracks) {
    fmt::format_to(std::back_inserter(text), "o piece_{}\n", track.component);
    for (const Vec3& v : track.vertex) {
      const Vec3 x = track.orientation[frame] * v + track.centre[frame];
      fmt::format_to(std::back_inserter(text), "v {} {} {}\n", x[0], x[1], x[2]);
    }
    for (const auto& [triangles, material] :
         {std::pair{&track.outer, "outside"}, std::pair{&track.crack, "crack"}}) {
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

ExitCode export_result(const ExportArguments& arguments) {
  const std::string ending = arguments.out.extension().string();
  if (ending != ".glb" && ending != ".obj") {
    fmt::print(stderr, "sunder export: {} ends neither in .glb nor in .obj\n",
               arguments.out.string());
    return ExitCode::usage;
  }
  const Result<RunResult> run = read_run_result(arguments.result);
  fmt::print(stderr, "{}", finding_lines(run.findings));
  if (!run) return ExitCode::bad_input;
  const std::vector<PieceTrack> tracks = piece_tracks(run->frames);
  std::optional<Finding> finding;
  if (ending == ".glb") {
    std::vector<double> times;
    for (const ResultFrame& frame : run->frames) times.push_back(frame.time);
    finding = write_file(arguments.out, glb_bytes(tracks, times, run->pieces));
  } else {
    finding = write_obj(arguments.out, tracks, run->frames.size());
  }
  if (finding) {
    fmt::print(stderr, "{}", finding_lines({*finding}));
    return ExitCode::not_written;
  }
  double departure = 0;
  for (const PieceTrack& track : tracks) departure = std::max(departure, track.departure);
  fmt::print("{} pieces, {} frames; tracks within {:.1e} m of the rigid references\n",
             tracks.size(), run->frames.size(), departure);
  return ExitCode::fine;
}

}  // namespace

void add_export_command(CLI::App& program, ExitCode& exit_code) {
  const auto arguments = std::make_shared<ExportArguments>();
  CLI::App* command =
      program.add_subcommand("export", "Writes a finished run as GLB or as a sequence of OBJ");
  command->add_option("RESULT", arguments->result, "Folder of a run")->required();
  command->add_option("OUT", arguments->out, "File to write: *.glb or *.obj")->required();
  command->footer(footer);
  command->callback([arguments, &exit_code] { exit_code = export_result(*arguments); });
}

}  // namespace sunder
