// SPDX-License-Identifier: MIT
// Cards that repeat the card before them, with fields that stay, grow or are new.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "topology/io/nastran/nastran_cards.hpp"
#include "topology/io/text/scan.hpp"

namespace sunder::io {
namespace {

/// The increment of *1 or *(1); empty for other fields.
std::string_view increment_of(std::string_view field) {
  if (!field.starts_with('*')) return {};
  field.remove_prefix(1);
  if (field.starts_with('(') && field.ends_with(')')) field = field.substr(1, field.size() - 2);
  return field;
}

bool is_whole(std::string_view field) {
  return !field.empty() && field.find_first_not_of("0123456789+-") == std::string_view::npos &&
         field.find_first_of("+-", 1) == std::string_view::npos;
}

/// The field of the card before, and the increment added.
std::string grown(std::string_view text, const Card& before, std::size_t i,
                  std::string_view increment) {
  const std::string_view field = field_of(before, i);
  if (field.empty()) fail_field(text, before, i, "a number that replication adds to", {});
  Card added{.name = before.name, .fields = {increment}, .at = before.at};
  constexpr std::string_view what = "what replication adds";
  if (!is_whole(field) || !is_whole(increment)) {
    return fmt::format("{}", card_real(text, before, i, "a number that replication adds to") +
                                 card_real(text, added, 0, what));
  }
  const std::int64_t value = card_integer(text, before, i, "a number that replication adds to");
  const std::int64_t step = card_integer(text, added, 0, what);
  constexpr std::int64_t most = 1'000'000'000'000'000;
  if (value > most || value < -most || step > most || step < -most) {
    fail_field(text, before, i, "a number that replication adds to",
               std::errc::result_out_of_range);
  }
  return std::to_string(value + step);
}

}  // namespace

void replicate_card(std::string_view text, Replication& replication, Card& card) {
  Card image{.name = card.name, .fields = {}, .at = card.at};
  std::swap(replication.words[0], replication.words[1]);
  std::deque<std::string>& words = replication.words[0];
  words.clear();
  for (std::size_t i = 0; i < replication.fields.size(); ++i) {
    const std::string_view field = replication.fields[i];
    const std::string_view increment = increment_of(field);
    if (field == "==") {
      for (std::size_t k = i; k < card.fields.size(); ++k) image.fields.push_back(card.fields[k]);
      break;
    }
    if (field == "=") {
      image.fields.push_back(field_of(card, i));
    } else if (increment.empty()) {
      image.fields.push_back(field);
    } else {
      image.fields.push_back(words.emplace_back(grown(text, card, i, increment)));
    }
  }
  // Words of the card before are gone with the next image: those that stay are taken over.
  for (std::string_view& field : image.fields) {
    const bool is_made = std::ranges::any_of(replication.words[1], [&](const std::string& w) {
      return !field.empty() && field.data() == w.data();
    });
    if (is_made) field = words.emplace_back(field);
  }
  card = std::move(image);
}

}  // namespace sunder::io
