// SPDX-License-Identifier: MIT
// Judging cells one by one while they are read, and the last words about the whole.
#include "topology/io/draft.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "topology/base/counted.hpp"
#include "topology/io/text/scan.hpp"
#include "topology/mesh/kinds/move_cells.hpp"
#include "topology/mesh/kinds/second_order.hpp"

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

/// Cells are numbered through all kinds that have numbers; vertices of Abaqus and UNV have none.
void drop_usual_numbers(FileMesh& mesh) {
  if (counts_up_from(1, mesh.source_point_id)) mesh.source_point_id.clear();
  std::int64_t first = 1;
  bool usual = true;
  for (const CellKind kind : all_cell_kinds) {
    const std::vector<std::int64_t>& numbers = columns_of(mesh, kind).source_id;
    usual = usual && counts_up_from(first, numbers);
    first += static_cast<std::int64_t>(numbers.size());
  }
  if (!usual) return;
  for (const CellKind kind : all_cell_kinds) columns_of(mesh, kind).source_id.clear();
}

/// "third-order prism" for "third-order prisms": readers name kinds by their plurals.
std::string singular_of(std::string_view plural) {
  constexpr std::pair<std::string_view, std::string_view> others[] = {
      {"tetrahedra", "tetrahedron"}, {"hexahedra", "hexahedron"}, {"vertices", "vertex"}};
  std::string text(plural);
  for (const auto& [several, one] : others) {
    const std::size_t at = text.find(several);
    if (at != std::string::npos) return text.replace(at, several.size(), one);
  }
  for (std::size_t end = 1; end <= text.size(); ++end) {
    const bool ends_word = end == text.size() || text[end] == ' ';
    if (ends_word && text[end - 1] == 's') return text.erase(end - 1, 1);
  }
  return text;
}

