// SPDX-License-Identifier: MIT
// The text, the JSON and the picture of sizes.
#include "apps/sunder/fragments/fragments_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "topology/base/counted.hpp"

namespace sunder {
namespace {

using nlohmann::ordered_json;

std::string_view name_of(const FittedLaw& law) {
  return size_law_names[static_cast<std::size_t>(law.law)];
}

std::string_view unit_of(const FragmentSizes& sizes) {
  return size_measure_units[static_cast<std::size_t>(sizes.measure)];
}

/// Names of a law's parameters; the second empty where it has one.
std::array<const char*, 2> parameter_names(SizeLaw law) {
  switch (law) {
    case SizeLaw::power:
      return {"exponent", ""};
    case SizeLaw::exponential:
      return {"rate", ""};
    case SizeLaw::weibull:
      return {"modulus", "scale"};
    case SizeLaw::lognormal:
      return {"log_mean", "log_deviation"};
  }
  return {};
}

ordered_json law_json(const FittedLaw& law) {
  ordered_json json = {{"law", name_of(law)}, {"cut", law.cut}};
  const auto names = parameter_names(law.law);
  for (std::size_t k = 0; k < 2; ++k) {
    if (*names[k] != '\0') json[names[k]] = law.parameters[k];
  }
  json["log_likelihood_per_value"] = law.log_likelihood;
  json["distance"] = law.distance;
  return json;
}

ordered_json laws_json(const SampleLaws& laws) {
  ordered_json whole = ordered_json::array(), tail = ordered_json::array();
  for (const FittedLaw& law : laws.whole) whole.push_back(law_json(law));
  for (std::size_t k = 0; k < laws.tail.size(); ++k) {
    tail.push_back(law_json(laws.tail[k]));
    if (k > 0) tail.back()["limit_is_power_law"] = is_power_limit(laws.tail[k]);
    if (k > 0) tail.back()["power_law_against_it"] = laws.against[k - 1];
  }
  return {{"whole", whole}, {"tail_values", laws.tail_values}, {"tail", tail}};
}

std::string parameters_of(const FittedLaw& law, std::size_t values) {
  if (law.law == SizeLaw::power) {
    return fmt::format("exponent {:.4g} +- {:.2g}", law.parameters[0],
                       law.parameters[0] / std::sqrt(static_cast<double>(values)));
  }
  if (law.cut > 0 && is_power_limit(law)) return "(runs away to its limit, the power law)";
  std::string text;
  const auto names = parameter_names(law.law);
  for (std::size_t k = 0; k < 2; ++k) {
    if (*names[k] != '\0') text += fmt::format("{} {:.4g}  ", names[k], law.parameters[k]);
  }
  return text;
}

std::string law_line(const FittedLaw& law, std::size_t values) {
  return fmt::format("  {:<12} {:<40} {:>9.4f} {:>9.4f}", name_of(law), parameters_of(law, values),
                     law.log_likelihood, law.distance);
}

std::string laws_text(const SampleLaws& laws, std::size_t count, std::string_view what,
                      std::string_view unit) {
  std::string text = fmt::format("  {:<53} {:>9} {:>9}\n", fmt::format("all {} {}", count, what),
                                 "ln L / n", "K-S");
  for (const FittedLaw& law : laws.whole) text += law_line(law, count) + "\n";
  if (laws.tail.empty()) return text;
  text +=
      fmt::format("  {}\n", fmt::format("the {} {} from {:.4g} {} on, where a power law fits best",
                                        laws.tail_values, what, laws.tail[0].cut, unit));
  for (std::size_t k = 0; k < laws.tail.size(); ++k) {
    text += law_line(laws.tail[k], laws.tail_values);
    if (k > 0) text += fmt::format("   power law against it {:+.1f}", laws.against[k - 1]);
    text += "\n";
  }
  return text;
}

/// Whether the tail is a power law's, in a sentence. Laws with the power law as their limit do not
/// count against it.
std::string verdict(const SampleLaws& laws) {
  if (laws.tail.empty()) return {};
  std::size_t nearest = 1;
  double worst = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k < laws.tail.size(); ++k) {
    if (is_power_limit(laws.tail[k]) || laws.against[k - 1] >= worst) continue;
    worst = laws.against[k - 1];
    nearest = k;
  }
  // 1.96 standard deviations: one chance in twenty.
  if (worst > 1.96) return "The tail is nearer to a power law than to the others.\n";
  if (worst >= -1.96)
    return "The sample does not separate the power law of the tail from the other laws.\n";
  return fmt::format("The tail is no power law: {} is nearer.\n", name_of(laws.tail[nearest]));
}

/// The pieces that are larger than any element.
std::string beyond_text(const FragmentSizes& s) {
  std::string text = fmt::format("{} larger than the largest element",
                                 counted(s.beyond_elements, "piece is", "pieces are"));
  if (!s.beyond) {
    return text + fmt::format(": too few (below {}) to show more than the mesh\n", fewest_for_fit);
  }
  return text + fmt::format("; their power law has the {}, K-S {:.3f}\n",
                            parameters_of(*s.beyond, s.beyond_elements), s.beyond->distance);
}

/// At most about 400 steps of the cumulative number, the largest values all.
std::string cumulative(std::span<const double> ascending, double scale) {
  std::string points;
  const std::size_t n = ascending.size(), stride = n / 300 + 1;
  for (std::size_t i = 0; i < n; i += i + 100 < n ? stride : 1) {
    if (i > 0 && ascending[i] == ascending[i - 1]) continue;
    points += fmt::format("{:.8g} {:.6g}\n", ascending[i], static_cast<double>(n - i) * scale);
  }
  return points;
}

std::string curve(const FittedLaw& law, double from, double to, double count) {
  std::string points;
  for (int k = 0; k <= 120; ++k) {
    const double x = from * std::pow(to / from, k / 120.0);
    const double number = count * survival(law, x);
    if (number > 0.3) points += fmt::format("{:.8g} {:.6g}\n", x, number);
  }
  return points;
}

}  // namespace

