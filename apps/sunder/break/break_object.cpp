// SPDX-License-Identifier: MIT
// Read the object, fill it, write the scene, run it, tell the outcome.
#include "apps/sunder/break/break_object.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <utility>

#include "apps/scene/scene_json.hpp"
#include "apps/sunder/break/budget.hpp"
#include "apps/sunder/break/fill.hpp"
#include "apps/sunder/break/outcome.hpp"
#include "apps/sunder/break/thing.hpp"
#include "apps/sunder/fragments/fragment_sizes.hpp"
#include "apps/sunder/program.hpp"
#include "apps/sunder/render/render.hpp"
#include "apps/sunder/run/pictures.hpp"
#include "apps/sunder/run/report/settings_report.hpp"
#include "apps/sunder/run/run.hpp"
#include "fracture/scene/expected_time.hpp"
#include "topology/base/counted.hpp"
#include "topology/io/files/input_file.hpp"
#include "topology/io/files/output_file.hpp"
#include "topology/io/files/printing.hpp"
#include "topology/io/mesh_file.hpp"

namespace sunder {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// Sizes of the film and of the other pictures, pixels.
constexpr std::uint32_t film_width = 960, film_height = 540;
constexpr double picture_megapixels = 1280 * 720 * 1e-6;

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

/// A break on its way.
struct Work {
  BreakArguments& a;
  std::string name;
  Thing thing = {};
  double metres = 1;  ///< per unit of the thing
  bool draws = true;  ///< pictures can be drawn here
  Clock::time_point start = Clock::now();

