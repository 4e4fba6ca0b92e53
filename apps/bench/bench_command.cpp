// SPDX-License-Identifier: MIT
// `sunder bench`: its command line, and where the figures go.
#include "apps/bench/bench_command.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "apps/bench/bench_formats.hpp"
#include "apps/bench/bench_kernel.hpp"
#include "apps/bench/bench_methods.hpp"
#include "apps/bench/bench_report.hpp"
#include "apps/bench/bench_step.hpp"
#include "apps/bench/bench_threshold.hpp"
#include "apps/bench/paper/bench_paper_report.hpp"
#include "apps/scene/json_text.hpp"
#include "apps/scene/words.hpp"
#include "apps/sunder/telling.hpp"
#include "topology/io/files/output_file.hpp"
#include "topology/io/files/printing.hpp"

namespace sunder {
namespace {

constexpr const char* kernel_footer = R"(
Bodies: cubes of 384, 6 000, 48 000 and 384 000 tetrahedra, and rings of 48, 4 560 and 28 320, one
cell thick. All of them take two minutes on an idle machine and 2 GB. --quick leaves out bodies above
6 000.

Memory counts the capacities of everything that a map holds, in bytes per tetrahedron:
  darts             CGAL's darts and attributes
  dense adjacency   vertex rows and neighbours of each tetrahedron
  handles           a dart of each tetrahedron and a corner of each vertex
  vertex columns    point and tetrahedron of each vertex, and the file's points
The use of glibc's heap is in the next column.

Times are microseconds, medians over the runs: this thread's own time for long stretches, wall time
for single fans. CGAL's managed unsew<3> splits the same faces in the same run. Searches for
components and the oracle are measured on random fans. A seed gives the same fans everywhere.

Exit codes: 0 done, 2 usage, 4 an output was not written (or gnuplot is missing).

Examples:
  sunder bench kernel --quick
  sunder bench kernel --csv kernel.csv --plot kernel.png
)";

void tell_next(const std::string& work, const Telling& telling) {
  remark(work + " ...\n", telling);
}

struct BenchArguments : Telling {
  KernelBenchSettings settings;
  std::filesystem::path csv, plot;
};

ExitCode run_kernel_bench(const BenchArguments& arguments) {
  const KernelBench bench = bench_kernel(
      arguments.settings, [&](const BenchBody& body) { tell_next(body.name, arguments); });
  if (arguments.json) {
    print_json(bench_json(bench));
  } else {
    print("{}", bench_table(bench));
  }
  std::vector<Finding> findings;
  if (!arguments.csv.empty()) {
    if (auto failure = write_file(arguments.csv, bench_csv(bench))) findings.push_back(*failure);
  }
  if (!arguments.plot.empty()) {
    if (auto failure = plot_bench(bench, arguments.plot)) findings.push_back(*failure);
  }
  tell_beside(findings, arguments);
  return findings.empty() ? ExitCode::fine : ExitCode::not_written;
}

void add_kernel_command(CLI::App& bench, ExitCode& exit_code) {
  const auto arguments = std::make_shared<BenchArguments>();
  CLI::App* command = bench.add_subcommand(
      "kernel", "Measure memory, times and searches of the 3-map, next to CGAL's managed unsew<3>");
  command->add_flag("--quick", arguments->settings.quick,
                    "Measure only bodies of up to 6 000 tetrahedra");
  command
      ->add_option("--kernel", arguments->settings.kernel,
                   "Kernel of the maps: dense (rows, default) or lcc (CGAL's darts)")
      ->type_name("dense|lcc")
      ->transform(CLI::CheckedTransformer(std::map<std::string, MapKernel>{
                                              {"dense", MapKernel::dense}, {"lcc", MapKernel::lcc}})
                      .description(""));
  command->add_option("--runs", arguments->settings.runs, "Runs to take medians over (default 5)")
      ->type_name("N")
      ->check(CLI::Range(1, 1000).description(""));
  command->add_option("--seed", arguments->settings.seed, "Seed of the random faces and fans")
      ->type_name("S");
  command->add_option("--csv", arguments->csv, "Write the figures as CSV")->type_name("FILE");
  command->add_option("--plot", arguments->plot, "Draw times over tetrahedra (PNG, by gnuplot)")
      ->type_name("FILE.png");
  add_quiet_flag(*command, *arguments);
  command->add_flag("--json", arguments->json, "Print JSON instead of the table");
  command->footer(kernel_footer);
  command->callback([=, &exit_code] { exit_code = run_kernel_bench(*arguments); });
}

constexpr const char* step_footer = R"(
Bodies: boxes of 414 and 6 120 tetrahedra (with --large one of 49 152), or those of the files given.
They are of concrete, in free fall, turning, and too strong to break. A step has the parts that it
has in `sunder run`: contact search, floating_frame, element and node stress, threshold tests, energy
ledger, display.

Times are medians, in milliseconds on the wall. Parts of a step are called one at a time. Over
modulus and step the simulations take turns (bodies of up to 10 000 tetrahedra). A crack splits the
vertices nearest to a corner. The old factor is kept under a border, or order, K and factor are made
again (docs/lab/factor.md). Give the process its priority on a busy machine:
echo -15 > /proc/self/autogroup. Our factor and Eigen's have the same order of elimination. The build
type is Release: -O3, no -march, and AVX2 if the processor has it.

Exit codes: 0 done, 2 usage, 3 a body has errors, 4 an output was not written.

Examples:
  sunder bench step
  sunder bench step meshes/monolith.msh meshes/bunny.msh --csv step.csv
)";

