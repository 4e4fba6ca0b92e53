// SPDX-License-Identifier: MIT
// Judging cells one by one while they are read, and the last words about the whole.
#include "topology/io/draft.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "topology/io/scan.hpp"

namespace sunder::io {
namespace {

/// Line of byte `at`; 0 in binary data.
std::size_t line_in(const Draft& draft, std::size_t at) {
  return draft.text.empty() ? 0 : line_of(draft.text, at);
}

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
    finding->file = draft.file;
    finding->line = line_in(draft, at);
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
    const bool all = cells.source_id.size() == cells.corners.size();
    usual = usual && all && counts_up_from(first, cells.source_id);
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

/// The finding, at the place of the first of the cells.
Finding at_first(const std::map<std::string, Draft::Others>& cells, Finding finding) {
  const Draft::Others* first = &cells.begin()->second;
  for (const auto& [name, others] : cells) {
    if (others.file == first->file && others.line < first->line) first = &others;
  }
  finding.file = first->file;
  finding.line = first->line;
  return finding;
}

void judge_other_cells(Draft& draft, bool tetrahedra_only) {
  const auto add = [&draft](const std::map<std::string, Draft::Others>& cells, Finding finding,
                            std::string_view what) {
    const auto [text, sum] = listed(cells);
    finding.text = fmt::format("{}{}", text, what);
    finding.count = sum;
    draft.findings.push_back(at_first(cells, std::move(finding)));
  };
  if (!draft.volume_cells.empty()) {
    add(draft.volume_cells,
        {.code = "unsupported_cells",
         .severity = tetrahedra_only ? Severity::warning : Severity::error,
         .remedy = "mesh the body with tetrahedra, or split these cells into tetrahedra"},
        tetrahedra_only ? ": are left out, as was asked for"
                        : ": of volume cells only tetrahedra are read");
  }
  if (!draft.curved_cells.empty()) {
    add(draft.curved_cells,
        {.code = "corners_only",
         .severity = Severity::note,
         .remedy = "nothing to do, if their sides are straight; their other points stay as unused "
                   "points"},
        " are read by their corners");
  }
  if (!draft.surface_cells.empty()) {
    add(draft.surface_cells,
        {.code = "skipped_cells",
         .severity = Severity::note,
         .remedy = "nothing to do: only simplices are used"},
        " are left out");
  }
}

constexpr std::string_view cell_names[] = {"vertex", "edge", "triangle", "tetrahedron"};

/// The first `n` numbers, a blank between them.
std::string numbers_text(const FileCell& cell, std::size_t n) {
  std::string text;
  for (std::size_t k = 0; k < n; ++k) {
    text += fmt::format("{}{}", k == 0 ? "" : " ", cell.numbers[k]);
  }
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

/// Counts cells of one kind in `cells`, one of the draft's lists.
void count_cells(Draft& draft, std::map<std::string, Draft::Others>& cells,
                 std::string_view plural_name, std::size_t count, std::size_t at) {
  if (count == 0) return;
  Draft::Others& others = cells[std::string(plural_name)];
  if (others.count == 0) {
    others.file = draft.file;
    others.line = line_in(draft, at);
  }
  others.count += count;
}

}  // namespace

void add_other_cells(Draft& draft, std::string_view plural_name, int dimension, std::size_t count,
                     std::size_t at) {
  auto& cells = dimension == 3 ? draft.volume_cells : draft.surface_cells;
  count_cells(draft, cells, plural_name, count, at);
}

void add_curved_cells(Draft& draft, std::string_view plural_name, std::size_t count,
                      std::size_t at) {
  count_cells(draft, draft.curved_cells, plural_name, count, at);
}

void check_end(Draft& draft, NumberSource& in, std::string_view row) {
  const std::size_t left = in.s.text.size() - in.s.at;
  if (in.is_binary && left > 0) {
    draft.findings.push_back(
        {.code = "trailing_bytes",
         .severity = Severity::warning,
         .count = left,
         .text = fmt::format("{} bytes stand behind the last {}: they are not read", left, row),
         .remedy = "correct the counts, if they are rows too"});
  }
  if (in.is_binary || peek_word(in.s).empty()) return;
  fail(in.s.text, in.s.at,
       {.code = "wrong_count",
        .text = fmt::format("{} stands behind the last {}", in_quotes(peek_word(in.s)), row),
        .remedy = "correct the counts, or take away what stands behind"});
}

namespace {

/// Columns without a row say nothing, and not every format can say it.
void drop_columns_of_nothing(FileMesh& mesh) {
  if (mesh.points.empty()) mesh.point_data.clear();
  for_each_cell_list(mesh, [](auto& cells, int) {
    if (cells.corners.empty()) cells.data.clear();
  });
}

}  // namespace

Result<FileMesh> finish(Draft&& draft, bool tetrahedra_only) {
  judge_other_cells(draft, tetrahedra_only);
  drop_usual_numbers(draft.mesh);
  drop_columns_of_nothing(draft.mesh);
  Result<FileMesh> result;
  result.findings = std::move(draft.findings);
  std::stable_sort(result.findings.begin(), result.findings.end(),
                   [](const Finding& a, const Finding& b) { return a.severity > b.severity; });
  if (!has_error(result.findings)) result.value = std::move(draft.mesh);
  return result;
}

}  // namespace sunder::io
