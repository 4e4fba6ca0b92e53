// SPDX-License-Identifier: MIT
// Pictures and films of the frames of a run.
#include "apps/sunder/render/render.hpp"

#include <fmt/format.h>

#include <cmath>

#include "apps/render/image.hpp"
#include "apps/render/renderer.hpp"
#include "apps/scene/json_text.hpp"
#include "apps/scene/words.hpp"
#include "apps/sunder/process/run_process.hpp"
#include "apps/sunder/render/result_picture.hpp"
#include "apps/sunder/run/interrupt.hpp"
#include "apps/sunder/run/progress.hpp"
#include "topology/io/files/output_file.hpp"
#include "topology/io/files/printing.hpp"

namespace sunder {
namespace {

namespace fs = std::filesystem;

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

/// Draws frames of one run, all seen by one camera.
class FramePainter {
 public:
  /// `last`: the row of the last frame drawn, all pieces of which are seen where they are apart.
  FramePainter(const RenderArguments& a, const RunResult& run, render::Renderer& renderer,
               std::size_t last)
      : a_(a),
        run_(run),
        renderer_(renderer),
        up_(run.gravity.norm() > 0 ? Vec3(-run.gravity.normalized()) : Vec3::UnitZ()),
        boundary_(boundary_of(run.frames.front())) {
    const ResultFrame& seen = a.explode > 0 ? run.frames[last] : run.frames.front();
    const FramePicture start = frame_picture(seen, boundary_, a.explode, up_);
    view_ = run_view(start.bodies, seen.obstacles, settings_of(a), run.gravity);
    if (!is_film(a.out)) return;
    // A film sees where its large pieces come to.
    const render::Bounds end = bounds_of_large(run.frames[last], view_.extent);
    view_ = run_view(start.bodies, seen.obstacles, settings_of(a), run.gravity, end);
  }

  /// Writes a frame as a PNG. Errors: those of the renderer, cannot_write.
  std::vector<Finding> paint(std::size_t row, const fs::path& path) {
    const ResultFrame& frame = run_.frames[row];
    FramePicture picture = frame_picture(frame, boundary_, a_.explode, up_);
    magnify(picture.bodies, a_.magnify);
    const render::FrameScene scene =
        picture_scene(picture.bodies, frame.obstacles, a_.show, view_.extent);
    Result<render::Image> image = renderer_.render(
        scene, view_.camera, static_cast<int>(a_.size[0]), static_cast<int>(a_.size[1]));
    if (!image) return std::move(image.findings);
    if (auto finding = make_folder_of(path)) return {*finding};
    return render::write_png(path, *image);
  }

