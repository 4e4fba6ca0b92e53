// SPDX-License-Identifier: MIT
// Internal to topology/io: regions in formats that know them by words and not by numbers (sets,
// groups, solids), and the way from the one to the other and back.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "topology/mesh/file_mesh.hpp"

namespace sunder::io {

/// The names of regions by dimension, as in a FileMesh, or the words that stand for them.
using RegionNames = std::array<std::map<std::int32_t, std::string>, 4>;

/// The word for each named region: letters, digits, _ and -, a letter first, at most 80 characters;
/// every other byte becomes _, and a word that is taken already (upper and lower case are one) gets
/// _2, _3, ... at its end. Words are given to tetrahedra first, vertices last, in the order of the
/// regions' numbers, and depend on nothing but the names. No word is `region_N`: that stands for
/// the region N without a name.
RegionNames region_words(const RegionNames& names);

/// The word that is written for a region: that of its name, else `region_N`.
std::string word_of_region(const RegionNames& words, int dimension, std::int32_t region);

/// The words that a file has for the regions of one dimension, in the order of appearance.
struct WordList {
  /// As they were first spelt.
  std::vector<std::string> words;
  /// Places in `words`, by the word in lower case.
  std::unordered_map<std::string, std::int32_t> place;
};

/// The place of a word in the list, where it is added if it is not there.
std::int32_t place_of_word(WordList& list, std::string_view word);

/// Makes regions of places in `list`, where -1 stands for no word. The word `region_N` is the
/// region N without a name; every other word gets the smallest number from 1 up that is free, in
/// the order of the list, and its name in `names`. No word is region 0; where no cell has a word
/// `region` becomes empty.
void number_regions(std::vector<std::int32_t>& region, const WordList& list,
                    std::map<std::int32_t, std::string>& names);

/// The same for the regions of all cells of a dimension, which share numbers and names; lists
/// without a word lose their column.
void number_labels(FileMesh& mesh, int dimension, const WordList& list);

/// Gives the regions of a mesh that was read by its words the numbers and names of the list next to
/// it. Regions with words that are names in `names` (upper and lower case are one) become those
/// regions. The others keep their words as names and get the smallest numbers that are free.
/// Leaves: every name of `names` in the mesh.
void match_names(FileMesh& mesh, const RegionNames& names);

/// Letters A to Z made small.
std::string lower_case(std::string_view text);

}  // namespace sunder::io
