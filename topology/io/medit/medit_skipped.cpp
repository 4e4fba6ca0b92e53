// SPDX-License-Identifier: MIT
// Sections of MEDIT about points and cells that the mesh does not hold: required ones, normals,
// tangents.
#include "topology/io/medit/medit_skipped.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace sunder::io {
namespace {

struct Section {
  std::string_view keyword;
  /// Of binary files (libMeshb); 0 where it is not known here.
  int code;
  /// In a row of text; 0: as many as the dimension.
  std::size_t numbers;
};
constexpr Section sections[] = {
    {"Corners", 13, 1},
    {"Ridges", 14, 1},
    {"RequiredVertices", 15, 1},
    {"RequiredEdges", 16, 1},
    {"RequiredTriangles", 17, 1},
    {"RequiredQuadrilaterals", 18, 1},
    {"RequiredTetrahedra", 0, 1},
    {"NormalAtVertices", 20, 2},
    {"NormalAtTriangleVertices", 21, 3},
    {"NormalAtQuadrilateralVertices", 22, 3},
    {"Normals", 60, 0},
    {"Tangents", 59, 0},
    {"TangentAtVertices", 61, 2},
    {"TangentAtEdges", 0, 3},
};

}  // namespace

void skip_medit_section(Scanner& s, Draft& draft, std::string_view keyword, std::size_t dimension,
                        std::size_t at) {
  const bool letters = std::all_of(keyword.begin(), keyword.end(),
                                   [](unsigned char c) { return std::isalnum(c) || c == '_'; }) &&
                       std::isalpha(static_cast<unsigned char>(keyword.front()));
  if (!letters) {
    fail(s.text, at,
         {.code = "wrong_count",
          .text = fmt::format("{} stands where a section's name (Tetrahedra, ...) was expected",
                              in_quotes(keyword)),
          .remedy = "the section before has more rows than it announces: correct its count"});
  }
  const auto* const section = std::ranges::find(sections, keyword, &Section::keyword);
  if (section != std::end(sections)) {
    const std::size_t numbers = section->numbers == 0 ? dimension : section->numbers;
    const std::size_t rows = read_count(s, "rows", 2 * numbers);
    skip_words(s, rows * numbers, "a number");
    return add_skipped(draft, "sections", keyword, at, rows);
  }
  add_skipped(draft, "sections", keyword, at);
  for (std::string_view word = peek_word(s); !word.empty(); word = peek_word(s)) {
    if (std::isalpha(static_cast<unsigned char>(word.front())) || word.front() == '#') return;
    next_word(s);
  }
}

std::string medit_keyword_of(int code) {
  const auto* const section = std::ranges::find(sections, code, &Section::code);
  return code == 0 || section == std::end(sections) ? fmt::format("keyword {}", code)
                                                    : std::string(section->keyword);
}

}  // namespace sunder::io
