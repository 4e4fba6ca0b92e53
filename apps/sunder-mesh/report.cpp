// SPDX-License-Identifier: GPL-3.0-or-later
// Words and JSON for sunder-mesh's results.
#include "apps/sunder-mesh/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "topology/io/files/printing.hpp"

namespace sunder {
namespace {

std::array<Point, 2> bounds_of(const TetMesh& mesh) {
  std::array<Point, 2> b{mesh.points.front(), mesh.points.front()};
  for (const Point& p : mesh.points) {
    for (int k = 0; k < 3; ++k) {
      b[0][k] = std::min(b[0][k], p[k]);
      b[1][k] = std::max(b[1][k], p[k]);
    }
  }
  return b;
}

}  // namespace

std::string report_text(const TetMesh& mesh, const MeshQuality& quality) {
  const auto [low, high] = bounds_of(mesh);
  return fmt::format(
      "tetrahedra       {}\n"
      "vertices         {}\n"
      "components       {}\n"
      "bounding box     [{:.6g}, {:.6g}] x [{:.6g}, {:.6g}] x [{:.6g}, {:.6g}] m\n"
      "volume           {:.6g} m^3\n"
      "tetrahedra from  {:.4g} to {:.4g} m^3\n"
      "dihedral angles  {:.2f} to {:.2f} degrees\n",
      mesh.tetrahedra.size(), mesh.points.size(), quality.components, low[0], high[0], low[1],
      high[1], low[2], high[2], quality.volume, quality.least_volume, quality.largest_volume,
      quality.least_dihedral_angle, quality.largest_dihedral_angle);
}

std::string report_json(const TetMesh& mesh, const MeshQuality& quality) {
  const auto [low, high] = bounds_of(mesh);
  const nlohmann::ordered_json json{
      {"tetrahedra", mesh.tetrahedra.size()},
      {"vertices", mesh.points.size()},
      {"components", quality.components},
      {"bounding_box", {low, high}},
      {"volume", quality.volume},
      {"tetrahedron_volume", {quality.least_volume, quality.largest_volume}},
      {"dihedral_angle", {quality.least_dihedral_angle, quality.largest_dihedral_angle}}};
  return json_text(json) + "\n";
}

std::string finding_line(const Finding& finding) {
  std::string line;
  if (!finding.file.empty()) line += finding.file + ":";
  if (finding.line > 0) line += fmt::format("{}:", finding.line);
  if (!line.empty()) line += " ";
  line += fmt::format("{}: {}", to_string(finding.severity), finding.text);
  if (!finding.remedy.empty()) line += "; " + finding.remedy;
  return line + fmt::format(" [{}]\n", finding.code);
}

}  // namespace sunder
