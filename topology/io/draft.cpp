// SPDX-License-Identifier: MIT
// Judging cells one by one while they are read, and the last words about the whole.
#include "topology/io/draft.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "topology/io/scan.hpp"

namespace sunder::io {
namespace {

/// Counts row `id` under `code`; `words()` gives the text and remedy and is asked for once a code.
template <class Words>
void add_problem(Draft& draft, std::string_view code, std::size_t id, std::size_t at, Words words) {
  Finding* finding = nullptr;
  for (Finding& f : draft.findings) {
    if (f.code == code) finding = &f;
  }
  if (finding == nullptr) {
    draft.findings.push_back(words());
    finding = &draft.findings.back();
    finding->code = code;
    finding->count = 0;
    finding->line = draft.text.empty() ? 0 : line_of(draft.text, at);
  }
  ++finding->count;
  if (finding->ids.size() < Finding::max_ids) finding->ids.push_back(static_cast<std::int64_t>(id));
}

bool counts_up_from_one(const std::vector<std::int64_t>& numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] != static_cast<std::int64_t>(i) + 1) return false;
  }
  return true;
}

/// "108 triangles, 12 lines", and their sum.
std::pair<std::string, std::size_t> listed(const std::map<std::string, Draft::Others>& cells) {
  std::string text;
  std::size_t sum = 0;
  for (const auto& [name, others] : cells) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", others.count, name);
    sum += others.count;
  }
  return {text, sum};
}

void judge_other_cells(Draft& draft) {
  if (!draft.volume_cells.empty()) {
    const auto [text, sum] = listed(draft.volume_cells);
    std::size_t first = std::string::npos;
    for (const auto& [name, others] : draft.volume_cells) first = std::min(first, others.first_at);
    draft.findings.push_back(
        {.code = "unsupported_cells",
         .count = sum,
         .text = fmt::format("{}: of volume cells only linear tetrahedra are read", text),
         .remedy =
             "mesh the body with first-order tetrahedra, or split these cells into tetrahedra",
         .line = draft.text.empty() ? 0 : line_of(draft.text, first)});
  }
  if (!draft.surface_cells.empty()) {
    const auto [text, sum] = listed(draft.surface_cells);
    draft.findings.push_back({.code = "skipped_cells",
                              .severity = Severity::note,
                              .count = sum,
                              .text = fmt::format("{} are left out", text),
                              .remedy = "nothing to do: only tetrahedra are used"});
  }
}

}  // namespace

void add_point(Draft& draft, const Point& point, std::size_t at) {
  const std::size_t row = draft.mesh.points.size();
  draft.mesh.points.push_back(point);
  if (std::isfinite(point[0]) && std::isfinite(point[1]) && std::isfinite(point[2])) return;
  add_problem(draft, "nan_coordinate", row, at, [&] {
    return Finding{.text = fmt::format("the point in row {} is ({}, {}, {}): finite numbers were "
                                       "expected",
                                       row, point[0], point[1], point[2]),
                   .remedy = "correct the coordinates, or write the file again"};
  });
}

void add_tetrahedron(Draft& draft, const FileTetrahedron& tetrahedron) {
  const std::size_t row = draft.mesh.tetrahedra.size();
  const auto& r = tetrahedron.rows;
  const auto points = static_cast<std::int64_t>(draft.mesh.points.size());
  for (int k = 0; k < 4; ++k) {
    if (r[k] >= 0 && r[k] < points) continue;
    add_problem(draft, "index_out_of_range", row, tetrahedron.at, [&] {
      return Finding{
          .text = fmt::format("the tetrahedron in row {} names point {}, which is none of "
                              "the {} points",
                              row, tetrahedron.numbers[k], points),
          .remedy = "correct the number, or add the missing points"};
    });
    draft.mesh.tetrahedra.push_back({0, 0, 0, 0});  // keeps the rows of those that follow
    return;
  }
  draft.mesh.tetrahedra.push_back(
      {static_cast<std::uint32_t>(r[0]), static_cast<std::uint32_t>(r[1]),
       static_cast<std::uint32_t>(r[2]), static_cast<std::uint32_t>(r[3])});
  if (r[0] == r[1] || r[0] == r[2] || r[0] == r[3] || r[1] == r[2] || r[1] == r[3] ||
      r[2] == r[3]) {
    add_problem(draft, "repeated_vertex", row, tetrahedron.at, [&] {
      const auto& n = tetrahedron.numbers;
      return Finding{.text = fmt::format("the tetrahedron in row {} has points {} {} {} {}: four "
                                         "different ones were expected",
                                         row, n[0], n[1], n[2], n[3]),
                     .remedy = "correct the numbers, or delete the tetrahedron"};
    });
  }
}

void add_other_cells(Draft& draft, std::string_view plural_name, int dimension, std::size_t count,
                     std::size_t at) {
  if (count == 0) return;
  auto& cells = dimension == 3 ? draft.volume_cells : draft.surface_cells;
  Draft::Others& others = cells[std::string(plural_name)];
  if (others.count == 0) others.first_at = at;
  others.count += count;
}

Result<TetMesh> finish(Draft&& draft) {
  judge_other_cells(draft);
  TetMesh& mesh = draft.mesh;
  if (mesh.tetrahedra.empty() && draft.volume_cells.empty()) {
    draft.findings.push_back(
        {.code = "no_tetrahedron",
         .text = fmt::format("the file has {} points but no tetrahedron", mesh.points.size()),
         .remedy =
             draft.surface_cells.empty()
                 ? "give a volume mesh of tetrahedra"
                 : "the file holds a surface: fill it with tetrahedra first (a mesher such as "
                   "sunder-mesh or gmsh -3 does)"});
  }
  if (counts_up_from_one(mesh.source_point_id)) mesh.source_point_id.clear();
  if (counts_up_from_one(mesh.source_tetrahedron_id)) mesh.source_tetrahedron_id.clear();
  Result<TetMesh> result;
  result.findings = std::move(draft.findings);
  std::stable_sort(result.findings.begin(), result.findings.end(),
                   [](const Finding& a, const Finding& b) { return a.severity > b.severity; });
  if (!has_error(result.findings)) result.value = std::move(mesh);
  return result;
}

}  // namespace sunder::io
