// SPDX-License-Identifier: MIT
// The command line of `sunder chart`, and the files it leaves.
#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "apps/bench/chart/chart.hpp"
#include "apps/bench/chart/chart_mesh.hpp"
#include "apps/bench/chart/chart_report.hpp"
#include "apps/scene/json_text.hpp"
#include "apps/scene/scene_json.hpp"
#include "apps/scene/words.hpp"
#include "apps/sunder/gnuplot.hpp"
#include "apps/sunder/telling.hpp"
#include "topology/io/files/output_file.hpp"
#include "topology/io/files/printing.hpp"
#include "topology/io/mesh_file.hpp"

namespace sunder {
namespace {

std::string footer() {
  std::string text = R"(
Runs SCENE with every method, step, impact window and mesh, and compares the error of one quantity
with the time to compute it. DIR/QUANTITY.csv has a line per run, with the reason where a run
diverged, broke nothing or took too long. DIR/QUANTITY.png is the chart, drawn by gnuplot. The last
lines give the cheapest setting inside --within, as keys of a scene. Its shorter steps must be inside
too: an error that grows again with a shorter step was small by chance.

Quantities:
)";
  for (const QuantityTraits& q : quantities()) {
    text += fmt::format("  {:<18} {}{}\n", q.name, q.text,
                        q.unit.empty() ? "" : fmt::format(" ({})", q.unit));
  }
  text += "\nMethods:\n";
  for (const ChartMethod& m : chart_methods()) text += fmt::format("  {}\n", m.name);
  return text + R"(
Errors are relative to --exact. Without it they are relative to the default method on the finest
mesh, at half the shortest step. With impacts that step is at most a quarter of the time in which a
wave crosses a cell. That run has an error of its own, estimated from step, window and mesh, and no
point counts as better. Times are ms of mechanics, fracture and rebuilding per simulated ms, first
factors included. They are medians of up to a hundred runs, in time of this program alone: compare
ratios, not machines. given_up counts steps that did not converge and were solved with the factor.
Steps are whole fractions of the duration. Those of methods that are stable only below a bound are
fractions of that bound on each mesh.
With --ensemble N every setting and the reference run N times. Places and velocities are moved by up
to 1e-12 of them, strengths by up to 1e-6. The error is that of the mean, and the table has deviation
and band next to it. Differences within a band are numerical noise.
With --ensemble meshes the files of --mesh are these runs, one each, instead of points of their own.
The meshes are of one body and one size, and none is the right one. The first is timed. Steps that
are fractions of a bound take the least bound.

Exit codes: 0 done, 1 no run is inside --within, 2 usage, 3 bad scene, mesh or reference,
4 not written.

Examples:
  sunder chart meshes/scenes/charts/bar.json --quantity peak_stress --exact 4.5e6
  sunder chart meshes/scenes/monolith.json --quantity largest_piece --quick --levels 0
  sunder chart meshes/scenes/ensembles/ball.json --quantity pieces --ensemble 4 --exact 520 --levels 0 \
    --method floating_frame --steps 2e-4 --windows on --vary fracture.crack=paper,object
  sunder chart SCENE --quantity pieces --ensemble meshes --mesh a.mesh --mesh b.mesh --mesh c.mesh
  sunder chart meshes/scenes/block.json --quantity largest_piece --vary contact.max_iterations=10,40,200
)";
}

/// Writes the finer meshes that the answer needs, and says which.
std::vector<Finding> write_meshes(const ChartArguments& arguments, const ChartPoint& point,
                                  std::string& said) {
  if (arguments.over_meshes) return {};
  if (point.setting.mesh == 0 && arguments.meshes.empty()) return {};
  if (!arguments.meshes.empty()) {
    said += fmt::format("bodies.0.mesh: {}\n", arguments.meshes[point.setting.mesh]);
    return {};
  }
  Result<SceneFile> file = read_scene(arguments.scene, arguments.settings);
  if (!file) return file.findings;
  for (std::size_t b = 0; b < file->scene.bodies.size(); ++b) {
    TetMesh mesh = file->scene.bodies[b].mesh;
    for (std::size_t k = 0; k < point.setting.mesh; ++k) mesh = refined(mesh);
    const auto path = arguments.folder / fmt::format("body_{}_finer_{}.msh", b, point.setting.mesh);
    const std::vector<Finding> findings = write_mesh(path, mesh);
    if (has_error(findings)) return findings;
    said += fmt::format("bodies.{}.mesh: {}\n", b, path.string());
  }
  return {};
}

/// The result of the chart, for people.
std::string answer_text(const Chart& chart) {
  if (!chart.cheapest) {
    const double own = chart.reference.own_error;
    return fmt::format("No run is inside an error of {:.3g}{}.\n", chart.within,
                       own > chart.within
                           ? fmt::format(", nor can one be: the reference's own is {:.2g}", own)
                           : "");
  }
  const ChartPoint& p = chart.points[*chart.cheapest];
  return fmt::format("Cheapest inside an error of {:.3g}: {}\n{}\n", chart.within,
                     setting_text(chart, p.setting), json_text(setting_json(p.setting)));
}

