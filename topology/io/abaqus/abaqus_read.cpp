// SPDX-License-Identifier: MIT
// Abaqus' input read: keywords with their lines, nodes, files that are included.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <utility>

#include "topology/io/abaqus/abaqus.hpp"
#include "topology/io/abaqus/abaqus_reader.hpp"
#include "topology/io/text/scan.hpp"

namespace sunder::io {
namespace {

constexpr int deepest_include = 8;

/// A keyword's line: `*ELEMENT, TYPE=C3D4, ELSET=core`.
struct Keyword {
  /// In lower case, without the star and without blanks.
  std::string name;
  /// Names in lower case without blanks; values as they are, without quotes.
  std::vector<std::pair<std::string, std::string_view>> parameters;
  std::size_t at = 0;
};

std::string without_blanks(std::string_view text) {
  std::string word = lower_case(text);
  std::erase_if(word, is_blank);
  return word;
}

/// Where the lines of a file stand: the keyword that they belong to.
enum class Card { other, nodes, elements, elset, nset, instance };

struct Place {
  Card card = Card::other;
  /// Of *ELEMENT.
  const AbaqusType* type = nullptr;
  std::string_view type_word;
  std::int32_t set = -1;
  bool generate = false;
  /// Whether lines of data have been met since the keyword, in the same file.
  bool has_begun = false;
};

struct Pass {
  AbaqusReader& r;
  Place place;
  std::uint32_t file = 0;
  std::string_view text;
  /// Where the next line begins.
  std::size_t next = 0;
};

[[noreturn]] void refuse(const Pass& p, std::size_t at, Finding finding) {
  fail(p.text, at, std::move(finding));
}

std::string_view parameter(const Keyword& k, std::string_view name) {
  for (const auto& [own, value] : k.parameters) {
    if (own == name) return value;
  }
  return {};
}

bool has_parameter(const Keyword& k, std::string_view name) {
  return std::ranges::any_of(k.parameters, [&](const auto& p) { return p.first == name; });
}

std::string_view needed(const Pass& p, const Keyword& k, std::string_view name) {
  const std::string_view value = parameter(k, name);
  if (!value.empty()) return value;
  refuse(p, k.at,
         {.code = "bad_keyword",
          .text = fmt::format("*{} has no parameter {}=", k.name, name),
          .remedy = "complete the keyword's line"});
}

/// Reads the words of one line.
void read_parameters(std::string_view line, Keyword& k) {
  while (!line.empty()) {
    std::size_t comma = 0;
    for (bool quoted = false; comma < line.size() && (quoted || line[comma] != ','); ++comma) {
      quoted = quoted != (line[comma] == '"');
    }
    const std::string_view word = trimmed(line.substr(0, comma));
    line.remove_prefix(std::min(comma + 1, line.size()));
    if (k.name.empty()) {
      k.name = without_blanks(word);
    } else if (!word.empty()) {
      const std::size_t equals = std::min(word.find('='), word.size());
      std::string_view value = trimmed(word.substr(std::min(equals + 1, word.size())));
      if (value.size() >= 2 && value.front() == '"' && value.back() == '"') {
        value = value.substr(1, value.size() - 2);
      }
      k.parameters.emplace_back(without_blanks(word.substr(0, equals)), value);
    }
  }
}

std::string_view line_at(std::string_view text, std::size_t begin) {
  return text.substr(begin, std::min(text.find('\n', begin), text.size()) - begin);
}

/// The keyword at byte `at`, its lines passed: one that ends with a comma goes on in the next.
Keyword read_keyword(Pass& p, std::size_t at) {
  Keyword k{.at = at};
  for (std::size_t begin = at; begin < p.text.size();) {
    const std::string_view line = line_at(p.text, begin);
    p.next = begin + line.size() + 1;
    const std::string_view words = trimmed(line);
    read_parameters(begin == at ? words.substr(1) : words, k);
    if (words.empty() || words.back() != ',') break;
    begin = p.next;
  }
  return k;
}

void read_include(Pass& p, std::string_view name, std::size_t at, int depth);

void begin_nodes(Pass& p, const Keyword& k) {
  const std::string system = lower_case(parameter(k, "system"));
  if (!system.empty() && system != "r") {
    refuse(p, k.at,
           {.code = "unsupported_keyword",
            .text = fmt::format("*NODE has SYSTEM={}: only Cartesian coordinates are read",
                                in_quotes(system)),
            .remedy = "give the nodes in Cartesian coordinates"});
  }
  p.place.card = Card::nodes;
  const std::string_view set = parameter(k, "nset");
  if (!set.empty()) p.place.set = set_called(p.r.node_sets, set);
}

void begin_elements(Pass& p, const Keyword& k) {
  const std::string_view type = needed(p, k, "type");
  p.place.card = Card::elements;
  p.place.type = abaqus_type(type);
  if (p.place.type == nullptr) p.place.type = &unknown_type;
  p.place.type_word = type;
  const std::string_view set = parameter(k, "elset");
  if (!set.empty()) p.place.set = set_called(p.r.element_sets, set);
}

void begin_set(Pass& p, const Keyword& k) {
  const bool of_nodes = k.name == "nset";
  AbaqusSets& sets = of_nodes ? p.r.node_sets : p.r.element_sets;
  p.place.card = of_nodes ? Card::nset : Card::elset;
  p.place.set = set_called(sets, needed(p, k, k.name));
  p.place.generate = has_parameter(k, "generate");
  if (has_parameter(k, "internal")) {
    sets.is_internal[static_cast<std::size_t>(p.place.set)] = true;
  }
}

/// One part, placed once and not moved, is the mesh itself.
void count_parts(Pass& p, const Keyword& k) {
  const bool is_part = k.name == "part";
  if (!is_part) p.place.card = Card::instance;
  if (++(is_part ? p.r.parts : p.r.instances) == 1) return;
  refuse(p, k.at,
         {.code = "several_parts",
          .text = fmt::format("a second {} {}: their numbers and places are their own",
                              is_part ? "part" : "instance", in_quotes(parameter(k, "name"))),
          .remedy = "give a file with one part, or write the model without parts and assemblies "
                    "(Abaqus/CAE: Model > Edit Attributes)"});
}

/// Keywords that make nodes or elements from others, or move them.
void refuse_makers(const Pass& p, const Keyword& k) {
  constexpr std::string_view makers[] = {"ngen",  "nfill",  "ncopy",
                                         "nmap",  "elgen",  "elcopy",
                                         "ncord", "system", "symmetricmodelgeneration"};
  if (std::ranges::find(makers, k.name) == std::end(makers)) return;
  refuse(
      p, k.at,
      {.code = "unsupported_keyword",
       .text = fmt::format("*{} makes or moves nodes or elements: that is not done here", k.name),
       .remedy = "write the mesh with all of its nodes and elements listed"});
}

void begin_other(Pass& p, const Keyword& k) {
  refuse_makers(p, k);
  const std::string_view set = parameter(k, "elset");
  if (k.name.ends_with("section") && !set.empty()) {
    const std::int32_t place = set_called(p.r.element_sets, set);
    p.r.element_sets.has_section[static_cast<std::size_t>(place)] = true;
  }
  constexpr std::string_view silent[] = {"heading", "preprint",    "assembly",
                                         "endpart", "endassembly", "endinstance"};
  if (std::ranges::find(silent, k.name) != std::end(silent)) return;
  add_skipped(p.r.draft, "keywords", "*" + k.name, k.at);
}

void begin_keyword(Pass& p, const Keyword& k, int depth) {
  if (k.name == "include") {
    // The lines behind the included file continue the block before it.
    p.place.has_begun = false;
    return read_include(p, needed(p, k, "input"), k.at, depth);
  }
  p.place = {};
  if (k.name == "node") {
    begin_nodes(p, k);
  } else if (k.name == "element") {
    begin_elements(p, k);
  } else if (k.name == "elset" || k.name == "nset") {
    begin_set(p, k);
  } else if (k.name == "part" || k.name == "instance") {
    count_parts(p, k);
  } else {
    return begin_other(p, k);
  }
  const std::string_view input = parameter(k, "input");
  if (!input.empty()) read_include(p, input, k.at, depth);
}

/// Nodes up to the next keyword: number, then up to three coordinates; those left out are 0.
void read_nodes(Pass& p, std::size_t begin) {
  // Of a line, on the average, where there are thousands of different numbers.
  constexpr std::size_t least_bytes = 4;
  DataLines lines{.text = p.text, .next = begin};
  FileMesh& mesh = p.r.draft.mesh;
  const std::size_t first = mesh.points.size();
  const std::size_t most = most_lines(p.text, begin, least_bytes);
  reserve_more(mesh.points, most);
  reserve_more(mesh.source_point_id, most);
  p.r.nodes.push_back({p.file, begin, first});
  while (next_data_line(lines)) {
    const std::size_t at = lines.at;
    mesh.source_point_id.push_back(integer_of(lines, next_field(lines), "a node number"));
    Point point{};
    for (double& x : point) {
      const std::string_view field = next_field(lines);
      if (!field.empty()) x = real_of(lines, field, "a coordinate");
    }
    add_point(p.r.draft, point, at);
    if (mesh.points.size() - first <= 1000 + (lines.next - begin) / least_bytes) continue;
    refuse(p, at,
           {.code = "count_too_big",
            .text = fmt::format("{} nodes in {} bytes cannot have different numbers",
                                mesh.points.size() - first, lines.next - begin),
            .remedy = "give every node its own number and its coordinates"});
  }
  p.next = lines.next;
  if (p.place.set < 0) return;
  add_lines(
      p.r.node_sets,
      {.set = p.place.set, .before = -1, .is_block = true, .at = first, .end = mesh.points.size()});
}

/// Behind *INSTANCE stands its offset, then two points of an axis and an angle. One that is 0
/// leaves the part at its place.
void expect_unmoved(const Pass& p, std::size_t begin, bool is_offset) {
  DataLines lines{.text = p.text, .next = begin};
  next_data_line(lines);
  double last = 0;
  bool is_moved = false;
  while (has_field(lines)) {
    const std::string_view field = next_field(lines);
    if (!field.empty()) last = real_of(lines, field, "a number of an instance's place");
    is_moved = is_moved || (is_offset && last != 0);
  }
  if (!is_moved && (is_offset || last == 0)) return;
  refuse(p, begin,
         {.code = "several_parts",
          .text = "the instance is moved or turned: its nodes would be elsewhere",
          .remedy = "write the model without parts and assemblies"});
}

/// A line of data at `begin`, of whatever keyword.
void read_data(Pass& p, std::size_t begin) {
  const bool is_first = !std::exchange(p.place.has_begun, true);
  switch (p.place.card) {
    case Card::nodes:
      return read_nodes(p, begin);
    case Card::elements:
      if (is_first)
        p.r.elements.push_back({p.place.type, p.file, p.place.set, begin, p.place.type_word});
      return;
    case Card::elset:
    case Card::nset:
      if (!is_first) return;
      return add_lines(p.place.card == Card::nset ? p.r.node_sets : p.r.element_sets,
                       {.set = p.place.set,
                        .before = -1,
                        .file = p.file,
                        .generate = p.place.generate,
                        .at = begin});
    case Card::instance:
      return expect_unmoved(p, begin, is_first);
    case Card::other:
      return;
  }
}

void read_lines(Pass& p, int depth) {
  while (p.next < p.text.size()) {
    const std::size_t begin = p.next;
    const std::string_view line = line_at(p.text, begin);
    p.next = begin + line.size() + 1;
    const std::string_view words = trimmed(line);
    if (words.empty() || words.starts_with("**")) continue;
    if (words.front() != '*') {
      read_data(p, begin);
    } else {
      const std::size_t at = begin + static_cast<std::size_t>(words.data() - line.data());
      begin_keyword(p, read_keyword(p, at), depth);
    }
  }
}

void read_include(Pass& p, std::string_view name, std::size_t at, int depth) {
  const std::string path = std::filesystem::path(name).lexically_normal().string();
  const bool is_known =
      std::ranges::any_of(p.r.files, [&](const AbaqusText& f) { return f.name == path; }) ||
      path == p.r.source.name;
  if (is_known || depth >= deepest_include) {
    refuse(p, at,
           {.code = "include_cycle",
            .text = fmt::format("{} is included {}", in_quotes(path),
                                is_known ? "a second time" : "too deeply"),
            .remedy = "include every file once"});
  }
  std::optional<std::string> text = other_text(p.r.source, path);
  if (!text) {
    refuse(p, at,
           {.code = "missing_file",
            .text = fmt::format("{} is not there, which this file includes", in_quotes(path)),
            .remedy = "put it next to the mesh"});
  }
  p.r.included.push_back(std::move(*text));
  p.r.bytes += p.r.included.back().size();
  p.r.files.push_back({path, p.r.included.back()});
  Pass inner{p.r, p.place, static_cast<std::uint32_t>(p.r.files.size() - 1), p.r.files.back().text,
             0};
  in_file(p.r.draft, path, inner.text, [&] { read_lines(inner, depth + 1); });
  p.place = inner.place;
  p.place.has_begun = false;
}

void index_nodes(AbaqusReader& r) {
  const std::vector<std::int64_t>& numbers = r.draft.mesh.source_point_id;
  if (numbers.empty()) {
    fail(r.source.text, r.source.text.size(),
         {.code = "missing_section",
          .text = "the file ends without nodes",
          .remedy = "give a file with *NODE and *ELEMENT, or include theirs"});
  }
  std::array<std::int64_t, 2> twice;
  if (index_numbers(r.node_rows, numbers, twice)) return;
  const auto row = static_cast<std::size_t>(twice[1]);
  const auto behind = std::ranges::upper_bound(r.nodes, row, {}, &NodeLines::first);
  const NodeLines& block = *std::prev(behind);
  const AbaqusText& file = r.files[block.file];
  DataLines lines{.text = file.text, .next = block.at};
  for (std::size_t i = block.first; i <= row; ++i) next_data_line(lines);
  in_file(r.draft, file.name, file.text, [&] {
    fail(file.text, lines.at,
         {.code = "duplicate_id",
          .ids = {twice[0], twice[1]},
          .text = fmt::format("the nodes in rows {} and {} have the same number {}", twice[0],
                              twice[1], numbers[row]),
          .remedy = "give every node its own number"});
  });
}

}  // namespace

bool is_abaqus(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::string_view line = line_at(text, at);
    at += line.size() + 1;
    const std::string_view words = trimmed(line);
    if (words.empty() || words.starts_with("**")) continue;
    const char c = words.size() > 1 && words[0] == '*' ? words[1] : ' ';
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  }
  return false;
}

Draft read_abaqus(const FileSource& source) {
  AbaqusReader r{.source = source, .draft = {.text = source.text}};
  r.bytes = source.text.size();
  r.files.push_back({"", source.text});
  Pass pass{r, {}, 0, source.text, 0};
  read_lines(pass, 0);
  index_nodes(r);
  read_abaqus_elements(r);
  read_abaqus_sets(r);
  return std::move(r.draft);
}

}  // namespace sunder::io
