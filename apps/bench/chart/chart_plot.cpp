// SPDX-License-Identifier: MIT
// The picture of a chart: a script for gnuplot.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>

#include "apps/bench/chart/chart_pareto.hpp"
#include "apps/bench/chart/chart_report.hpp"
#include "topology/base/counted.hpp"

namespace sunder {
namespace {

/// Text in gnuplot's single quotes.
std::string title(std::string_view text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("''") : std::string(1, c);
  return out + "'";
}

/// Curves of a plot and the points that they read from "-", in the same order.
struct Plot {
  std::string curves, data;

  /// A curve without points gets its place in the legend only.
  void add(const std::string& points, const std::string& style, const std::string& name) {
    curves += fmt::format("{}{} {} {}", curves.empty() ? "plot " : ", \\\n  ",
                          points.empty() ? "NaN" : "'-'", style,
                          name.empty() ? "notitle" : "title " + title(name));
    if (!points.empty()) data += points + "e\n";
  }
};

std::string point_line(const Chart& chart, const ChartPoint& p) {
  return fmt::format("{:.6g} {:.6g}\n", p.outcome.cost, counted_error(chart.reference, p.error));
}

/// Marks by mesh, hollow without a window where the scene has any.
int mark(std::size_t mesh, bool hollow) {
  constexpr int filled[] = {7, 9, 5, 13};
  return filled[std::min<std::size_t>(mesh, 3)] - (hollow ? 1 : 0);
}

bool has_windows(const Chart& chart) {
  return std::ranges::any_of(chart.points,
                             [](const ChartPoint& p) { return p.setting.has_window; });
}

/// From the last series to the first: the default lies on top.
void add_series(Plot& plot, const Chart& chart) {
  const bool windows = has_windows(chart);
  for (std::size_t end = chart.points.size(); end > 0;) {
    const ChartSetting& s = chart.points[end - 1].setting;
    std::string points;
    for (; end > 0 && chart.points[end - 1].setting.series == s.series; --end) {
      const ChartPoint& p = chart.points[end - 1];
      if (p.outcome.end == ChartEnd::fine) points += point_line(chart, p);
    }
    if (points.empty()) continue;
    plot.add(points,
             fmt::format("with linespoints lc rgb '{}' lw 1.2 pt {} ps 1.1",
                         chart_methods()[s.method].color, mark(s.mesh, windows && !s.has_window)),
             "");
  }
}

/// Least and largest error of one run of an ensemble, as counted.
std::array<double, 2> error_band(const Chart& chart, const ChartPoint& p) {
  std::array<double, 2> band{std::numeric_limits<double>::infinity(), 0};
  for (const Vec3& value : p.outcome.values) {
    const double error = counted_error(
        chart.reference, (value - chart.reference.value).norm() / chart.reference.scale);
    band = {std::min(band[0], error), std::max(band[1], error)};
  }
  return band;
}

/// Of ensembles, bars through the errors of the means.
void add_bands(Plot& plot, const Chart& chart) {
  for (const ChartPoint& p : chart.points) {
    if (p.outcome.values.size() < 2) continue;
    const auto [low, high] = error_band(chart, p);
    const double middle = counted_error(chart.reference, p.error);
    plot.add(
        fmt::format("{:.6g} {:.6g} {:.6g} {:.6g}\n", p.outcome.cost, middle, low, high),
        fmt::format("with yerrorbars lc rgb '{}' pt 0", chart_methods()[p.setting.method].color),
        "");
  }
}

/// One entry a method, whether it has points or not.
void add_legend(Plot& plot, const Chart& chart) {
  std::vector<std::size_t> seen;
  for (const ChartPoint& p : chart.points) {
    if (std::ranges::find(seen, p.setting.method) != seen.end()) continue;
    seen.push_back(p.setting.method);
    const ChartMethod& method = chart_methods()[p.setting.method];
    const bool any = std::ranges::any_of(chart.points, [&](const ChartPoint& other) {
      return other.setting.method == p.setting.method && other.outcome.end == ChartEnd::fine;
    });
    plot.add("", fmt::format("with lines lc rgb '{}' lw 4", method.color),
             std::string(method.name) + (any ? "" : " (no run ended well)"));
  }
  for (std::size_t mesh = 0; mesh < chart.tetrahedra.size(); ++mesh) {
    plot.add("", fmt::format("with points lc rgb '#444444' pt {} ps 1.1", mark(mesh, false)),
             fmt::format("{} tetrahedra", chart.tetrahedra[mesh]));
  }
  if (has_windows(chart)) {
    plot.add("", "with points lc rgb '#444444' pt 6 ps 1.1", "hollow: without impact windows");
  }
}

void add_marked(Plot& plot, const Chart& chart) {
  const auto ring = [&](const std::optional<std::size_t>& k, const char* color, const char* name) {
    if (!k) return;
    plot.add(point_line(chart, chart.points[*k]),
             fmt::format("with points lc rgb '{}' pt 6 ps 3.4 lw 3", color), name);
  };
  ring(chart.default_point, "#000000", "ringed: the default");
  ring(chart.paper_point, "#d00000", "ringed: the paper's choice");
}

/// The range of the points on both axes, with room around them.
struct Extent {
  CostError low{1e300, 1e300}, high{0, 0};
};

Extent extent_of(const Chart& chart) {
  Extent e;
  for (const ChartPoint& p : chart.points) {
    if (p.outcome.end == ChartEnd::nothing_broke) {
      e.low.cost = std::min(e.low.cost, p.outcome.cost);
      e.high.cost = std::max(e.high.cost, p.outcome.cost);
    }
    if (p.outcome.end != ChartEnd::fine) continue;
    const double error = counted_error(chart.reference, p.error);
    e.low = {std::min(e.low.cost, p.outcome.cost), std::min(e.low.error, error)};
    e.high = {std::max(e.high.cost, p.outcome.cost), std::max(e.high.error, error)};
    const auto [least, most] = error_band(chart, p);
    e.low.error = std::min(e.low.error, least);
    e.high.error = std::max(e.high.error, most);
  }
  e.low.error = std::min(e.low.error, chart.within);
  e.high.error = std::max(e.high.error, chart.within);
  return {{e.low.cost / 1.6, e.low.error / 2}, {e.high.cost * 1.6, e.high.error * 2.5}};
}

/// Runs in which nothing broke have a cost and no error: crosses along the upper edge.
void add_unbroken(Plot& plot, const Chart& chart, double height) {
  bool is_named = false;
  for (const ChartPoint& p : chart.points) {
    if (p.outcome.end != ChartEnd::nothing_broke) continue;
    plot.add(fmt::format("{:.6g} {:.6g}\n", p.outcome.cost, height),
             fmt::format("with points lc rgb '{}' pt 2 lw 2 ps 1.2",
                         chart_methods()[p.setting.method].color),
             is_named ? "" : "cross above: nothing broke");
    is_named = true;
  }
}

void add_level(Plot& plot, const Extent& extent, double level, const char* style,
               const char* name) {
  plot.add(fmt::format("{:.6g} {:.6g}\n{:.6g} {:.6g}\n", extent.low.cost, level, extent.high.cost,
                       level),
           fmt::format("with lines {}", style), name);
}

}  // namespace

std::string chart_script(const Chart& chart) {
  const QuantityTraits& q = traits_of(chart.probe.quantity);
  Plot plot;
  std::string front;
  for (const std::size_t k : chart.front) front += point_line(chart, chart.points[k]);
  plot.add(front, "with steps lc rgb '#c8c8c8' lw 9", "Pareto front");
  add_bands(plot, chart);
  add_series(plot, chart);
  add_legend(plot, chart);
  add_marked(plot, chart);
  const Extent extent = extent_of(chart);
  add_unbroken(plot, chart, extent.high.error / 1.4);
  add_level(plot, extent, chart.within, "lc rgb '#666666' dt 3 lw 1.5", "--within");
  if (chart.reference.own_error > 0) {
    add_level(plot, extent, chart.reference.own_error, "lc rgb '#aa3377' dt 2 lw 1.5",
              "own error of the reference");
  }
  const auto missing = std::ranges::count_if(chart.points, [](const ChartPoint& p) {
    return p.outcome.end != ChartEnd::fine && p.outcome.end != ChartEnd::nothing_broke;
  });
  std::string script = fmt::format(
      "set terminal pngcairo noenhanced size 1300,720 font 'DejaVu Sans,13'\n"
      "set logscale xy\nset format xy '%g'\nset grid lc rgb '#e4e4e4'\n"
      "set key outside right center Left reverse spacing 1.25 font ',11' samplen 2\n"
      "set xrange [{:.6g}:{:.6g}]\nset yrange [{:.6g}:{:.6g}]\n",
      extent.low.cost, extent.high.cost, extent.low.error, extent.high.error);
  script += fmt::format(
      "set title {}\nset xlabel {}\nset ylabel {}\n",
      title(fmt::format("{}: error of {}", chart.scene, q.name)),
      title(fmt::format("ms of computing per simulated ms{}",
                        missing == 0 ? ""
                                     : fmt::format("    ({} of {} {} no point: see the table)",
                                                   missing, counted(chart.points.size(), "run"),
                                                   for_count(missing, "has", "have")))),
      title(fmt::format("error over {}", q.scale)));
  return script + plot.curves + "\n" + plot.data;
}

}  // namespace sunder
