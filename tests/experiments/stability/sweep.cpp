// SPDX-License-Identifier: MIT
// Maps of the sweep and their picture.
#include "tests/experiments/stability/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/stability/flight.hpp"
#include "tests/stability/matrix.hpp"

namespace sunder::stability {
namespace {

constexpr int steps = 100;
const std::vector<double> time_steps = {1e-6, 3e-6, 1e-5, 3e-5, 1e-4,
                                        3e-4, 1e-3, 3e-3, 1e-2, 1.0 / 30};

template <class... Values>
std::string formatted(const char* format, Values... values) {
  char text[256];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

/// Colours of the outcomes, in their order.
constexpr std::string_view colors[] = {"#ffffff", "#4a9a5b", "#b8d8f0", "#cfd8a0",
                                       "#f2d14b", "#f0953b", "#d8443c", "#3a2430"};

/// Names of places on an axis, every `each`th.
std::string tics(const char* axis, const char* format, const std::vector<double>& list,
                 std::size_t each) {
  std::string text = formatted("set %stics (", axis);
  for (std::size_t i = 0; i < list.size(); i += each) {
    text += (i ? ",'" : "'") + formatted(format, list[i]) + formatted("' %zu", i);
  }
  return text + ")\n";
}

/// One panel: a square a cell, in places of the lists, so that axes need not be even.
std::string panel(const Map& map, const std::string& method, const std::vector<SweepRow>& rows) {
  std::string script =
      formatted("set xrange [-.5:%g]\nset yrange [-.5:%g]\n", double(map.time_steps.size()) - 0.5,
                double(map.values.size()) - 0.5);
  script += "plot '-' using 1:2:3 with points pt 5 ps 1.55 lc rgb variable notitle\n";
  const auto place = [](const std::vector<double>& list, double x) {
    return std::find(list.begin(), list.end(), x) - list.begin();
  };
  for (const SweepRow& row : rows) {
    if (row.map != map.name || row.method != method) continue;
    const std::string_view color = colors[static_cast<std::size_t>(row.cell.outcome)];
    script += formatted("%td %td 0x%s\n", place(map.time_steps, row.time_step),
                        place(map.values, row.value), std::string(color.substr(1)).c_str());
  }
  return script + "e\n";
}

/// What the colours mean, as a strip below.
std::string legend() {
  std::string script;
  for (std::size_t i = 1; i < std::size(colors); ++i) {
    const double x = 0.06 + 0.13 * double(i - 1);
    script += formatted("set label %zu '%s' at screen %g,0.018 font ',13'\n", i,
                        std::string(outcome_names[i]).c_str(), x + 0.014);
    script += formatted(
        "set object %zu rectangle center screen %g,0.018 size screen 0.012,0.014 fc rgb '%s' "
        "fs solid noborder\n",
        i, x, std::string(colors[i]).c_str());
  }
  return script;
}

}  // namespace

std::vector<Map> maps() {
  return {
      {"stiffness",
       "E, Pa",
       {1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12},
       time_steps,
       [](const Method& method, double E, double h) {
         return fly({.material = {.young_modulus = E}, .time_step = h, .steps = steps}, method);
       }},
      {"spin",
       "spin, rad/s",
       {1, 5, 20, 50, 100, 200, 500},
       time_steps,
       [](const Method& method, double spin, double h) {
         return fly({.time_step = h,
                     .steps = steps,
                     .spin = Vec3(0, 0, spin),
                     .deformation = 0,
                     .weight = false},
                    method);
       }},
      {"poisson",
       "nu",
       {0, 0.2, 0.4, 0.45, 0.48, 0.49, 0.5},
       time_steps,
       [](const Method& method, double nu, double h) {
         return fly(
             {.material = {.poisson_ratio = nu}, .time_step = h, .steps = steps, .weight = false},
             method);
       }},
      {"sliver",
       "least angle, degrees",
       {45, 10, 5, 2, 1, 0.3, 0.1},
       time_steps,
       [](const Method& method, double angle, double h) {
         return fly({.time_step = h, .steps = steps, .sliver_angle = angle, .weight = false},
                    method);
       }},
      {"mass",
       "block over ball",
       {1, 10, 1e2, 1e3, 1e4, 1e5, 1e6},
       time_steps,
       [](const Method& method, double ratio, double h) {
         return ball_on_block({.ratio = ratio, .time_step = h, .steps = steps}, method);
       }},
  };
}

std::vector<Method> mapped_methods() {
  std::vector<Method> some;
  for (const Method& method : methods()) {
    if (method.settings.isolated == IntegratorSettings{}.isolated) some.push_back(method);
  }
  return some;
}

std::string sweep_script(const std::vector<Map>& all, const std::vector<SweepRow>& rows) {
  const std::vector<Method> shown = mapped_methods();
  const std::size_t columns = shown.size();
  const std::size_t width = 100 + 190 * columns, height = 60 + 190 * all.size();
  std::string script =
      formatted("set terminal pngcairo size %zu,%zu font 'DejaVu Sans,10'\n", width, height);
  script +=
      formatted("set multiplot layout %zu,%zu margins %g,0.99,0.07,0.95 spacing 0.008,0.025\n",
                all.size(), columns, 90.0 / double(width));
  script +=
      "set tics nomirror out scale 0.4\nset border lc rgb '#aaaaaa'\nset title offset 0,-0.6\n";
  for (const Map& map : all) {
    const bool top = &map == &all.front(), bottom = &map == &all.back();
    for (const Method& method : shown) {
      const bool left = &method == &shown.front();
      if (bottom && left) script += legend();
      script += formatted("set title '%s'\n", top ? method.name.c_str() : "");
      script += bottom ? "set xlabel 'step, s' offset 0,0.6\n" : "unset xlabel\n";
      script += tics("x", bottom ? "%.0e" : "", map.time_steps, 3);
      script += left ? formatted("set ylabel '%s' offset 0.5,0\n", map.quantity.c_str())
                     : std::string("unset ylabel\n");
      script += tics("y", left ? "%g" : "", map.values, 1);
      script += panel(map, method.name, rows);
    }
  }
  return script + "unset multiplot\n";
}

}  // namespace sunder::stability
