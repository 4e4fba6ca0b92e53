// SPDX-License-Identifier: MIT
// Figures as text.
#include "apps/bench/bench_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace sunder {
namespace {

constexpr std::size_t text_width = 44, column_width = 13;

const BenchQuantity* quantity_of(std::string_view name) {
  const auto all = kernel_quantities();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [name](const BenchQuantity& q) { return q.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace

std::string bench_table(const KernelBench& bench) {
  const std::vector<std::string> bodies = bodies_of(bench);
  std::string out =
      fmt::format("{}; medians of {}, seed {}\n", bench.machine, bench.runs, bench.seed);
  std::size_t group = kernel_groups().size();
  for (const BenchQuantity& q : kernel_quantities()) {
    if (q.group != group) {
      group = q.group;
      fmt::format_to(std::back_inserter(out), "\n{:<{}}", kernel_groups()[group].title, text_width);
      for (const std::string& body : bodies) {
        fmt::format_to(std::back_inserter(out), "{:>{}}", body, column_width);
      }
      fmt::format_to(std::back_inserter(out), "\n  ({})\n", kernel_groups()[group].note);
    }
    fmt::format_to(std::back_inserter(out), "{:<{}}", q.text, text_width);
    for (const std::string& body : bodies) {
      const std::optional<double> value = figure_of(bench, body, q.name);
      fmt::format_to(std::back_inserter(out), "{:>{}}",
                     value ? fmt::format("{:.{}f}", *value, q.decimals) : "-", column_width);
    }
    out += '\n';
  }
  out +=
      "\nThe paper's table 3, per fan: 94.1 (monolith), 93.7 (block), 91.1 (bunny) % true, "
      "where\n"
      "56.6, 54.7 and 46.3 % of the fans part a component.\n";
  return out;
}

std::string bench_csv(const KernelBench& bench) {
  std::string out = fmt::format("# sunder bench kernel on {}\n# medians of {} runs, seed {}\n",
                                bench.machine, bench.runs, bench.seed);
  out += "body,tetrahedra,quantity,unit,value\n";
  for (const BenchFigure& f : bench.figures) {
    fmt::format_to(std::back_inserter(out), "{},{},{},{},{:.6g}\n", f.body, f.tetrahedra,
                   f.quantity, quantity_of(f.quantity)->unit, f.value);
  }
  return out;
}

nlohmann::ordered_json bench_json(const KernelBench& bench) {
  nlohmann::ordered_json figures = nlohmann::ordered_json::array();
  for (const BenchFigure& f : bench.figures) {
    figures.push_back({{"body", f.body},
                       {"tetrahedra", f.tetrahedra},
                       {"quantity", f.quantity},
                       {"unit", quantity_of(f.quantity)->unit},
                       {"value", f.value}});
  }
  return {
      {"machine", bench.machine}, {"runs", bench.runs}, {"seed", bench.seed}, {"figures", figures}};
}

}  // namespace sunder
