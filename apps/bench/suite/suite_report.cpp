// SPDX-License-Identifier: MIT
// Tables and JSON of `sunder suite`.
#include "apps/bench/suite/suite_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "topology/base/counted.hpp"

namespace sunder {
namespace {

using suite::Verdict;

std::string_view result_of(const Verdict& verdict) {
  if (is_wrong(verdict)) return "DIFFERS";
  return verdict.known_difference.empty() ? "same" : "known";
}

std::size_t checks_of(const SuiteRow& row) {
  std::size_t checks = row.truth_checks;
  for (const Verdict& v : row.verdicts) checks += v.checks;
  return checks;
}

double kernel_us(const SuiteRow& row) {
  double sum = 0;
  for (const Verdict& v : row.verdicts) sum += v.kernel_us;
  return sum;
}

struct Totals {
  std::size_t fixtures = 0, operations = 0, steps = 0, checks = 0, not_asked = 0;
  std::size_t mismatches = 0, known_differences = 0;
  std::vector<double> kernel_us;
  double truth_us = 0;
};

Totals totals_of(const std::vector<SuiteRow>& rows, std::size_t kernels) {
  Totals totals{.fixtures = rows.size(), .kernel_us = std::vector<double>(kernels, 0)};
  for (const SuiteRow& row : rows) {
    totals.truth_us += row.truth_us;
    totals.checks += checks_of(row);
    for (std::size_t k = 0; k < row.verdicts.size(); ++k) {
      const Verdict& v = row.verdicts[k];
      totals.operations += v.operations;
      totals.steps += v.steps;
      totals.not_asked += v.not_asked;
      totals.mismatches += is_wrong(v) ? 1 : 0;
      totals.known_differences += v.known_difference.empty() ? 0 : 1;
      totals.kernel_us[k] += v.kernel_us;
    }
  }
  return totals;
}

nlohmann::ordered_json side_json(const suite::FaceSide& side) {
  return {{"tetrahedron", side.tetrahedron}, {"opposite", side.opposite}};
}

nlohmann::ordered_json step_json(const suite::Step& step) {
  if (step.kind == suite::Step::Kind::split) return {{"split", side_json(step.a)}};
  return {{"glue", {side_json(step.a), side_json(step.b)}}};
}

nlohmann::ordered_json verdict_json(const Verdict& v) {
  nlohmann::ordered_json json{{"kernel", v.kernel},
                              {"result", is_wrong(v)                  ? "different"
                                         : v.known_difference.empty() ? "same"
                                                                      : "known difference"},
                              {"checks", v.checks},
                              {"not_asked", v.not_asked},
                              {"microseconds", v.kernel_us}};
  if (!v.known_difference.empty()) json["why"] = v.known_difference;
  if (v.mismatch) {
    const suite::Mismatch& m = *v.mismatch;
    nlohmann::ordered_json steps = nlohmann::ordered_json::array();
    for (const suite::Step& step : m.steps) steps.push_back(step_json(step));
    json["mismatch"] = {{"operation", m.operation}, {"step", m.step},         {"what", m.what},
                        {"expected", m.expected},   {"answered", m.answered}, {"steps", steps}};
  }
  return json;
}

}  // namespace

bool is_wrong(const Verdict& verdict) { return verdict.mismatch.has_value(); }

bool any_wrong(const SuiteRow& row) {
  return std::any_of(row.verdicts.begin(), row.verdicts.end(), is_wrong);
}

std::string suite_heading(const SuiteTable& table) {
  std::string line =
      fmt::format("{:<{}}{:>12}{:>11}", "fixture", table.name_width, "tetrahedra", "operations");
  for (const std::string& kernel : table.kernels) line += fmt::format("{:>10.9}", kernel);
  return line + fmt::format("{:>10}{:>10}{:>14}\n", "checks", "result", "microseconds");
}

std::string suite_line(const SuiteTable& table, const SuiteRow& row) {
  std::string line = fmt::format("{:<{}}{:>12}{:>11}", row.fixture, table.name_width,
                                 row.tetrahedra, row.operations);
  for (const Verdict& v : row.verdicts) line += fmt::format("{:>10}", result_of(v));
  const char* result = any_wrong(row) ? "DIFFERS" : "fine";
  return line + fmt::format("{:>10}{:>10}{:>14.0f}\n", checks_of(row), result, kernel_us(row));
}

std::string verdict_details(const Verdict& v, const std::vector<std::string>& steps) {
  std::string text;
  if (!v.known_difference.empty()) text += fmt::format("known: {}\n", v.known_difference);
  if (!v.mismatch) return text;
  const suite::Mismatch& m = *v.mismatch;
  const std::string when = m.operation == 0
                               ? "after loading"
                               : fmt::format("in operation {}, after step {}", m.operation, m.step);
  text += fmt::format("{}: {}: expected {}, answered {}\n", when, m.what, m.expected, m.answered);
  constexpr std::size_t most = 20;
  if (steps.empty()) return text;
  text += fmt::format("    seen with {}:\n", counted(steps.size(), "step"));
  for (std::size_t i = 0; i < std::min(most, steps.size()); ++i) {
    text += fmt::format("      {}\n", steps[i]);
  }
  if (steps.size() > most) text += "      ... (--json has them all)\n";
  return text;
}

std::string suite_details(const SuiteRow& row) {
  std::vector<std::pair<std::string, std::string>> said;  // text, kernels
  for (std::size_t k = 0; k < row.verdicts.size(); ++k) {
    const std::string text = verdict_details(row.verdicts[k], row.steps_in_words[k]);
    if (text.empty()) continue;
    const auto same = std::find_if(said.begin(), said.end(),
                                   [&text](const auto& entry) { return entry.first == text; });
    if (same == said.end()) {
      said.emplace_back(text, row.verdicts[k].kernel);
    } else {
      same->second += ", " + row.verdicts[k].kernel;
    }
  }
  std::string lines;
  for (const auto& [text, kernels] : said) lines += fmt::format("  {}: {}", kernels, text);
  return lines;
}

std::string suite_totals(const SuiteTable& table, const std::vector<SuiteRow>& rows) {
  const Totals t = totals_of(rows, table.kernels.size());
  std::string times;
  for (std::size_t k = 0; k < table.kernels.size(); ++k) {
    times += fmt::format("{} {:.2f} s, ", table.kernels[k], t.kernel_us[k] * 1e-6);
  }
  const std::size_t left = table.fixtures - rows.size();
  const std::string ended =
      left == 0 ? ""
                : fmt::format("ended at a mismatch, {} not judged; ", counted(left, "fixture"));
  return fmt::format("{}{}, {}: {}, {}, {}, {} not asked, {}, {}; {}truth {:.2f} s\n", ended,
                     counted(t.fixtures, "fixture"), counted(table.kernels.size(), "kernel"),
                     counted(t.operations, "operation"), counted(t.steps, "step"),
                     counted(t.checks, "check"), t.not_asked,
                     counted(t.known_differences, "known difference"),
                     counted(t.mismatches, "mismatch", "mismatches"), times, t.truth_us * 1e-6);
}

nlohmann::ordered_json suite_json(const SuiteTable& table, const std::vector<SuiteRow>& rows) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const SuiteRow& row : rows) {
    nlohmann::ordered_json verdicts = nlohmann::ordered_json::array();
    for (const Verdict& v : row.verdicts) verdicts.push_back(verdict_json(v));
    list.push_back({{"fixture", row.fixture},
                    {"tetrahedra", row.tetrahedra},
                    {"operations", row.operations},
                    {"steps", row.steps},
                    {"truth_checks", row.truth_checks},
                    {"truth_microseconds", row.truth_us},
                    {"verdicts", verdicts}});
  }
  const Totals t = totals_of(rows, table.kernels.size());
  return {{"kernels", table.kernels},
          {"fixtures", list},
          {"totals",
           {{"fixtures", t.fixtures},
            {"not_judged", table.fixtures - rows.size()},
            {"operations", t.operations},
            {"steps", t.steps},
            {"checks", t.checks},
            {"not_asked", t.not_asked},
            {"known_differences", t.known_differences},
            {"mismatches", t.mismatches},
            {"kernel_microseconds", t.kernel_us},
            {"truth_microseconds", t.truth_us}}}};
}

}  // namespace sunder
