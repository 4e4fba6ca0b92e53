// SPDX-License-Identifier: MIT
// STL read and written: facets of three points each, which are made one where they coincide.
#include "topology/io/surface/stl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "topology/io/regions/named_regions.hpp"
#include "topology/io/text/number_sink.hpp"
#include "topology/io/text/number_source.hpp"
#include "topology/io/text/row_watch.hpp"

namespace sunder::io {
namespace {

constexpr std::size_t header_bytes = 80, facet_bytes = 50;

/// How many facets a binary file announces; it may be too short to.
std::size_t announced_facets(std::string_view text) {
  std::uint32_t facets = 0;
  if (text.size() < header_bytes + 4) return 0;
  std::memcpy(&facets, text.data() + header_bytes, sizeof facets);
  return std::endian::native == std::endian::big ? byte_swapped(facets) : facets;
}

bool is_binary_stl(std::string_view text) {
  return text.size() >= header_bytes + 4 &&
         text.size() == header_bytes + 4 + facet_bytes * announced_facets(text);
}

bool is_word(std::string_view word, std::string_view lower) {
  return std::ranges::equal(word, lower, [](char a, char b) {
    return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
  });
}

/// A corner of a facet: its coordinates as words that are equal where they are (-0 is 0), and its
/// place among the corners. Words and not doubles: not-a-number has its place in the order too.
struct Corner {
  std::array<std::uint64_t, 3> place;
  std::uint32_t row;
};

/// The lowest row of each row's place. Sorting, not hashing: no file can make it slow.
std::vector<std::uint32_t> first_of_place(const std::vector<Point>& corners) {
  std::vector<Corner> sorted(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      sorted[i].place[k] = std::bit_cast<std::uint64_t>(corners[i][k] + 0.0);
    }
    sorted[i].row = static_cast<std::uint32_t>(i);
  }
  std::ranges::sort(sorted, [](const Corner& a, const Corner& b) {
    return a.place != b.place ? a.place < b.place : a.row < b.row;
  });
  std::vector<std::uint32_t> first(corners.size());
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const bool is_new = i == 0 || sorted[i].place != sorted[i - 1].place;
    first[sorted[i].row] = is_new ? sorted[i].row : first[sorted[i - 1].row];
  }
  return first;
}

/// Corners of facets while they are read, three each, and where each facet stands.
struct Facets {
  RowWatch watch;
  std::vector<Point> corners;
  std::vector<std::size_t> at;
  /// Of each facet, in text: the place of its solid's name among the words, -1 for none.
  std::vector<std::int32_t> solid;
  WordList words;
};

/// Points and triangles of the facets.
void take_facets(Draft& draft, Facets&& facets) {
  const std::vector<std::uint32_t> first = first_of_place(facets.corners);
  std::vector<std::uint32_t> point_of(first.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (first[i] == i) {
      point_of[i] = static_cast<std::uint32_t>(draft.mesh.points.size());
      add_point(draft, facets.corners[i], facets.at[i / 3]);
    } else {
      point_of[i] = point_of[first[i]];
    }
  }
  facets.corners = {};
  draft.mesh.triangles.corners.reserve(point_of.size() / 3);
  for (std::size_t i = 0; i < point_of.size(); i += 3) {
    FileCell& cell = draft.cell;
    cell.begin(3, facets.at[i / 3]);
    for (std::size_t k = 0; k < 3; ++k) cell.numbers[k] = cell.rows[k] = point_of[i + k];
    add_cell(draft, CellKind::triangle, cell);
  }
  draft.mesh.triangles.region = std::move(facets.solid);
  number_regions(draft.mesh.triangles.region, facets.words, draft.mesh.region_name[2]);
}

void expect(Scanner& s, std::string_view word) {
  if (is_word(peek_word(s), word)) {
    next_word(s);
    return;
  }
  fail_expected(s, fmt::format("the word {}", word));
}

/// Whether the next words end the block of `word`: `endsolid`, or `end solid` as in some files.
bool is_end(Scanner s, std::string_view word) {
  const std::string_view first = next_word(s);
  if (is_word(first, "end")) return is_word(next_word(s), word);
  return first.size() > 3 && is_word(first.substr(0, 3), "end") && is_word(first.substr(3), word);
}

