// SPDX-License-Identifier: MIT
// `sunder check`: reads a mesh, builds its 3-map, counts its cells, lists every finding.
#include "apps/sunder/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "apps/sunder/words.hpp"
#include "topology/build_map.hpp"
#include "topology/invariants.hpp"
#include "topology/io/mesh_file.hpp"
#include "topology/suite/homology.hpp"

namespace sunder {
namespace {

constexpr const char* footer = R"(
MESH is Gmsh MSH 1 to 4.1 (text or binary), MEDIT, VTU or legacy VTK, packed by gzip
or not; its content decides, not its name.
Coordinates are taken as metres, volumes are m^3. Vertices, edges and faces are counted as orbits
of the 3-map: cells that only touch are not joined. Numbers in brackets are rows counted from 0.
Betti numbers follow from boundary sheets where the body lies in space; where it is flat, folded or
has no boundary they are those of its homology over the integers, which is told with its torsion.

Exit codes: 0 no error found (warnings and notes may be), 1 a mesh with errors, 2 usage, 3 no mesh
can be read from the file.

Examples:
  sunder check meshes/ring.msh
  sunder check body.vtu --json | jq .counts
)";

/// What is known of a mesh in the end; `counts` where a map could be built.
struct CheckReport {
  std::vector<Finding> findings;
  bool is_read = false;
  TetMesh mesh;
  std::optional<Counts> counts;
  /// Where the body may not lie in space, so that its sheets do not tell its Betti numbers.
  std::optional<suite::IntegerHomology> homology;
};

/// The homology of a body from its tetrahedra; nothing where its numbers outgrow 64 bits.
std::optional<suite::IntegerHomology> homology_of(const TetMesh& mesh) {
  try {
    const auto twin = suite::glue_twin(mesh.tetrahedra, mesh.points.size());
    return suite::integer_homology(suite::orbit_complex(twin));
  } catch (const std::overflow_error&) {
    return std::nullopt;
  }
}

CheckReport check(const std::filesystem::path& path) {
  CheckReport report;
  Result<TetMesh> mesh = read_mesh(path);
  report.findings = std::move(mesh.findings);
  if (!mesh) return report;
  report.is_read = true;
  report.mesh = std::move(*mesh);
  // Flat tetrahedra do not hinder counting, but a body of them cannot be computed with.
  Result<VolumeMap> map = build_map(report.mesh, Severity::warning);
  bool is_in_space = true;
  for (Finding& f : map.findings) {
    if (f.code == "flat_tetrahedron" || f.code == "folded_tetrahedron") {
      f.severity = Severity::error;
      is_in_space = false;
    }
    f.file = path.string();
    report.findings.push_back(std::move(f));
  }
  std::stable_sort(report.findings.begin(), report.findings.end(),
                   [](const Finding& a, const Finding& b) { return a.severity > b.severity; });
  if (!map) return report;
  report.counts = count_cells(*map);
  if (is_in_space && report.counts->betti) return report;
  report.counts->betti.reset();
  report.homology = homology_of(report.mesh);
  if (!report.homology) return report;
  const auto number = [&report](int d) {
    return static_cast<std::ptrdiff_t>(report.homology->betti[d]);
  };
  report.counts->betti = {number(0), number(1), number(2)};
  return report;
}

void print_json(const CheckReport& report) {
  nlohmann::ordered_json json;
  Counts unknown;
  unknown.tetrahedra = report.mesh.tetrahedra.size();
  json["counts"] =
      cell_counts_json(report.mesh.points.size(), report.counts ? *report.counts : unknown);
  json.update(invariants_json(report.counts ? *report.counts : unknown));
  if (!report.counts) {
    // Nothing is claimed that was not counted.
    for (auto& [key, value] : json["counts"].items()) {
      const bool known = report.is_read && (key == "file_vertices" || key == "tetrahedra");
      if (!known) value = nullptr;
    }
    for (const char* key : {"euler_characteristic", "betti", "volume"}) json[key] = nullptr;
  }
  if (report.homology) {
    json["homology"] = {{"betti", report.homology->betti}, {"torsion", report.homology->torsion}};
  }
  json["findings"] = findings_json(report.findings);
  json["valid"] = !has_error(report.findings);
  fmt::print("{}\n", json.dump(2));
}

/// "Z^2 + Z/3" of one dimension; "0" for nothing.
std::string group_text(const suite::IntegerHomology& homology, std::size_t dimension) {
  std::string text;
  const auto add = [&text](const std::string& part) {
    if (!text.empty()) text += " + ";
    text += part;
  };
  const std::size_t rank = homology.betti[dimension];
  if (rank > 0) add(rank == 1 ? "Z" : fmt::format("Z^{}", rank));
  for (const std::uint64_t n : homology.torsion[dimension]) add(fmt::format("Z/{}", n));
  return text.empty() ? "0" : text;
}

void print_homology(const suite::IntegerHomology& homology) {
  fmt::print("homology            ");
  for (std::size_t d = 0; d < 4; ++d) fmt::print(" H{} = {}", d, group_text(homology, d));
  fmt::print("\n");
}

void print_table(const CheckReport& report) {
  if (report.is_read) {
    fmt::print("points in the file  {:>10}\ntetrahedra          {:>10}\n",
               report.mesh.points.size(), report.mesh.tetrahedra.size());
  }
  if (report.counts) {
    const Counts& c = *report.counts;
    fmt::print(
        "vertices            {:>10}\nedges               {:>10}\nfaces               {:>10}\n",
        c.vertices, c.edges, c.faces);
    fmt::print(
        "components          {:>10}\nboundary faces      {:>10}\nboundary sheets     {:>10}\n",
        c.components, c.boundary_faces, c.boundary_sheets);
    fmt::print(
        "Euler characteristic{:>10}\nBetti numbers       {:>10}\nvolume, m^3         {:>10.6g}\n",
        c.euler_characteristic, betti_text(c), c.volume);
  }
  if (report.homology) print_homology(*report.homology);
  fmt::print("{}{}\n", finding_lines(report.findings),
             has_error(report.findings) ? "not valid" : "valid");
}

ExitCode run_check(const std::filesystem::path& path, bool as_json) {
  const CheckReport report = check(path);
  as_json ? print_json(report) : print_table(report);
  if (!report.is_read) return ExitCode::bad_input;
  return has_error(report.findings) ? ExitCode::problems : ExitCode::fine;
}

}  // namespace

void add_check_command(CLI::App& program, ExitCode& exit_code) {
  struct Arguments {
    std::filesystem::path mesh;
    bool json = false;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      program.add_subcommand("check", "Count the cells of a mesh and list what is wrong with it");
  command->add_option("MESH", arguments->mesh, "Mesh file (.msh, .mesh, .vtu)")
      ->type_name("FILE")
      ->required();
  command->add_flag("--json", arguments->json, "Print JSON instead of a table");
  command->footer(footer);
  command->callback([=, &exit_code] { exit_code = run_check(arguments->mesh, arguments->json); });
}

}  // namespace sunder
