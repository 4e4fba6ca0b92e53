// SPDX-License-Identifier: MIT
// The check of all that a file holds: the order of its passes.
#include "topology/mesh/check.hpp"
#include "topology/mesh/survey.hpp"

namespace sunder {
namespace {

bool is_about_volume(const Finding& f) {
  return f.code == "flat_tetrahedron" || f.code == "folded_tetrahedron";
}

}  // namespace

MeshCheck check_file_mesh(const FileMesh& file, bool keeps_places) {
  TetMesh mesh;
  mesh.points = file.points;
  mesh.tetrahedra = file.tetrahedra.corners;
  mesh.region = file.tetrahedra.region;
  mesh.source_point_id = file.source_point_id;
  mesh.source_tetrahedron_id = file.tetrahedra.source_id;
  // Bad volumes do not hinder counting.
  Survey survey = survey_mesh(mesh, Severity::warning, keeps_places);
  MeshCheck check;
  const bool is_surveyed = survey.neighbours.size() == mesh.tetrahedra.size();
  if (!has_error(survey.findings)) {
    check.counts = count_cells(survey);
    survey_links(survey);
  }
  if (is_surveyed) {
    survey_contact(survey);
    survey_triangles(survey, file.triangles.corners);
    check.quality = quality_of(survey);
  }
  for (Finding& f : survey.findings) {
    if (!is_about_volume(f)) continue;
    f.severity = Severity::error;
    if (check.counts) check.counts->betti.reset();
  }
  sort_findings(survey.findings);
  check.findings = std::move(survey.findings);
  check.places = std::move(survey.places);
  return check;
}

}  // namespace sunder
