// SPDX-License-Identifier: MIT
// The command line of `sunder fragments`.
#include "apps/sunder/fragments/fragments.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "apps/scene/json_text.hpp"
#include "apps/scene/words.hpp"
#include "apps/sunder/fragments/fragments_report.hpp"
#include "apps/sunder/gnuplot.hpp"
#include "apps/sunder/program.hpp"
#include "topology/io/files/printing.hpp"

namespace sunder {
namespace {

namespace fs = std::filesystem;

constexpr const char* fragments_footer = R"(
DIR is the folder of a run (or its fragments.csv). Laws are fitted to the sizes of the pieces by
maximum likelihood, and to those of the mesh's elements as a control
(docs/explanation/validation_and_limits.md). The elements are those of --mesh, else of the run's
first frame.
ln L / n is the log likelihood per value, K-S the largest difference of the cumulative
distributions.

Exit codes: 0 done, 2 usage, 3 bad table or mesh, 4 the picture was not written.

Examples:
  sunder fragments out/bunny --png bunny_fragments.png
  sunder fragments out/bunny --by mass --json
)";

struct FragmentsArguments : Telling {
  fs::path folder, png;
  std::vector<fs::path> meshes;
  SizeMeasure measure = SizeMeasure::volume;
};

ExitCode measure_folder(FragmentsArguments arguments) {
  std::error_code error;
  fs::path csv = arguments.folder;
  if (fs::is_directory(csv, error)) csv /= "fragments.csv";
  Stages stages(arguments);
  const Result<PieceColumns> pieces = read_fragments(csv);
  tell(pieces.findings, arguments);
  if (!pieces) return ExitCode::bad_input;
  stages.done(fmt::format("read {}", csv.string()));
  const fs::path frame = csv.parent_path() / "frames" / "frame_000000.vtu";
  if (arguments.meshes.empty() && fs::exists(frame, error)) arguments.meshes = {frame};
  const Result<std::vector<double>> elements = element_volumes(arguments.meshes);
  tell(elements.findings, arguments);
  if (!elements) return ExitCode::bad_input;
  stages.done(fmt::format("measured the elements: {}", elements->size()));
  const FragmentSizes sizes = measure_fragments(*pieces, *elements, arguments.measure);
  stages.done("fitted the laws");
  if (arguments.json) {
    print_json(fragments_json(sizes));
  } else {
    print("{}", fragments_text(sizes));
  }
  if (arguments.png.empty()) return ExitCode::fine;
  const fs::path folder = fs::absolute(csv).parent_path();
  if (const auto missing =
          draw_png(fragments_script(sizes, fmt::format("Pieces of {}", folder.filename().string())),
                   arguments.png)) {
    tell({*missing}, arguments);
    return ExitCode::not_written;
  }
  stages.done(fmt::format("drew {}", arguments.png.string()));
  return ExitCode::fine;
}

}  // namespace

void add_fragments_command(CLI::App& program, ExitCode& exit_code) {
  CLI::App* command = program.add_subcommand(
      "fragments", "Analyse the sizes of a run's pieces and fit laws to them");
  const auto arguments = std::make_shared<FragmentsArguments>();
  command->add_option("DIR", arguments->folder, "Folder of a run")->required();
  std::map<std::string, SizeMeasure> measures;
  for (std::size_t k = 0; k < size_measure_names.size(); ++k) {
    measures[std::string(size_measure_names[k])] = static_cast<SizeMeasure>(k);
  }
  command
      ->add_option("--by", arguments->measure,
                   "Measure of size: volume (m^3, default), size (its cube root, m), mass (kg)")
      ->transform(CLI::CheckedTransformer(measures).description(""))
      ->type_name("volume|size|mass");
  command
      ->add_option("--mesh", arguments->meshes,
                   "Mesh of the bodies, for the control; may be repeated")
      ->type_name("FILE")
      ->take_all();
  command->add_option("--png", arguments->png, "Draw the distribution (needs gnuplot)")
      ->type_name("FILE.png");
  add_verbose_flag(*command, *arguments);
  command->add_flag("--json", arguments->json, "Print JSON instead of a table");
  command->footer(fragments_footer);
  command->callback([=, &exit_code] { exit_code = measure_folder(*arguments); });
}

}  // namespace sunder
