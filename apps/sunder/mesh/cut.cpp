// SPDX-License-Identifier: MIT
// `sunder cut`: the command line, and the two ways to cut.
#include "apps/sunder/mesh/cut.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "apps/scene/words.hpp"
#include "apps/sunder/mesh/divided_mesh.hpp"
#include "topology/base/counted.hpp"
#include "topology/cells/plane_cut.hpp"
#include "topology/mesh/crack.hpp"

namespace sunder {
namespace {

constexpr const char* cut_footer = R"(
With --exact the tetrahedra that the plane passes through are divided by it: the section is flat, and
each side keeps its volume to rounding. A plane that nearly passes through a point leaves thin
tetrahedra there (the table lists the least radius ratio). A point counts as in the plane when an edge
would be divided nearer to it than --tolerance times that edge. The default, 1e-12, takes only points
within rounding. With 1e-6 `sunder check` finds no flat or close tetrahedra. The section and the
volumes of its sides are then right to a millionth of an edge. Without --exact the cut follows the faces
between tetrahedra with their centres on different sides, and no tetrahedron changes.
Points of the section are copied where the sides come apart, and each side has its own. Triangles,
edges, regions, entities and data are kept as in `sunder refine`.

Exit codes: 0 written, 2 usage (also a plane that no tetrahedron meets), 3 the mesh cannot be read or
has no map, 4 OUT not written.

Examples:
  sunder cut body.msh halves.msh --plane 1,0,0,0.5 --exact
  sunder cut body.msh halves.vtu --plane 0,0,1,0 --exact --share mass --json
  sunder cut body.msh halves.msh --plane 0,1,0,0.2 --exact --tolerance 1e-6
)";

struct CutArguments : DivideArguments {
  std::string plane;
  bool exact = false;
  double tolerance = 1e-12;
};

/// How near to an end of its edge a new vertex lies, as a part of the edge; 1/2 when there is none.
double nearest_to_an_end(const CellEdit& edit) {
  double nearest = 0.5;
  for (const MiddleVertex& v : edit.vertices) {
    nearest = std::min({nearest, v.weight, 1 - v.weight});
  }
  return nearest;
}

/// Divides the tetrahedra by the plane; gives the faces to cut, by the rows of the mesh.
Result<CutFaces> exact_faces(const CuttingPlane& plane, double tolerance, DividedMesh& body,
                             const std::set<std::string>& shared, std::string& lines,
                             nlohmann::ordered_json& json) {
  const auto cut = cut_cells(body.map, plane, tolerance);
  if (!cut) return cut.findings.front();
  const DividedFile file = divide_file(body.mesh, body.map, std::span(&cut->edit, 1), shared);
  CutFaces faces;
  for (const HalfFaceId f : cut->faces) {
    faces.push_back(std::min(f, body.map.neighbour(f)).value);
  }
  std::ranges::sort(faces);
  lines += fmt::format("{} divided at {}; {} of before {} in the plane\n",
                       counted_tetrahedra(file.divided[3]),
                       counted(cut->edit.vertices.size(), "new point"),
                       counted(cut->on_plane, "point"), for_count(cut->on_plane, "lies", "lie"));
  json["divided"] = file.divided[3];
  json["new_vertices"] = cut->edit.vertices.size();
  json["on_plane"] = cut->on_plane;
  const double nearest = nearest_to_an_end(cut->edit);
  json["nearest_to_an_end"] = nearest;
  if (nearest < 1e-6) {
    lines += fmt::format(
        "an edge was divided at {:.1e} of its length: --tolerance 1e-6 takes its end for a point "
        "in the "
        "plane\n",
        nearest);
  }
  return faces;
}

ExitCode run_cut(const CutArguments& arguments) {
  Stages stages(arguments);
  Result<DividedMesh> body = read_to_divide(arguments.in, arguments.kernel);
  if (!body) return refuse(arguments, body.findings, ExitCode::bad_input);
  stages.done(fmt::format("read {} and built its map", arguments.in.string()));
  const auto shared = shared_columns(arguments, body->mesh);
  if (!shared) return refuse(arguments, shared.findings, ExitCode::usage);
  const std::vector<double> x = *numbers_of(arguments.plane, 4);
  const CuttingPlane plane{{x[0], x[1], x[2]}, x[3]};
  std::string lines;
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  Result<CutFaces> faces;
  if (arguments.exact) {
    faces = exact_faces(plane, arguments.tolerance, *body, *shared, lines, json);
  }
  const Result<FaceLinks> links = face_links(body->mesh);
  if (!links) return refuse(arguments, links.findings, ExitCode::bad_input);
  if (!arguments.exact) faces = section_faces(body->mesh, *links, plane);
  if (!faces) return refuse(arguments, faces.findings, ExitCode::usage);
  if (faces->empty()) {
    return refuse(arguments,
                  {{.code = "no_face",
                    .text = "the plane passes through no tetrahedron and along no inner face",
                    .remedy = "`sunder check` prints the size of the body; give another offset D"}},
                  ExitCode::usage);
  }
  const Crack crack = open_crack(body->mesh, *links, *faces);
  lines += fmt::format("{} cut, {} copied{}\n", counted(faces->size(), "face"),
                       counted(crack.copies.size(), "point"),
                       crack.closed_faces == 0
                           ? ""
                           : fmt::format("; {} of the faces {} not open", crack.closed_faces,
                                         for_count(crack.closed_faces, "does", "do")));
  json["faces_cut"] = faces->size();
  json["points_copied"] = crack.copies.size();
  json["closed_faces"] = crack.closed_faces;
  stages.done("cut the mesh");
  return finish(arguments, *body, lines, json);
}

}  // namespace

void add_cut_command(CLI::App& program, ExitCode& exit_code) {
  const auto arguments = std::make_shared<CutArguments>();
  CLI::App* command = program.add_subcommand("cut", "Cut a mesh in two by a plane");
  add_divide_arguments(*command, *arguments);
  command
      ->add_option("--plane", arguments->plane,
                   "The plane NX x + NY y + NZ z = D (D in m for a unit normal)")
      ->type_name("NX,NY,NZ,D")
      ->check(CLI::Validator(check_plane, "", "plane"))
      ->required();
  CLI::Option* exact =
      command->add_flag("--exact", arguments->exact, "Divide the tetrahedra that the plane meets");
  command
      ->add_option("--tolerance", arguments->tolerance,
                   "Share of an edge: no edge is divided nearer to its end (default 1e-12)")
      ->type_name("PART")
      ->check(CLI::Range(0.0, 0.01))
      ->needs(exact);
  command->footer(cut_footer);
  command->callback([=, &exit_code] { exit_code = run_cut(*arguments); });
}

}  // namespace sunder
