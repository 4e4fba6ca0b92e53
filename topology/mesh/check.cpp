// SPDX-License-Identifier: MIT
// Findings about single entries of a mesh, and the order of the stages of a survey.
#include "topology/mesh/check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "topology/base/counted.hpp"
#include "topology/base/point_math.hpp"
#include "topology/mesh/survey.hpp"

namespace sunder {
namespace {

constexpr FindingWords empty_mesh = {"empty_mesh", Severity::error,
                                     "the mesh has no points and no tetrahedra",
                                     "give a file that holds a tetrahedral mesh"};
constexpr FindingWords no_tetrahedron = {"no_tetrahedron", Severity::error,
                                         "the mesh has points but no tetrahedron",
                                         "give a volume mesh of tetrahedra"};
constexpr FindingWords column_length = {
    "column_length", Severity::error,
    "a column (region, source numbers) does not have one entry a row",
    "leave a column empty or fill it for every row"};
constexpr FindingWords too_large = {
    "too_large", Severity::error,
    "the mesh has more tetrahedra or points than rows of 32 bits can number",
    "cut it into bodies of at most 357 913 941 tetrahedra"};
constexpr FindingWords index_out_of_range = {
    "index_out_of_range", Severity::error,
    "% [tetrahedron names|tetrahedra name] a point that does not exist",
    "correct the numbers: points are counted from 0 to the number of points less one"};
constexpr FindingWords repeated_vertex = {
    "repeated_vertex", Severity::error,
    "% [tetrahedron names|tetrahedra name] one point more than once",
    "remove them: they have no volume and their faces are not triangles"};
constexpr FindingWords nan_coordinate = {
    "nan_coordinate", Severity::error,
    "% [point has|points have] a coordinate that is not a finite number",
    "correct the coordinates"};
constexpr FindingWords flat_tetrahedron = {
    "flat_tetrahedron", Severity::error,
    "% [tetrahedron has|tetrahedra have] no volume beyond rounding",
    "remove them or move a point; without volume there is no stiffness and no mass"};

// A finding about the mesh as a whole, without ids.
void report_whole(Survey& survey, const FindingWords& words) {
  Places places(PlaceKind::points);
  places.add(0);
  report(survey, words, places);
  survey.findings.back().ids.clear();
  if (survey.keeps_places) survey.places.pop_back();
}

using Index4 = std::array<std::uint32_t, 4>;

bool has_repeated(const Index4& t) {
  return t[0] == t[1] || t[0] == t[2] || t[0] == t[3] || t[1] == t[2] || t[1] == t[3] ||
         t[2] == t[3];
}

bool is_finite(const Point& p) {
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

// Sign of det(b - a, c - a, d - a), 0 when rounding can have made it. Each difference is off by at
// most eps M (M: largest coordinate), each product of three by 3 such over L^2, six products.
signed char volume_sign(const TetMesh& mesh, const Index4& t) {
  const Point& a = mesh.points[t[0]];
  std::array<Point, 3> e;
  double largest = 0, length = 0;
  for (int i = 0; i < 3; ++i) largest = std::max(largest, std::abs(a[i]));
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 3; ++i) {
      const double x = mesh.points[t[static_cast<std::size_t>(k) + 1]][i];
      e[k][i] = x - a[i];
      largest = std::max(largest, std::abs(x));
      length = std::max(length, std::abs(e[k][i]));
    }
  }
  const double det = detail::dot(e[0], detail::cross(e[1], e[2]));
  constexpr double rounding = 18 * std::numeric_limits<double>::epsilon();
  const double tolerance = rounding * std::max(largest, length) * length * length;
  // Overflow gives an infinity or a NaN: such a tetrahedron has no volume one could compute with.
  if (!std::isfinite(det) || std::abs(det) <= tolerance) return 0;
  return det > 0 ? 1 : -1;
}

void survey_columns(Survey& s) {
  std::size_t wrong = 0;
  const std::size_t tetrahedra = s.mesh.tetrahedra.size(), points = s.mesh.points.size();
  const auto expect = [&wrong](std::size_t size, std::size_t rows) {
    if (size != 0 && size != rows) ++wrong;
  };
  expect(s.mesh.region.size(), tetrahedra);
  expect(s.mesh.source_tetrahedron_id.size(), tetrahedra);
  expect(s.mesh.source_point_id.size(), points);
  if (wrong == 0) return;
  report_whole(s, column_length);
}

}  // namespace