struct StepArguments : Telling {
  StepBenchSettings settings;
  std::filesystem::path csv;
};

ExitCode run_step_bench(const StepArguments& arguments) {
  const Result<StepBench> bench =
      bench_step(arguments.settings, [&](const std::string& body) { tell_next(body, arguments); });
  if (!bench) {
    tell_beside(bench.findings, arguments);
    return ExitCode::bad_input;
  }
  print("{}", arguments.json ? step_json(*bench) : step_table(*bench));
  if (arguments.csv.empty()) return ExitCode::fine;
  if (auto failure = write_file(arguments.csv, step_csv(*bench))) {
    tell_beside({*failure}, arguments);
    return ExitCode::not_written;
  }
  return ExitCode::fine;
}

void add_step_command(CLI::App& bench, ExitCode& exit_code) {
  const auto arguments = std::make_shared<StepArguments>();
  CLI::App* command = bench.add_subcommand(
      "step", "Measure a step without contact and cracks, in parts, and its factor");
  command
      ->add_option("MESH", arguments->settings.meshes,
                   "Measure these bodies instead of the built-in ones")
      ->type_name("");
  command->add_flag("--large", arguments->settings.large,
                    "Measure a body of 49 152 tetrahedra too");
  command->add_option("--runs", arguments->settings.runs, "Steps to take medians over (default 50)")
      ->type_name("N")
      ->check(CLI::Range(1, 100000).description(""));
  command->add_option("--csv", arguments->csv, "Write the figures as CSV")->type_name("FILE");
  add_quiet_flag(*command, *arguments);
  command->add_flag("--json", arguments->json, "Print JSON instead of the table");
  command->footer(step_footer);
  command->callback([=, &exit_code] { exit_code = run_step_bench(*arguments); });
}

constexpr const char* methods_footer = R"(
Bodies: boxes of 414 and 6 120 tetrahedra in flight, turning and a little deformed. They have 30 GPa at
a step of 1 ms, and 1e7 Pa at 10 ms. One step is repeated from the same state: prediction and element stress, no
contact, no cracks. Every method that factors uses the same block factor, and reassembled makes it
again every step. Iterations end at 1e-6 or are given up at 1 000, and the factor steps.

Times are milliseconds on the wall, medians. Give the process its priority on a busy machine:
echo -15 > /proc/self/autogroup.

Exit codes: 0 done, 2 usage, 3 a body has errors, 4 an output was not written.

Examples:
  sunder bench methods
  sunder bench methods --runs 50 --csv methods.csv
)";

