// SPDX-License-Identifier: MIT
// The picture: a script for gnuplot.
#include <fmt/format.h>

#include <array>
#include <iterator>

#include "apps/bench/bench_report.hpp"
#include "apps/sunder/gnuplot.hpp"

namespace sunder {
namespace {

struct Curve {
  std::string_view quantity, title;
  int color = 1;
  bool dashed = false;
};

constexpr auto operations = std::to_array<Curve>({
    {"managed_unsew", "CGAL managed unsew<3>, per face", 7, false},
    {"split_first", "split, intact body, per face", 6, false},
    {"split_components", "split and search, to total shatter, per face", 2, false},
    {"build", "build with findings, per tetrahedron", 8, true},
    {"quiet_total", "split and search without a new component, per fan", 4, false},
});
constexpr auto searches = std::to_array<Curve>({
    {"search_kept_us_walk", "full walk, nothing new", 7, false},
    {"search_kept_us_dirty_counter", "dirty counter, nothing new", 4, false},
    {"search_kept_us_oracle", "bare oracle, nothing new", 2, false},
    {"search_kept_us_exact", "lockstep, nothing new", 6, false},
    {"search_parted_us_walk", "full walk, new component", 7, true},
    {"search_parted_us_dirty_counter", "dirty counter, new component", 4, true},
    {"search_parted_us_oracle", "bare oracle, new component", 2, true},
    {"search_parted_us_exact", "lockstep, new component", 6, true},
});

/// One panel: its curves, then their points inline, as gnuplot reads "-".
void add_panel(std::string& script, const KernelBench& bench, std::string_view title,
               std::span<const Curve> curves) {
  std::string plot, data;
  for (const Curve& curve : curves) {
    std::string points;
    for (const BenchFigure& f : bench.figures) {
      if (f.quantity != curve.quantity || !f.body.starts_with("cube") || f.value <= 0) continue;
      fmt::format_to(std::back_inserter(points), "{} {}\n", f.tetrahedra, f.value);
    }
    if (points.empty()) continue;
    plot += fmt::format("{}'-' with linespoints title '{}' lc {} lw 2 pt 7 ps 1.1{}",
                        plot.empty() ? "plot " : ", ", curve.title, curve.color,
                        curve.dashed ? " dt 2" : "");
    data += points + "e\n";
  }
  script += fmt::format("set title '{}'\n{}\n{}", title, plot, data);
}

std::string plot_script(const KernelBench& bench) {
  std::string script =
      "set terminal pngcairo size 1500,720 font 'DejaVu Sans,13'\n"
      "set logscale xy\nset format x '10^{%T}'\nset format y '%g'\nset grid\n"
      "set xlabel 'tetrahedra (cubes)'\nset ylabel 'time, µs'\nset xrange [200:800000]\n"
      "set bmargin 9.5\nset key below maxcols 2 spacing 1.1 font ',11' samplen 2\n";
  script += fmt::format("set multiplot layout 1,2 title '{}'\n", bench.machine);
  add_panel(script, bench, "Operations", operations);
  add_panel(script, bench, "Search for components, per fan (mean)", searches);
  return script + "unset multiplot\n";
}

}  // namespace

std::optional<Finding> plot_bench(const KernelBench& bench, const std::filesystem::path& png) {
  return draw_png(plot_script(bench), png);
}

}  // namespace sunder