void report(Survey& survey, const FindingWords& words, const Places& places) {
  if (places.count() == 0) return;
  Finding finding;
  finding.code = words.code;
  finding.severity = words.severity;
  finding.count = places.count();
  const auto& rows = places.rows();
  const std::size_t size = rows_of_place(places.kind());
  const std::size_t kept = std::min(rows.size(), Finding::max_ids / size * size);
  finding.ids.assign(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(kept));
  finding.text = text_of_count(words.text, places.count());
  finding.remedy = words.remedy;
  survey.findings.push_back(std::move(finding));
  if (survey.keeps_places) survey.places.push_back({words.code, places.kind(), rows});
}

void sort_findings(std::vector<Finding>& findings) {
  std::stable_sort(findings.begin(), findings.end(),
                   [](const Finding& a, const Finding& b) { return a.severity > b.severity; });
}

void survey_size(Survey& s, std::size_t tetrahedra, std::size_t points) {
  if (s.mesh.tetrahedra.size() > tetrahedra || s.mesh.points.size() > points) {
    report_whole(s, too_large);
  }
}

void survey_entries(Survey& s) {
  const TetMesh& mesh = s.mesh;
  const std::size_t points = mesh.points.size();
  if (mesh.tetrahedra.empty()) {
    report_whole(s, points == 0 ? empty_mesh : no_tetrahedron);
  }
  survey_columns(s);
  Places not_finite(PlaceKind::points, s.keeps_places);
  for (std::size_t p = 0; p < points; ++p) {
    if (!is_finite(mesh.points[p])) not_finite.add(p);
  }
  report(s, nan_coordinate, not_finite);
  Places out_of_range(PlaceKind::tetrahedra, s.keeps_places);
  Places repeated = out_of_range, flat = out_of_range;
  s.usable.assign(mesh.tetrahedra.size(), 1);
  s.sign.assign(mesh.tetrahedra.size(), 0);
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const Index4& corners = mesh.tetrahedra[t];
    const bool in_range = std::all_of(corners.begin(), corners.end(),
                                      [points](std::uint32_t p) { return p < points; });
    if (!in_range) out_of_range.add(t);
    if (has_repeated(corners)) repeated.add(t);
    s.usable[t] = in_range && !has_repeated(corners) ? 1 : 0;
    if (!s.usable[t]) continue;
    s.sign[t] = volume_sign(mesh, corners);
    // A point that is not a number has its own finding, and takes its tetrahedra's volumes along.
    const bool finite = std::all_of(corners.begin(), corners.end(),
                                    [&mesh](std::uint32_t p) { return is_finite(mesh.points[p]); });
    if (s.sign[t] == 0 && finite) flat.add(t);
  }
  report(s, index_out_of_range, out_of_range);
  report(s, repeated_vertex, repeated);
  FindingWords words = flat_tetrahedron;
  words.severity = s.bad_volume;
  report(s, words, flat);
}

Survey survey_mesh(const TetMesh& mesh, Severity bad_volume, bool keeps_places) {
  Survey survey{.mesh = mesh, .bad_volume = bad_volume, .keeps_places = keeps_places};
  survey_size(survey, most_tetrahedra, most_points);
  if (!survey.findings.empty()) return survey;
  survey_entries(survey);
  survey_faces(survey);
  survey_orientation(survey);
  survey_vertices(survey);
  sort_findings(survey.findings);
  return survey;
}

std::vector<Finding> check_mesh(const TetMesh& mesh, Severity bad_volume) {
  return survey_mesh(mesh, bad_volume).findings;
}

}  // namespace sunder
