// SPDX-License-Identifier: MIT
// The table of fragments read back, and the figures and laws of its sizes.
#include "apps/sunder/fragments/fragment_sizes.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <numeric>
#include <string>

#include "topology/base/counted.hpp"
#include "topology/base/split_text.hpp"
#include "topology/io/mesh_file.hpp"

namespace sunder {
namespace {

std::optional<double> positive_number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value > 0 && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

Finding bad_table(const std::filesystem::path& csv, std::size_t line, std::string text) {
  return {.code = "bad_table",
          .text = std::move(text),
          .remedy = "give the folder of a run, or its fragments.csv as the run wrote it",
          .file = csv.string(),
          .line = line};
}

struct WantedColumn {
  std::string_view name;
  std::vector<double>& values;
  std::size_t place = 0;
};

double in_measure(double volume, SizeMeasure measure, double density) {
  switch (measure) {
    case SizeMeasure::volume:
      return volume;
    case SizeMeasure::size:
      return std::cbrt(volume);
    case SizeMeasure::mass:
      return volume * density;
  }
  return volume;
}

double sum_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

Result<PieceColumns> read_fragments(const std::filesystem::path& csv) {
  std::ifstream in(csv, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::vector<std::string_view> lines = lines_of(text);
  if (lines.empty()) {
    return Finding{.code = "cannot_open",
                   .text = fmt::format("cannot read the table of fragments {}", csv.string()),
                   .remedy = "give the folder that `sunder run` wrote",
                   .file = csv.string()};
  }
  PieceColumns pieces;
  std::array<WantedColumn, 3> columns = {
      {{"mass", pieces.mass}, {"volume", pieces.volume}, {"tetrahedra", pieces.tetrahedra}}};
  const std::vector<std::string_view> header = split_text(lines[0], ',');
  for (WantedColumn& column : columns) {
    const auto found = std::ranges::find(header, column.name);
    if (found == header.end()) {
      return bad_table(csv, 1, fmt::format("has no column {}", column.name));
    }
    column.place = static_cast<std::size_t>(found - header.begin());
  }
  const std::size_t width = header.size();
  for (std::size_t row = 2; row <= lines.size(); ++row) {
    const std::vector<std::string_view> cells = split_text(lines[row - 1], ',');
    if (cells.size() != width) {
      return bad_table(csv, row,
                       fmt::format("has {}, not {}", counted(cells.size(), "cell"), width));
    }
    for (WantedColumn& column : columns) {
      const std::optional<double> value = positive_number(cells[column.place]);
      if (!value) {
        return bad_table(
            csv, row,
            fmt::format("{} is \"{}\", not a number above 0", column.name, cells[column.place]));
      }
      column.values.push_back(*value);
    }
  }
  if (pieces.mass.empty()) return bad_table(csv, 1, "has no pieces");
  return pieces;
}

Result<std::vector<double>> element_volumes(std::span<const std::filesystem::path> meshes) {
  Result<std::vector<double>> result;
  std::vector<double> volumes;
  for (const std::filesystem::path& path : meshes) {
    Result<TetMesh> mesh = read_mesh(path);
    for (Finding& f : mesh.findings) {
      if (f.severity == Severity::error) result.findings.push_back(std::move(f));
    }
    if (!mesh) continue;
    for (const auto& t : mesh->tetrahedra) {
      const auto edge = [&](std::size_t corner) -> Eigen::Vector3d {
        return Eigen::Map<const Eigen::Vector3d>(mesh->points[t[corner]].data()) -
               Eigen::Map<const Eigen::Vector3d>(mesh->points[t[0]].data());
      };
      volumes.push_back(std::abs(edge(1).cross(edge(2)).dot(edge(3))) / 6);
    }
  }
  if (!has_error(result.findings)) result.value = std::move(volumes);
  return result;
}

SampleLaws fit_laws(std::span<const double> ascending) {
  SampleLaws laws;
  if (ascending.size() < fewest_for_fit || ascending.front() == ascending.back()) return laws;
  constexpr std::array others = {SizeLaw::exponential, SizeLaw::weibull, SizeLaw::lognormal};
  for (const SizeLaw law : others) laws.whole.push_back(fit_law(law, ascending, 0));
  const std::optional<FittedLaw> power = fit_power_tail(ascending);
  if (!power) return laws;
  const auto first = std::ranges::lower_bound(ascending, power->cut);
  const std::span<const double> tail(first, ascending.end());
  laws.tail_values = tail.size();
  laws.tail.push_back(*power);
  for (const SizeLaw law : others) {
    laws.tail.push_back(fit_law(law, tail, power->cut));
    laws.against.push_back(vuong(*power, laws.tail.back(), tail));
  }
  return laws;
}

FragmentSizes measure_fragments(const PieceColumns& pieces, std::span<const double> elements,
                                SizeMeasure measure) {
  FragmentSizes result{.measure = measure};
  const double volume = sum_of(pieces.volume);
  const double density = sum_of(pieces.mass) / volume;
  std::vector<double> singles;
  for (std::size_t row = 0; row < pieces.volume.size(); ++row) {
    const double size = measure == SizeMeasure::mass
                            ? pieces.mass[row]
                            : in_measure(pieces.volume[row], measure, density);
    result.pieces.push_back(size);
    if (pieces.tetrahedra[row] > 1) continue;
    singles.push_back(size);
    result.single_part += pieces.volume[row] / volume;
  }
  result.single_tetrahedra = singles.size();
  result.largest_part = std::ranges::max(pieces.volume) / volume;
  for (const double element : elements) {
    result.elements.push_back(in_measure(element, measure, density));
  }
  for (std::vector<double>* sample : {&result.pieces, &result.elements, &singles}) {
    std::ranges::sort(*sample);
  }
  result.laws = fit_laws(result.pieces);
  result.control = fit_laws(result.elements);
  if (!result.elements.empty()) {
    const auto first = std::ranges::upper_bound(result.pieces, result.elements.back());
    const std::span<const double> beyond(first, result.pieces.end());
    result.beyond_elements = beyond.size();
    if (beyond.size() >= fewest_for_fit && beyond.front() < beyond.back()) {
      result.beyond = fit_law(SizeLaw::power, beyond, result.elements.back());
    }
  }
  result.from_elements = sample_distance(result.pieces, result.elements);
  result.singles_from_elements = sample_distance(singles, result.elements);
  return result;
}

}  // namespace sunder
