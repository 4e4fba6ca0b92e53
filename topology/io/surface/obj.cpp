// SPDX-License-Identifier: MIT
// OBJ read: a line per point or cell, joined to the next where it ends with a
// backslash.
#include "topology/io/surface/obj.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "topology/io/regions/named_regions.hpp"
#include "topology/io/text/scan.hpp"

namespace sunder::io {
namespace {

/// The purpose of a line, by its first word.
enum class Kind {
  point,
  face,
  line,
  vertex,
  group,
  object,
  material,
  look,
  freedom,
  curve,
  surface
};

struct Keyword {
  std::string_view word;
  Kind kind;
};
/// `look`: says nothing of the shape. `freedom`: belongs to free-form curves and surfaces. Both are
/// left out.
constexpr Keyword keywords[] = {
    {"v", Kind::point},         {"f", Kind::face},        {"l", Kind::line},
    {"p", Kind::vertex},        {"g", Kind::group},       {"o", Kind::object},
    {"usemtl", Kind::material}, {"mtllib", Kind::look},   {"s", Kind::look},
    {"vn", Kind::look},         {"vt", Kind::look},       {"usemap", Kind::look},
    {"maplib", Kind::look},     {"lod", Kind::look},      {"bevel", Kind::look},
    {"c_interp", Kind::look},   {"d_interp", Kind::look}, {"shadow_obj", Kind::look},
    {"trace_obj", Kind::look},  {"mg", Kind::look},       {"vp", Kind::freedom},
    {"cstype", Kind::freedom},  {"deg", Kind::freedom},   {"bmat", Kind::freedom},
    {"step", Kind::freedom},    {"parm", Kind::freedom},  {"trim", Kind::freedom},
    {"hole", Kind::freedom},    {"scrv", Kind::freedom},  {"sp", Kind::freedom},
    {"end", Kind::freedom},     {"con", Kind::freedom},   {"ctech", Kind::freedom},
    {"stech", Kind::freedom},   {"curv", Kind::curve},    {"curv2", Kind::curve},
    {"surf", Kind::surface},
};

const Keyword* keyword_of(std::string_view word) {
  const auto* const found = std::ranges::find(keywords, word, &Keyword::word);
  return found == std::end(keywords) ? nullptr : found;
}

/// The length of a line's end that a backslash hides at the scanner's place; 0 where there is none.
std::size_t hidden_end(const Scanner& s) {
  const std::string_view rest = s.text.substr(s.at, 3);
  return rest.starts_with("\\\n") ? 2 : rest == "\\\r\n" ? 3 : 0;
}

/// Passes blanks of the line, and line ends that a backslash hides.
void skip_in_line(Scanner& s) {
  while (s.at < s.text.size() && s.text[s.at] != '\n') {
    const std::size_t hidden = hidden_end(s);
    if (hidden == 0 && !is_blank(s.text[s.at])) return;
    s.at += std::max<std::size_t>(hidden, 1);
  }
}

/// The next word of the line; empty at its end and where a comment begins.
std::string_view next_in_line(Scanner& s) {
  skip_in_line(s);
  std::size_t end = s.at;
  Scanner here = s;
  while (here.at < s.text.size() && !is_blank(s.text[here.at]) && hidden_end(here) == 0) ++here.at;
  end = here.at;
  const std::string_view word = s.text.substr(s.at, end - s.at);
  if (word.starts_with('#')) return {};
  s.at = end;
  return word;
}

/// Passes the line's end.
void end_line(Scanner& s) {
  while (s.at < s.text.size()) {
    const std::size_t end = std::min(s.text.find('\n', s.at), s.text.size());
    std::string_view line = s.text.substr(s.at, end - s.at);
    s.at = std::min(end + 1, s.text.size());
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (!line.ends_with('\\')) return;
  }
}

struct ObjReader {
  Scanner s;
  Draft draft;
  /// The lines that give the regions.
  Kind label = Kind::material;
  /// Points read up to the line, for negative numbers.
  std::int64_t points = 0;
  std::string_view name;
  /// By dimension.
  std::array<WordList, 3> words;
  /// The name's place among the words; -1 for no name, `unknown_place` until a cell asks.
  std::array<std::int32_t, 3> place{-1, -1, -1};
};
constexpr std::int32_t unknown_place = -2;

void read_point(ObjReader& r, std::size_t at) {
  Point p;
  for (double& x : p) {
    skip_in_line(r.s);
    const bool is_there = r.s.at < r.s.text.size() && r.s.text[r.s.at] != '\n';
    if (!is_there) {
      fail(r.s.text, at,
           {.code = "bad_number",
            .text = "a line v has fewer than three coordinates",
            .remedy = "correct this line, or write the file again"});
    }
    const std::string_view word = next_in_line(r.s);
    Scanner number{r.s.text.substr(0, r.s.at), r.s.at - word.size()};
    x = read_number<double>(number, "a coordinate");
  }
  add_point(r.draft, p, at);
  if (!next_in_line(r.s).empty()) add_skipped(r.draft, "weights or colours of points", {}, at);
}

/// The number of a point: the digits before the first slash.
std::int64_t number_of(const ObjReader& r, std::string_view word) {
  const std::string_view digits = word.substr(0, word.find('/'));
  std::int64_t number = 0;
  const auto [end, reason] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (reason == std::errc{} && end == digits.data() + digits.size()) return number;
  fail(r.s.text, r.s.at - word.size(),
       {.code = reason == std::errc::result_out_of_range ? "number_out_of_range" : "bad_number",
        .text = fmt::format("{} stands where a point's number was expected", in_quotes(word)),
        .remedy = "correct this line, or write the file again"});
}

void set_corner(const ObjReader& r, FileCell& cell, std::size_t k, std::int64_t number) {
  cell.numbers[k] = number;
  const bool counts_back = number < 0 && number >= -r.points;
  cell.rows[k] = number > 0 ? number - 1 : counts_back ? r.points + number : -1;
}

/// Gives a cell the region that the lines before it name.
void add_label(ObjReader& r, CellKind kind) {
  const auto dimension = static_cast<std::size_t>(traits_of(kind).dimension);
  WordList& words = r.words[dimension];
  std::int32_t& place = r.place[dimension];
  if (place == unknown_place) place = r.name.empty() ? -1 : place_of_word(words, r.name);
  // A word takes some 200 bytes of memory, and may take ten of the file.
  if (words.words.size() > 1000 + r.s.text.size() / 128) {
    fail(r.s.text, r.draft.cell.at,
         {.code = "count_too_big",
          .text = fmt::format("{} groups are named in a file of {} bytes", words.words.size(),
                              r.s.text.size()),
          .remedy = "join groups, or take their names away"});
  }
  columns_of(r.draft.mesh, kind).region.push_back(place);
}

void read_face(ObjReader& r, std::size_t at) {
  FileCell& cell = r.draft.cell;
  cell.begin(0, at);
  for (std::string_view word = next_in_line(r.s); !word.empty(); word = next_in_line(r.s)) {
    const std::size_t k = cell.rows.size();
    if (k > most_corners) continue;  // reported by add_face
    cell.begin(k + 1, at);
    set_corner(r, cell, k, number_of(r, word));
  }
  if (const auto kind = add_face(r.draft, cell)) add_label(r, *kind);
}

void read_line(ObjReader& r, std::size_t at) {
  FileCell& cell = r.draft.cell;
  cell.begin(2, at);
  std::size_t corners = 0;
  for (std::string_view word = next_in_line(r.s); !word.empty(); word = next_in_line(r.s)) {
    cell.rows[0] = cell.rows[1];
    cell.numbers[0] = cell.numbers[1];
    set_corner(r, cell, 1, number_of(r, word));
    if (corners++ == 0) continue;
    add_cell(r.draft, CellKind::edge, cell);
    add_label(r, CellKind::edge);
  }
  if (corners < 2) add_other_cells(r.draft, "lines of fewer than two points", 1, 1, at);
}

void read_vertices(ObjReader& r, std::size_t at) {
  for (std::string_view word = next_in_line(r.s); !word.empty(); word = next_in_line(r.s)) {
    r.draft.cell.begin(1, at);
    set_corner(r, r.draft.cell, 0, number_of(r, word));
    add_cell(r.draft, CellKind::vertex, r.draft.cell);
    add_label(r, CellKind::vertex);
  }
}

/// Calls `work(keyword, place)` for every line, behind its first word; a null pointer for an
/// unknown one.
template <class Work>
void for_each_line(Scanner& s, Work work) {
  s.at = 0;
  while (s.at < s.text.size()) {
    const std::string_view word = next_in_line(s);
    if (!word.empty()) work(keyword_of(word), s.at - word.size());
    end_line(s);
  }
}

/// How many words are left on the line.
std::size_t words_left(Scanner& s) {
  std::size_t words = 0;
  while (!next_in_line(s).empty()) ++words;
  return words;
}

/// Room for all that will come, which growing lists would take twice.
struct Room {
  std::size_t points = 0, vertices = 0, edges = 0, triangles = 0;