  double elapsed() const { return std::chrono::duration<double>(Clock::now() - start).count(); }
};

/// Reads the thing and its scale; false after an error.
bool read(Work& work) {
  const BreakArguments& a = work.a;
  Result<Thing> thing = read_thing(a.thing, a.mending);
  tell(thing.findings, a);
  if (!thing) return false;
  std::optional<double> size;
  if (!a.size.empty()) size = length_of(a.size);
  const ThingScale scale = scale_of(*thing, size, a.units, a.thing.string());
  if (scale.guess) tell({*scale.guess}, a);
  work.thing = std::move(*thing);
  work.metres = scale.metres;
  return true;
}

/// The scene for a mesh that lies on the ground.
nlohmann::ordered_json scene_of(const Work& work, const TetMesh& mesh) {
  return break_scene({work.name, work.name + ".msh", mesh, *find_material(work.a.material)},
                     blow_of(work.a), work.a.times, work.draws);
}

/// s of computing that a mesh is expected to take: its run, pictures and film.
double expected_seconds(const Work& work, const TetMesh& mesh) {
  const std::string text = scene_of(work, mesh).dump();
  SceneFiles files;
  files.mesh = [&](const std::string&) { return Result<TetMesh>(mesh); };
  Result<SceneFile> file = read_scene(SceneBytes{text, work.name + ".json"}, files);
  if (!file) return 0;
  // Thin things bend, and break by blows far below the strength. A budget has room for that.
  for (BodySettings& body : file->scene.bodies) body.material.tensile_strength *= 0.1;
  double seconds = expected_time(file->scene).between(0, file->scene.duration);
  const auto cells = static_cast<double>(mesh.tetrahedra.size());
  if (!work.draws) return seconds;
  seconds += drawing_time(file->output.pictures.count, picture_megapixels, cells);
  const double film = drawing_time(file->output.frames, film_width * film_height * 1e-6, cells);
  return work.a.no_film ? seconds : seconds + film;
}

/// Fills the surface with about so many tetrahedra, in metres on the ground. A surface that no
/// mesher takes is wrapped, where repairs are allowed.
std::optional<TetMesh> filled(Work& work, double tetrahedra) {
  const BreakArguments& a = work.a;
  Result<Filled> filled = fill(work.thing, tetrahedra, a.mesher);
  if (!filled && filled.findings.back().code == "not_filled" && a.mending != Mending::none) {
    Result<Mended> around = wrapped(work.thing.surface);
    if (around) {
      for (Finding& f : around.findings) f.file = a.thing.string();
      tell(around.findings, a);
      work.thing = Thing{{}, std::move(around->surface), around->volume};
      filled = fill(work.thing, tetrahedra, a.mesher);
    }
  }
  for (Finding& f : filled.findings) f.file = a.thing.string();
  tell(filled.findings, a);
  if (!filled) return std::nullopt;
  remark(fmt::format("{} filled it with {}, volume {:+.2g} %, skin within {} of the surface\n",
                     filled->mesher, counted_tetrahedra(filled->mesh.tetrahedra.size()),
                     100 * filled->volume_error, length_words(filled->gap.largest * work.metres)),
         a);
  set_down(filled->mesh, work.metres, a.up);
  return std::move(filled->mesh);
}

/// A number of tetrahedra, or of a cell size in the unit of the options.
double wanted_cells(const Work& work) {
  const BreakArguments& a = work.a;
  if (a.cell.empty() || !(work.thing.volume > 0)) return a.tetrahedra;
  const double cell = *length_of(a.cell) / work.metres;
  return std::max(1.0, 6 * work.thing.volume / (cell * cell * cell));
}

Finding over_budget(double expected, const std::string& budget, bool is_solid) {
  return {.code = "over_budget",
          .severity = Severity::warning,
          .text = fmt::format("{} of computing are expected, more than the {} of --time-budget{}",
                              time_words(expected), budget,
                              is_solid ? ": the cells of a file of tetrahedra stay as they are"
                                       : ", with the fewest cells"),
          .remedy = "give more time, a shorter --duration, or a coarser mesh"};
}

/// Leaves the film out where it would take too much of the budget.
void judge_film(Work& work, double budget, double cells) {
  BreakArguments& a = work.a;
  if (a.no_film || !work.draws) return;
  const double film = drawing_time(film_frames, film_width * film_height * 1e-6, cells);
  if (film < 0.5 * budget) return;
  a.no_film = true;
  remark(fmt::format("no film: it would take {} of the {}\n", time_words(film), a.budget), a);
}

/// The mesh that fits into --time-budget, with words about it.
std::optional<TetMesh> mesh_within(Work& work, double budget) {
  judge_film(work, budget, 2000);
  const auto left = [&] { return budget - work.elapsed(); };
  std::optional<Costed> chosen;
  if (work.thing.is_solid()) {
    chosen = Costed{std::move(work.thing.solid)};
    set_down(chosen->mesh, work.metres, work.a.up);
    chosen->seconds = expected_seconds(work, chosen->mesh);
  } else {
    chosen = finest_within(left, [&](double tetrahedra) -> std::optional<Costed> {
      std::optional<TetMesh> mesh = filled(work, tetrahedra);
      if (!mesh) return std::nullopt;
      const double seconds = expected_seconds(work, *mesh);
      return Costed{std::move(*mesh), seconds};
    });
  }
  if (!chosen) return std::nullopt;
  remark(fmt::format("{} fit into {}: {:.0f} s have passed, and {} of run and pictures are "
                     "expected\n",
                     counted_tetrahedra(chosen->mesh.tetrahedra.size()), work.a.budget,
                     work.elapsed(), time_words(chosen->seconds)),
         work.a);
  if (chosen->seconds > left()) {
    tell({over_budget(chosen->seconds, work.a.budget, work.thing.surface.points.empty())}, work.a);
  }
  return std::move(chosen->mesh);
}

/// The tetrahedra of the thing in metres, on the ground; nothing after an error.
std::optional<TetMesh> mesh_of(Work& work) {
  const BreakArguments& a = work.a;
  if (!work.thing.is_solid()) {
    if (a.budget.empty()) return filled(work, wanted_cells(work));
    return mesh_within(work, *time_of(a.budget));
  }
  remark(fmt::format("{} has {}\n", a.thing.string(),
                     counted_tetrahedra(work.thing.solid.tetrahedra.size())),
         a);
  if (!a.filling.empty()) {
    tell({{.code = "filled_already",
           .severity = Severity::warning,
           .text = fmt::format("the file has tetrahedra, which stay as they are: {} without effect",
                               fmt::join(a.filling, ", ")),
           .remedy = "make them smaller: sunder refine; or fill its surface again: sunder convert "
                     "FILE surface.stl",
           .file = a.thing.string()}},
         a);
  }
  if (!a.budget.empty()) return mesh_within(work, *time_of(a.budget));
  TetMesh mesh = std::move(work.thing.solid);
  set_down(mesh, work.metres, a.up);
  return mesh;
}

/// Whether a file is there with other contents.
bool differs(const fs::path& path, std::string_view text) {
  if (!file_exists(path)) return false;
  const Result<std::string> bytes = io::bytes_of_file(path);
  return !bytes || *bytes != text;
}

/// Writes scene and mesh. Nothing of the user's is replaced without --force.
std::optional<Finding> write_scene(const BreakArguments& a, const fs::path& scene,
                                   const std::string& text, const fs::path& file,
                                   const TetMesh& mesh) {
  const fs::path draft = fs::path(file).replace_extension(".new.msh");
  if (auto fault = make_folder(a.folder)) return fault;
  for (Finding& f : write_mesh(draft, mesh)) {
    if (f.severity == Severity::error) return f;
  }
  const Result<std::string> bytes = io::bytes_of_file(draft);
  std::error_code none;
  fs::remove(draft, none);
  if (!bytes) return bytes.findings.front();
  for (const auto& [path, content] : {std::pair{file, &*bytes}, std::pair{scene, &text}}) {
    if (!a.force && differs(path, *content)) {
      return Finding{.code = "in_the_way",
                     .text = fmt::format("{} is there with other contents", path.string()),
                     .remedy = "give another folder with -o, or replace it with --force",
                     .file = path.string()};
    }
  }
  if (auto fault = write_file(file, *bytes)) return fault;
  return write_file(scene, text);
}

std::size_t line_count(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return static_cast<std::size_t>(
      std::count(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>(), '\n'));
}

#if defined(SUNDER_HAS_RENDERER)
/// Draws the film of a finished run and tells its place. A film that cannot be made is no failure
/// of the run: its findings are on standard error.
ExitCode tell_film(const BreakArguments& a, const fs::path& scene, const fs::path& run) {
  RenderArguments film{a};
  film.result = run;
  film.out = fs::path(scene).replace_extension(".mp4");
  film.size = {film_width, film_height};
  const Rendered rendered = render_result(film);
  if (rendered.code == ExitCode::interrupted) return rendered.code;
  if (rendered.film) {
    print("Film      {}  {}\n", shell_word(film.out.string()), film_words(*rendered.film));
  } else if (!rendered.pictures.empty()) {
    print("Film      its pictures: {}\n",
          shell_word((rendered.pictures / film_picture_name(0)).string()));
  }
  return ExitCode::fine;
}
#endif

/// The sentence about a finished run and the places of its files.
ExitCode tell_outcome(const Work& work, const fs::path& scene, const fs::path& run) {
  const BreakArguments& a = work.a;
  const Result<PieceColumns> pieces = read_fragments(run / "fragments.csv");
  tell(pieces.findings, a);
  if (!pieces) return ExitCode::failed;
  const std::size_t cracks =
      line_count(run / "cracks.csv");  // its first line has the names of columns
  print("\n{}\n", outcome_sentence(pieces->mass, cracks > 0 ? cracks - 1 : 0));
  print("Scene     {}\n", shell_word(scene.string()));
#if defined(SUNDER_HAS_RENDERER)
  if (work.draws) {
    print("Pictures  {}\n", shell_word((run / "picture_005.png").string()));
    return a.no_film ? ExitCode::fine : tell_film(a, scene, run);
  }
#endif
  print("Frames    {}\n", shell_word((run / "frames.pvd").string()));
  return ExitCode::fine;
}

}  // namespace

ExitCode break_object(BreakArguments a) {
  Work work{a, name_of(a.thing)};
  if (a.folder.empty()) a.folder = fs::path("out") / work.name;
  if (!read(work)) return ExitCode::bad_input;
  work.draws = may_draw(a);
  const std::optional<TetMesh> mesh = mesh_of(work);
  if (!mesh) return ExitCode::bad_input;
  const fs::path file = a.folder / (work.name + ".msh"), scene = a.folder / (work.name + ".json");
  if (const auto fault =
          write_scene(a, scene, json_text(scene_of(work, *mesh)) + "\n", file, *mesh)) {
    tell({*fault}, a);
    return ExitCode::not_written;
  }
  remark(fmt::format("{} of {} is {}\n", work.name, a.material, blow_words(blow_of(a))), a);
  if (a.scene_only) {
    print("{} run {}\n", program_word(), shell_word(scene.string()));
    return ExitCode::fine;
  }
  RunArguments run{a};
  run.scene = scene;
  run.folder = a.folder / "run";
  run.force = true;
  const ExitCode code = run_scene(run);
  return code == ExitCode::fine ? tell_outcome(work, scene, run.folder) : code;
}

}  // namespace sunder