/// "108 triangles, 1 line", and their sum.
std::pair<std::string, std::size_t> listed(const std::map<std::string, Draft::Others>& cells) {
  std::string text;
  std::size_t sum = 0;
  for (const auto& [name, others] : cells) {
    text += fmt::format("{}{}", text.empty() ? "" : ", ",
                        counted(others.count, singular_of(name), name));
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

void add_to(std::map<std::string, Draft::Others>& cells, std::string_view name,
            const Draft::Others& others) {
  Draft::Others& sum = cells[std::string(name)];
  const std::size_t count = sum.count + others.count;
  if (sum.count == 0) sum = others;
  sum.count = count;
}

/// Reports curved cells; straight ones follow from their corners.
void tell_curved(Draft& draft, CellKind kind) {
  const CurvedCells curved = curved_cells(draft.mesh, kind);
  if (curved.count == 0) return;
  const CellKindTraits& t = traits_of(kind);
  Finding finding{.code = "curved_cells",
                  .severity = Severity::warning,
                  .text = fmt::format("{} {} curved: the middle of an edge lies up to {:.2g} of "
                                      "its length from the straight line",
                                      counted(curved.count, t.name, t.plural),
                                      for_count(curved.count, "is", "are"), curved.most),
                  .remedy =
                      "make the cells straight: sunder convert --order 1 FILE NEW.msh, or mesh "
                      "finer where the surface is curved"};
  finding.count = curved.count;
  const Draft::Others& others = draft.kept[index_of(kind)];
  finding.file = others.file;
  finding.line = others.line;
  draft.findings.push_back(std::move(finding));
}

/// Removes cells that the options do not keep, or makes them linear.
void take_out(Draft& draft, const ReadOptions& options) {
  FileMesh& mesh = draft.mesh;
  for (const CellKind kind : all_cell_kinds) {
    Draft::Others& others = draft.kept[index_of(kind)];
    others.count = rows_of(mesh, kind).count;
    if (others.count == 0 || is_simplex(kind)) continue;
    const CellKindTraits& t = traits_of(kind);
    const CellKind linear = linear_kind(kind);
    const bool is_other_volume = t.dimension == 3 && linear != CellKind::tetrahedron;
    if (options.simplices && is_simplex(linear)) {
      add_to(draft.curved_cells, t.plural, others);
      if (t.dimension == 3) tell_curved(draft, kind);
      move_cells(mesh, kind, linear);
    } else if (options.simplices || (options.tetrahedra_only && is_other_volume)) {
      add_to(t.dimension == 3 ? draft.volume_cells : draft.surface_cells, t.plural, others);
      drop_cells(mesh, kind);
    }
  }
}

void judge_other_cells(Draft& draft, const ReadOptions& options) {
  const auto add = [&draft](const std::map<std::string, Draft::Others>& cells, Finding finding,
                            std::string_view what) {
    const auto [text, sum] = listed(cells);
    finding.text = text + text_of_count(what, sum);
    finding.count = sum;
    draft.findings.push_back(at_first(cells, std::move(finding)));
  };
  const bool nothing_is_left = cell_count(draft.mesh) == 0;
  if (!draft.volume_cells.empty()) {
    const bool is_refused = !options.tetrahedra_only && (options.simplices || nothing_is_left);
    add(draft.volume_cells,
        {.code = "unsupported_cells",
         .severity = is_refused ? Severity::error : Severity::warning,
         .remedy =
             options.simplices
                 ? "mesh the body with tetrahedra, or split these cells: sunder convert "
                   "--split FILE NEW.vtu"
                 : "split these cells, in the program that made them, into cells that are kept"},
        options.tetrahedra_only ? " [is|are] left out, as requested"
        : options.simplices     ? ": of volume cells only tetrahedra are used here"
                                : " [is|are] left out");
  }
  if (!draft.curved_cells.empty()) {
    add(draft.curved_cells,
        {.code = "corners_only",
         .severity = Severity::warning,
         .remedy = "nothing to do, if their sides are straight; their other points stay as unused "
                   "points"},
        " [is|are] read by [its|their] corners");
  }
  if (!draft.surface_cells.empty()) {
    add(draft.surface_cells,
        {.code = "skipped_cells",
         .severity = Severity::warning,
         .remedy = options.simplices ? "nothing to do: only simplices are used"
                                     : "write them in another way, if they matter"},
        " [is|are] left out");
  }
}

/// The first `n` numbers, a blank between them.
std::string numbers_text(const FileCell& cell, std::size_t n) {
  constexpr std::size_t most = 27;
  std::string text;
  for (std::size_t k = 0; k < std::min(n, most); ++k) {
    text += fmt::format("{}{}", k == 0 ? "" : " ", cell.numbers[k]);
  }
  return n > most ? text + " ..." : text;
}

/// Whether two of the first `n` nodes are one.
bool repeats_node(const FileCell& cell, std::size_t n) {
  constexpr std::size_t few = 8;
  if (n > few) {
    std::vector<std::int64_t> sorted(cell.rows.begin(),
                                     cell.rows.begin() + static_cast<std::ptrdiff_t>(n));
    std::ranges::sort(sorted);
    return std::ranges::adjacent_find(sorted) != sorted.end();
  }
  for (std::size_t k = 1; k < n; ++k) {
    for (std::size_t j = 0; j < k; ++j) {
      if (cell.rows[j] == cell.rows[k]) return true;
    }
  }
  return false;
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

void add_cell(Draft& draft, CellKind kind, const FileCell& cell) {
  const CellKindTraits& t = traits_of(kind);
  const std::size_t nodes = kind == CellKind::polygon ? cell.rows.size() : t.nodes;
  const std::size_t row = rows_of(draft.mesh, kind).count;
  if (row == 0) draft.kept[index_of(kind)] = {0, draft.file, line_in(draft, cell.at)};
  const auto points = static_cast<std::int64_t>(draft.mesh.points.size());
  std::array<std::uint32_t, 27> few;
  std::vector<std::uint32_t> many(nodes > few.size() ? nodes : 0);
  const std::span<std::uint32_t> taken(nodes > few.size() ? many.data() : few.data(), nodes);
  std::size_t bad = nodes;
  for (std::size_t k = 0; k < nodes; ++k) {
    const bool is_there = cell.rows[k] >= 0 && cell.rows[k] < points;
    if (!is_there && bad == nodes) bad = k;
    taken[k] = is_there ? static_cast<std::uint32_t>(cell.rows[k]) : 0;
  }
  append_cell(draft.mesh, kind, taken);  // stays where the cell is wrong: rows are kept
  if (bad < nodes) {
    return add_problem(draft, "index_out_of_range", row, cell.at, [&] {
      return Finding{.text = fmt::format("the {} in row {} names point {}, which is none of the {} "
                                         "points",
                                         t.name, row, cell.numbers[bad], points),
                     .remedy = "correct the number, or add the missing points"};
    });
  }
  const std::size_t corners = kind == CellKind::polygon ? nodes : t.corners;
  if (!repeats_node(cell, corners)) return;
  const bool is_tetrahedron = linear_kind(kind) == CellKind::tetrahedron;
  add_problem(draft, is_tetrahedron ? "repeated_vertex" : "degenerate_cell", row, cell.at, [&] {
    return Finding{.severity = is_tetrahedron ? Severity::error : Severity::warning,
                   .text = fmt::format("the {} in row {} has points {}: {} different ones were "
                                       "expected",
                                       t.name, row, numbers_text(cell, corners),
                                       is_tetrahedron ? "four" : fmt::format("{}", corners)),
                   .remedy = fmt::format("correct the numbers, or delete the {}", t.name)};
  });
}

std::optional<CellKind> add_face(Draft& draft, const FileCell& cell) {
  const std::size_t corners = cell.rows.size();
  if (corners < 3) {
    add_other_cells(draft, "faces of fewer than three corners", 2, 1, cell.at);
    return std::nullopt;
  }
  if (corners > most_corners) {
    add_other_cells(draft, "faces of more than 10000 corners", 2, 1, cell.at);
    return std::nullopt;
  }
  add_cell(draft, kind_of_face(corners), cell);
  return kind_of_face(corners);
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
         .text = fmt::format("{} behind the last {} {} not read", counted(left, "byte"), row,
                             for_count(left, "is", "are")),
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
  for (const CellKind kind : all_cell_kinds) {
    if (rows_of(mesh, kind).count == 0) columns_of(mesh, kind).data.clear();
  }
}

/// A caller that computes with simplices needs no other content.
void lower_left_out(std::vector<Finding>& findings) {
  for (Finding& f : findings) {
    const bool is_left_out =
        f.code == "skipped_data" || f.code == "skipped_cells" || f.code == "corners_only";
    if (is_left_out && f.severity == Severity::warning) f.severity = Severity::note;
  }
}

}  // namespace

Result<FileMesh> finish(Draft&& draft, const ReadOptions& options) {
  drop_usual_numbers(draft.mesh);
  take_out(draft, options);
  drop_usual_numbers(draft.mesh);  // without the removed cells they may repeat the row too
  judge_other_cells(draft, options);
  drop_columns_of_nothing(draft.mesh);
  report_skipped(draft);
  if (options.simplices) lower_left_out(draft.findings);
  Result<FileMesh> result;
  result.findings = std::move(draft.findings);
  std::stable_sort(result.findings.begin(), result.findings.end(),
                   [](const Finding& a, const Finding& b) { return a.severity > b.severity; });
  if (!has_error(result.findings)) result.value = std::move(draft.mesh);
  return result;
}

}  // namespace sunder::io
