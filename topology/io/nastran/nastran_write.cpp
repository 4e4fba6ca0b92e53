// SPDX-License-Identifier: MIT
// Nastran's bulk data written: points in large fields, elements in small ones.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>

#include "topology/base/counted.hpp"
#include "topology/base/sort_unique.hpp"
#include "topology/io/nastran/nastran.hpp"
#include "topology/io/nastran/nastran_cards.hpp"
#include "topology/io/nastran/nastran_reader.hpp"

namespace sunder::io {
namespace {

struct WrittenType {
  CellKind kind;
  std::string_view card;
};
constexpr WrittenType written_types[] = {{CellKind::edge, "CROD"},
                                         {CellKind::edge3, "CBEAM3"},
                                         {CellKind::triangle, "CTRIA3"},
                                         {CellKind::triangle6, "CTRIA6"},
                                         {CellKind::quad4, "CQUAD4"},
                                         {CellKind::quad8, "CQUAD8"},
                                         {CellKind::quad9, "CQUAD"},
                                         {CellKind::tetrahedron, "CTETRA"},
                                         {CellKind::tetrahedron10, "CTETRA"},
                                         {CellKind::hexahedron8, "CHEXA"},
                                         {CellKind::hexahedron20, "CHEXA"},
                                         {CellKind::prism6, "CPENTA"},
                                         {CellKind::prism15, "CPENTA"},
                                         {CellKind::pyramid5, "CPYRAM"},
                                         {CellKind::pyramid13, "CPYRAM"}};

constexpr std::int64_t highest_number = 99'999'999;
constexpr std::size_t large_field = 16;

bool is_property(std::int32_t region) { return region > 0 && region <= highest_number; }

bool are_held(std::vector<std::int64_t> numbers, std::size_t rows) {
  if (numbers.size() != rows) return false;
  sort_unique(numbers);
  return numbers.size() == rows &&
         (rows == 0 || (numbers.front() > 0 && numbers.back() <= highest_number));
}

/// A real as Nastran writes it: with a point, its exponent without a letter.
std::string as_field(std::string text) {
  const std::size_t e = text.find('e');
  std::string exponent = e == std::string::npos ? "" : text.substr(e + 1);
  if (e != std::string::npos) text.resize(e);
  if (text.find('.') == std::string::npos) text += '.';
  if (exponent.empty()) return text;
  const bool is_negative = exponent.front() == '-';
  exponent.erase(0, std::min(exponent.find_first_not_of("+-0"), exponent.size() - 1));
  return text + (is_negative ? '-' : '+') + exponent;
}

/// The number in sixteen characters, with all digits that fit.
std::string real_field(double x) {
  std::string text = as_field(fmt::format("{}", x));
  if (text.size() <= large_field) return text;
  // Of 0.0012345678901234 all digits fit behind an exponent, of 12.345678901234567 without one.
  for (int digits = 17; digits > 0; --digits) {
    for (const bool is_plain : {true, false}) {
      text = as_field(is_plain ? fmt::format("{:.{}g}", x, digits)
                               : fmt::format("{:.{}e}", x, digits - 1));
      if (text.size() > large_field) continue;
      return text;
    }
  }
  return text;
}

double value_of(const std::string& field) {
  Card card;
  card.fields.emplace_back(field);
  return card_real(field, card, 0, "a coordinate");
}

/// The property that stands for no region: the lowest that no cell has; 0 where all cells have one.
std::int32_t unused_property(const FileMesh& mesh) {
  std::vector<std::int32_t> used;
  bool is_needed = false;
  for (const CellKind kind : all_cell_kinds) {
    if (kind == CellKind::vertex) continue;
    const std::vector<std::int32_t>& label = label_of(columns_of(mesh, kind));
    is_needed = is_needed || (label.empty() && rows_of(mesh, kind).count > 0);
    for (const std::int32_t region : label) {
      is_property(region) ? used.push_back(region) : void(is_needed = true);
    }
  }
  if (!is_needed) return 0;
  sort_unique(used);
  std::int32_t property = 1;
  for (const std::int32_t region : used) property += region == property;
  return property;
}

}  // namespace

HeldNumbers nastran_holds(const FileMesh& mesh) {
  std::vector<std::int64_t> cells;
  std::size_t rows = 0;
  for (const CellKind kind : all_cell_kinds) {
    if (kind == CellKind::vertex) continue;
    const std::vector<std::int64_t>& own = columns_of(mesh, kind).source_id;
    cells.insert(cells.end(), own.begin(), own.end());
    rows += rows_of(mesh, kind).count;
  }
  return {are_held(mesh.source_point_id, mesh.points.size()), are_held(std::move(cells), rows)};
}

std::vector<Finding> lost_in_nastran(const FileMesh& mesh) {
  std::vector<Finding> lost;
  const auto lose = [&](std::string_view code, std::size_t count, std::string text) {
    if (count == 0) return;
    lost.push_back({.code = std::string(code),
                    .severity = Severity::warning,
                    .count = count,
                    .text = std::move(text),
                    .remedy = "write another format than Nastran to keep them"});
  };
  std::size_t rounded = 0, others = 0;
  double largest = 0;
  for (const Point& p : mesh.points) {
    double change = 0;
    for (const double x : p) {
      const double kept = value_of(real_field(x));
      if (kept != x) change = std::max(change, std::abs((x - kept) / x));
    }
    rounded += change > 0;
    largest = std::max(largest, change);
  }
  for (const CellKind kind : all_cell_kinds) {
    if (kind == CellKind::vertex) continue;
    others += static_cast<std::size_t>(
        std::ranges::count_if(label_of(columns_of(mesh, kind)),
                              [](auto region) { return region != 0 && !is_property(region); }));
  }
  lose("coordinates_rounded", rounded,
       fmt::format("{} coordinates of more digits than sixteen characters hold: they change by up "
                   "to {:.2g} of their size",
                   counted(rounded, "point has", "points have"), largest));
  lose("regions_lost", others,
       fmt::format("{} no property, from 1 to 99999999",
                   counted(others, "cell has a region that is", "cells have regions that are")));
  return lost;
}

std::string write_nastran(const FileMesh& mesh) {
  std::string out;
  out.reserve(96 * mesh.points.size() + 72 * cell_count(mesh));
  const HeldNumbers own = nastran_holds(mesh);
  const std::int32_t no_region = unused_property(mesh);
  out += "$ written by Sunder\n";
  if (no_region > 0) {
    fmt::format_to(std::back_inserter(out), "{}{}\n", no_region_mark, no_region);
  }
  out += "BEGIN BULK\n";
  const auto node = [&](std::size_t row) {
    return own.points ? mesh.source_point_id[row] : static_cast<std::int64_t>(row) + 1;
  };
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const Point& p = mesh.points[i];
    fmt::format_to(std::back_inserter(out), "GRID*   {:<16}{:16}{:>16}{:>16}\n*       {:>16}\n",
                   node(i), "", real_field(p[0]), real_field(p[1]), real_field(p[2]));
  }
  std::int64_t next = 1;
  for (const WrittenType& type : written_types) {
    const CellRows rows = rows_of(mesh, type.kind);
    const CellColumns& cells = columns_of(mesh, type.kind);
    const std::vector<std::int32_t>& label = label_of(cells);
    const std::span<const std::uint8_t> order = nastran_order(type.kind);
    for (std::size_t i = 0; i < rows.count; ++i) {
      const std::int32_t region = label.empty() ? 0 : label[i];
      fmt::format_to(std::back_inserter(out), "{:<8}{:<8}{:<8}", type.card,
                     own.cells ? cells.source_id[i] : next++,
                     is_property(region) ? region : no_region);
      for (std::size_t k = 0; k < rows.nodes; ++k) {
        // Eight fields a line, the first of which has number and property too.
        if (k >= 6 && (k - 6) % 8 == 0) out += "\n        ";
        fmt::format_to(std::back_inserter(out), "{:<8}",
                       node(rows[i][order.empty() ? k : order[k]]));
      }
      while (out.back() == ' ') out.pop_back();
      out += '\n';
    }
  }
  out += "ENDDATA\n";
  return out;
}

}  // namespace sunder::io
