// SPDX-License-Identifier: MIT
// PolyData's lists of cells become one list with types, as unstructured grids have it.
#include "topology/io/vtk/vtk_polydata.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace sunder::io {
namespace {

constexpr std::string_view list_words[] = {"vertices", "lines", "polygons", "triangle_strips"};

/// VTK's type of a cell by its list and size.
std::int64_t type_of(PolyList list, std::int64_t size) {
  switch (list) {
    case PolyList::vertices:
      return size == 1 ? 1 : 2;
    case PolyList::lines:
      return size == 2 ? 3 : 4;
    case PolyList::polygons:
      return size == 3 ? 5 : size == 4 ? 9 : 7;
    case PolyList::strips:
      return 6;
  }
  return 0;
}

/// The lists, kept until all are there: they may stand in any order.
using PolyLists = std::array<VtkCells, poly_lists>;

void add_all(VtkReader& r, PolyLists& lists) {
  VtkCells cells;
  for (std::size_t i = 0; i < poly_lists; ++i) {
    VtkCells list = std::move(lists[i]);
    append_poly_cells(cells, static_cast<PolyList>(i), std::move(list), r.draft.text.size());
  }
  check_vtk_cells(cells, r.draft.text, r.cells_at);
  add_vtk_cells(r.draft, r.piece, cells, r.cells_at);
}

/// Cells without points take a byte of a file each, and many times that of memory.
void bound_empty_cells(const std::vector<std::int64_t>& ends, std::size_t bytes) {
  constexpr std::size_t bytes_a_cell = 32, always = 1000;
  std::size_t empty = 0;
  std::int64_t before = 0;
  for (const std::int64_t end : ends) empty += end == std::exchange(before, end);
  if (empty <= always + bytes / bytes_a_cell) return;
  throw ReadFailure{{.code = "count_too_big",
                     .text = fmt::format("{} cells without points in {} bytes", empty, bytes),
                     .remedy = "leave out cells that have no points"}};
}

template <class Number>
void append(std::vector<Number>& list, std::vector<Number>&& more) {
  if (list.empty()) {
    list = std::move(more);
  } else {
    make_room(list, more.size());
    list.insert(list.end(), more.begin(), more.end());
  }
}

}  // namespace

void append_poly_cells(VtkCells& cells, PolyList list, VtkCells&& more, std::size_t bytes) {
  bound_empty_cells(more.ends, bytes);
  const auto first = static_cast<std::int64_t>(cells.points.size());
  const auto size = static_cast<std::int64_t>(more.points.size());
  append(cells.points, std::move(more.points));
  make_room(cells.types, more.ends.size());
  std::int64_t before = 0;
  for (std::int64_t& end : more.ends) {
    const bool falls = end < before || end > size;
    cells.types.push_back(type_of(list, falls ? 0 : end - before));
    if (!falls) before = end;  // one far below 0 would leave no difference to the next
    end = falls ? -1 : first + end;
  }
  append(cells.ends, std::move(more.ends));
}

Draft read_polydata(VtkReader&& r) {
  PolyLists lists;
  std::array<bool, poly_lists> is_there{};
  bool is_added = false;
  while (!peek_word(r.in.s).empty()) {
    const std::size_t at = r.in.s.at;
    const std::string_view word = next_word(r.in.s);
    const std::string keyword = lower(word);
    const auto* const list = std::ranges::find(list_words, keyword);
    if (list != std::end(list_words)) {
      const auto i = static_cast<std::size_t>(list - list_words);
      if (is_added) {
        fail(r.in.s.text, at,
             {.code = "wrong_section_order",
              .text = fmt::format("{} stands behind data", in_quotes(word)),
              .remedy = "put all cells before the data"});
      }
      refuse_second(r, is_there[i], word);
      r.cells = {};
      read_cell_list(r);
      lists[i] = std::move(r.cells);
      continue;
    }
    if ((keyword == "point_data" || keyword == "cell_data") && !std::exchange(is_added, true)) {
      add_all(r, lists);
    }
    const bool is_of_grids = keyword == "cells" || keyword == "cell_types";
    read_keyword(r, is_of_grids ? "" : word, at);
  }
  if (!is_added) add_all(r, lists);
  expect_section(r, r.has_points, "POINTS");
  finish_vtk_columns(r.draft);
  return std::move(r.draft);
}

}  // namespace sunder::io