std::string fragments_text(const FragmentSizes& s) {
  const std::string_view unit = unit_of(s);
  const auto n = s.pieces.size();
  std::string text = fmt::format(
      "{}, {} to {:.4g} {}, median {:.4g}\n{} with {:.1f} % of "
      "the volume; the largest piece has {:.1f} %\n",
      counted(n, "piece"), fmt::format("{:.4g}", s.pieces.front()), s.pieces.back(), unit,
      s.pieces[n / 2],
      counted(s.single_tetrahedra, "of them a single tetrahedron", "of them single tetrahedra"),
      100 * s.single_part, 100 * s.largest_part);
  if (s.elements.empty()) {
    text += "The mesh's elements are not known: give --mesh, or run with frames.\n";
  } else {
    text += fmt::format(
        "{}, {:.4g} to {:.4g} {}, median {:.4g}\nDistance of all pieces from the "
        "elements {:.3f} (probability {:.2g} if they were the same), of single tetrahedra {:.3f} "
        "({:.2g})\n",
        counted(s.elements.size(), "element"), s.elements.front(), s.elements.back(), unit,
        s.elements[s.elements.size() / 2], s.from_elements.distance, s.from_elements.probability,
        s.singles_from_elements.distance, s.singles_from_elements.probability);
    text += beyond_text(s);
  }
  if (s.laws.whole.empty()) {
    return text +
           fmt::format("Too few pieces for a law: below {} a fit means nothing.\n", fewest_for_fit);
  }
  text += "\n";
  text += laws_text(s.laws, n, "pieces", unit) + verdict(s.laws);
  if (!s.elements.empty() && s.from_elements.probability > 0.05) {
    text += "The pieces are distributed as the elements are: these laws are the mesh's.\n";
  }
  if (!s.control.whole.empty()) {
    text += "\nControl: the same for the mesh\n";
    text += laws_text(s.control, s.elements.size(), "elements", unit);
  }
  return text;
}

