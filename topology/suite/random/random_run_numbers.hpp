// SPDX-License-Identifier: MIT
// The numbers of a random run by name: to add them up and to print them.
#pragma once

#include <array>
#include <cstddef>

#include "topology/suite/random/random_run_tear.hpp"
#include "topology/suite/random/random_run_trial.hpp"

namespace sunder::suite {

template <class Counts>
struct NamedNumber {
  const char* name;
  std::size_t Counts::*number;
};

/// Every number of `TearCounts`.
inline constexpr std::array<NamedNumber<TearCounts>, 21> tear_numbers = {
    {{"operations", &TearCounts::operations},
     {"fans", &TearCounts::fans},
     {"empty_fans", &TearCounts::empty_fans},
     {"labelled_fans", &TearCounts::labelled_fans},
     {"empty_labelled_fans", &TearCounts::empty_labelled_fans},
     {"crack_groups", &TearCounts::crack_groups},
     {"planes", &TearCounts::planes},
     {"single_faces", &TearCounts::single_faces},
     {"faces", &TearCounts::faces},
     {"vertices", &TearCounts::vertices},
     {"edges", &TearCounts::edges},
     {"alarms", &TearCounts::alarms},
     {"separations", &TearCounts::separations},
     {"missed", &TearCounts::missed},
     {"glues", &TearCounts::glues},
     {"in_vain", &TearCounts::vain},
     {"other_orders", &TearCounts::orders},
     {"all_orders", &TearCounts::all_orders},
     {"replays", &TearCounts::replays},
     {"crack_orders", &TearCounts::crack_orders},
     {"fans_in_other_orders", &TearCounts::fans_in_other_orders}}};

/// Every number of `CheckCounts`.
inline constexpr std::array<NamedNumber<CheckCounts>, 10> check_numbers = {
    {{"splits", &CheckCounts::splits},
     {"glues", &CheckCounts::glues},
     {"refusals", &CheckCounts::refusals},
     {"laws", &CheckCounts::laws},
     {"betti_changes", &CheckCounts::betti_changes},
     {"wholes", &CheckCounts::wholes},
     {"fans", &CheckCounts::fans},
     {"sections", &CheckCounts::sections},
     {"faults", &CheckCounts::faults},
     {"homologies", &CheckCounts::homologies}}};

static_assert(sizeof(TearCounts) == tear_numbers.size() * sizeof(std::size_t));
static_assert(sizeof(CheckCounts) == check_numbers.size() * sizeof(std::size_t));

/// Adds every number of `part` to that of `sum`.
template <class Counts, std::size_t N>
void add(Counts& sum, const Counts& part, const std::array<NamedNumber<Counts>, N>& numbers) {
  for (const NamedNumber<Counts>& n : numbers) sum.*n.number += part.*n.number;
}

}  // namespace sunder::suite
