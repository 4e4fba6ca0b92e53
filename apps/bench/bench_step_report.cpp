// SPDX-License-Identifier: MIT
// Figures of `sunder bench step` as text.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "apps/bench/bench_step.hpp"
#include "apps/scene/json_text.hpp"

namespace sunder {
namespace {

constexpr std::size_t step_text_width = 44, step_column_width = 14;

struct BodyName {
  std::string name;
  std::size_t tetrahedra;
};

std::vector<BodyName> bodies_of(const StepBench& bench) {
  std::vector<BodyName> bodies;
  for (const StepFigure& f : bench.figures) {
    if (bodies.empty() || bodies.back().name != f.body) bodies.push_back({f.body, f.tetrahedra});
  }
  return bodies;
}

/// The first figure of a body and quantity; with modulus and step where they are given.
struct Wanted {
  std::string_view body, quantity;
  std::optional<double> young_modulus = {}, time_step = {};
};

std::optional<double> figure_of(const StepBench& bench, const Wanted& wanted) {
  for (const StepFigure& f : bench.figures) {
    if (f.body == wanted.body && f.quantity == wanted.quantity &&
        (!wanted.young_modulus || f.young_modulus == wanted.young_modulus) &&
        (!wanted.time_step || f.time_step == wanted.time_step)) {
      return f.value;
    }
  }
  return std::nullopt;
}

std::string cell_of(std::optional<double> value, std::string_view quantity) {
  if (!value) return "-";
  if (quantity == "cholmod_difference") return fmt::format("{:.1e}", *value);
  if (quantity == "factor_doubles") return fmt::format("{:.0f}", *value);
  return fmt::format("{:.{}f}", *value, std::abs(*value) < 10 ? 3 : 1);
}

void append_range(std::string& out, const StepBench& bench) {
  std::set<std::pair<double, double>> cases;
  for (const StepFigure& f : bench.figures) {
    if (f.quantity == "step") cases.emplace(f.young_modulus, f.time_step);
  }
  fmt::format_to(std::back_inserter(out), "\n{:<{}}\n", "Whole step, ms, over modulus and step",
                 step_text_width);
  for (const auto& [modulus, step] : cases) {
    fmt::format_to(std::back_inserter(out), "{:<{}}",
                   fmt::format("  {:.0e} Pa, {:.3g} ms", modulus, 1e3 * step), step_text_width);
    for (const BodyName& body : bodies_of(bench)) {
      fmt::format_to(std::back_inserter(out), "{:>{}}",
                     cell_of(figure_of(bench, {body.name, "step", modulus, step}), "step"),
                     step_column_width);
    }
    out += '\n';
  }
}

}  // namespace

std::string step_table(const StepBench& bench) {
  std::string out = fmt::format("{}; medians of {} steps, ms\n\n{:<{}}", bench.machine, bench.runs,
                                "", step_text_width);
  for (const BodyName& body : bodies_of(bench)) {
    fmt::format_to(std::back_inserter(out), "{:>{}}", body.name, step_column_width);
  }
  fmt::format_to(std::back_inserter(out), "\n{:<{}}", "Tetrahedra", step_text_width);
  for (const BodyName& body : bodies_of(bench)) {
    fmt::format_to(std::back_inserter(out), "{:>{}}", body.tetrahedra, step_column_width);
  }
  out += '\n';
  for (const StepQuantity& q : step_quantities()) {
    fmt::format_to(std::back_inserter(out), "{:<{}}", q.text, step_text_width);
    for (const BodyName& body : bodies_of(bench)) {
      fmt::format_to(std::back_inserter(out), "{:>{}}",
                     cell_of(figure_of(bench, {body.name, q.name}), q.name), step_column_width);
    }
    out += '\n';
  }
  append_range(out, bench);
  return out;
}

std::string step_csv(const StepBench& bench) {
  std::string out =
      fmt::format("# sunder bench step on {}\n# medians of {} steps\n", bench.machine, bench.runs);
  out += "body,tetrahedra,young_modulus,time_step,quantity,unit,value\n";
  const std::vector<StepQuantity> all = step_quantities();
  for (const StepFigure& f : bench.figures) {
    const auto q = std::ranges::find_if(
        all, [&](const StepQuantity& each) { return each.name == f.quantity; });
    fmt::format_to(std::back_inserter(out), "{},{},{:.6g},{:.6g},{},{},{:.6g}\n", f.body,
                   f.tetrahedra, f.young_modulus, f.time_step, f.quantity, q->unit, f.value);
  }
  return out;
}

std::string step_json(const StepBench& bench) {
  nlohmann::ordered_json figures = nlohmann::ordered_json::array();
  for (const StepFigure& f : bench.figures) {
    figures.push_back({{"body", f.body},
                       {"tetrahedra", f.tetrahedra},
                       {"young_modulus", f.young_modulus},
                       {"time_step", f.time_step},
                       {"quantity", f.quantity},
                       {"value", f.value}});
  }
  const nlohmann::ordered_json answer = {
      {"machine", bench.machine}, {"runs", bench.runs}, {"figures", figures}};
  return json_text(answer) + "\n";
}

}  // namespace sunder
