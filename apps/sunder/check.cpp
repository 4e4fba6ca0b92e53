// SPDX-License-Identifier: MIT
// `sunder check`: reads a mesh, builds its 3-map, counts its cells, lists every finding.
#include "apps/sunder/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "apps/sunder/words.hpp"
#include "topology/build_map.hpp"
#include "topology/invariants.hpp"
#include "topology/io/mesh_file.hpp"

namespace sunder {
namespace {

constexpr const char* footer = R"(
MESH is Gmsh MSH 2.x or 4.1 (ASCII), MEDIT .mesh (ASCII) or VTU; its content decides, not its name.
Coordinates are taken as metres, volumes are m^3. Vertices, edges and faces are counted as orbits
of the 3-map: cells that only touch are not joined. Numbers in brackets are rows counted from 0.

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
};

CheckReport check(const std::filesystem::path& path) {
  CheckReport report;
  Result<TetMesh> mesh = read_mesh(path);
  report.findings = std::move(mesh.findings);
  if (!mesh) return report;
  report.is_read = true;
  report.mesh = std::move(*mesh);
  // Flat tetrahedra do not hinder counting, but a body of them cannot be computed with.
  Result<VolumeMap> map = build_map(report.mesh, Severity::warning);
  for (Finding& f : map.findings) {
    if (f.code == "flat_tetrahedron" || f.code == "folded_tetrahedron")
      f.severity = Severity::error;
    f.file = path.string();
    report.findings.push_back(std::move(f));
  }
  std::stable_sort(report.findings.begin(), report.findings.end(),
                   [](const Finding& a, const Finding& b) { return a.severity > b.severity; });
  if (map) report.counts = count_cells(*map);
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
  json["findings"] = findings_json(report.findings);
  json["valid"] = !has_error(report.findings);
  fmt::print("{}\n", json.dump(2));
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
