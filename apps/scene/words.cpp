// SPDX-License-Identifier: MIT
// The wording of findings and counts.
#include "apps/scene/words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

#include "topology/base/counted.hpp"
#include "topology/io/files/printing.hpp"

namespace sunder {

namespace {

/// "error:" in red and "warning:" in yellow, as terminals take it; "note:" as it is.
std::string severity_word(Severity severity, bool coloured) {
  const std::string word = fmt::format("{}:", to_string(severity));
  if (!coloured || severity == Severity::note) return word;
  return fmt::format("\033[1;{}m{}\033[0m", severity == Severity::error ? 31 : 33, word);
}

/// The key of a body or an obstacle with which a text begins, "bodies.3.mesh"; empty without one.
std::string_view place_of(const Finding& f) {
  const std::string_view text = f.text;
  if (!text.starts_with("bodies.") && !text.starts_with("obstacles.")) return {};
  return text.substr(0, text.find(' '));
}

/// The common part of findings that are printed together: severity, code, and the key without rows.
/// Empty for findings that are printed one by one: errors, as each has to be mended, and findings
/// without a place.
std::string kind_of(const Finding& f) {
  std::string key(place_of(f));
  if (f.severity == Severity::error || key.empty()) return {};
  std::erase_if(key, [](char c) { return c >= '0' && c <= '9'; });
  return fmt::format("{} {} {}", to_string(f.severity), f.code, key);
}

/// Findings of one kind, by rows.
struct FindingsOfKind {
  std::string kind;
  std::vector<std::size_t> rows;
};

std::vector<FindingsOfKind> by_kind(const std::vector<Finding>& findings) {
  std::vector<FindingsOfKind> groups;
  for (std::size_t row = 0; row < findings.size(); ++row) {
    const std::string kind = kind_of(findings[row]);
    const auto group = std::ranges::find(groups, kind, &FindingsOfKind::kind);
    if (kind.empty() || group == groups.end()) {
      groups.push_back({kind, {row}});
    } else {
      group->rows.push_back(row);
    }
  }
  return groups;
}

/// The text of the first, the first places of the others, a count.
Finding joined(const std::vector<Finding>& findings, const std::vector<std::size_t>& rows) {
  constexpr std::size_t most_named = 4;
  Finding all = findings[rows.front()];
  const std::size_t named = std::min(rows.size(), most_named);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const Finding& f = findings[rows[i]];
    if (i < named) all.text += fmt::format("{} {}", i == 1 ? "; also" : ",", place_of(f));
    all.count += f.count;
  }
  if (const std::size_t more = rows.size() - named; more > 0) {
    const bool is_body = all.text.starts_with("bodies.");
    all.text += is_body ? " and " + counted(more, "more body", "more bodies")
                        : " and " + counted(more, "more obstacle");
  }
  return all;
}

}  // namespace

std::string finding_lines(const std::vector<Finding>& findings, bool coloured) {
  std::string out;
  for (const FindingsOfKind& group : by_kind(findings)) {
    const Finding f = joined(findings, group.rows);
    if (!f.file.empty()) out += plain_line(f.file);
    if (f.line != 0) out += fmt::format(":{}", f.line);
    if (!f.file.empty() || f.line != 0) out += ": ";
    out +=
        fmt::format("{} {} [{}", severity_word(f.severity, coloured), plain_line(f.text), f.code);
    if (f.count > 1) out += fmt::format(", {} times", f.count);
    if (!f.ids.empty()) {
      out += fmt::format(": {}{}", fmt::join(f.ids, " "), f.count > f.ids.size() ? " ..." : "");
    }
    out += "]\n";
    if (!f.remedy.empty()) out += fmt::format("  {}\n", plain_line(f.remedy));
  }
  return out;
}

nlohmann::ordered_json findings_json(const std::vector<Finding>& findings) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Finding& f : findings) {
    list.push_back({{"code", f.code},
                    {"severity", to_string(f.severity)},
                    {"count", f.count},
                    {"ids", f.ids},
                    {"text", f.text},
                    {"remedy", f.remedy},
                    {"file", f.file},
                    {"line", f.line}});
  }
  return list;
}

nlohmann::ordered_json cell_counts_json(std::size_t file_vertices, const Counts& counts) {
  return {{"file_vertices", file_vertices},
          {"vertices", counts.vertices},
          {"edges", counts.edges},
          {"faces", counts.faces},
          {"tetrahedra", counts.tetrahedra},
          {"components", counts.components},
          {"boundary_faces", counts.boundary_faces},
          {"boundary_sheets", counts.boundary_sheets}};
}

nlohmann::ordered_json invariants_json(const Counts& counts) {
  nlohmann::ordered_json json{{"euler_characteristic", counts.euler_characteristic},
                              {"betti", nullptr},
                              {"volume", counts.volume}};
  if (counts.betti) json["betti"] = *counts.betti;
  return json;
}

std::string betti_text(const Counts& counts) {
  return counts.betti ? fmt::format("{}", fmt::join(*counts.betti, " ")) : "-";
}

std::optional<std::vector<double>> numbers_of(std::string_view list, std::size_t length) {
  std::vector<double> numbers;
  while (true) {
    const std::string_view part = list.substr(0, list.find(','));
    double value = 0;
    const auto [end, reason] = std::from_chars(part.data(), part.data() + part.size(), value);
    if (part.empty() || reason != std::errc{} || end != part.data() + part.size()) return {};
    numbers.push_back(value);
    if (part.size() == list.size()) break;
    list.remove_prefix(part.size() + 1);
  }
  if (numbers.size() != length) return {};
  return numbers;
}

std::string check_plane(const std::string& list) {
  return numbers_of(list, 4) ? "" : fmt::format("'{}' is not NX,NY,NZ,D: four numbers", list);
}

std::string_view yes_or_no(bool is_so) { return is_so ? "yes" : "no"; }

}  // namespace sunder