ordered_json fragments_json(const FragmentSizes& s) {
  ordered_json json = {{"measure", size_measure_names[static_cast<std::size_t>(s.measure)]},
                       {"unit", unit_of(s)},
                       {"pieces", s.pieces.size()},
                       {"smallest", s.pieces.front()},
                       {"median", s.pieces[s.pieces.size() / 2]},
                       {"largest", s.pieces.back()},
                       {"single_tetrahedra", s.single_tetrahedra},
                       {"single_tetrahedra_part", s.single_part},
                       {"largest_part", s.largest_part},
                       {"fewest_for_fit", fewest_for_fit},
                       {"laws", laws_json(s.laws)},
                       {"elements", nullptr}};
  if (s.elements.empty()) return json;
  json["elements"] = {{"count", s.elements.size()},
                      {"smallest", s.elements.front()},
                      {"median", s.elements[s.elements.size() / 2]},
                      {"largest", s.elements.back()},
                      {"laws", laws_json(s.control)}};
  json["beyond_elements"] = {{"pieces", s.beyond_elements},
                             {"power_law", s.beyond ? law_json(*s.beyond) : ordered_json()}};
  const auto distance = [](const SampleDistance& d) {
    return ordered_json{{"distance", d.distance}, {"probability", d.probability}};
  };
  json["from_elements"] = {{"all", distance(s.from_elements)},
                           {"single_tetrahedra", distance(s.singles_from_elements)}};
  return json;
}

std::string fragments_script(const FragmentSizes& s, const std::string& title) {
  std::string quoted;
  for (const char c : title) quoted += c == '\'' ? std::string("''") : std::string(1, c);
  std::string curves, data;
  const auto add = [&](const std::string& points, const std::string& style) {
    if (points.empty()) return;
    curves += fmt::format("{}'-' {}", curves.empty() ? "plot " : ", \\\n  ", style);
    data += points + "e\n";
  };
  const auto n = static_cast<double>(s.pieces.size());
  if (!s.elements.empty()) {
    add(cumulative(s.elements, n / static_cast<double>(s.elements.size())),
        "with steps lc rgb '#999999' lw 2 title 'elements of the mesh, scaled to as many'");
  }
  add(cumulative(s.pieces, 1), "with points pt 7 ps 0.6 lc rgb '#1f77b4' title 'pieces'");
  constexpr std::array colors = {"#d62728", "#8c564b", "#2ca02c", "#9467bd"};
  for (const FittedLaw& law : s.laws.whole) {
    add(curve(law, s.pieces.front(), s.pieces.back(), n),
        fmt::format("with lines dt 2 lw 1.6 lc rgb '{}' title '{} of all'",
                    colors[static_cast<std::size_t>(law.law)], name_of(law)));
  }
  if (!s.laws.tail.empty()) {
    const FittedLaw& power = s.laws.tail[0];
    add(curve(power, power.cut, s.pieces.back(), static_cast<double>(s.laws.tail_values)),
        fmt::format("with lines lw 2.5 lc rgb '{}' title 'power law {:.2f} of the {} largest'",
                    colors[0], power.parameters[0], s.laws.tail_values));
  }
  return fmt::format(
      "set terminal pngcairo size 900,600 font 'DejaVu Sans,11'\n"
      "set title '{}' noenhanced\nset logscale xy\nset format '%.0e'\nset format y '%g'\n"
      "set xlabel '{} x of a piece, {}'\nset ylabel 'pieces of at least x'\n"
      "set yrange [0.7:{:.6g}]\nset bmargin 7.5\nset key below\n"
      "set grid lc rgb '#dddddd'\n{}\n{}",
      quoted, size_measure_names[static_cast<std::size_t>(s.measure)],
      unit_of(s) == "m^3" ? "m³" : unit_of(s), 1.5 * n, curves, data);
}

}  // namespace sunder
