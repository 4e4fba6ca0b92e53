// SPDX-License-Identifier: MIT
// A chart as text.
#include "apps/bench/chart/chart_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "apps/bench/chart/chart_ensemble.hpp"
#include "apps/scene/scene_text.hpp"

namespace sunder {
namespace {

using nlohmann::ordered_json;

std::string number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

/// A scalar or a vector, as its quantity is.
std::string value_text(const Chart& chart, const Vec3& value, const char* between) {
  if (!traits_of(chart.probe.quantity).is_vector) return fmt::format("{:.6g}", value[0]);
  return fmt::format("{:.6g}{}{:.6g}{}{:.6g}", value[0], between, value[1], between, value[2]);
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string error_text(const Chart& chart, double error) {
  if (error < chart.reference.own_error) {
    return fmt::format("{:.2g} (below the reference's own {:.2g})", error,
                       chart.reference.own_error);
  }
  return fmt::format("{:.2g}", error);
}

/// Mean and band of an ensemble; nothing of single runs.
std::string band_text(const Chart& chart, const ChartPoint& p) {
  if (chart.members == 1) return "";
  const ChartBand band = band_of(p.outcome.values);
  return fmt::format("mean {} +- {:.3g} [{} to {}]  ", value_text(chart, band.mean, " "),
                     band.deviation, value_text(chart, band.low, " "),
                     value_text(chart, band.high, " "));
}

std::string point_text(const Chart& chart, const ChartPoint& p) {
  return fmt::format("{:>10.4g} ms/ms  error {:<10}  {}{}", p.outcome.cost,
                     error_text(chart, p.error), band_text(chart, p),
                     setting_text(chart, p.setting));
}

/// How many runs ended in each other way than fine.
std::string without_point(const Chart& chart) {
  std::map<ChartEnd, std::size_t> count;
  for (const ChartPoint& p : chart.points) ++count[p.outcome.end];
  std::string text;
  for (const auto& [end, n] : count) {
    if (end == ChartEnd::fine) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", n, word_of(end));
  }
  return text;
}

ordered_json value_json(const Chart& chart, const Vec3& value) {
  if (!traits_of(chart.probe.quantity).is_vector) return value[0];
  return {value[0], value[1], value[2]};
}

ordered_json point_json(const Chart& chart, const ChartPoint& p) {
  ordered_json json = {{"method", chart_methods()[p.setting.method].name},
                       {"variant", p.setting.variant},
                       {"window", p.setting.has_window},
                       {"time_step", p.setting.step},
                       {"tetrahedra", p.outcome.tetrahedra},
                       {"end", word_of(p.outcome.end)}};
  if (p.outcome.end != ChartEnd::fine) {
    json["reason"] = p.outcome.reason;
    return json;
  }
  json["given_up_steps"] = p.outcome.given_up;
  json["value"] = value_json(chart, p.outcome.value);
  const ChartBand band = band_of(p.outcome.values);
  json[chart.over_meshes ? "meshes" : "runs_moved_by_nothing"] = chart.members;
  json["deviation"] = band.deviation;
  json["low"] = value_json(chart, band.low);
  json["high"] = value_json(chart, band.high);
  json["error"] = p.error;
  json["lasting_error"] = p.lasting_error;
  json["ms_per_ms"] = p.outcome.cost;
  json["on_front"] = p.on_front;
  return json;
}

}  // namespace

std::string setting_text(const Chart& chart, const ChartSetting& s) {
  std::string text{chart_methods()[s.method].name};
  if (s.has_window) text += ", with windows";
  if (!s.variant.empty()) text += ", " + s.variant;
  text += fmt::format(", step {:.4g} s", s.step);
  if (chart.tetrahedra.size() > 1) text += fmt::format(", {} tetrahedra", chart.tetrahedra[s.mesh]);
  return text;
}

ordered_json setting_json(const ChartSetting& setting) {
  SceneText text;
  text.root = nlohmann::json::object();
  for (const std::string& change : setting.changes) apply_setting(text, change);
  // A whole number of steps in the run makes a number of many digits: as written it is the same.
  return ordered_json(text.root);
}

std::string chart_table(const Chart& chart) {
  const QuantityTraits& q = traits_of(chart.probe.quantity);
  std::string out;
  const auto row = [&](const char* name, const std::string& text) {
    fmt::format_to(std::back_inserter(out), "{:<14} {}\n", name, text);
  };
  row("quantity", fmt::format("{}: {}", q.name, q.text));
  if (q.quantity == Quantity::position) {
    row("point", fmt::format("{:.6g}, {:.6g}, {:.6g} m in the mesh", chart.probe.point[0],
                             chart.probe.point[1], chart.probe.point[2]));
  }
  row("reference", fmt::format("{} {} ({})", value_text(chart, chart.reference.value, ", "), q.unit,
                               chart.reference.how));
  row("errors", fmt::format("over {}", q.scale));
  if (chart.default_point) row("default", point_text(chart, chart.points[*chart.default_point]));
  if (chart.paper_point) row("paper's", point_text(chart, chart.points[*chart.paper_point]));
  for (const std::size_t k : chart.front) {
    row(k == chart.front.front() ? "front" : "", point_text(chart, chart.points[k]));
  }
  const std::string others = without_point(chart);
  row("runs", fmt::format("{}{}", chart.points.size(),
                          others.empty() ? "" : ", without a point: " + others));
  return out;
}

std::string chart_csv(const Chart& chart) {
  const QuantityTraits& q = traits_of(chart.probe.quantity);
  std::string out = fmt::format(
      "# {} of {}, {}; error over {}\n# reference {} {}: {}; its own error {:.3g}\n"
      "# ms_per_ms: computing (median of the runs) over simulated time; ratios count\n",
      q.name, chart.scene, q.unit, q.scale, value_text(chart, chart.reference.value, " "), q.unit,
      chart.reference.how, chart.reference.own_error);
  out +=
      "method,variant,window,time_step,mesh,tetrahedra,steps,sub_steps,given_up,fans,"
      "value,deviation,low,high,error,lasting_error,below_reference,ms_per_ms,runs,on_front,end,"
      "reason\n";
  for (const ChartPoint& p : chart.points) {
    const ChartOutcome& o = p.outcome;
    const bool fine = o.end == ChartEnd::fine;
    const ChartBand band = fine ? band_of(o.values) : ChartBand{};
    fmt::format_to(
        std::back_inserter(out),
        "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n",
        quoted(std::string(chart_methods()[p.setting.method].name)), quoted(p.setting.variant),
        p.setting.has_window ? 1 : 0, p.setting.step, p.setting.mesh, o.tetrahedra, o.steps,
        o.sub_steps, o.given_up, o.fans, fine ? value_text(chart, o.value, " ") : "",
        fine ? fmt::format("{:.5g}", band.deviation) : "",
        fine ? value_text(chart, band.low, " ") : "", fine ? value_text(chart, band.high, " ") : "",
        number(p.error), number(p.lasting_error),
        fine ? fmt::format("{:d}", p.error < chart.reference.own_error) : "",
        fine ? fmt::format("{:.5g}", o.cost) : "", o.runs, p.on_front ? 1 : 0, word_of(o.end),
        quoted(o.reason));
  }
  return out;
}

ordered_json chart_json(const Chart& chart) {
  const QuantityTraits& q = traits_of(chart.probe.quantity);
  ordered_json points = ordered_json::array(), front = ordered_json::array();
  for (const ChartPoint& p : chart.points) points.push_back(point_json(chart, p));
  for (const std::size_t k : chart.front) front.push_back(k);
  const auto row = [](const std::optional<std::size_t>& k) {
    return k ? ordered_json(*k) : ordered_json(nullptr);
  };
  ordered_json json = {{"scene", chart.scene},
                       {"quantity", q.name},
                       {"unit", q.unit},
                       {"reference",
                        {{"value", value_json(chart, chart.reference.value)},
                         {"scale", chart.reference.scale},
                         {"own_error", chart.reference.own_error},
                         {"how", chart.reference.how}}},
                       {"points", points},
                       {"front", front},
                       {"default", row(chart.default_point)},
                       {"paper", row(chart.paper_point)},
                       {"within", chart.within},
                       {"cheapest", row(chart.cheapest)}};
  if (chart.cheapest) json["settings"] = setting_json(chart.points[*chart.cheapest].setting);
  return json;
}

}  // namespace sunder
