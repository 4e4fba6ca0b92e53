// SPDX-License-Identifier: MIT
// The settings that `sunder chart` tries: methods as data, crossed with steps, windows and meshes.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sunder {

/// One way of stepping, said as changes of a scene. A new integrator or model is a row.
struct ChartMethod {
  std::string_view name;
  /// `key=value` changes as `--set` takes them, separated by spaces; no key twice.
  std::string_view changes;
  /// Whether impact windows exist for it (docs/explanation/time_and_contact.md).
  bool has_windows = false;
  /// Whether it holds only below about `explicit_step_bound`: its steps are shares of that.
  bool has_wall = false;
  /// gnuplot's colour.
  std::string_view color = "black";
};

/// All of them. The first is the scene format's default, by which references are made.
std::span<const ChartMethod> chart_methods();

/// The row of the paper's own integrator.
std::size_t paper_method();

/// The choices that the chart crosses.
struct ChartGrid {
  /// Rows of `chart_methods`.
  std::vector<std::size_t> methods;
  /// s, of methods without a wall; of methods with one, as shares of the bound of each mesh.
  std::vector<double> steps, wall_shares;
  /// Values of `impact.window`. Empty: the scene has nothing to strike, and windows do nothing.
  std::vector<char> windows;
  /// Values of further keys, `key=value` each; empty: none are varied.
  std::vector<std::string> variants;
  /// s, the explicit step bound of each mesh, coarse to fine.
  std::vector<double> bounds;
  /// s: every step is made a whole part of it.
  double duration = 1;
};

/// One point of the grid.
struct ChartSetting {
  std::size_t method = 0;
  std::string variant;
  /// With impact windows.
  bool has_window = false;
  double step = 1e-3;
  std::size_t mesh = 0;
  /// Over the explicit step bound; not a number for methods without a wall.
  double wall_share = 0;
  /// `key=value` changes that make it of the scene.
  std::vector<std::string> changes;
  /// Where two settings differ in nothing but the step, so do their series.
  std::size_t series = 0;
};

/// Every sensible combination, series by series, each from its longest step to its shortest.
std::vector<ChartSetting> chart_settings(const ChartGrid& grid);

/// `duration` over the least whole number of steps that are no longer than `step`, s.
double whole_step(double duration, double step);

/// `key=value` with a number that reads back exactly.
std::string change(std::string_view key, double value);

}  // namespace sunder
