// SPDX-License-Identifier: MIT
// The claims of section 5, as numbers that can be compared.
#include "apps/bench/paper/bench_paper_claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>

#include "apps/bench/paper/bench_paper_tables.hpp"

namespace sunder {
namespace {

using Number = std::optional<double>;

/// Figures of one scene in one mode.
struct View {
  const PaperBench& bench;
  std::string_view scene, mode;

  Number operator()(std::string_view quantity) const {
    return figure_of(bench, scene, mode, quantity);
  }
  Number ratio(std::string_view part, std::string_view whole) const {
    const Number a = (*this)(part), b = (*this)(whole);
    if (!a || !b || *b == 0) return std::nullopt;
    return *a / *b;
  }
};

std::string in_percent(double value) { return fmt::format("{:.1f} %", 100 * value); }
std::string times(double value) { return fmt::format("{:.3g} x", value); }
std::string fine_times(double value) { return fmt::format("{:.4g} x", value); }
std::string whole_number(double value) { return fmt::format("{:.0f}", value); }

/// A claim before it is compared with figures.
struct Question {
  const char* text;
  std::function<Number(const View&)> number;
  std::string (*format)(double);
  std::function<bool(double)> holds;
};

Number less_one(Number value) {
  if (value) *value -= 1;
  return value;
}

Number one_less(Number value) {
  if (value) *value = 1 - *value;
  return value;
}

/// Of table 2.
std::vector<Question> questions_of_steps() {
  return {
      {"corotational steps take longer: average over average",
       [](const View& v) { return v.ratio("corotational_av", "model_av"); }, times,
       [](double r) { return r > 1; }},
      {"- their maximum over our maximum",
       [](const View& v) { return v.ratio("corotational_max", "model_max"); }, times,
       [](double r) { return r > 1; }},
      {"- one evaluation of the forces alone",
       [](const View& v) { return v.ratio("corotational_force", "force"); }, times,
       [](double r) { return r > 1; }},
      {"fractures add up to 20 % (simple) and 50 % (bunny) to a step",
       [](const View& v) { return less_one(v.ratio("fracture_av", "model_av")); }, in_percent,
       [](double r) { return r <= 0.6; }},
      {"- share of the fracture process in steps with fans",
       [](const View& v) { return v("fracture_share"); }, in_percent,
       [](double r) { return r <= 0.5; }},
      {"the largest step comes early among the steps with fans of its phase (1: with the first)",
       [](const View& v) {
         // Nothing where the phase says nothing: its only step with fans.
         const Number length = v("phase_length");
         return length && *length > 1 ? v("max_in_phase") : std::nullopt;
       },
       whole_number, [](double r) { return r <= 2; }},
      {"- and comes once: later steps above nine tenths of it",
       [](const View& v) { return v("later_near_max"); }, whole_number,
       [](double r) { return r == 0; }},
  };
}

/// Of tables 3 and 4.
std::vector<Question> questions_of_accelerations() {
  return {
      {"Gershgorin's test is 3 times faster than eigenvalues",
       [](const View& v) { return v("test_speed"); }, times, [](double r) { return r >= 3; }},
      {"about 80 % or more of what the bound lets through is over the threshold",
       [](const View& v) { return v("gershgorin_efficiency"); }, in_percent,
       [](double r) { return r >= 0.78; }},
      {"- had vertices with empty fans been tested every step",
       [](const View& v) { return v("gershgorin_retested"); }, in_percent,
       [](double r) { return r >= 0.78; }},
      {"the oracle is right in over 90 % of its predictions",
       [](const View& v) { return v("oracle_efficiency"); }, in_percent,
       [](double r) { return r > 0.9; }},
      {"it never misses a new component",
       [](const View& v) { return v.mode == theirs ? Number(0) : v("missed"); }, whole_number,
       [](double r) { return r == 0; }},
      {"without oracle the worst case is no new component: over one with",
       [](const View& v) { return v.ratio("walk_none", "walk_new"); }, times,
       [](double r) { return r > 1; }},
      {"with a new component the oracle costs at most 2 % more",
       [](const View& v) { return less_one(v("oracle_cost")); }, in_percent,
       [](double r) { return r <= 0.021; }},
      {"without one it saves at least 55 %, up to 67 %",
       [](const View& v) { return one_less(v.ratio("oracle_none", "walk_none")); }, in_percent,
       [](double r) { return r >= 0.547; }},
  };
}

/// Of the last paragraph, and one of section 7.
std::vector<Question> questions_of_models() {
  return {
      {"corotational node stress is lower: largest of the run without fractures, over ours",
       [](const View& v) { return v.ratio("peak_stress_corotational", "peak_stress"); }, fine_times,
       [](double r) { return r < 1; }},
      {"- at the same positions, vertices above half of the largest",
       [](const View& v) { return v("same_state_ratio"); }, fine_times,
       [](double r) { return r < 1; }},
      {"so it shatters less: fans over ours",
       [](const View& v) { return v.ratio("fractures_corotational", "fractures"); }, times,
       [](double r) { return r < 1; }},
      {"- pieces over ours", [](const View& v) { return v.ratio("pieces_corotational", "pieces"); },
       times, [](double r) { return r < 1; }},
      {"one crack a step shatters less (section 7): pieces over ours",
       [](const View& v) { return v.ratio("pieces_single", "pieces"); }, times,
       [](double r) { return r < 1; }},
  };
}

PaperClaim answer(const PaperBench& bench, const Question& question) {
  PaperClaim claim{question.text, {}, {}, "-"};
  const std::string_view mode = paper_modes().front().name;
  int asked = 0, held = 0;
  for (const PaperScene& scene : paper_scenes()) {
    const auto cell = [&](const Number& value) { return value ? question.format(*value) : "-"; };
    const Number ours = question.number({bench, scene.name, mode});
    claim.paper.push_back(cell(question.number({bench, scene.name, theirs})));
    claim.ours.push_back(cell(ours));
    asked += ours.has_value();
    held += ours && question.holds(*ours);
  }
  if (asked > 0) {
    claim.verdict = held == asked ? "holds"
                    : held == 0   ? "differs"
                                  : fmt::format("holds in {} of {}", held, asked);
  }
  return claim;
}

}  // namespace

std::vector<PaperClaim> paper_claims(const PaperBench& bench) {
  std::vector<PaperClaim> claims;
  for (const auto& questions :
       {questions_of_steps(), questions_of_accelerations(), questions_of_models()}) {
    for (const Question& question : questions) claims.push_back(answer(bench, question));
  }
  return claims;
}

}  // namespace sunder
