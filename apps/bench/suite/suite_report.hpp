// SPDX-License-Identifier: MIT
// The output of `sunder suite`: a row for each fixture, mismatches in full, totals; and JSON.
#pragma once

#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "topology/suite/fixtures/fixture.hpp"
#include "topology/suite/judge/judge.hpp"

namespace sunder {

/// One fixture on every kernel.
struct SuiteRow {
  std::string fixture;
  std::size_t tetrahedra = 0, operations = 0, steps = 0;
  /// In the order of the kernels.
  std::vector<suite::Verdict> verdicts;
  /// The steps of each verdict's mismatch in words; empty where there is none.
  std::vector<std::vector<std::string>> steps_in_words;
  /// Comparisons of the fixture with the twin's own run, and the time of that, microseconds.
  std::size_t truth_checks = 0;
  double truth_us = 0;
};

/// Whether a verdict is neither as expected nor a known difference; whether one of a row is.
bool is_wrong(const suite::Verdict& verdict);
bool any_wrong(const SuiteRow& row);

/// The data that all lines of a table share.
struct SuiteTable {
  /// Names of the kernels, and length of the longest fixture's name.
  std::vector<std::string> kernels = {};
  std::size_t name_width = 7;
  /// How many were to be judged: with --fail-fast there may be fewer rows.
  std::size_t fixtures = 0;
  std::chrono::system_clock::time_point started = {};
};

/// Heading, one row, and totals of the table.
std::string suite_heading(const SuiteTable& table);
std::string suite_line(const SuiteTable& table, const SuiteRow& row);
std::string suite_totals(const SuiteTable& table, const std::vector<SuiteRow>& rows);

/// The details of a verdict that its row leaves out, empty when there are none. `steps`: those of
/// its mismatch, in words.
std::string verdict_details(const suite::Verdict& verdict, const std::vector<std::string>& steps);

/// Every mismatch of a row, and every known difference with its reason, as lines of text; kernels
/// of which the same is to be said share them.
std::string suite_details(const SuiteRow& row);

/// {fixtures: [{fixture, tetrahedra, operations, steps, verdicts: [...]}], kernels, totals}.
nlohmann::ordered_json suite_json(const SuiteTable& table, const std::vector<SuiteRow>& rows);

}  // namespace sunder