void expect_end(Scanner& s, std::string_view word) {
  if (!is_end(s, word)) fail_expected(s, fmt::format("the word end{}", word));
  if (is_word(next_word(s), "end")) next_word(s);
}

/// A normal is computed from the corners: it may be short, or missing.
void skip_normal(Scanner& s) {
  if (!is_word(peek_word(s), "normal")) return;
  next_word(s);
  for (int k = 0; k < 3 && !is_word(peek_word(s), "outer"); ++k) skip_words(s, 1, "a normal");
}

void read_text_facet(Scanner& s, Facets& facets) {
  facets.at.push_back(s.at);
  expect(s, "facet");
  skip_normal(s);
  expect(s, "outer");
  expect(s, "loop");
  for (std::size_t k = 0; k < 3; ++k) {
    skip_blanks(s);
    begin_row(facets.watch, s.at);
    expect(s, "vertex");
    Point& p = facets.corners.emplace_back();
    for (double& x : p) x = read_number<double>(s, "a coordinate");
    end_row(facets.watch, s);
  }
  if (is_word(peek_word(s), "vertex")) {
    fail(s.text, s.at,
         {.code = "wrong_count",
          .text = fmt::format("facet {} has a fourth vertex: three were expected",
                              facets.at.size() - 1),
          .remedy = "cut the facets into triangles"});
  }
  expect_end(s, "loop");
  expect_end(s, "facet");
}

void read_text(Draft& draft) {
  Scanner s{draft.text};
  Facets facets;
  while (!peek_word(s).empty()) {
    expect(s, "solid");
    const std::string_view name = rest_of_line(s);
    const std::size_t first = facets.at.size();
    try {
      while (!is_end(s, "solid")) read_text_facet(s, facets);
    } catch (ReadFailure& failure) {
      blame_row(facets.watch, draft.text, failure);
      throw;
    }
    if (facets.at.size() > first) {
      facets.solid.resize(facets.at.size(), name.empty() ? -1 : place_of_word(facets.words, name));
    }
    expect_end(s, "solid");
    rest_of_line(s);
  }
  take_facets(draft, std::move(facets));
}

void read_binary(Draft& draft, std::string_view text) {
  NumberSource in{.s = {.text = text, .at = header_bytes}, .is_binary = true};
  in.swap = std::endian::native == std::endian::big;
  const std::size_t n = read_bounded<std::uint32_t>(in, "facets", 1, facet_bytes);
  Facets facets;
  facets.corners.reserve(3 * n);
  facets.at.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    facets.at.push_back(in.s.at);
    skip_numbers(in, 0, 12, "a normal");
    for (int k = 0; k < 3; ++k) {
      Point& p = facets.corners.emplace_back();
      for (double& x : p) x = read_raw<float>(in, "a coordinate");
    }
    const std::size_t at = in.s.at;
    const auto attribute = read_raw<std::uint16_t>(in, "attribute bytes");
    if (attribute != 0) add_skipped(draft, "attribute bytes of facets", {}, at);
  }
  check_end(draft, in, "facet");
  take_facets(draft, std::move(facets));
}

}  // namespace

bool is_stl(std::string_view text) {
  return is_binary_stl(text) || is_word(first_word(text), "solid");
}

Draft read_stl(std::string_view text) {
  if (!is_binary_stl(text) && is_word(first_word(text), "solid")) {
    Draft draft{.text = text};
    read_text(draft);
    return draft;
  }
  Draft draft;
  if (text.size() < header_bytes) fail_short({text, 0}, "a header", header_bytes);
  read_binary(draft, text);
  return draft;
}

namespace {

/// The unit normal; 0 where there is none. Edges are scaled: neither overflow nor underflow spoils
/// it.
std::array<float, 3> unit_normal(const Point& a, const Point& b, const Point& c) {
  Point e{}, f{};
  double e_size = 0, f_size = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    e[k] = b[k] / 2 - a[k] / 2;
    f[k] = c[k] / 2 - a[k] / 2;
    e_size = std::max(e_size, std::abs(e[k]));
    f_size = std::max(f_size, std::abs(f[k]));
  }
  if (e_size == 0 || f_size == 0) return {};
  for (double& x : e) x /= e_size;
  for (double& x : f) x /= f_size;
  const Point n = {e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]};
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  if (length == 0) return {};
  std::array<float, 3> unit{};
  for (std::size_t k = 0; k < 3; ++k) unit[k] = static_cast<float>(n[k] / length);
  return unit;
}