struct MethodArguments : Telling {
  MethodBenchSettings settings;
  std::filesystem::path csv;
};

ExitCode run_method_bench(const MethodArguments& arguments) {
  const Result<MethodBench> bench = bench_methods(
      arguments.settings, [&](const std::string& body) { tell_next(body, arguments); });
  if (!bench) {
    tell_beside(bench.findings, arguments);
    return ExitCode::bad_input;
  }
  print("{}", arguments.json ? methods_json(*bench) : methods_table(*bench));
  if (arguments.csv.empty()) return ExitCode::fine;
  if (auto failure = write_file(arguments.csv, methods_csv(*bench))) {
    tell_beside({*failure}, arguments);
    return ExitCode::not_written;
  }
  return ExitCode::fine;
}

void add_methods_command(CLI::App& bench, ExitCode& exit_code) {
  const auto arguments = std::make_shared<MethodArguments>();
  CLI::App* command =
      bench.add_subcommand("methods", "Measure a step with every integrator and model");
  command->add_option("--runs", arguments->settings.runs, "Steps to take medians over (default 20)")
      ->type_name("N")
      ->check(CLI::Range(1, 100000).description(""));
  command->add_option("--csv", arguments->csv, "Write the figures as CSV")->type_name("FILE");
  add_quiet_flag(*command, *arguments);
  command->add_flag("--json", arguments->json, "Print JSON instead of the table");
  command->footer(methods_footer);
  command->callback([=, &exit_code] { exit_code = run_method_bench(*arguments); });
}

constexpr const char* paper_footer = R"(
Scenes: monolith, block and bunny of meshes/scenes/paper, which spell out every key.
meshes/scenes/README.md lists our choices where the paper gives no value. Each mode runs without
fractures, corotational without fractures, and with fractures.
Modes:
  the paper's process   node stress by mass, Gershgorin's test, oracle, tetrahedra by QR, with
                        linearised implicit Euler, and with Broyden's method from M or the factor
  floating_frame        one solve per step
  our defaults
Parts of the scenes are run, and the column of steps counts them. The fans of a run are cut again with
every way to find components. Threshold tests, forces and stresses of both models are measured on
moments of the run in the paper's mode.

Times of steps are this thread's own, of fans medians of nine on the wall. docs/lab/paper.md reads them.

Exit codes: 0 done, 2 usage, 3 a scene has errors, 4 an output was not written.

Examples:
  sunder bench paper --quick
  sunder bench paper --csv paper.csv --markdown paper.md
)";

struct PaperArguments : Telling {
  PaperBenchSettings settings;
  std::filesystem::path csv, markdown;
};

/// The folder given, or that of the three scenes.
std::filesystem::path scenes_in(const std::filesystem::path& given) {
  const std::filesystem::path here = "meshes/scenes/paper";
  if (!given.empty()) return given;
  return std::filesystem::is_directory(here) ? here : SUNDER_SOURCE_DIR / here;
}

ExitCode run_paper_bench(PaperArguments arguments) {
  arguments.settings.scenes = scenes_in(arguments.settings.scenes);
  const Result<PaperBench> bench =
      bench_paper(arguments.settings, [&](const std::string& run) { tell_next(run, arguments); });
  if (!bench) {
    tell_beside(bench.findings, arguments);
    return ExitCode::bad_input;
  }
  print("{}", paper_text(*bench));
  std::vector<Finding> findings;
  const auto write = [&](const std::filesystem::path& path, const std::string& text) {
    if (path.empty()) return;
    if (auto failure = write_file(path, text)) findings.push_back(*failure);
  };
  write(arguments.csv, paper_csv(*bench));
  write(arguments.markdown, paper_markdown(*bench));
  tell_beside(findings, arguments);
  return findings.empty() ? ExitCode::fine : ExitCode::not_written;
}

