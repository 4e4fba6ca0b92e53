// SPDX-License-Identifier: MIT
// OFF read and written: three counts, points, faces. Binary files have big-endian words of 4 bytes.
#include "topology/io/surface/off.hpp"

#include <fmt/format.h>

#include <bit>

#include "topology/io/text/number_sink.hpp"
#include "topology/io/text/number_source.hpp"
#include "topology/io/text/row_watch.hpp"

namespace sunder::io {
namespace {

/// The meaning of the header's word: OFF behind any of ST, C, N, 4 and n.
struct Header {
  bool is_off = false;
  bool has_texture = false, has_colors = false, has_normals = false;
  /// 4OFF and nOFF: points that are not in space.
  bool has_other_dimension = false;

  bool has_more() const { return has_texture || has_colors || has_normals; }
};

Header header_of(std::string_view word) {
  Header h;
  const auto takes = [&word](std::string_view prefix) {
    if (!word.starts_with(prefix)) return false;
    word.remove_prefix(prefix.size());
    return true;
  };
  // The format's description has ST, C, N, 4, n in this order, programs have any.
  for (bool goes_on = true; goes_on;) {
    const bool texture = takes("ST"), colors = takes("C"), normals = takes("N");
    const bool other = takes("4") || takes("n");
    h.has_texture = h.has_texture || texture;
    h.has_colors = h.has_colors || colors;
    h.has_normals = h.has_normals || normals;
    h.has_other_dimension = h.has_other_dimension || other;
    goes_on = texture || colors || normals || other;
  }
  h.is_off = word == "OFF" || word == "off";
  return h;
}

void skip_comments(Scanner& s) {
  while (peek_word(s).starts_with('#')) rest_of_line(s);
}

struct OffReader {
  NumberSource in;
  Draft draft;
  RowWatch watch;
  Header header;
};

void read_header(OffReader& r) {
  Scanner& s = r.in.s;
  skip_comments(s);
  const std::size_t at = s.at;
  r.header = header_of(peek_word(s));
  if (!r.header.is_off) return;  // the word may be missing
  const std::string_view word = next_word(s);
  if (r.header.has_other_dimension) {
    fail(s.text, at,
         {.code = "unsupported_cells",
          .text = fmt::format("{}: its points have other than three coordinates", in_quotes(word)),
          .remedy = "give a surface in space, as OFF"});
  }
  Scanner behind = s;
  if (next_word(behind) != "BINARY") return;
  r.in.is_binary = true;
  r.in.swap = std::endian::native == std::endian::little;
  rest_of_line(s);
}

/// The rest of a row's line behind its numbers; empty for a comment.
std::string_view rest_of_row(Scanner& s) {
  const std::string_view rest = rest_of_line(s);
  return rest.starts_with('#') ? std::string_view{} : rest;
}

void skip_behind_point(OffReader& r, std::size_t at) {
  if (r.in.is_binary) {
    const std::size_t numbers = (r.header.has_normals ? 3 : 0) + (r.header.has_colors ? 4 : 0) +
                                (r.header.has_texture ? 2 : 0);
    return skip_numbers(r.in, numbers, 4 * numbers, "a normal or a colour");
  }
  const std::string_view rest = rest_of_row(r.in.s);
  if (rest.empty() || r.header.has_more()) return;
  fail(r.in.s.text, at,
       {.code = "bad_number",
        .text = fmt::format("{} stands behind a point's three coordinates", in_quotes(rest)),
        .remedy = "give each point a line of its own; where there are colours or normals, the file "
                  "must begin with COFF or NOFF"});
}

/// Words behind a row in its line are colours; a row that goes on in the next may be short.
void watch_short(OffReader& r) {
  if (r.in.is_binary) return;
  const Scanner ended{r.in.s.text.substr(0, r.in.s.at), r.in.s.at};
  end_row(r.watch, ended);
}

void read_points(OffReader& r, std::size_t n) {
  r.draft.mesh.points.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (!r.in.is_binary) skip_comments(r.in.s);
    const std::size_t at = place_of_next(r.in);
    Point p;
    begin_row(r.watch, at);
    for (double& x : p) x = read_next<double, float>(r.in, "a coordinate");
    watch_short(r);
    add_point(r.draft, p, at);
    skip_behind_point(r, at);
  }
}

void skip_colors(OffReader& r, std::size_t at) {
  bool any = false;
  if (r.in.is_binary) {
    const std::size_t colors = read_bounded<std::int32_t>(r.in, "colour components", 1, 4);
    skip_numbers(r.in, 0, 4 * colors, "a colour");
    any = colors > 0;
  } else {
    any = !rest_of_row(r.in.s).empty();
  }
  if (any) add_skipped(r.draft, "colours of faces", {}, at);
}

void read_face(OffReader& r) {
  if (!r.in.is_binary) skip_comments(r.in.s);
  const std::size_t at = place_of_next(r.in);
  begin_row(r.watch, at);
  const std::size_t corners = read_bounded<std::int32_t>(r.in, "corners of a face", 2, 4);
  FileCell& cell = r.draft.cell;
  const std::size_t taken = std::min(corners, most_corners + 1);
  cell.begin(taken, at);
  for (std::size_t k = 0; k < taken; ++k) {
    cell.numbers[k] = cell.rows[k] = read_next<std::int64_t, std::int32_t>(r.in, "a point's row");
  }
  skip_numbers(r.in, corners - taken, 4 * (corners - taken), "a point's row");
  watch_short(r);
  if (corners == 0) {
    add_other_cells(r.draft, "faces without corners", 2, 1, at);
  } else if (corners < 3) {
    add_cell(r.draft, simplex_of(static_cast<int>(corners) - 1), cell);
  } else {
    add_face(r.draft, cell);
  }
  skip_colors(r, at);
}

/// The data of every point that the header announces.
void skip_looks(OffReader& r, std::size_t at) {
  const std::size_t points = r.draft.mesh.points.size();
  const auto skip = [&](bool is_there, std::string_view what) {
    if (is_there) add_skipped(r.draft, "data of points", what, at, points);
  };
  skip(r.header.has_normals, "normals");
  skip(r.header.has_colors, "colours");
  skip(r.header.has_texture, "texture coordinates");
}

}  // namespace

