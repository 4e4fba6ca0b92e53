// SPDX-License-Identifier: MIT
// Words for regions, and regions for words.
#include "topology/io/regions/named_regions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>

namespace sunder::io {
namespace {

constexpr std::size_t longest_word = 80;
constexpr std::string_view unnamed = "region_";

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// N where the word is `region_N`, spelt as we spell it (but for the case).
std::optional<std::int32_t> number_in_word(std::string_view word) {
  if (word.size() <= unnamed.size() || lower_case(word.substr(0, unnamed.size())) != unnamed) {
    return std::nullopt;
  }
  word.remove_prefix(unnamed.size());
  std::int32_t number = 0;
  const auto [stop, reason] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (reason != std::errc{} || word != std::to_string(number)) return std::nullopt;
  return number;
}

/// The word of a name, were it alone.
std::string plain_word(std::string_view name) {
  std::string word;
  for (const char c : name.substr(0, longest_word)) {
    word += is_letter(c) || (c >= '0' && c <= '9') || c == '-' ? c : '_';
  }
  // "region" a second time would be region_2, which is the region 2 without a name.
  const bool means_number = number_in_word(word) || lower_case(word) == "region";
  if (word.empty() || !is_letter(word.front()) || means_number) word = "name_" + word;
  return word.substr(0, longest_word);
}

/// The smallest number from `next` up that is not taken; takes it.
std::int32_t take_free(std::set<std::int32_t>& taken, std::int32_t& next) {
  while (taken.contains(next)) ++next;
  taken.insert(next);
  return next;
}

}  // namespace

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

RegionNames region_words(const RegionNames& names) {
  RegionNames words;
  // The last number that was put behind each word, so that a thousand equal names take no longer.
  std::unordered_map<std::string, std::size_t> last;
  for (std::size_t d = names.size(); d-- > 0;) {
    for (const auto& [region, name] : names[d]) {
      const std::string plain = plain_word(name);
      std::string word = plain;
      while (!last.emplace(lower_case(word), 1).second) {
        const std::string end = fmt::format("_{}", ++last[lower_case(plain)]);
        word = plain.substr(0, longest_word - end.size()) + end;
      }
      words[d].emplace(region, std::move(word));
    }
  }
  return words;
}

std::string word_of_region(const RegionNames& words, int dimension, std::int32_t region) {
  const auto& of_dimension = words[static_cast<std::size_t>(dimension)];
  const auto found = of_dimension.find(region);
  return found == of_dimension.end() ? fmt::format("{}{}", unnamed, region) : found->second;
}

std::int32_t place_of_word(WordList& list, std::string_view word) {
  const auto [entry, is_new] =
      list.place.emplace(lower_case(word), static_cast<std::int32_t>(list.words.size()));
  if (is_new) list.words.emplace_back(word);
  return entry->second;
}

void number_regions(std::vector<std::int32_t>& region, const WordList& list,
                    std::map<std::int32_t, std::string>& names) {
  // Only the words that cells have: a set of other cells is no region of these.
  std::vector<bool> used(list.words.size(), false);
  for (const std::int32_t place : region) {
    if (place >= 0) used[static_cast<std::size_t>(place)] = true;
  }
  if (std::ranges::find(used, true) == used.end()) return region.clear();
  std::set<std::int32_t> taken;
  for (std::size_t i = 0; i < used.size(); ++i) {
    const auto number = used[i] ? number_in_word(list.words[i]) : std::nullopt;
    if (number) taken.insert(*number);
  }
  std::vector<std::int32_t> number_of(list.words.size(), 0);
  std::int32_t next = 1;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i]) continue;
    if (const auto number = number_in_word(list.words[i])) {
      number_of[i] = *number;
      continue;
    }
    number_of[i] = take_free(taken, next);
    names[number_of[i]] = list.words[i];
  }
  for (std::int32_t& r : region) r = r < 0 ? 0 : number_of[static_cast<std::size_t>(r)];
}

void number_labels(FileMesh& mesh, int dimension, const WordList& list) {
  std::vector<std::int32_t> all;
  for (const CellKind kind : all_cell_kinds) {
    if (traits_of(kind).dimension != dimension) continue;
    std::vector<std::int32_t>& places = columns_of(mesh, kind).region;
    if (std::ranges::all_of(places, [](std::int32_t place) { return place < 0; })) places.clear();
    all.insert(all.end(), places.begin(), places.end());
  }
  number_regions(all, list, mesh.region_name[static_cast<std::size_t>(dimension)]);
  auto next = all.begin();
  for (const CellKind kind : all_cell_kinds) {
    if (traits_of(kind).dimension != dimension) continue;
    for (std::int32_t& place : columns_of(mesh, kind).region) place = *next++;
  }
}

void match_names(FileMesh& mesh, const RegionNames& names) {
  const RegionNames words = region_words(names);
  for (std::size_t d = 0; d < 4; ++d) {
    std::map<std::string, std::int32_t> region_of;
    for (const auto& [region, word] : words[d]) region_of.emplace(lower_case(word), region);
    const auto for_each_list = [&](auto work) {
      for (const CellKind kind : all_cell_kinds) {
        if (traits_of(kind).dimension == static_cast<int>(d)) work(columns_of(mesh, kind).region);
      }
    };
    std::set<std::int32_t> taken;
    for (const auto& [region, name] : names[d]) taken.insert(region);
    for_each_list([&](const std::vector<std::int32_t>& list) {
      for (const std::int32_t region : list) {
        if (!mesh.region_name[d].contains(region)) taken.insert(region);
      }
    });
    std::map<std::int32_t, std::int32_t> new_number;
    std::map<std::int32_t, std::string> new_names = names[d];
    std::int32_t next = 1;
    for (auto& [region, word] : mesh.region_name[d]) {
      const auto known = region_of.find(lower_case(word));
      const std::int32_t number = known == region_of.end() ? take_free(taken, next) : known->second;
      new_number.emplace(region, number);
      if (known == region_of.end()) new_names.emplace(number, std::move(word));
    }
    for_each_list([&](std::vector<std::int32_t>& list) {
      for (std::int32_t& region : list) {
        const auto found = new_number.find(region);
        if (found != new_number.end()) region = found->second;
      }
    });
    mesh.region_name[d] = std::move(new_names);
  }
}

}  // namespace sunder::io
