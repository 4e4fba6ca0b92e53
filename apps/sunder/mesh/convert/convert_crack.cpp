// SPDX-License-Identifier: MIT
// From the command line to cut faces, and the crack in words and as a list.
#include "apps/sunder/mesh/convert/convert_crack.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "apps/scene/words.hpp"
#include "topology/base/counted.hpp"
#include "topology/io/face_list.hpp"
#include "topology/mesh/crack.hpp"
#include "topology/mesh/repair.hpp"

namespace sunder {
namespace {

/// The faces that the options name, and the findings of looking for them.
struct Named {
  CutFaces faces;
  std::vector<Finding> findings;
};

void add(Named& named, Result<CutFaces>&& found) {
  std::ranges::move(found.findings, std::back_inserter(named.findings));
  if (found) named.faces.insert(named.faces.end(), found->begin(), found->end());
}

Named named_faces(const FileMesh& mesh, const FaceLinks& links, const CrackOptions& options) {
  Named named;
  if (!options.faces.empty()) {
    auto listed = read_face_list(options.faces);
    std::ranges::move(listed.findings, std::back_inserter(named.findings));
    if (listed) add(named, listed_faces(mesh, links, *listed));
  }
  if (!options.plane.empty()) {
    const std::vector<double> x = *numbers_of(options.plane, 4);
    add(named, section_faces(mesh, links, {.normal = {x[0], x[1], x[2]}, .offset = x[3]}));
  }
  if (!options.regions.empty()) {
    const std::string_view words = options.regions;
    const std::size_t comma = words.find(',');
    add(named, interface_faces(mesh, links, {words.substr(0, comma), words.substr(comma + 1)}));
  }
  std::ranges::sort(named.faces);
  named.faces.erase(std::unique(named.faces.begin(), named.faces.end()), named.faces.end());
  return named;
}

Finding note(std::string_view code, std::size_t count, std::string text) {
  return {.code = std::string(code),
          .severity = Severity::note,
          .count = count,
          .text = std::move(text),
          .remedy = "nothing to do: it was requested"};
}

std::vector<Finding> notes_of(const Crack& crack) {
  std::size_t points = 0;
  for (std::size_t i = 0; i < crack.copies.size(); ++i) {
    points += i == 0 || crack.copies[i][0] != crack.copies[i - 1][0];
  }
  std::vector<Finding> notes{
      note("cracked", crack.faces.size(),
           fmt::format("{} {} cut: {} {} {}", counted(crack.faces.size(), "face"),
                       for_count(crack.faces.size(), "is", "are"), counted(points, "point"),
                       for_count(points, "has", "have"),
                       counted(crack.copies.size(), "copy", "copies")))};
  if (crack.closed_faces > 0) {
    notes.push_back(
        note("closed_faces", crack.closed_faces,
             fmt::format("{} of the faces {} not open: all points lie on the crack's "
                         "front and stay joined",
                         crack.closed_faces, for_count(crack.closed_faces, "does", "do"))));
  }
  if (crack.triangles_on_it > 0) {
    notes.push_back(note("triangles_on_crack", crack.triangles_on_it,
                         fmt::format("{} {} on the crack: each goes with the tetrahedron of the "
                                     "lower row",
                                     counted(crack.triangles_on_it, "triangle"),
                                     for_count(crack.triangles_on_it, "lies", "lie"))));
  }
  return notes;
}

/// One line a pair of points, and one a cut face.
std::string pairs_text(const Crack& crack) {
  std::string text =
      "# rows, counted from 0\n"
      "# point,POINT,COPY\n"
      "# face,TETRAHEDRON,TETRAHEDRON,three points of the first,the same of the second\n";
  for (const auto& [point, copy] : crack.copies) text += fmt::format("point,{},{}\n", point, copy);
  for (const CrackFace& face : crack.faces) {
    text += fmt::format("face,{},{},{},{}\n", face.tetrahedra[0], face.tetrahedra[1],
                        fmt::join(face.points[0], ","), fmt::join(face.points[1], ","));
  }
  return text;
}

}  // namespace

void add_crack_options(CLI::App& command, CrackOptions& options) {
  const auto is_plane = [](const std::string& list) {
    return numbers_of(list, 4) ? std::string()
                               : fmt::format("'{}' is not NX,NY,NZ,D: four numbers", list);
  };
  const auto is_pair = [](const std::string& list) {
    return std::ranges::count(list, ',') == 1 ? std::string()
                                              : fmt::format("'{}' is not A,B: two regions", list);
  };
  std::vector<CLI::Option*> cracks;
  cracks.push_back(command
                       .add_option("--crack-faces", options.faces,
                                   "Crack: cut the faces listed in this file, three rows of "
                                   "points (from 0) per line")
                       ->type_name("FILE"));
  cracks.push_back(command
                       .add_option("--crack-plane", options.plane,
                                   "Crack: cut where the plane NX x + NY y + NZ z = D "
                                   "separates centres of tetrahedra")
                       ->type_name("NX,NY,NZ,D")
                       ->check(CLI::Validator(is_plane, "", "plane")));
  cracks.push_back(command
                       .add_option("--crack-regions", options.regions,
                                   "Crack: cut between two regions, by number or name")
                       ->type_name("A,B")
                       ->check(CLI::Validator(is_pair, "", "regions")));
  const auto has_crack = [cracks](const std::string&) {
    const bool any = std::ranges::any_of(cracks, [](const auto* o) { return o->count() > 0; });
    return any ? std::string() : "there is no crack: give --crack-faces, -plane or -regions first";
  };
  command
      .add_option("--crack-pairs", options.pairs,
                  "Write the pairs of points and faces across the crack to this file")
      ->type_name("FILE")
      ->check(CLI::Validator(has_crack, "", "crack"));
}

NamedCrack open_named_crack(FileMesh& mesh, const CrackOptions& options) {
  if (options.faces.empty() && options.plane.empty() && options.regions.empty()) return {};
  if (auto refused = needs_tetrahedra(mesh, "a crack")) return {{std::move(*refused)}, {}};
  const Result<FaceLinks> links = face_links(mesh);
  if (!links) return {links.findings, {}};
  Named named = named_faces(mesh, *links, options);
  if (has_error(named.findings)) return {std::move(named.findings), {}};
  const Crack crack = open_crack(mesh, *links, named.faces);
  return {notes_of(crack), pairs_text(crack)};
}

}  // namespace sunder
