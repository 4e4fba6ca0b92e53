// SPDX-License-Identifier: MIT
// Counters of reports: each is defined once, by its name, its member and its rule of addition.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <tuple>

namespace sunder {

/// Rule for the sum of one counter over two reports, the earlier one first.
enum class Adds {
  sum,
  most,  ///< the larger value
  last,  ///< the value of the second report
  once,  ///< the number of reports with a value other than 0
};

/// A member of a report that adds up. `name` is its key in report.json, or empty. A report lists
/// all its counters, in the order of report.json, in an overload of `counters_of(const Report*)`,
/// which everything that adds, names or reads counters uses.
template <class Report, class Value>
struct Counter {
  std::string_view name;
  Value Report::*member;
  Adds over_step = Adds::sum;  ///< parts of a step, components, searches
  Adds over_run = over_step;   ///< steps of a run
};

// Clang deduces no template arguments of aggregates before its version 17.
template <class Report, class Value>
Counter(std::string_view, Value Report::*) -> Counter<Report, Value>;
template <class Report, class Value>
Counter(std::string_view, Value Report::*, Adds) -> Counter<Report, Value>;
template <class Report, class Value>
Counter(std::string_view, Value Report::*, Adds, Adds) -> Counter<Report, Value>;

/// Calls `visit(counter)` for every counter of a report.
template <class Report, class Visit>
void for_each_counter(Visit visit) {
  std::apply([&](const auto&... counter) { (visit(counter), ...); },
             counters_of(static_cast<const Report*>(nullptr)));
}

template <class Value>
void add_value(Value& sum, const Value& part, Adds adds) {
  if constexpr (requires { sum.size(); }) {
    auto of_part = part.begin();
    for (auto& value : sum) add_value(value, *of_part++, adds);
  } else {
    switch (adds) {
      case Adds::sum:
        sum += part;
        return;
      case Adds::most:
        sum = std::max(sum, part);
        return;
      case Adds::last:
        sum = part;
        return;
      case Adds::once:
        sum += part != Value{} ? Value{1} : Value{0};
    }
  }
}

/// Adds another part of the same step.
template <class Report>
void add_part(Report& sum, const Report& part) {
  for_each_counter<Report>([&](const auto& counter) {
    add_value(sum.*counter.member, part.*counter.member, counter.over_step);
  });
}

/// Adds the report of a step to that of a run.
template <class Report>
void add_step(Report& sum, const Report& step) {
  for_each_counter<Report>([&](const auto& counter) {
    add_value(sum.*counter.member, step.*counter.member, counter.over_run);
  });
}

}  // namespace sunder
