// SPDX-License-Identifier: MIT
// `sunder split`: the command line, the splitting face by face, and the printed results.
#include "apps/sunder/mesh/split.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "apps/scene/json_text.hpp"
#include "apps/scene/words.hpp"
#include "apps/sunder/mesh/split_faces.hpp"
#include "apps/sunder/mesh/split_output.hpp"
#include "apps/sunder/program.hpp"
#include "apps/sunder/static/static_fan.hpp"
#include "topology/base/counted.hpp"
#include "topology/base/whole_number.hpp"
#include "topology/io/files/printing.hpp"
#include "topology/io/mesh_file.hpp"
#include "topology/kernel/invariants.hpp"
#include "topology/kernel/split_face.hpp"
#include "topology/mesh/build_map.hpp"

namespace sunder {
namespace {

constexpr const char* split_footer = R"(
One of --faces, --fan and --plane chooses the faces. All are found on the intact mesh and then split
one after the other. Points are rows of the mesh file, counted from 0, and lengths are metres. A face
that is not interior is reported in its row of the result, and changes nothing.

The result has the counts before and after, and a row per face in the order of splitting:
  the vertices and edges that came apart
  whether all three vertices did, which is the oracle
  whether a new component came off
  the number of tetrahedra that the search for components visited
--oracle chooses that search. The result is the same, and only the cost differs:
  exact  if the oracle predicts a component, from both sides of the face until one side is complete
  paper  if the oracle predicts a component, the whole component (algorithm 4 of the paper)
  walk   the whole component after every face

With -o the cut mesh is written. Every copy of a vertex is a point of its own, and the region of a
tetrahedron is its component, numbered from 1. Vertex numbers cannot express a cut face whose two
sides still have the same three points. Such faces are listed in OUT.cuts, and
`sunder split OUT --faces OUT.cuts` restores the same map. Where there is none, an OUT.cuts of an
earlier run is removed.

Exit codes: 0 done, 2 usage (also an impossible vertex or normal), 3 mesh or list of faces
unreadable or invalid, 4 OUT or OUT.cuts not written.

Examples:
  sunder split meshes/two_tets.msh --plane 0,0,1,0 -o halves.vtu
  sunder split meshes/cube.msh --fan 13,1,0,0 --json
  echo "1 4 14" > faces.txt && sunder split meshes/cube.msh --faces faces.txt
)";

struct SplitArguments : Telling {
  std::filesystem::path mesh;
  std::filesystem::path faces;
  std::string fan;
  std::string plane;
  std::filesystem::path output;
  FaceOrder order = FaceOrder::given;
  Detection oracle = Detection::exact;
  MapKernel kernel = MapKernel::dense;
};

/// The result of splitting one face.
struct SplitRow {
  FaceRequest request;
  /// Empty when it was split.
  std::string error;
  bool oracle = false;
  bool new_component = false;
  /// Tetrahedra that the search for components looked at.
  std::size_t visited = 0;
  /// Rows of the file's points, in rising order.
  std::vector<std::uint32_t> vertices;
  std::vector<std::array<std::uint32_t, 2>> edges;
};

struct SplitAnswer {
  std::size_t file_vertices = 0;
  Counts before, after;
  std::vector<SplitRow> rows;
};

std::size_t visited_by_all(const SplitAnswer& answer) {
  std::size_t sum = 0;
  for (const SplitRow& row : answer.rows) sum += row.visited;
  return sum;
}

SplitRow row_of(const VolumeMap& map, const FaceRequest& request, const FaceSplit& split) {
  SplitRow row{.request = request, .oracle = oracle_says_new(split)};
  for (int i = 0; i < split.vertex_count; ++i) {
    row.vertices.push_back(map.point_of_vertex(split.split_vertices[i].old_row));
  }
  for (int i = 0; i < 3; ++i) {
    if ((split.split_edges >> i & 1) == 0) continue;
    const std::uint32_t a = map.point_of_vertex(split.vertices[i]);
    const std::uint32_t b = map.point_of_vertex(split.vertices[(i + 1) % 3]);
    row.edges.push_back({std::min(a, b), std::max(a, b)});
  }
  std::sort(row.vertices.begin(), row.vertices.end());
  std::sort(row.edges.begin(), row.edges.end());
  return row;
}

/// Splits the faces one after the other; `components` follows. Fills the rows and both counts.
void split_all(VolumeMap& map, const std::vector<FaceRequest>& requests, Detection detection,
               Components& components, SplitAnswer& answer) {
  ComponentScratch scratch;
  std::vector<FaceSplit> splits;
  std::vector<SplitRow>& rows = answer.rows;
  answer.before = count_cells(map);
  const std::size_t pieces = components.size.size();
  for (const FaceRequest& request : requests) {
    if (std::string error = refusal_of(map, request); !error.empty()) {
      rows.push_back({.request = request, .error = std::move(error)});
      continue;
    }
    const FaceSplit split = split_face(map, request.face);
    const ComponentUpdate update =
        update_components(map, std::span(&split, 1), detection, components, scratch);
    rows.push_back(row_of(map, request, split));
    rows.back().new_component = update.created > 0;
    rows.back().visited = update.visited;
    splits.push_back(split);
  }
  answer.after = counts_after(answer.before, map, splits, components.size.size() - pieces);
}

nlohmann::ordered_json counts_json(std::size_t file_vertices, const Counts& counts) {
  nlohmann::ordered_json json = cell_counts_json(file_vertices, counts);
  json.update(invariants_json(counts));
  return json;
}

void print_split_json(const SplitAnswer& answer, const std::vector<Finding>& findings) {
  nlohmann::ordered_json splits = nlohmann::ordered_json::array();
  for (const SplitRow& row : answer.rows) {
    if (!row.error.empty()) {
      splits.push_back({{"face", row.request.points}, {"error", row.error}});
      continue;
    }
    splits.push_back({{"face", row.request.points},
                      {"split_vertices", row.vertices},
                      {"split_edges", row.edges},
                      {"oracle", row.oracle},
                      {"new_component", row.new_component},
                      {"visited", row.visited}});
  }
  const nlohmann::ordered_json json{{"before", counts_json(answer.file_vertices, answer.before)},
                                    {"after", counts_json(answer.file_vertices, answer.after)},
                                    {"splits", splits},
                                    {"visited", visited_by_all(answer)},
                                    {"findings", findings_json(findings)}};
  print_json(json);
}

void print_counts(const SplitAnswer& answer) {
  const auto line = [](std::string_view name, auto before, auto after) {
    print("{:<22}{:>12}{:>12}\n", name, before, after);
  };
  const Counts &a = answer.before, &b = answer.after;
  line("", "before", "after");
  line("vertices", a.vertices, b.vertices);
  line("edges", a.edges, b.edges);
  line("faces", a.faces, b.faces);
  line("tetrahedra", a.tetrahedra, b.tetrahedra);
  line("components", a.components, b.components);
  line("boundary faces", a.boundary_faces, b.boundary_faces);
  line("boundary sheets", a.boundary_sheets, b.boundary_sheets);
  line("Euler characteristic", a.euler_characteristic, b.euler_characteristic);
  line("Betti numbers", betti_text(a), betti_text(b));
  line("volume, m^3", fmt::format("{:.6g}", a.volume), fmt::format("{:.6g}", b.volume));
  print("\nvisited by the search for components: {}\n", counted_tetrahedra(visited_by_all(answer)));
}

void print_table(const SplitAnswer& answer) {
  print_counts(answer);
  print("\n{:<22}{:<20}{:<36}{:<8}{:<15}{}\n", "face", "vertices split", "edges split", "oracle",
        "new component", "visited");
  for (const SplitRow& row : answer.rows) {
    const std::string face = fmt::format("{}", fmt::join(row.request.points, " "));
    if (!row.error.empty()) {
      print("{:<22}{}\n", face, row.error);
      continue;
    }
    std::string edges;
    for (const auto& edge : row.edges) {
      edges += fmt::format("{}{}-{}", edges.empty() ? "" : " ", edge[0], edge[1]);
    }
    print("{:<22}{:<20}{:<36}{:<8}{:<15}{}\n", face,
          row.vertices.empty() ? "-" : fmt::format("{}", fmt::join(row.vertices, " ")),
          edges.empty() ? "-" : edges, row.oracle ? "yes" : "no", row.new_component ? "yes" : "no",
          row.visited);
  }
}

/// The faces that the arguments choose. The lists have been checked on the command line.
Result<std::vector<FaceRequest>> requested_faces(const VolumeMap& map,
                                                 const SplitArguments& arguments) {
  if (!arguments.fan.empty()) {
    const std::vector<double> x = *numbers_of(arguments.fan, 4);
    return faces_of_fan(map, whole_number<std::uint32_t>(x[0]), {x[1], x[2], x[3]});
  }
  if (!arguments.plane.empty()) {
    const std::vector<double> x = *numbers_of(arguments.plane, 4);
    return faces_of_plane(map, {.normal = {x[0], x[1], x[2]}, .offset = x[3]});
  }
  return faces_of_file(map, arguments.faces);
}

ExitCode refuse(const SplitArguments& arguments, const std::vector<Finding>& findings,
                ExitCode exit_code) {
  tell(findings, arguments);
  return exit_code;
}

ExitCode run_split(const SplitArguments& arguments) {
  Stages stages(arguments);
  Result<TetMesh> mesh = read_mesh(arguments.mesh);
  if (!mesh) return refuse(arguments, mesh.findings, ExitCode::bad_input);
  stages.done(fmt::format("read {}", arguments.mesh.string()));
  Result<VolumeMap> map = build_map(*mesh, Severity::warning, arguments.kernel);
  std::vector<Finding> findings = std::move(mesh.findings);
  for (Finding& f : map.findings) {
    f.file = arguments.mesh.string();
    findings.push_back(std::move(f));
  }
  if (!map) return refuse(arguments, findings, ExitCode::bad_input);
  stages.done(fmt::format("built the map, tetrahedra: {}", map->tetrahedra()));
  Result<std::vector<FaceRequest>> requests = requested_faces(*map, arguments);
  if (!requests) {
    const bool from_file = !arguments.faces.empty();
    return refuse(arguments, requests.findings, from_file ? ExitCode::bad_input : ExitCode::usage);
  }
  stages.done(fmt::format("found the faces: {}", requests->size()));
  order_requests(*map, arguments.order, *requests);

  SplitAnswer answer{.file_vertices = mesh->points.size()};
  Components components = label_components(*map);
  split_all(*map, *requests, arguments.oracle, components, answer);
  stages.done("split them");
  if (!arguments.output.empty()) {
    const auto written = write_cut_body(arguments.output, {*mesh, *map, components});
    findings.insert(findings.end(), written.begin(), written.end());
    if (!has_error(written)) stages.done(fmt::format("wrote {}", arguments.output.string()));
  }
  arguments.json ? print_split_json(answer, findings) : print_table(answer);
  tell_beside(findings, arguments);
  return has_error(findings) ? ExitCode::not_written : ExitCode::fine;
}

void add_options(CLI::App& command, SplitArguments& arguments) {
  command.add_option("MESH", arguments.mesh, "Mesh file, in any format that sunder convert reads")
      ->type_name("FILE")
      ->required();
  CLI::Option_group* which = command.add_option_group("faces to split (one of these)");
  which->add_option("--faces", arguments.faces, "Text file: three rows of points per line")
      ->type_name("FILE");
  which
      ->add_option("--fan", arguments.fan,
                   "The fan at point V of the plane through it with normal (NX, NY, NZ)")
      ->type_name("V,NX,NY,NZ")
      ->check(CLI::Validator(check_fan_text, "", "fan"));
  which
      ->add_option("--plane", arguments.plane,
                   "The section of the plane NX x + NY y + NZ z = D (D in m for a unit normal)")
      ->type_name("NX,NY,NZ,D")
      ->check(CLI::Validator(check_plane, "", "plane"));
  which->require_option(1);
  command
      .add_option("--order", arguments.order,
                  "Order of the splits: given (as listed, else by rising tetrahedron; default), "
                  "paper (surface first)")
      ->type_name("given|paper")
      ->transform(
          CLI::CheckedTransformer(std::map<std::string, FaceOrder>{{"given", FaceOrder::given},
                                                                   {"paper", FaceOrder::paper}})
              .description(""));
  command
      .add_option("--kernel", arguments.kernel,
                  "Kernel of the map: dense (rows, default) or lcc (CGAL's darts); same result")
      ->type_name("dense|lcc")
      ->transform(CLI::CheckedTransformer(std::map<std::string, MapKernel>{
                                              {"dense", MapKernel::dense}, {"lcc", MapKernel::lcc}})
                      .description(""));
  command
      .add_option("--oracle", arguments.oracle,
                  "Search for components: exact (default), paper, walk; same result")
      ->type_name("exact|paper|walk")
      ->transform(
          CLI::CheckedTransformer(std::map<std::string, Detection>{{"exact", Detection::exact},
                                                                   {"paper", Detection::oracle},
                                                                   {"walk", Detection::walk}})
              .description(""));
  command
      .add_option("-o,--output", arguments.output, "Write the cut mesh; its format by OUT's ending")
      ->type_name("OUT");
  add_telling_flags(command, arguments);
  command.add_flag("--json", arguments.json, "Print JSON instead of tables");
}

}  // namespace

void add_split_command(CLI::App& program, ExitCode& exit_code) {
  const auto arguments = std::make_shared<SplitArguments>();
  CLI::App* command = program.add_subcommand("split", "Split faces of a mesh and report the parts");
  add_options(*command, *arguments);
  command->footer(split_footer);
  command->callback([=, &exit_code] { exit_code = run_split(*arguments); });
}

}  // namespace sunder
