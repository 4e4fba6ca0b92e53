// SPDX-License-Identifier: MIT
// A chart as table, CSV, JSON and picture, and its answer as lines to paste into a scene.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "apps/bench/chart/chart.hpp"

namespace sunder {

/// method, window, step, mesh in words.
std::string setting_text(const Chart& chart, const ChartSetting& setting);

/// The changes that turn the scene into a setting, as keys of a scene.
nlohmann::ordered_json setting_json(const ChartSetting& setting);

/// For people: the reference, the marked points, the front, the runs without a point and why.
std::string chart_table(const Chart& chart);

/// Three lines of remarks, a header, one line a run in the order of the grid.
std::string chart_csv(const Chart& chart);

/// {scene, quantity, unit, reference, points, front, default, paper, within, cheapest}.
nlohmann::ordered_json chart_json(const Chart& chart);

/// gnuplot's script: error over cost, both logarithmic, one colour a method.
std::string chart_script(const Chart& chart);

}  // namespace sunder
