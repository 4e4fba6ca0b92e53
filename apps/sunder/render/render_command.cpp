// SPDX-License-Identifier: MIT
// The command line of `sunder render`.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <memory>

#include "apps/sunder/program.hpp"
#include "apps/sunder/render/render.hpp"
#include "topology/io/files/printing.hpp"

namespace sunder {
namespace {

constexpr const char* render_footer = R"(
RESULT is the folder of a run with frames (--frames of `sunder run`, or output.frames of its scene).
Without --eye and --target the camera sees the bodies as they started, and the ground below them. That
of a film sees too where the large pieces come to.
The ending of PICTURE chooses between a picture (.png) and a film of every frame (.mp4, .webm, .gif),
which ffmpeg encodes. Where it is not installed the film's pictures are kept, with exit code 4.

Exit codes: 0 done, 2 usage, 3 no result of a run, 4 not written, 130 interrupted by Ctrl-C.

Examples:
  sunder run meshes/scenes/monolith.json -o out/monolith
  sunder render out/monolith end.png
  sunder render out/monolith pieces.png --explode 0.6
  sunder render out/monolith bent.png --show both --magnify 100
  sunder render out/monolith close.png --time 0.05 --eye 1,-2,1.5 --target 0,0,0.8 --fov 40
  sunder render out/monolith monolith.mp4 --slower 20
  sunder render out/monolith pictures/monolith.png --all
)";

ExitCode usage(const std::string& text) {
  print(stderr, "sunder render: {}\n", text);
  return ExitCode::usage;
}

ExitCode render_checked(const RenderArguments& a, bool has_rate) {
  const bool films = is_film(a.out);
  if (a.out.extension() != ".png" && !films) {
    return usage(a.out.string() + " does not end in .png, nor in .mp4, .webm or .gif of a film");
  }
  if (a.eye.empty() != a.target.empty()) return usage("--eye and --target go together");
  if (a.all && !std::isnan(a.time)) return usage("--all draws every frame: leave out --time");
  if (films && (a.all || !std::isnan(a.time))) {
    return usage("a film has every frame: leave out --all and --time");
  }
  if (!films && (has_rate || a.speed.slower)) {
    return usage("--rate and --slower go with a film: .mp4, .webm or .gif");
  }
  const Rendered rendered = render_result(a);
  if (rendered.film && !a.json) print("{} {}\n", a.out.string(), film_words(*rendered.film));
  return rendered.code;
}

}  // namespace

void add_render_command(CLI::App& program, ExitCode& exit_code) {
  const auto a = std::make_shared<RenderArguments>();
  CLI::App* command = program.add_subcommand("render", "Draw pictures or a film of a finished run");
  command->add_option("RESULT", a->result, "Folder of a run")->required();
  command->add_option("PICTURE", a->out, "File to write: *.png, or a film: *.mp4, *.webm, *.gif")
      ->required();
  command->add_option("--time", a->time,
                      "Draw the frame nearest to this time, s; default: the last");
  command->add_flag("--all", a->all, "Draw every frame: PICTURE_000000.png and so on");
  command->add_option("--show", a->show, "Draw this shape: reference, deformed or both")
      ->transform(CLI::CheckedTransformer(
                      std::map<std::string, ShownShape>{{"reference", ShownShape::reference},
                                                        {"deformed", ShownShape::deformed},
                                                        {"both", ShownShape::both}})
                      .description(""))
      ->type_name("reference|deformed|both");
  command
      ->add_option(
          "--explode", a->explode,
          "Exploded view: move each piece outward by this factor of its distance from the centre")
      ->check(CLI::Range(0.0, 100.0));
  command->add_option("--magnify", a->magnify, "Scale displayed deformations by this factor")
      ->check(CLI::Range(0.0, 1e6));
  command->add_option("--eye", a->eye, "Position of the camera, m: X,Y,Z")
      ->expected(3)
      ->delimiter(',');
  command->add_option("--target", a->target, "Point in the middle of the picture, m: X,Y,Z")
      ->expected(3)
      ->delimiter(',');
  command->add_option("--fov", a->field_of_view, "With --eye: vertical angle of view, degrees")
      ->check(CLI::Range(1.0, 170.0))
      ->capture_default_str();
  command->add_option("--size", a->size, "Pixels: WIDTH,HEIGHT")
      ->expected(2)
      ->delimiter(',')
      ->check(CLI::Range(16u, 8192u))
      ->capture_default_str();
  CLI::Option* rate = command->add_option("--rate", a->speed.rate, "Pictures per second of film")
                          ->type_name("N")
                          ->check(CLI::Range(1.0, 240.0))
                          ->capture_default_str();
  command
      ->add_option("--slower", a->speed.slower,
                   "Times that a film is slower than life (default: each frame is shown once)")
      ->type_name("FACTOR")
      ->check(CLI::Range(1e-6, 1e9));
  add_telling_flags(*command, *a);
  command->add_flag("--json", a->json, "Print JSON instead of one line per file");
  command->footer(render_footer);
  command->callback([a, rate, &exit_code] { exit_code = render_checked(*a, rate->count() > 0); });
}

}  // namespace sunder