void add_paper_command(CLI::App& bench, ExitCode& exit_code) {
  const auto arguments = std::make_shared<PaperArguments>();
  CLI::App* command =
      bench.add_subcommand("paper", "Repeat tables 1 to 4 of the paper and its claims");
  command->add_flag("--quick", arguments->settings.quick,
                    "Measure only the beginnings of the scenes");
  command
      ->add_option("--runs", arguments->settings.runs,
                   "Repeats of everything to take medians over (default 1)")
      ->type_name("N")
      ->check(CLI::Range(1, 100).description(""));
  command
      ->add_option("--scenes", arguments->settings.scenes,
                   "Folder of the three scenes (default meshes/scenes/paper)")
      ->type_name("FOLDER");
  command->add_option("--csv", arguments->csv, "Write all figures as CSV")->type_name("FILE");
  command->add_option("--markdown", arguments->markdown, "Write the tables as Markdown")
      ->type_name("FILE");
  add_quiet_flag(*command, *arguments);
  command->footer(paper_footer);
  command->callback([=, &exit_code] { exit_code = run_paper_bench(*arguments); });
}

constexpr const char* threshold_footer = R"(
Node stresses come from the beginnings of the three scenes of meshes/scenes/paper, below their
thresholds, and from a random generator. All ways of the test give the same result:
  eigenvalues
  gershgorin   bound, then eigenvalues: the paper's
  exact        leading minors
  chain        bound, then minors: the default
Times are this thread's own.

Exit codes: 0 done, 2 usage, 3 a scene has errors, 4 an output was not written.

Examples:
  sunder bench threshold
  sunder bench threshold --runs 100 --csv threshold.csv
)";

struct ThresholdArguments : Telling {
  ThresholdBenchSettings settings;
  std::filesystem::path csv;
};

ExitCode run_threshold_bench(ThresholdArguments arguments) {
  arguments.settings.scenes = scenes_in(arguments.settings.scenes);
  const Result<ThresholdBench> bench = bench_threshold(
      arguments.settings, [&](const std::string& source) { tell_next(source, arguments); });
  if (!bench) {
    tell_beside(bench.findings, arguments);
    return ExitCode::bad_input;
  }
  print("{}", arguments.json ? threshold_json(*bench) : threshold_table(*bench));
  if (arguments.csv.empty()) return ExitCode::fine;
  if (auto failure = write_file(arguments.csv, threshold_csv(*bench))) {
    tell_beside({*failure}, arguments);
    return ExitCode::not_written;
  }
  return ExitCode::fine;
}

void add_threshold_command(CLI::App& bench, ExitCode& exit_code) {
  const auto arguments = std::make_shared<ThresholdArguments>();
  CLI::App* command =
      bench.add_subcommand("threshold", "Measure each test of a vertex against its strength");
  command
      ->add_option("--runs", arguments->settings.runs, "Passes to take medians over (default 25)")
      ->type_name("N")
      ->check(CLI::Range(1, 100000).description(""));
  command->add_option("--seed", arguments->settings.seed, "Seed of the random tensors")
      ->type_name("S");
  command
      ->add_option("--scenes", arguments->settings.scenes,
                   "Folder of the three scenes (default meshes/scenes/paper)")
      ->type_name("FOLDER");
  command->add_option("--csv", arguments->csv, "Write the figures as CSV")->type_name("FILE");
  add_quiet_flag(*command, *arguments);
  command->add_flag("--json", arguments->json, "Print JSON instead of the table");
  command->footer(threshold_footer);
  command->callback([=, &exit_code] { exit_code = run_threshold_bench(*arguments); });
}

}  // namespace

void add_bench_command(CLI::App& program, ExitCode& exit_code) {
  CLI::App* bench = program.add_subcommand("bench", "Measure the program on this machine");
  bench->require_subcommand(1);
  bench->footer("`sunder bench COMMAND --help` describes each measurement.");
  add_kernel_command(*bench, exit_code);
  add_step_command(*bench, exit_code);
  add_methods_command(*bench, exit_code);
  add_paper_command(*bench, exit_code);
  add_threshold_command(*bench, exit_code);
  add_formats_command(*bench, exit_code);
}

}  // namespace sunder
