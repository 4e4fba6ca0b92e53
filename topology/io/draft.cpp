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

/// Whether the numbers are `first`, `first + 1`, ...
bool counts_up_from(std::int64_t first, const std::vector<std::int64_t>& numbers) {
  for (const std::int64_t number : numbers) {
    if (number != first++) return false;
  }
  return true;
}

/// Cells are numbered through all dimensions where a file numbers them at all.
void drop_usual_numbers(FileMesh& mesh) {
  if (counts_up_from(1, mesh.source_point_id)) mesh.source_point_id.clear();
  std::int64_t first = 1;
  bool usual = true;
  for_each_cell_list(mesh, [&](const auto& cells, int) {
    usual = usual && counts_up_from(first, cells.source_id);
    first += static_cast<std::int64_t>(cells.corners.size());
  });
  if (!usual) return;
  for_each_cell_list(mesh, [](auto& cells, int) { cells.source_id.clear(); });
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

std::size_t first_line(const Draft& draft, const std::map<std::string, Draft::Others>& cells) {
  std::size_t first = std::string::npos;
  for (const auto& [name, others] : cells) first = std::min(first, others.first_at);
  return draft.text.empty() ? 0 : line_of(draft.text, first);
}

void judge_other_cells(Draft& draft, bool tetrahedra_only) {
  if (!draft.volume_cells.empty()) {
    const auto [text, sum] = listed(draft.volume_cells);
    const std::string_view what = tetrahedra_only ? "are left out, as was asked for"
                                                  : "of volume cells only tetrahedra are read";
    draft.findings.push_back({.code = "unsupported_cells",
                              .severity = tetrahedra_only ? Severity::warning : Severity::error,
                              .count = sum,
                              .text = fmt::format("{}: {}", text, what),
                              .remedy = "mesh the body with tetrahedra, or split these cells into "
                                        "tetrahedra",
                              .line = first_line(draft, draft.volume_cells)});
  }
  if (!draft.curved_cells.empty()) {
    const auto [text, sum] = listed(draft.curved_cells);
    draft.findings.push_back({.code = "corners_only",
                              .severity = Severity::note,
                              .count = sum,
                              .text = fmt::format("{} are read by their corners", text),
                              .remedy = "nothing to do, if their sides are straight; their other "
                                        "points stay as unused points",
                              .line = first_line(draft, draft.curved_cells)});
  }
  if (!draft.surface_cells.empty()) {
    const auto [text, sum] = listed(draft.surface_cells);
    draft.findings.push_back({.code = "skipped_cells",
                              .severity = Severity::note,
                              .count = sum,
                              .text = fmt::format("{} are left out", text),
                              .remedy = "nothing to do: only simplices are used"});
  }
}

constexpr std::string_view cell_names[] = {"vertex", "edge", "triangle", "tetrahedron"};

/// The first `n` numbers, a blank between them.
std::string numbers_text(const FileCell& cell, std::size_t n) {
  std::string text;
  for (std::size_t k = 0; k < n; ++k)
    text += fmt::format("{}{}", k == 0 ? "" : " ", cell.numbers[k]);
  return text;
}

template <std::size_t Corners>
void add_cell(Draft& draft, CellList<Corners>& cells, const FileCell& cell) {
  const std::size_t row = cells.corners.size();
  const std::string_view name = cell_names[Corners - 1];
  const auto points = static_cast<std::int64_t>(draft.mesh.points.size());
  auto& corners = cells.corners.emplace_back();  // stays where the cell is wrong: rows are kept
  for (std::size_t k = 0; k < Corners; ++k) {
    if (cell.rows[k] >= 0 && cell.rows[k] < points) continue;
    return add_problem(draft, "index_out_of_range", row, cell.at, [&] {
      return Finding{.text = fmt::format("the {} in row {} names point {}, which is none of the {} "
                                         "points",
                                         name, row, cell.numbers[k], points),
                     .remedy = "correct the number, or add the missing points"};
    });
  }
  bool repeats = false;
  for (std::size_t k = 0; k < Corners; ++k) {
    corners[k] = static_cast<std::uint32_t>(cell.rows[k]);
    for (std::size_t j = 0; j < k; ++j) repeats |= corners[j] == corners[k];
  }
  if (!repeats) return;
  constexpr bool is_volume = Corners == 4;
  add_problem(draft, is_volume ? "repeated_vertex" : "degenerate_cell", row, cell.at, [&] {
    return Finding{.severity = is_volume ? Severity::error : Severity::warning,
                   .text = fmt::format("the {} in row {} has points {}: {} different ones were "
                                       "expected",
                                       name, row, numbers_text(cell, Corners),
                                       is_volume ? "four" : fmt::format("{}", Corners)),
                   .remedy = fmt::format("correct the numbers, or delete the {}", name)};
  });
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

void add_cell(Draft& draft, int dimension, const FileCell& cell) {
  switch (dimension) {
    case 0:
      return add_cell(draft, draft.mesh.vertices, cell);
    case 1:
      return add_cell(draft, draft.mesh.edges, cell);
    case 2:
      return add_cell(draft, draft.mesh.triangles, cell);
    default:
      return add_cell(draft, draft.mesh.tetrahedra, cell);
  }
}

namespace {

void count_cells(std::map<std::string, Draft::Others>& cells, std::string_view plural_name,
                 std::size_t count, std::size_t at) {
  if (count == 0) return;
  Draft::Others& others = cells[std::string(plural_name)];
  if (others.count == 0) others.first_at = at;
  others.count += count;
}

}  // namespace

void add_other_cells(Draft& draft, std::string_view plural_name, int dimension, std::size_t count,
                     std::size_t at) {
  count_cells(dimension == 3 ? draft.volume_cells : draft.surface_cells, plural_name, count, at);
}

void add_curved_cells(Draft& draft, std::string_view plural_name, std::size_t count,
                      std::size_t at) {
  count_cells(draft.curved_cells, plural_name, count, at);
}

Result<FileMesh> finish(Draft&& draft, bool tetrahedra_only) {
  judge_other_cells(draft, tetrahedra_only);
  drop_usual_numbers(draft.mesh);
  Result<FileMesh> result;
  result.findings = std::move(draft.findings);
  std::stable_sort(result.findings.begin(), result.findings.end(),
                   [](const Finding& a, const Finding& b) { return a.severity > b.severity; });
  if (!has_error(result.findings)) result.value = std::move(draft.mesh);
  return result;
}

}  // namespace sunder::io
