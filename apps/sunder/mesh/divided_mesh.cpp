// SPDX-License-Identifier: MIT
// Reading, writing and telling for the commands that divide cells.
#include "apps/sunder/mesh/divided_mesh.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <iterator>
#include <map>

#include "apps/scene/json_text.hpp"
#include "apps/scene/words.hpp"
#include "apps/sunder/program.hpp"
#include "topology/base/split_text.hpp"
#include "topology/io/files/printing.hpp"
#include "topology/io/mesh_file.hpp"
#include "topology/mesh/build_map.hpp"

namespace sunder {
namespace {

MeshState state_of(const FileMesh& mesh) {
  return {{mesh.points.size(), mesh.edges.corners.size(), mesh.triangles.corners.size(),
           mesh.tetrahedra.corners.size()},
          check_file_mesh(mesh)};
}

nlohmann::ordered_json state_json(const MeshState& state) {
  const auto& [points, edges, triangles, tetrahedra] = state.sizes;
  nlohmann::ordered_json json{
      {"points", points}, {"edges", edges}, {"triangles", triangles}, {"tetrahedra", tetrahedra}};
  if (state.check.counts) {
    json["components"] = state.check.counts->components;
    json.update(invariants_json(*state.check.counts));
  }
  if (state.check.quality) {
    json["radius_ratio"] = {{"smallest", state.check.quality->smallest_radius_ratio.value},
                            {"mean", state.check.quality->mean_radius_ratio}};
  }
  return json;
}

constexpr std::array<std::string_view, 10> row_names = {"points",
                                                        "edges (1-D)",
                                                        "triangles",
                                                        "tetrahedra",
                                                        "components",
                                                        "Euler characteristic",
                                                        "Betti numbers",
                                                        "volume, m^3",
                                                        "radius ratio, least",
                                                        "radius ratio, mean"};

/// A column of the table; "-" where a check could not tell.
std::array<std::string, 10> column_of(const MeshState& state) {
  std::array<std::string, 10> words;
  words.fill("-");
  for (std::size_t i = 0; i < 4; ++i) words[i] = fmt::format("{}", state.sizes[i]);
  if (state.check.counts) {
    const Counts& c = *state.check.counts;
    words[4] = fmt::format("{}", c.components);
    words[5] = fmt::format("{}", c.euler_characteristic);
    words[6] = betti_text(c);
    words[7] = fmt::format("{:.10g}", c.volume);
  }
  if (state.check.quality) {
    words[8] = fmt::format("{:.4f}", state.check.quality->smallest_radius_ratio.value);
    words[9] = fmt::format("{:.4f}", state.check.quality->mean_radius_ratio);
  }
  return words;
}

void print_table(const MeshState& before, const MeshState& after) {
  const auto left = column_of(before), right = column_of(after);
  print("{:<22}{:>18}{:>18}\n", "", "before", "after");
  for (std::size_t i = 0; i < row_names.size(); ++i) {
    print("{:<22}{:>18}{:>18}\n", row_names[i], left[i], right[i]);
  }
}

}  // namespace

Result<DividedMesh> read_to_divide(const std::filesystem::path& in, MapKernel kernel) {
  Result<FileMesh> mesh = read_file_mesh(in, {.simplices = true});
  Result<DividedMesh> result;
  result.findings = std::move(mesh.findings);
  if (!mesh) return result;
  FileMesh copy = *mesh;
  const TetMesh tetrahedra = tet_mesh_of(std::move(copy));
  Result<VolumeMap> map = build_map(tetrahedra, Severity::warning, kernel);
  for (Finding& f : map.findings) f.file = in.string();
  if (!map) {
    std::ranges::move(map.findings, std::back_inserter(result.findings));
    return result;
  }
  MeshState before = state_of(*mesh);
  result.value.emplace(DividedMesh{std::move(*mesh), std::move(*map), {}, std::move(before)});
  result->findings = std::move(result.findings);
  std::ranges::move(map.findings, std::back_inserter(result->findings));
  return result;
}

void add_divide_arguments(CLI::App& command, DivideArguments& arguments) {
  command.add_option("MESH", arguments.in, "Mesh file, in any format that sunder convert reads")
      ->type_name("FILE")
      ->required();
  command.add_option("OUT", arguments.out, "Mesh file to write; its format by OUT's ending")
      ->type_name("FILE")
      ->required();
  command
      .add_option("--share", arguments.shared,
                  "Columns of tetrahedra to divide by volume among parts (masses, energies); all "
                  "others are copied")
      ->type_name("NAME,NAME");
  command
      .add_option("--kernel", arguments.kernel,
                  "Kernel of the map: dense (rows, default) or lcc (CGAL's darts); same result")
      ->type_name("dense|lcc")
      ->transform(CLI::CheckedTransformer(std::map<std::string, MapKernel>{
                                              {"dense", MapKernel::dense}, {"lcc", MapKernel::lcc}})
                      .description(""));
  add_telling_flags(command, arguments);
  command.add_flag("--json", arguments.json, "Print JSON instead of a table");
}

Result<std::set<std::string>> shared_columns(const DivideArguments& arguments,
                                             const FileMesh& mesh) {
  std::set<std::string> names;
  for (const std::string_view name : split_text(arguments.shared, ',')) {
    const bool is_there = std::ranges::any_of(mesh.tetrahedra.data, [&](const DataColumn& column) {
      return column.name == name && std::holds_alternative<std::vector<double>>(column.values);
    });
    if (!is_there) {
      std::string known;
      for (const DataColumn& column : mesh.tetrahedra.data) known += " '" + column.name + "'";
      return Finding{.code = "unknown_column",
                     .text = fmt::format("no column of tetrahedra '{}' holds fractions", name),
                     .remedy = known.empty()
                                   ? "the file has no data of tetrahedra: leave --share out"
                                   : "the columns are" + known};
    }
    names.emplace(name);
  }
  return names;
}

ExitCode refuse(const DivideArguments& arguments, const std::vector<Finding>& findings,
                ExitCode code) {
  tell(findings, arguments);
  return code;
}

ExitCode finish(const DivideArguments& arguments, DividedMesh& body, const std::string& lines,
                const nlohmann::ordered_json& json) {
  Stages stages(arguments);
  const MeshState after = state_of(body.mesh);
  for (const Finding& f : after.check.findings) {
    const bool was_there = std::ranges::any_of(body.before.check.findings,
                                               [&](const Finding& g) { return g.code == f.code; });
    if (f.severity != Severity::note && !was_there) body.findings.push_back(f);
  }
  stages.done("checked what came out");
  const std::vector<Finding> written = write_file_mesh(arguments.out, body.mesh, {});
  if (!has_error(written)) stages.done(fmt::format("wrote {}", arguments.out.string()));
  std::ranges::copy(written, std::back_inserter(body.findings));
  if (arguments.json) {
    nlohmann::ordered_json all{{"before", state_json(body.before)}, {"after", state_json(after)}};
    all.update(json);
    all["findings"] = findings_json(body.findings);
    print_json(all);
  } else {
    print_table(body.before, after);
    print("\n{}", lines);
  }
  tell_beside(body.findings, arguments);
  return has_error(written) ? ExitCode::not_written : ExitCode::fine;
}

}  // namespace sunder
