// SPDX-License-Identifier: MIT
// The command line of `sunder render`.
#include "apps/sunder/render/render.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <optional>

#include "apps/render/image.hpp"
#include "apps/render/renderer.hpp"
#include "apps/scene/json_text.hpp"
#include "apps/scene/words.hpp"
#include "apps/sunder/program.hpp"
#include "apps/sunder/render/result_picture.hpp"
#include "topology/io/files/output_file.hpp"
#include "topology/io/files/printing.hpp"

namespace sunder {
namespace {

constexpr const char* render_footer = R"(
RESULT is the folder of a run with frames (--frames of `sunder run`, or output.frames of its scene).
Without --eye and --target the camera sees the bodies as they started, and the ground below them.

Exit codes: 0 done, 2 usage, 3 no result of a run, 4 not written.

Examples:
  sunder run meshes/scenes/monolith.json -o out/monolith
  sunder render out/monolith end.png
  sunder render out/monolith pieces.png --explode 0.6
  sunder render out/monolith bent.png --show both --magnify 100
  sunder render out/monolith close.png --time 0.05 --eye 1,-2,1.5 --target 0,0,0.8 --fov 40
  sunder render out/monolith film/monolith.png --all
)";

struct RenderArguments : Telling {
  std::filesystem::path result, out;
  double time = std::numeric_limits<double>::quiet_NaN();
  double explode = 0, magnify = 1, field_of_view = 35;
  std::vector<double> eye, target;
  std::vector<std::uint32_t> size = {1280, 720};
  ShownShape show = ShownShape::reference;
  bool all = false;
};

std::size_t nearest_frame(const RunResult& run, double time) {
  if (std::isnan(time)) return run.frames.size() - 1;
  std::size_t nearest = 0;
  for (std::size_t k = 0; k < run.frames.size(); ++k) {
    if (std::abs(run.frames[k].time - time) < std::abs(run.frames[nearest].time - time))
      nearest = k;
  }
  return nearest;
}

PictureSettings settings_of(const RenderArguments& a) {
  PictureSettings settings;
  settings.width = a.size[0];
  settings.height = a.size[1];
  settings.show = a.show;
  if (!a.eye.empty()) {
    settings.camera = {.eye = Vec3(a.eye[0], a.eye[1], a.eye[2]),
                       .target = Vec3(a.target[0], a.target[1], a.target[2]),
                       .field_of_view = a.field_of_view};
  }
  return settings;
}

/// Deformations as many times as large.
void magnify(PictureBodies& bodies, double factor) {
  for (std::size_t v = 0; v < bodies.deformed.size(); ++v) {
    bodies.deformed[v] = bodies.reference[v] + factor * (bodies.deformed[v] - bodies.reference[v]);
  }
}

/// Draws the frames from `first` to before `end`, and tells each: as a line, or in `pictures`.
std::vector<Finding> draw(const RenderArguments& a, const RunResult& run,
                          render::Renderer& renderer, std::size_t first, std::size_t end,
                          nlohmann::ordered_json& pictures) {
  const Vec3 up = run.gravity.norm() > 0 ? Vec3(-run.gravity.normalized()) : Vec3::UnitZ();
  const std::vector<char> boundary = boundary_of(run.frames.front());
  const PictureSettings settings = settings_of(a);
  // A view of pieces that are drawn apart must see all of them.
  const ResultFrame& seen = a.explode > 0 ? run.frames[end - 1] : run.frames.front();
  const FramePicture start = frame_picture(seen, boundary, a.explode, up);
  const RunView view = run_view(start.bodies, seen.obstacles, settings, run.gravity);
  for (std::size_t k = first; k < end; ++k) {
    FramePicture picture = frame_picture(run.frames[k], boundary, a.explode, up);
    magnify(picture.bodies, a.magnify);
    const render::FrameScene scene =
        picture_scene(picture.bodies, run.frames[k].obstacles, a.show, view.extent);
    Result<render::Image> image = renderer.render(scene, view.camera, static_cast<int>(a.size[0]),
                                                  static_cast<int>(a.size[1]));
    if (!image) return std::move(image.findings);
    std::filesystem::path path = a.out;
    if (a.all) path.replace_filename(fmt::format("{}_{:06}.png", a.out.stem().string(), k));
    if (auto finding = make_folder_of(path)) return {*finding};
    if (std::vector<Finding> findings = render::write_png(path, *image); has_error(findings)) {
      return findings;
    }
    pictures.push_back({{"file", path.string()}, {"time", run.frames[k].time}});
    if (!a.json) print("{} {:.6g} s\n", path.string(), run.frames[k].time);
  }
  return {};
}

ExitCode usage(const std::string& text) {
  print(stderr, "sunder render: {}\n", text);
  return ExitCode::usage;
}

ExitCode render_result(const RenderArguments& a) {
  if (a.out.extension() != ".png") return usage(a.out.string() + " does not end in .png");
  if (a.eye.empty() != a.target.empty()) return usage("--eye and --target go together");
  if (a.all && !std::isnan(a.time)) return usage("--all draws every frame: leave out --time");
  Stages stages(a);
  const Result<RunResult> run = read_run_result(a.result);
  tell(run.findings, a);
  if (!run) return ExitCode::bad_input;
  stages.done(fmt::format("read {}, frames: {}", a.result.string(), run->frames.size()));
  Result<render::Renderer> renderer = render::Renderer::offscreen();
  tell(renderer.findings, a);
  if (!renderer) return ExitCode::failed;
  stages.done("made the renderer");
  const std::size_t frames = run->frames.size(), one = nearest_frame(*run, a.time);
  nlohmann::ordered_json pictures = nlohmann::ordered_json::array();
  const std::vector<Finding> findings =
      draw(a, *run, *renderer, a.all ? 0 : one, a.all ? frames : one + 1, pictures);
  tell(findings, a);
  if (has_error(findings)) return ExitCode::not_written;
  stages.done(fmt::format("drew the pictures: {}", pictures.size()));
  if (a.json) {
    const nlohmann::ordered_json answer{{"pictures", pictures},
                                        {"findings", findings_json(run.findings)}};
    print_json(answer);
  }
  return ExitCode::fine;
}

}  // namespace

void add_render_command(CLI::App& program, ExitCode& exit_code) {
  const auto a = std::make_shared<RenderArguments>();
  CLI::App* command = program.add_subcommand("render", "Draw pictures of a finished run");
  command->add_option("RESULT", a->result, "Folder of a run")->required();
  command->add_option("PICTURE", a->out, "File to write: *.png")->required();
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
  add_telling_flags(*command, *a);
  command->add_flag("--json", a->json, "Print JSON instead of one line per picture");
  command->footer(render_footer);
  command->callback([a, &exit_code] { exit_code = render_result(*a); });
}

}  // namespace sunder
