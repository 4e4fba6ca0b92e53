// SPDX-License-Identifier: MIT
// The methods, and the product of everything.
#include "apps/bench/chart/chart_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "topology/base/assert.hpp"
#include "topology/base/split_text.hpp"

namespace sunder {
namespace {

constexpr auto methods = std::to_array<ChartMethod>({
    {"floating_frame", "integrator.method=floating_frame integrator.rho_infinity=0", true, false,
     "#0072b2"},
    {"floating_frame, rho 0.5", "integrator.method=floating_frame integrator.rho_infinity=0.5",
     true, false, "#56b4e9"},
    {"floating_frame, no ladder",
     "integrator.method=floating_frame integrator.rho_infinity=0 ladder.rigid=false "
     "ladder.quasi_static=false ladder.sleep=false",
     true, false, "#332288"},
    {"implicit_euler", "integrator.method=implicit_euler integrator.euler_frame=current", false,
     false, "#d55e00"},
    {"implicit_euler, predicted frame",
     "integrator.method=implicit_euler integrator.euler_frame=predicted", false, false, "#e69f00"},
    {"broyden, mass (paper)", "integrator.method=broyden integrator.broyden_start=mass", false,
     true, "#cc0000"},
    {"broyden, factor", "integrator.method=broyden integrator.broyden_start=factor", false, false,
     "#ff8888"},
    {"newton_cg", "integrator.method=newton_cg", false, false, "#cc79a7"},
    {"corotational, reassembled",
     "model=corotational integrator.method=implicit_euler "
     "integrator.corotational_solve=reassembled",
     false, false, "#666666"},
    {"corotational, prefactored",
     "model=corotational integrator.method=implicit_euler "
     "integrator.corotational_solve=prefactored",
     false, false, "#aaaaaa"},
    {"verlet", "integrator.method=verlet", false, true, "#009e73"},
    {"sub_stepped", "integrator.method=sub_stepped", false, false, "#66cc99"},
    {"modal", "integrator.method=modal", false, false, "#882255"},
});

/// Adds the settings of one series.
struct SeriesMaker {
  const ChartGrid& grid;
  std::vector<ChartSetting>& all;
  std::size_t series = 0;

  void add(ChartSetting setting, double step) {
    setting.step = whole_step(grid.duration, step);
    if (!all.empty() && all.back().series == series && all.back().step == setting.step) return;
    setting.changes.push_back(change("time_step", setting.step));
    setting.series = series;
    all.push_back(std::move(setting));
  }

  void make(const ChartSetting& setting) {
    const bool wall = methods[setting.method].has_wall;
    std::vector<double> numbers = wall ? grid.wall_shares : grid.steps;
    std::ranges::sort(numbers, std::greater<>());
    for (const double number : numbers) {
      ChartSetting one = setting;
      one.wall_share = wall ? number : std::numeric_limits<double>::quiet_NaN();
      add(std::move(one), wall ? number * grid.bounds[setting.mesh] : number);
    }
    ++series;
  }
};

std::vector<std::string> words(std::string_view text) {
  const std::vector<std::string_view> all = split_text(text, ' ');
  return {all.begin(), all.end()};
}

}  // namespace

std::span<const ChartMethod> chart_methods() { return methods; }

std::size_t paper_method() {
  const auto row = std::ranges::find(methods, "broyden, mass (paper)", &ChartMethod::name);
  SUNDER_ASSERT(row != methods.end(), "the paper's own method is in the table");
  return static_cast<std::size_t>(row - methods.begin());
}

std::string change(std::string_view key, double value) { return fmt::format("{}={}", key, value); }

double whole_step(double duration, double step) {
  return duration / std::max(1.0, std::ceil(duration / step * (1 - 1e-9)));
}

std::vector<ChartSetting> chart_settings(const ChartGrid& grid) {
  std::vector<ChartSetting> all;
  SeriesMaker maker{grid, all};
  const std::vector<char> none = {0};
  const std::vector<std::string> as_it_is = {""};
  for (const std::size_t method : grid.methods) {
    const bool windows = methods[method].has_windows && !grid.windows.empty();
    for (const bool window : windows ? grid.windows : none) {
      for (const std::string& variant : grid.variants.empty() ? as_it_is : grid.variants) {
        for (std::size_t mesh = 0; mesh < grid.bounds.size(); ++mesh) {
          ChartSetting s{method, variant, window, 0, mesh, 0, words(methods[method].changes), 0};
          if (windows) {
            s.changes.push_back(window ? "impact.window=true" : "impact.window=false");
          }
          if (!variant.empty()) s.changes.push_back(variant);
          maker.make(s);
        }
      }
    }
  }
  return all;
}

}  // namespace sunder