ExitCode write_chart(const ChartArguments& arguments, const Chart& chart) {
  const std::string name(traits_of(chart.probe.quantity).name);
  std::vector<Finding> findings;
  const auto keep = [&](std::optional<Finding> f) {
    if (f) findings.push_back(std::move(*f));
  };
  keep(make_folder(arguments.folder));
  if (!has_error(findings)) keep(write_file(arguments.folder / (name + ".csv"), chart_csv(chart)));
  if (!has_error(findings)) keep(draw_png(chart_script(chart), arguments.folder / (name + ".png")));
  std::string meshes;
  if (chart.cheapest) {
    for (Finding& f : write_meshes(arguments, chart.points[*chart.cheapest], meshes)) {
      findings.push_back(std::move(f));
    }
  }
  tell_beside(findings, arguments);
  if (arguments.json) {
    print_json(chart_json(chart));
  } else {
    print("{}{:<14} {}\n\n{}{}", chart_table(chart), "written to", arguments.folder.string(),
          answer_text(chart), meshes);
  }
  if (has_error(findings)) return ExitCode::not_written;
  return chart.cheapest ? ExitCode::fine : ExitCode::problems;
}

ExitCode run_chart_command(ChartArguments arguments) {
  if (arguments.folder.empty()) {
    arguments.folder =
        std::filesystem::path("out") / fmt::format("chart_{}", arguments.scene.stem().string());
  }
  const Result<Chart> chart =
      make_chart(arguments, [&](const std::string& what) { remark(what + "\n", arguments); });
  tell_beside(chart.findings, arguments);
  if (!chart) return ExitCode::bad_input;
  return write_chart(arguments, *chart);
}

void add_grid_options(CLI::App& command, ChartArguments& a) {
  command
      .add_option("--method", a.methods, "Run only these methods; may be repeated; default: all")
      ->type_name("NAME")
      ->take_all();
  command
      .add_option("--steps", a.steps, "Steps; default: 8 times the scene's to a sixteenth of it")
      ->type_name("SECONDS,...")
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  command
      .add_option("--windows", a.windows, "Runs with and without impact windows; default: off,on")
      ->type_name("on,off")
      ->delimiter(',')
      ->check(CLI::IsMember({"on", "off"}));
  CLI::Option* levels =
      command
          .add_option("--levels", a.levels,
                      "Refine the meshes up to N times, eight tetrahedra for one; default: once "
                      "where that leaves at most 20 000")
          ->type_name("N")
          ->check(CLI::Range(0, 5));
  command
      .add_option(
          "--mesh", a.meshes,
          "Meshes of the first body instead, coarse to fine (with --ensemble meshes: of one "
          "size); may be repeated")
      ->type_name("FILE")
      ->take_all()
      ->excludes(levels);
  command
      .add_option("--vary", a.variants,
                  "Cross with values of one more key of the scene: impact.negligible=0.03,0.1,0.3")
      ->type_name("KEY=VALUE,...")
      ->take_all();
  command.add_flag("--quick", a.quick, "Run half the steps, one window");
  command
      .add_option_function<std::string>(
          "--ensemble",
          [&a](const std::string& runs) {
            a.over_meshes = runs == "meshes";
            if (!a.over_meshes) a.members = std::stoul(runs, nullptr, 0);
          },
          "Runs of every setting, N moved by nothing or one for each --mesh; their mean and band "
          "instead of one value; default: 1")
      ->type_name("N|meshes")
      ->check(CLI::Range(1, 1000) | CLI::IsMember({"meshes"}));
}

void add_options(CLI::App& command, ChartArguments& a) {
  command.add_option("SCENE", a.scene, "Scene file (JSON)")->required();
  command.add_option("--quantity", a.quantity, "Quantity of the charted error; default: position")
      ->type_name("NAME");
  command.add_option("-o,--out", a.folder, "Folder; default: out/chart_ and the scene's name")
      ->type_name("DIR");
  command.add_option("--within", a.within, "Error to stay inside; default: 0.01")
      ->type_name("ERROR")
      ->check(CLI::PositiveNumber);
  command
      .add_option(
          "--exact", a.exact,
          "The true value (three numbers for a vector), or 'start' for a conserved quantity")
      ->type_name("VALUE");
  command
      .add_option("--probe", a.probe,
                  "Point of the first body for 'position', m, in its mesh; default: the farthest "
                  "from the mesh's origin")
      ->type_name("X,Y,Z");
  command.add_option("--limit", a.limit, "Wall seconds a run may take; default: 20")
      ->type_name("SECONDS")
      ->check(CLI::PositiveNumber);
  add_grid_options(command, a);
  command.add_option("--set", a.settings, "Change a value of the scene; may be repeated")
      ->type_name("KEY=VALUE")
      ->take_all();
  add_quiet_flag(command, a);
  command.add_flag("--json", a.json, "Print the chart as JSON instead of a table");
}

}  // namespace

void add_chart_command(CLI::App& program, ExitCode& exit_code) {
  CLI::App* command = program.add_subcommand(
      "chart", "Chart the error of a scene's runs over their computing time");
  const auto arguments = std::make_shared<ChartArguments>();
  add_options(*command, *arguments);
  command->footer(footer());
  command->callback([=, &exit_code] { exit_code = run_chart_command(*arguments); });
}

}  // namespace sunder