 private:
  const RenderArguments& a_;
  const RunResult& run_;
  render::Renderer& renderer_;
  Vec3 up_;
  std::vector<char> boundary_;
  RunView view_;
};

/// The pictures drawn, as JSON, and the findings about them.
struct Answer {
  nlohmann::ordered_json json;
  std::vector<Finding> findings;
  fs::path kept;  ///< folder of pictures without a film
};

/// One picture, or one per frame.
void draw_pictures(const RenderArguments& a, const RunResult& run, FramePainter& painter,
                   Answer& answer) {
  const std::size_t one = nearest_frame(run, a.time);
  answer.json["pictures"] = nlohmann::ordered_json::array();
  for (std::size_t k = a.all ? 0 : one; k < (a.all ? run.frames.size() : one + 1); ++k) {
    fs::path path = a.out;
    if (a.all) path.replace_filename(fmt::format("{}_{:06}.png", a.out.stem().string(), k));
    std::vector<Finding> findings = painter.paint(k, path);
    if (has_error(findings)) return void(answer.findings = std::move(findings));
    const double time = run.frames[k].time;
    answer.json["pictures"].push_back({{"file", path.string()}, {"time", time}});
    if (!a.json) print("{} {:.6g} s\n", path.string(), time);
  }
}

/// The pictures of a film in a folder. A frame that is seen again is copied.
std::vector<Finding> draw_film_pictures(const FilmPlan& plan, FramePainter& painter,
                                        const fs::path& folder) {
  for (std::size_t k = 0; k < plan.frames.size() && !was_interrupted; ++k) {
    const fs::path path = folder / film_picture_name(k);
    std::error_code failed;
    if (k > 0 && plan.frames[k] == plan.frames[k - 1]) {
      fs::copy_file(folder / film_picture_name(k - 1), path, fs::copy_options::overwrite_existing,
                    failed);
      if (!failed) continue;
    }
    std::vector<Finding> findings = painter.paint(plan.frames[k], path);
    if (has_error(findings)) return findings;
  }
  return {};
}

/// Pictures that no encoder took, in a folder of their own.
std::optional<Finding> keep_pictures(const fs::path& from, const fs::path& folder) {
  if (auto fault = make_folder(folder)) return fault;
  std::error_code failed;
  fs::copy(from, folder, fs::copy_options::overwrite_existing | fs::copy_options::recursive,
           failed);
  if (!failed) return std::nullopt;
  return Finding{.code = "cannot_write",
                 .text = fmt::format("cannot write {}: {}", folder.string(), failed.message()),
                 .remedy = "name a film in a folder that can be written",
                 .file = folder.string()};
}

Finding no_encoder(const RenderArguments& a, const fs::path& pictures) {
  return {.code = "no_encoder",
          .severity = Severity::warning,
          .text = fmt::format("ffmpeg is not installed: the film's pictures are kept in {}",
                              pictures.string()),
          .remedy = fmt::format("install it (Debian: apt-get install ffmpeg), then: {}",
                                encoder_line(pictures, a.out, a.speed.rate)),
          .file = a.out.string()};
}

/// Pictures of a film in a folder, encoded there. Gives whether the film is written.
bool make_film(const RenderArguments& a, FramePainter& painter, const FilmPlan& plan,
               const fs::path& folder, Answer& answer) {
  const auto encoder = find_encoder();
  const Heartbeat heartbeat(a.quiet, line_of_work("drawing the film"));
  answer.findings = draw_film_pictures(plan, painter, folder);
  if (has_error(answer.findings) || was_interrupted) return false;
  const fs::path kept = fs::path(a.out).replace_extension("").concat("_pictures");
  std::optional<Finding> fault =
      encoder ? encode_film(*encoder, folder, a.out, a.speed.rate) : no_encoder(a, kept);
  if (!fault) return true;
  if (was_interrupted) return false;
  answer.findings.push_back(std::move(*fault));
  std::error_code none;
  fs::remove(folder / "printed.txt", none);  // the words of the encoder, which the finding has
  if (auto unkept = keep_pictures(folder, kept)) {
    answer.findings.push_back(std::move(*unkept));
  } else {
    answer.kept = kept;
  }
  return false;
}

Rendered draw_film(const RenderArguments& a, const RunResult& run, FramePainter& painter,
                   Answer& answer) {
  std::vector<double> times;
  for (const ResultFrame& frame : run.frames) times.push_back(frame.time);
  Result<FilmPlan> plan = film_plan(times, a.speed);
  if (!plan) {
    answer.findings = std::move(plan.findings);
    return {ExitCode::bad_input, {}, {}};
  }
  const TemporaryFolder temporary;
  if (temporary.path().empty()) {
    answer.findings = {{.code = "cannot_write",
                        .text = "no folder for the film's pictures can be made",
                        .remedy = "set TMPDIR to a folder that can be written"}};
    return {ExitCode::not_written, {}, {}};
  }
  watch_for_interrupt();
  writes_files = true;
  const bool is_made = make_film(a, painter, *plan, temporary.path(), answer);
  if (was_interrupted) return {ExitCode::interrupted, {}, {}};
  if (!is_made) return {ExitCode::not_written, {}, answer.kept};
  answer.json["film"] = {{"file", a.out.string()},
                         {"pictures", plan->frames.size()},
                         {"seconds", plan->seconds},
                         {"times_slower", plan->slower}};
  return {ExitCode::fine, std::move(*plan), {}};
}

}  // namespace

Rendered render_result(const RenderArguments& a) {
  Stages stages(a);
  const Result<RunResult> run = read_run_result(a.result);
  tell(run.findings, a);
  if (!run) return {ExitCode::bad_input, {}, {}};
  stages.done(fmt::format("read {}, frames: {}", a.result.string(), run->frames.size()));
  Result<render::Renderer> renderer = render::Renderer::offscreen();
  tell(renderer.findings, a);
  if (!renderer) return {ExitCode::failed, {}, {}};
  stages.done("made the renderer");
  const bool has_all = a.all || is_film(a.out);
  FramePainter painter(a, *run, *renderer,
                       has_all ? run->frames.size() - 1 : nearest_frame(*run, a.time));
  Rendered rendered;
  Answer answer;
  if (is_film(a.out)) {
    rendered = draw_film(a, *run, painter, answer);
  } else {
    draw_pictures(a, *run, painter, answer);
    if (has_error(answer.findings)) rendered.code = ExitCode::not_written;
  }
  tell(answer.findings, a);
  stages.done("drew the pictures");
  if (a.json && rendered.code == ExitCode::fine) {
    answer.json["findings"] = findings_json(run.findings);
    print_json(answer.json);
  }
  return rendered;
}

}  // namespace sunder
