// SPDX-License-Identifier: MIT
// What `sunder suite` prints: a row for each fixture, what went wrong in full, totals; and JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "topology/suite/fixture.hpp"
#include "topology/suite/judge.hpp"

namespace sunder {

/// One fixture on every kernel.
struct SuiteRow {
  std::string fixture;
  std::size_t tetrahedra = 0, operations = 0, steps = 0;
  /// In the order of the kernels.
  std::vector<suite::Verdict> verdicts;
  /// The steps of each verdict's mismatch in words; empty where there is none.
  std::vector<std::vector<std::string>> steps_in_words;
  /// Time of the twin's own run that the verdicts are held against, microseconds.
  double truth_us = 0;
};

/// Whether a verdict is neither as expected nor a known difference.
bool is_wrong(const suite::Verdict& verdict);

/// Heading, one row, and totals of the table. `kernels`: their names.
std::string suite_heading(const std::vector<std::string>& kernels);
std::string suite_line(const SuiteRow& row);
std::string suite_totals(const std::vector<SuiteRow>& rows,
                         const std::vector<std::string>& kernels);

/// Every mismatch of a row, and every known difference with its reason, as lines of text.
std::string suite_details(const SuiteRow& row);

/// {fixtures: [{fixture, tetrahedra, operations, steps, verdicts: [...]}], kernels, totals}.
nlohmann::ordered_json suite_json(const std::vector<SuiteRow>& rows,
                                  const std::vector<std::string>& kernels);

}  // namespace sunder
