// SPDX-License-Identifier: MIT
// An archive that reads along and writes nothing.
#include "fracture/saving/state_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "fracture/saving/sections.hpp"

namespace sunder {
namespace {

/// Large sections that follow from the columns or never change.
constexpr std::array<std::string_view, 5> beside_columns = {"scene", "bodies", "map", "pieces",
                                                            "systems"};

bool is_looked_at(NumbersOf which, std::string_view name) {
  return which == NumbersOf::everything ||
         std::ranges::find(beside_columns, name) == beside_columns.end();
}

/// Whether there is a NaN at all, without its place: the question of nearly every step.
class NanProbe {
 public:
  explicit NanProbe(NumbersOf which) : which_(which) {}

  template <Scalar T>
  void numbers(const T* x, std::size_t count) {
    if constexpr (std::is_floating_point_v<T>) {
      bool any = false;
      for (std::size_t i = 0; i < count; ++i) any |= x[i] != x[i];
      found |= any;
    }
  }
  template <Scalar T>
  void rows(const T* x, std::size_t count) {
    numbers(x, count);
  }
  void count(const std::uint64_t&) {}
  bool enter(std::string_view name) { return is_looked_at(which_, name); }
  void enter(std::uint64_t) {}
  void leave() {}

  bool found = false;

 private:
  NumbersOf which_;
};

class NumberSeeker {
 public:
  /// `lists`: columns without a NaN too.
  NumberSeeker(NumbersOf which, bool lists) : which_(which), lists_(lists) {}

  template <Scalar T>
  void numbers(const T* x, std::size_t count) {
    look(x, count, false);
  }
  /// Each a row of its own.
  template <Scalar T>
  void rows(const T* x, std::size_t count) {
    look(x, count, true);
  }
  void count(const std::uint64_t&) { at_ += sizeof(std::uint64_t); }

  bool enter(std::string_view name) {
    path_.push_back({name, 0});
    return is_looked_at(which_, name);
  }
  void enter(std::uint64_t row) { path_.push_back({{}, row}); }
  void leave() { path_.pop_back(); }

  std::vector<NumberColumn> found;

 private:
  /// A step into the state: a member, or a row where `name` is empty.
  struct Place {
    std::string_view name;
    std::uint64_t row = 0;
  };

  template <Scalar T>
  void look(const T* x, std::size_t count, bool are_rows) {
    constexpr std::size_t size = sizeof(Saved<T>);
    if constexpr (std::is_floating_point_v<T>) {
      std::size_t none = 0;
      for (std::size_t i = 0; i < count; ++i) none += x[i] != x[i];
      if (count > 0 && (lists_ || none > 0)) {
        std::size_t first = 0;
        while (none > 0 && x[first] == x[first]) ++first;
        note({{}, count, none, are_rows ? first : 0, at_, at_ + (count - 1) * size});
      }
    }
    at_ += count * size;
  }

  void note(NumberColumn numbers) {
    std::optional<std::uint64_t> row;
    for (const Place& place : path_) {
      if (place.name.empty()) {
        if (!row) row = place.row;
      } else {
        if (!numbers.name.empty()) numbers.name += '.';
        numbers.name += place.name;
      }
    }
    if (row) numbers.row = *row;
    const auto same = std::ranges::find(found, numbers.name, &NumberColumn::name);
    if (same == found.end()) {
      found.push_back(std::move(numbers));
      return;
    }
    if (same->not_numbers == 0) same->row = numbers.row;
    same->numbers += numbers.numbers;
    same->not_numbers += numbers.not_numbers;
    same->last_byte = numbers.last_byte;
  }

  NumbersOf which_;
  bool lists_;
  std::vector<Place> path_;
  /// Behind the magic and the format.
  std::size_t at_ = 12;
};

/// The kind of object that a row of a column belongs to.
std::string_view row_word(std::string_view column) {
  constexpr std::pair<std::string_view, std::string_view> words[] = {
      {"vertices.", "vertex"},      {"elements.", "tetrahedron"}, {"components.", "component"},
      {"cells.strength", "vertex"}, {"cells.flaw", "vertex"},     {"cells.painted", "vertex"},
      {"obstacles.", "obstacle"},   {"materials.", "material"},   {"motions.", "motion"},
      {"display", "component"}};
  for (const auto& [part, word] : words) {
    if (column.find(part) != std::string_view::npos) return word;
  }
  return "row";
}

}  // namespace

std::vector<NumberColumn> number_columns(const Simulation& simulation, NumbersOf which) {
  NumberSeeker seeker(which, true);
  sections(seeker, simulation);
  return std::move(seeker.found);
}

std::vector<Finding> check_numbers(const Simulation& simulation, NumbersOf which) {
  NanProbe probe(which);
  sections(probe, simulation);
  if (!probe.found) return {};
  NumberSeeker seeker(which, false);
  sections(seeker, simulation);
  if (seeker.found.empty()) return {};
  std::string places;
  std::size_t count = 0;
  for (const NumberColumn& column : seeker.found) {
    count += column.not_numbers;
    places += fmt::format("{}{} of {} {}", places.empty() ? "" : ", ", column.name,
                          row_word(column.name), column.row);
  }
  return {{.code = "not_a_number",
           .count = count,
           .ids = {static_cast<std::int64_t>(seeker.found.front().row)},
           .text = fmt::format("after step {} (t = {:.6g} s) these are not numbers: {}",
                               simulation.state->step, simulation.state->mechanics.time, places),
           .remedy = "look for values of the scene that are too large or too small, take a shorter "
                     "time_step or the integrator floating_frame; --check-map names the first step "
                     "that has one, in matrices too"}};
}

}  // namespace sunder
