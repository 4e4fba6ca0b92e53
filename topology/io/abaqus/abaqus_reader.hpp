// SPDX-License-Identifier: MIT
// Internal to the Abaqus reader: its lines, and the data kept between the passes over them. Nodes
// and the places of everything else are read first; then the elements, when all nodes are known;
// then the sets, when all elements are.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "topology/io/abaqus/abaqus_lines.hpp"
#include "topology/io/formats.hpp"
#include "topology/io/regions/named_regions.hpp"
#include "topology/io/text/number_index.hpp"

namespace sunder::io {

/// A kind of element by the beginning of its name; letters may follow.
struct AbaqusType {
  std::string_view name;
  std::size_t nodes;
  int dimension;
  /// Of several, as messages call them.
  std::string_view plural;
};

/// The kind of a TYPE= that is not known: such elements are left out.
inline constexpr AbaqusType unknown_type{"", 0, 3, "elements of an unknown type"};

/// The kind of a TYPE=; a null pointer for those that are not known.
const AbaqusType* abaqus_type(std::string_view word);

/// The kind of its cells; none for points, springs and the like, which are left out.
std::optional<CellKind> kind_of(const AbaqusType& type);

/// The mesh's file or one that is included.
struct AbaqusText {
  /// Empty for the mesh's file.
  std::string name;
  std::string_view text;
};

/// Data lines behind a *ELEMENT.
struct ElementLines {
  const AbaqusType* type;
  std::uint32_t file;
  /// Place of its ELSET= among the element sets; -1 without.
  std::int32_t set;
  std::size_t at;
  /// The word behind TYPE=.
  std::string_view type_word;
};

/// Elements of a type that is not known, and the place of the first.
struct UnknownElements {
  std::size_t count = 0;
  std::string file;
  std::size_t line = 0;
};

/// Nodes behind a *NODE, or a part of them.
struct NodeLines {
  std::uint32_t file;
  std::size_t at;
  /// The first row.
  std::size_t first;
};

/// Some members of a set: data lines behind *ELSET or *NSET, or the nodes or elements of a block.
struct SetLines {
  std::int32_t set;
  /// Of the same set, the one before; -1 for the first.
  std::int32_t before;
  /// Of elements in blocks: their kind.
  std::uint32_t file = 0;
  bool generate = false;
  bool is_block = false;
  /// Lines: where they begin. Blocks: the first row of the kind, and behind the last.
  std::size_t at = 0;
  std::size_t end = 0;
};

/// The sets of nodes, or those of elements.
struct AbaqusSets {
  WordList names;
  std::deque<SetLines> lines;
  /// By set: its last lines (-1 without), whether Abaqus made it for itself, whether a section of
  /// material names it.
  std::vector<std::int32_t> last;
  std::vector<bool> is_internal, has_section;
};

struct AbaqusReader {
  const FileSource& source;
  Draft draft;
  std::deque<AbaqusText> files;
  /// Texts of the files that are included.
  std::deque<std::string> included;
  /// Bytes of all of them.
  std::size_t bytes = 0;
  std::deque<NodeLines> nodes;
  std::deque<ElementLines> elements;
  AbaqusSets node_sets, element_sets;
  /// Rows of all elements, by kind.
  NumberIndex node_rows, element_rows;
  /// By the word of their type; "" for all behind the first few types.
  std::map<std::string, UnknownElements> unknown;
  std::size_t parts = 0, instances = 0;
};

/// The set of that name, which is added if it is not there.
std::int32_t set_called(AbaqusSets& sets, std::string_view name);

/// Adds members to a set.
void add_lines(AbaqusSets& sets, SetLines lines);

/// Elements, once all nodes are there.
void read_abaqus_elements(AbaqusReader& r);

/// Regions and vertices from the sets, once all elements are there.
void read_abaqus_sets(AbaqusReader& r);

}  // namespace sunder::io
