// SPDX-License-Identifier: MIT
// Counters of reports: each defined once by its name, its member and how it adds up.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <tuple>

namespace sunder {

/// What a counter of two reports is together, the first one's before the second's.
enum class Adds {
  sum,
  most,  ///< the larger one
  last,  ///< the second one
  once,  ///< a sum of ones: how many reports had any
};

/// A member of a report that adds up; `name` is its key in report.json, empty where it has none. A
/// report lists all of them, in the order of report.json, in
/// an overload of `counters_of(const Report*)`; whatever adds, names or reads them goes by it.
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