bool is_off(std::string_view text) {
  Scanner s{text};
  skip_comments(s);
  return header_of(peek_word(s)).is_off;
}

Draft read_off(std::string_view text) {
  OffReader r{.in = {.s = {.text = text}}, .draft = {.text = text}};
  read_header(r);
  if (r.in.is_binary) {
    r.draft.text = {};  // there are no lines to count
  } else {
    skip_comments(r.in.s);
  }
  const std::size_t points = read_bounded<std::int32_t>(r.in, "points", 6, 12);
  const std::size_t faces = read_bounded<std::int32_t>(r.in, "faces", 2, 8);
  // The number of edges is checked by nobody, and sometimes missing.
  r.in.is_binary ? skip_numbers(r.in, 0, 4, "a number of edges") : void(rest_of_line(r.in.s));
  const std::size_t points_at = place_of_next(r.in);
  try {
    read_points(r, points);
    skip_looks(r, points_at);
    for (std::size_t i = 0; i < faces; ++i) read_face(r);
    if (!r.in.is_binary) skip_comments(r.in.s);
    check_end(r.draft, r.in, "face");
  } catch (ReadFailure& failure) {
    if (!r.in.is_binary) blame_row(r.watch, text, failure);
    throw;
  }
  return std::move(r.draft);
}

std::string write_off(const FileMesh& mesh) {
  constexpr CellKind kinds[] = {CellKind::triangle, CellKind::quad4, CellKind::polygon};
  std::size_t faces = 0;
  for (const CellKind kind : kinds) faces += rows_of(mesh, kind).count;
  NumberSink out;
  out.bytes.reserve(64 + 60 * mesh.points.size() + 24 * faces);
  put_text(out, "OFF\n");
  put<std::size_t>(out, mesh.points.size());
  put<std::size_t>(out, faces);
  put_text(out, "0\n");
  for (const Point& p : mesh.points) {
    for (std::size_t k = 0; k < 3; ++k) put<double>(out, p[k], k == 2 ? '\n' : ' ');
  }
  for (const CellKind kind : kinds) {
    const CellRows rows = rows_of(mesh, kind);
    for (std::size_t i = 0; i < rows.count; ++i) {
      put<std::size_t>(out, rows[i].size());
      for (const std::uint32_t corner : rows[i]) put<std::uint32_t>(out, corner);
      out.bytes.back() = '\n';
    }
  }
  return std::move(out.bytes);
}

}  // namespace sunder::io
