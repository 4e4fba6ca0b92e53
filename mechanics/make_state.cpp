// SPDX-License-Identifier: MIT
// Columns at rest from a described body, and possible faults of the description.
#include "mechanics/rebuild.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "mechanics/element/strain_displacement.hpp"
#include "mechanics/integrators/scratch.hpp"
#include "mechanics/state/settings/check_settings.hpp"

namespace sunder {
namespace {

/// Gathers one kind of defect over all rows: first ids, count, and the finding at the end.
struct Defect {
  const char* code;
  const char* text;
  const char* remedy;
  std::vector<std::int64_t> ids = {};
  std::size_t count = 0;

  void add(std::size_t row) {
    ++count;
    if (ids.size() < Finding::max_ids) ids.push_back(static_cast<std::int64_t>(row));
  }
};

void report(std::vector<Finding>& findings, const Defect& defect) {
  if (defect.count == 0) return;
  Finding finding;
  finding.code = defect.code;
  finding.count = defect.count;
  finding.ids = defect.ids;
  finding.text = std::to_string(defect.count) + " " + defect.text + ", first in row " +
                 std::to_string(defect.ids.front()) + ".";
  finding.remedy = defect.remedy;
  findings.push_back(std::move(finding));
}

/// Spans that should have |T| rows or none, and rows that should exist.
void check_rows(std::vector<Finding>& findings, const BodyDescription& body) {
  const std::size_t T = body.corners.size();
  Defect lengths{"bad_column_length", "columns of tetrahedra have the wrong length",
                 "Give one row a tetrahedron, or none."};
  if (!body.material.empty() && body.material.size() != T) lengths.add(0);
  if (!body.component.empty() && body.component.size() != T) lengths.add(1);
  report(findings, lengths);
  if (!findings.empty()) return;

  Defect corners{"index_out_of_range", "tetrahedra name a vertex that does not exist",
                 "Number the vertices from 0."};
  Defect materials{"material_out_of_range", "tetrahedra name a material that does not exist",
                   "Give a material for every region."};
  Defect components{"component_out_of_range", "tetrahedra name no component or one above |T|",
                    "Number the components from 0 without gaps."};
  for (std::size_t t = 0; t < T; ++t) {
    for (VertexId v : body.corners[t]) {
      if (v.index() >= body.rest_positions.size()) corners.add(t);
    }
    const std::size_t material = body.material.empty() ? 0 : body.material[t].index();
    if (material >= body.materials.size()) materials.add(t);
    if (!body.component.empty() && body.component[t].index() >= T) components.add(t);
  }
  report(findings, corners);
  report(findings, materials);
  report(findings, components);
}

void check_points(std::vector<Finding>& findings, const BodyDescription& body) {
  Defect points{"nan_coordinate", "rest positions are not finite", "Mend the mesh."};
  std::vector<bool> used(body.rest_positions.size(), false);
  for (const Corners& corners : body.corners) {
    for (VertexId v : corners) used[v.index()] = true;
  }
  Defect unused{"unused_vertex", "vertex rows belong to no tetrahedron",
                "Give rows to vertices of tetrahedra only."};
  for (std::size_t v = 0; v < body.rest_positions.size(); ++v) {
    if (!body.rest_positions[v].allFinite()) points.add(v);
    if (!used[v]) unused.add(v);
  }
  report(findings, points);
  report(findings, unused);
}

/// Appends the elements; flat and inverted ones become findings.
void make_elements(std::vector<Finding>& findings, ElementColumns& elements,
                   const BodyDescription& body) {
  Defect flat{"flat_tetrahedron", "tetrahedra have no volume", "Mend the mesh."};
  Defect inverted{"inverted_tetrahedron", "tetrahedra have a negative volume",
                  "Swap two of their vertices."};
  for (std::size_t t = 0; t < body.corners.size(); ++t) {
    std::array<Vec3, 4> p;
    double longest = 0;
    for (std::size_t a = 0; a < 4; ++a) {
      p[a] = body.rest_positions[body.corners[t][a].index()];
      for (std::size_t b = 0; b < a; ++b) longest = std::max(longest, (p[a] - p[b]).norm());
    }
    const double volume = tetrahedron_volume(p);
    // Volumes below rounding of the coordinates' differences have no meaning: 64 eps L^3.
    if (!(std::abs(volume) > 64 * 2.2e-16 * longest * longest * longest)) {
      flat.add(t);
    } else if (volume < 0) {
      inverted.add(t);
    }
    const MaterialId material = body.material.empty() ? MaterialId{0} : body.material[t];
    elements.shape_gradient.push_back(shape_gradients(p));
    elements.rest_volume.push_back(volume);
    elements.mass.push_back(volume * body.materials[material.index()].density);
    elements.material.push_back(material);
    elements.component.push_back(body.component.empty() ? ComponentId{0} : body.component[t]);
    elements.stress.push_back(Mat3::Zero());
  }
  report(findings, flat);
  report(findings, inverted);
}

VertexColumns columns_at_rest(const BodyDescription& body) {
  const std::size_t n = body.rest_positions.size();
  VertexColumns vertices;
  vertices.rest_position.assign(body.rest_positions.begin(), body.rest_positions.end());
  vertices.position = vertices.rest_position;
  vertices.velocity.assign(n, Vec3::Zero());
  vertices.mass.assign(n, 0);
  vertices.component.assign(n, ComponentId::none());
  vertices.displacement.assign(n, Vec3::Zero());
  vertices.displacement_rate.assign(n, Vec3::Zero());
  vertices.displacement_acceleration.assign(n, Vec3::Zero());
  vertices.support.assign(n, MotionId::none());
  return vertices;
}

}  // namespace

Result<MechanicsState> make_state(const BodyDescription& body) {
  Result<MechanicsState> result;
  for (std::size_t m = 0; m < body.materials.size(); ++m) {
    for (Finding& f : check_settings(body.materials[m], "materials." + std::to_string(m))) {
      result.findings.push_back(std::move(f));
    }
  }
  std::vector<Finding> rows;
  check_rows(rows, body);
  if (rows.empty()) check_points(rows, body);
  if (rows.empty() && body.corners.empty()) {
    Finding empty;
    empty.code = "no_tetrahedron";
    empty.text = "The body has no tetrahedron.";
    empty.remedy = "Give a tetrahedral mesh.";
    rows.push_back(std::move(empty));
  }
  MechanicsState state;
  if (rows.empty()) make_elements(rows, state.elements, body);
  for (Finding& f : rows) result.findings.push_back(std::move(f));
  if (has_error(result.findings)) return result;

  state.vertices = columns_at_rest(body);
  state.materials.assign(body.materials.begin(), body.materials.end());
  std::vector<ComponentId> all = state.elements.component;
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  MechanicsScratch scratch;
  rebuild(state, body.corners, all, scratch);
  result.value = std::move(state);
  return result;
}

}  // namespace sunder