void put_text_facet(NumberSink& out, const std::array<float, 3>& normal,
                    const std::array<Point, 3>& corners) {
  put_text(out, "facet normal");
  for (const float x : normal) {
    out.bytes += ' ';
    put_text(out, x);
  }
  put_text(out, "\n outer loop\n");
  for (const Point& p : corners) {
    put_text(out, "  vertex");
    for (const double x : p) {
      out.bytes += ' ';
      put_text(out, x);
    }
    out.bytes += '\n';
  }
  put_text(out, " endloop\nendfacet\n");
}

}  // namespace

std::string write_stl(const FileMesh& mesh, bool is_binary) {
  const auto& triangles = mesh.triangles.corners;
  NumberSink out{.is_binary = is_binary};
  if (is_binary) {
    out.bytes.reserve(header_bytes + 4 + facet_bytes * triangles.size());
    out.bytes = "binary STL written by sunder";
    out.bytes.resize(header_bytes, ' ');
    put_little(out, static_cast<std::uint32_t>(triangles.size()));
  } else {
    out.bytes.reserve(32 + 256 * triangles.size());
    if (triangles.empty()) put_text(out, "solid\nendsolid\n");
  }
  const RegionNames words = region_words(mesh.region_name);
  const std::vector<std::int32_t>& label = label_of(mesh.triangles);
  std::string name;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto& t = triangles[i];
    const bool is_first = i == 0 || (!label.empty() && label[i] != label[i - 1]);
    if (!is_binary && is_first) {
      if (i > 0) put_text(out, fmt::format("endsolid{}\n", name));
      if (!label.empty()) name = fmt::format(" {}", word_of_region(words, 2, label[i]));
      put_text(out, fmt::format("solid{}\n", name));
    }
    const std::array<Point, 3> corners = {mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]};
    const auto normal = unit_normal(corners[0], corners[1], corners[2]);
    if (!is_binary) {
      put_text_facet(out, normal, corners);
      continue;
    }
    for (const float x : normal) put_little(out, x);
    for (const Point& p : corners) {
      for (const double x : p) put_little(out, static_cast<float>(x));
    }
    put_little(out, std::uint16_t{0});
  }
  if (!is_binary && !triangles.empty()) put_text(out, fmt::format("endsolid{}\n", name));
  return std::move(out.bytes);
}

namespace {

/// Counts a used point that floats do not hold.
void judge_rounding(StlPoints& points, const Point& p) {
  double change = 0;
  bool is_too_big = false;
  for (const double x : p) {
    if (std::abs(x) > static_cast<double>(std::numeric_limits<float>::max())) {
      is_too_big = true;
    } else if (x != static_cast<double>(static_cast<float>(x))) {
      change =
          std::max(change, std::abs(x - static_cast<double>(static_cast<float>(x))) / std::abs(x));
    }
  }
  points.too_big += is_too_big;
  points.rounded += change > 0;
  points.largest_change = std::max(points.largest_change, change);
}

}  // namespace

StlPoints stl_points(const FileMesh& mesh, bool is_binary) {
  StlPoints result;
  constexpr auto unseen = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> order, place(mesh.points.size(), unseen);
  std::vector<Point> used;
  for (const auto& corners : mesh.triangles.corners) {
    for (const std::uint32_t corner : corners) {
      if (place[corner] != unseen) continue;
      place[corner] = static_cast<std::uint32_t>(order.size());
      order.push_back(corner);
      Point p = mesh.points[corner];
      if (is_binary) {
        judge_rounding(result, p);
        for (double& x : p) {
          if (std::abs(x) <= static_cast<double>(std::numeric_limits<float>::max())) {
            x = static_cast<double>(static_cast<float>(x));
          }
        }
      }
      used.push_back(p);
    }
  }
  result.unused = mesh.points.size() - order.size();
  result.is_reordered = !std::ranges::is_sorted(order);
  const std::vector<std::uint32_t> first = first_of_place(used);
  for (std::size_t i = 0; i < first.size(); ++i) result.merged += first[i] != i;
  return result;
}

}  // namespace sunder::io
