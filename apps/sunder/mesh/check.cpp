// SPDX-License-Identifier: MIT
// `sunder check`: reads a mesh, counts its cells, measures its tetrahedra, lists every finding.
#include "apps/sunder/mesh/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "apps/scene/json_text.hpp"
#include "apps/sunder/mesh/check_report.hpp"
#include "apps/sunder/telling.hpp"
#include "topology/io/files/printing.hpp"
#include "topology/io/format_traits.hpp"
#include "topology/io/mesh_file.hpp"
#include "topology/mesh/boundary_surface.hpp"
#include "topology/mesh/finding_cells.hpp"
#include "topology/mesh/surface/surface_check.hpp"

namespace sunder {
namespace {

constexpr const char* check_footer = R"(
Several meshes are reported one after the other, with --json as a list. The exit code is the highest
of theirs.
MESH is any mesh file that sunder convert reads (sunder convert --formats lists them), packed by
gzip or not. Its format is recognised by content, not by name.
A mesh of faces without volume cells is checked as a surface: whether it is closed, manifold, oriented
and free of faces that cross. Crossings are decided exactly. Its area and the volume that it encloses
are printed too.
Volume cells that are no tetrahedra are refused: sunder convert --split cuts them.
Coordinates are taken as metres, volumes are m^3. Vertices, edges and faces are counted as orbits
of the 3-map: cells that only touch are not joined. Numbers in brackets are rows counted from 0.
Betti numbers are those of the homology over the integers, computed for up to 200 000 tetrahedra, for
more with --homology. Without it they follow from boundary sheets, which is right where no
tetrahedra overlap. Where the two differ the body overlaps itself, or does not lie in space, and the
homology is printed with its torsion.
Dihedral angles lie between two faces of a tetrahedron (70.5 degrees in a regular one). Radius
ratios are 3 r / R of the spheres inside and around it: 1 for a regular one, 0 for a flat one.
docs/reference/checks.md explains every finding, its tolerance and its remedy.

Exit codes: 0 no error found (warnings and notes may be), 1 a mesh with errors, 2 usage, 3 no mesh
can be read from the file, 4 FILE of --write-findings cannot be written.

Examples:
  sunder check meshes/ring.msh
  sunder check body.vtu --json | jq .counts
  sunder check meshes/*.msh --json | jq '.[] | select(.valid | not) | .file'
  sunder check body.inp --write-findings look.vtu
  sunder check part.stl --density 2700
)";

struct CheckArguments : Telling {
  /// One after the other; of each its answer is printed.
  std::vector<std::filesystem::path> meshes;
  std::filesystem::path mesh;
  std::filesystem::path findings;
  bool homology = false;
  std::optional<double> density;
};

/// Tetrahedra up to which homology is computed unasked: 2 us each in solid bodies, 20 in closed
/// ones.
constexpr std::size_t most_unasked = 200000;

/// The homology of a body from its tetrahedra; nothing where its numbers outgrow 64 bits.
std::optional<suite::IntegerHomology> homology_of(const FileMesh& mesh) {
  try {
    const auto twin = suite::glue_twin(mesh.tetrahedra.corners, mesh.points.size());
    return suite::integer_homology(suite::orbit_complex(twin));
  } catch (const std::overflow_error&) {
    return std::nullopt;
  }
}

using Betti = std::array<std::ptrdiff_t, 3>;

Betti betti_of(const suite::IntegerHomology& homology) {
  const auto number = [&](int d) { return static_cast<std::ptrdiff_t>(homology.betti[d]); };
  return {number(0), number(1), number(2)};
}

/// Holds the Betti numbers that boundary sheets tell, if they do, against the homology.
void find_homology(CheckReport& report, const FileMesh& mesh, const CheckArguments& arguments) {
  const std::string name = arguments.mesh.string();
  const bool asked = arguments.homology;
  std::optional<Betti>& told = report.counts->betti;
  if (told && !asked && report.tetrahedra > most_unasked) {
    const bool overlaps = std::ranges::any_of(report.findings, [](const Finding& f) {
      return f.code == "overlapping_faces" || f.code == "overlap_unfinished";
    });
    if (overlaps) told.reset();
    report.findings.push_back(
        {.code = "betti_by_sheets",
         .severity = Severity::note,
         .text = overlaps ? fmt::format("boundary sheets do not give the Betti numbers of {} "
                                        "tetrahedra where some overlap: none are given",
                                        report.tetrahedra)
                          : fmt::format("the Betti numbers of {} tetrahedra follow from boundary "
                                        "sheets: they are right where none overlap",
                                        report.tetrahedra),
         .remedy = "--homology computes them",
         .file = name});
    return;
  }
  const std::optional<suite::IntegerHomology> homology = homology_of(mesh);
  if (!homology) return;
  const Betti found = betti_of(*homology);
  if (told == found && !asked) return;
  report.homology = homology;
  if (told == found) return;
  if (told) {
    // In space the sheets tell them (docs/reference/checks.md).
    report.findings.push_back(
        {.code = "overlapping_body",
         .text = fmt::format(
             "the body overlaps itself: its Betti numbers are {} {} {}, those of a body in "
             "space with its boundary sheets {} {} {}",
             found[0], found[1], found[2], (*told)[0], (*told)[1], (*told)[2]),
         .remedy = "look for parts that pass through each other, and cut one out of the other",
         .file = name});
  }
  told = found;
}

/// Gives the exit code of a failure.
ExitCode write_findings(CheckReport& report, const FileMesh& mesh, const MeshCheck& check) {
  const FileMesh cells = cells_of_findings(mesh, check);
  if (cell_count(cells) == 0) return ExitCode::fine;
  const std::vector<Finding> written = write_file_mesh(report.findings_file, cells);
  report.findings.insert(report.findings.end(), written.begin(), written.end());
  if (has_error(written)) return ExitCode::not_written;
  report.cells_written = cell_count(cells);
  return ExitCode::fine;
}

/// Triangles, quadrilaterals or polygons without a volume cell.
bool is_surface(const FileMesh& mesh) {
  return !has_volume_cells(mesh) && std::ranges::any_of(all_cell_kinds, [&](CellKind kind) {
    return traits_of(kind).dimension == 2 && rows_of(mesh, kind).count > 0;
  });
}

ExitCode report_surface(const CheckArguments& arguments, CheckReport& report,
                        const FileMesh& mesh) {
  report.surface = check_surface(mesh);
  report.is_read = true;
  report.points = mesh.points.size();
  if (!arguments.findings.empty()) {
    report.findings.push_back({.code = "findings_not_written",
                               .severity = Severity::warning,
                               .text = "what is found in a surface is not written as a mesh",
                               .remedy = "look at the numbers in the findings",
                               .file = arguments.mesh.string()});
  }
  for (const Finding& f : report.surface->findings) {
    report.findings.push_back(f);
    report.findings.back().file = arguments.mesh.string();
  }
  std::ranges::stable_sort(report.findings, std::ranges::greater{}, &Finding::severity);
  return has_error(report.findings) ? ExitCode::problems : ExitCode::fine;
}

/// Checks one mesh; the report is to be printed.
ExitCode run_check(const CheckArguments& arguments, CheckReport& report) {
  report.findings_file = arguments.findings;
  ExitCode exit_code = ExitCode::bad_input;
  report.density = arguments.density;
  Stages stages(arguments);
  Result<FileMesh> mesh = read_file_mesh(arguments.mesh);
  stages.done(fmt::format("read {}", arguments.mesh.string()));
  if (mesh && is_surface(*mesh)) {
    report.findings = std::move(mesh.findings);
    const ExitCode found = report_surface(arguments, report, *mesh);
    stages.done("checked the surface");
    return found;
  }
  mesh = only_simplices(std::move(mesh), arguments.mesh.string());
  report.findings = std::move(mesh.findings);
  if (mesh) {
    const MeshCheck check = check_file_mesh(*mesh, !arguments.findings.empty());
    for (const Finding& f : check.findings) {
      report.findings.push_back(f);
      report.findings.back().file = arguments.mesh.string();
    }
    report.is_read = !mesh->tetrahedra.corners.empty();
    report.points = mesh->points.size();
    report.tetrahedra = mesh->tetrahedra.corners.size();
    report.counts = check.counts;
    report.quality = check.quality;
    report.extent = extent_of_tetrahedra(*mesh);
    stages.done(fmt::format("checked the tetrahedra: {}", report.tetrahedra));
    if (report.counts) {
      find_homology(report, *mesh, arguments);
      stages.done("held the Betti numbers against the homology");
    }
    const bool is_bad = has_error(report.findings);
    exit_code = !report.is_read ? ExitCode::bad_input
                : is_bad        ? ExitCode::problems
                                : ExitCode::fine;
    if (!arguments.findings.empty()) {
      const ExitCode failure = write_findings(report, *mesh, check);
      if (failure != ExitCode::fine) exit_code = failure;
      if (report.cells_written > 0)
        stages.done(fmt::format("wrote {}", arguments.findings.string()));
    }
  }
  std::ranges::stable_sort(report.findings, std::ranges::greater{}, &Finding::severity);
  return exit_code;
}

/// Checks all; the exit code is the highest.
ExitCode run_checks(CheckArguments arguments) {
  ExitCode worst = ExitCode::fine;
  const bool several = arguments.meshes.size() > 1;
  auto all = nlohmann::ordered_json::array();
  for (const std::filesystem::path& mesh : arguments.meshes) {
    arguments.mesh = mesh;
    CheckReport report;
    worst = std::max(worst, run_check(arguments, report));
    if (arguments.json) {
      nlohmann::ordered_json json = {{"file", mesh.string()}};
      json.update(report_json(report));
      all.push_back(std::move(json));
      continue;
    }
    if (several)
      print("{}{}:\n", &mesh == arguments.meshes.data() ? "" : "\n", plain_line(mesh.string()));
    print_table(report);
  }
  if (arguments.json) print_json(several ? all : all.front());
  return worst;
}

}  // namespace

void add_check_command(CLI::App& program, ExitCode& exit_code) {
  const auto arguments = std::make_shared<CheckArguments>();
  CLI::App* command =
      program.add_subcommand("check", "Count and measure the cells of a mesh and list its faults");
  command->add_option("MESH", arguments->meshes, "Mesh files; - for standard input")
      ->type_name("FILE")
      ->required();
  command
      ->add_option("--write-findings", arguments->findings,
                   "Write every cell and point that a finding names as a mesh to look at. Its "
                   "ending chooses the format; .vtu keeps everything. Cells have their finding as "
                   "region and column, and their row in MESH")
      ->type_name("FILE")
      ->check([](const std::string& name) {
        return format_of_name(name) ? std::string() : name + " has the ending of no mesh format";
      });
  command->add_flag("--homology", arguments->homology,
                    "Compute and print the homology, for any number of tetrahedra");
  command
      ->add_option("--density", arguments->density,
                   "Print the mass too, for this density in kg/m^3")
      ->type_name("DENSITY")
      ->check(CLI::PositiveNumber);
  add_verbose_flag(*command, *arguments);
  command->add_flag("--json", arguments->json, "Print JSON instead of a table");
  command->footer(check_footer);
  command->callback([=, &exit_code] {
    std::error_code cannot_compare;
    if (!arguments->findings.empty() && arguments->meshes.size() > 1) {
      throw CLI::ValidationError("--write-findings", "goes with one MESH");
    }
    if (std::filesystem::equivalent(arguments->meshes[0], arguments->findings, cannot_compare)) {
      throw CLI::ValidationError("--write-findings", "FILE is MESH itself");
    }
    exit_code = run_checks(*arguments);
  });
}

}  // namespace sunder