  void count(Scanner& s, Kind kind) {
    if (kind == Kind::point) ++points;
    if (kind == Kind::vertex) vertices += words_left(s);
    if (kind == Kind::line) edges += std::max<std::size_t>(words_left(s), 1) - 1;
    if (kind == Kind::face) triangles += words_left(s) == 3;
  }
};

void make_room(FileMesh& mesh, const Room& room) {
  const auto reserve = [](auto& cells, std::size_t n) {
    cells.corners.reserve(n);
    cells.region.reserve(n);
  };
  mesh.points.reserve(room.points);
  reserve(mesh.vertices, room.vertices);
  reserve(mesh.edges, room.edges);
  reserve(mesh.triangles, room.triangles);
}

/// The content of a line that is left out.
std::string_view name_of_look(std::string_view word) {
  return word == "vn" ? "normals" : word == "vt" ? "texture coordinates" : word;
}

/// Smoothing that is switched off says nothing.
bool is_off_line(Scanner s, std::string_view word) {
  const std::string_view value = next_in_line(s);
  return word == "s" && (value == "off" || value == "0");
}

/// Reports a line that is left out, unless it is read.
void skip_line(ObjReader& r, const Keyword* keyword, std::size_t at) {
  Scanner line{r.s.text, at};
  const std::string_view word = next_in_line(line);
  if (keyword == nullptr) return add_skipped(r.draft, "lines of an unknown kind", word, at);
  if (keyword->kind == Kind::freedom) {
    return add_skipped(r.draft, "lines of free-form shapes", word, at);
  }
  if (keyword->kind == Kind::curve) add_other_cells(r.draft, "free-form curves", 1, 1, at);
  if (keyword->kind == Kind::surface) add_other_cells(r.draft, "free-form surfaces", 2, 1, at);
  if (keyword->kind == Kind::look && !is_off_line(line, word)) {
    add_skipped(r.draft, "lines", name_of_look(word), at);
  }
}

/// Names of groups are regions; those of objects and materials are left out.
void skip_other_names(ObjReader& r) {
  for_each_line(r.s, [&](const Keyword* keyword, std::size_t at) {
    if (keyword == nullptr || keyword->kind == r.label) return;
    if (keyword->kind == Kind::object) add_skipped(r.draft, "names", "of objects (o)", at);
    if (keyword->kind == Kind::material) {
      add_skipped(r.draft, "names", "of materials (usemtl)", at);
    }
  });
}

/// Counts the contents of the file, to make room for them, and reports those left out.
void survey(ObjReader& r) {
  bool has_groups = false, has_objects = false, has_materials = false;
  Room room;
  for_each_line(r.s, [&](const Keyword* keyword, std::size_t at) {
    skip_line(r, keyword, at);
    if (keyword == nullptr) return;
    room.count(r.s, keyword->kind);
    has_groups = has_groups || keyword->kind == Kind::group;
    has_objects = has_objects || keyword->kind == Kind::object;
    has_materials = has_materials || keyword->kind == Kind::material;
  });
  make_room(r.draft.mesh, room);
  r.label = has_groups ? Kind::group : has_objects ? Kind::object : Kind::material;
  if (has_groups + has_objects + has_materials > 1) skip_other_names(r);
}

/// Points are read before the cells, which may stand before them.
void read_points(ObjReader& r) {
  for_each_line(r.s, [&](const Keyword* keyword, std::size_t at) {
    if (keyword != nullptr && keyword->kind == Kind::point) read_point(r, at);
  });
}

void read_cells(ObjReader& r) {
  for_each_line(r.s, [&](const Keyword* keyword, std::size_t at) {
    if (keyword == nullptr) return;
    if (keyword->kind == Kind::point) ++r.points;
    if (keyword->kind == Kind::face) read_face(r, at);
    if (keyword->kind == Kind::line) read_line(r, at);
    if (keyword->kind == Kind::vertex) read_vertices(r, at);
    if (keyword->kind == r.label) {
      skip_in_line(r.s);
      Scanner rest = r.s;
      r.name = rest_of_line(rest);
      r.place.fill(unknown_place);
    }
  });
}

}  // namespace

bool is_obj(std::string_view text) {
  Scanner s{text};
  std::string_view word;
  while (s.at < text.size() && word.empty()) {
    word = next_in_line(s);
    end_line(s);
  }
  return keyword_of(word) != nullptr;
}

Draft read_obj(std::string_view text) {
  ObjReader r{.s = {text}, .draft = {.text = text}};
  survey(r);
  read_points(r);
  if (r.draft.mesh.points.empty()) {
    fail(text, text.size(),
         {.code = "missing_section",
          .text = "the file ends without a point (v x y z)",
          .remedy = "the file was cut short, or holds no mesh: write it again"});
  }
  read_cells(r);
  FileMesh& mesh = r.draft.mesh;
  for (int d = 0; d < 3; ++d) number_labels(mesh, d, r.words[static_cast<std::size_t>(d)]);
  return std::move(r.draft);
}

}  // namespace sunder::io
