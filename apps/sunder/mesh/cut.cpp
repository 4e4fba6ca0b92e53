// SPDX-License-Identifier: MIT
// `sunder cut`: the command line, and the two ways to cut.
#include "apps/sunder/mesh/cut.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "apps/scene/words.hpp"
#include "apps/sunder/mesh/divided_mesh.hpp"
#include "topology/cells/plane_cut.hpp"
#include "topology/mesh/crack.hpp"

namespace sunder {
namespace {

constexpr const char* footer = R"(
With --exact the tetrahedra that the plane passes through are divided by it: the section is flat, and
each side keeps its volume to rounding. A plane that nearly passes through a point leaves thin
tetrahedra there (the table tells the least radius ratio); a point is taken to lie in the plane when
no edge's middle could be told from it. Without --exact the cut follows the faces between tetrahedra
with their centres on different sides, and no tetrahedron changes.
Points of the section are copied where the sides come apart; each side has its own. Triangles, edges,
regions, entities and data go along as in `sunder refine`.

Exit codes: 0 written, 2 usage (also a plane that no tetrahedron meets), 3 the mesh cannot be read or
has no map, 4 OUT not written.

Examples:
  sunder cut body.msh halves.msh --plane 1,0,0,0.5 --exact
  sunder cut body.msh halves.vtu --plane 0,0,1,0 --exact --share mass --json
)";

struct CutArguments : DivideArguments {
  std::string plane;
  bool exact = false;
};

/// Divides the tetrahedra by the plane; gives the faces to cut, by the rows of the mesh.
Result<CutFaces> exact_faces(const CuttingPlane& plane, DividedMesh& body,
                             const std::set<std::string>& shared, std::string& lines,
                             nlohmann::ordered_json& json) {
  const auto cut = cut_cells(body.map, plane);
  if (!cut) return cut.findings.front();
  const DividedFile file = divide_file(body.mesh, body.map, std::span(&cut->edit, 1), shared);
  CutFaces faces;
  for (const HalfFaceId f : cut->faces) {
    faces.push_back(std::min(f, body.map.neighbour(f)).value);
  }
  std::ranges::sort(faces);
  lines += fmt::format(
      "{} tetrahedra divided at {} new points; {} points of before lie in the plane\n",
      file.divided[3], cut->edit.vertices.size(), cut->on_plane);
  json["divided"] = file.divided[3];
  json["new_vertices"] = cut->edit.vertices.size();
  json["on_plane"] = cut->on_plane;
  return faces;
}

ExitCode run_cut(const CutArguments& arguments) {
  Result<DividedMesh> body = read_to_divide(arguments.in, arguments.kernel);
  if (!body) return refuse(arguments, body.findings, ExitCode::bad_input);
  const auto shared = shared_columns(arguments, body->mesh);
  if (!shared) return refuse(arguments, shared.findings, ExitCode::usage);
  const std::vector<double> x = *numbers_of(arguments.plane, 4);
  const CuttingPlane plane{{x[0], x[1], x[2]}, x[3]};
  std::string lines;
  nlohmann::ordered_json json;
  Result<CutFaces> faces;
  if (arguments.exact) {
    faces = exact_faces(plane, *body, *shared, lines, json);
  }
  const Result<FaceLinks> links = face_links(body->mesh);
  if (!links) return refuse(arguments, links.findings, ExitCode::bad_input);
  if (!arguments.exact) faces = section_faces(body->mesh, *links, plane);
  if (!faces) return refuse(arguments, faces.findings, ExitCode::usage);
  if (faces->empty()) {
    return refuse(arguments,
                  {{.code = "no_face",
                    .text = "the plane passes through no tetrahedron and along no inner face",
                    .remedy = "`sunder check` tells where the body lies; give another offset D"}},
                  ExitCode::usage);
  }
  const Crack crack = open_crack(body->mesh, *links, *faces);
  lines += fmt::format("{} faces cut, {} points copied{}\n", faces->size(), crack.copies.size(),
                       crack.closed_faces == 0
                           ? ""
                           : fmt::format("; {} of the faces do not open", crack.closed_faces));
  json["faces_cut"] = faces->size();
  json["points_copied"] = crack.copies.size();
  json["closed_faces"] = crack.closed_faces;
  return finish(arguments, *body, lines, json);
}

std::string check_plane(const std::string& list) {
  return numbers_of(list, 4) ? "" : "'" + list + "' is not NX,NY,NZ,D: four numbers";
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
  command->add_flag("--exact", arguments->exact, "Divide the tetrahedra that the plane meets");
  command->footer(footer);
  command->callback([=, &exit_code] { exit_code = run_cut(*arguments); });
}

}  // namespace sunder
