// SPDX-License-Identifier: MIT
// Frames back from VTU, and two columns of fragments.csv.
#include "apps/sunder/export/result_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <variant>

#include "topology/io/mesh_file.hpp"

namespace sunder {
namespace {

Finding no_result(const std::filesystem::path& path, std::string_view what) {
  return {.code = "no_result",
          .text = fmt::format("{} {}", path.string(), what),
          .remedy = "name the folder of a run: sunder run SCENE -o FOLDER, with frames",
          .file = path.string()};
}

/// The value of `key="..."` from `at` on; empty where there is none.
std::string attribute(const std::string& text, const std::string& key, std::size_t at) {
  const std::size_t begin = text.find(key + "=\"", at);
  if (begin == std::string::npos) return {};
  const std::size_t first = begin + key.size() + 2;
  return text.substr(first, text.find('"', first) - first);
}

struct NamedFrame {
  double time = 0;
  std::string file;
};

std::vector<NamedFrame> named_frames(const std::string& pvd) {
  std::vector<NamedFrame> frames;
  for (std::size_t at = pvd.find("<DataSet"); at != std::string::npos;
       at = pvd.find("<DataSet", at + 1)) {
    frames.push_back({std::strtod(attribute(pvd, "timestep", at).c_str(), nullptr),
                      attribute(pvd, "file", at)});
  }
  return frames;
}

const DataColumn* column_of(const std::vector<DataColumn>& columns, std::string_view name) {
  const auto found = std::ranges::find(columns, name, &DataColumn::name);
  return found == columns.end() ? nullptr : &*found;
}

Result<ResultFrame> read_frame(const std::filesystem::path& path, double time) {
  Result<FileMesh> mesh = read_file_mesh(path);
  Result<ResultFrame> result;
  result.findings = mesh.findings;
  if (!mesh) return result;
  const DataColumn* displacement = column_of(mesh->point_data, "displacement");
  const DataColumn* component = column_of(mesh->tetrahedra.data, "component");
  if (displacement == nullptr || component == nullptr ||
      !std::holds_alternative<std::vector<double>>(displacement->values) ||
      !std::holds_alternative<std::vector<std::int64_t>>(component->values)) {
    return no_result(path, "has no displacement and component: it is no frame of a run");
  }
  const auto& u = std::get<std::vector<double>>(displacement->values);
  ResultFrame frame;
  frame.time = time;
  for (std::size_t v = 0; v < mesh->points.size(); ++v) {
    const Vec3 x(mesh->points[v][0], mesh->points[v][1], mesh->points[v][2]);
    frame.position.push_back(x);
    frame.reference.push_back(x - Vec3(u[3 * v], u[3 * v + 1], u[3 * v + 2]));
  }
  frame.tetrahedra = mesh->tetrahedra.corners;
  frame.component = std::get<std::vector<std::int64_t>>(component->values);
  result.value = std::move(frame);
  return result;
}

std::vector<std::string> split_line(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

std::map<std::int64_t, ResultPiece> read_pieces(const std::filesystem::path& path) {
  std::map<std::int64_t, ResultPiece> pieces;
  std::ifstream in(path);
  std::string line;
  if (!std::getline(in, line)) return pieces;
  const std::vector<std::string> names = split_line(line);
  const auto place = [&](std::string_view name) {
    return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
  };
  const std::size_t component = place("component"), mass = place("mass"),
                    birth = place("birth_step");
  while (std::getline(in, line)) {
    const std::vector<std::string> cells = split_line(line);
    if (component >= cells.size() || mass >= cells.size() || birth >= cells.size()) continue;
    pieces[std::atoll(cells[component].c_str())] = {std::strtod(cells[mass].c_str(), nullptr),
                                                    std::atoll(cells[birth].c_str())};
  }
  return pieces;
}

}  // namespace

Result<RunResult> read_run_result(const std::filesystem::path& folder) {
  std::ifstream in(folder / "frames.pvd", std::ios::binary);
  if (!in) return no_result(folder / "frames.pvd", "is not there");
  const std::string pvd(std::istreambuf_iterator<char>(in), {});
  Result<RunResult> result;
  RunResult run;
  for (const NamedFrame& named : named_frames(pvd)) {
    Result<ResultFrame> frame = read_frame(folder / named.file, named.time);
    for (Finding& f : frame.findings) result.findings.push_back(std::move(f));
    if (!frame) return result;
    run.frames.push_back(std::move(*frame));
  }
  if (run.frames.empty()) return no_result(folder / "frames.pvd", "names no frame");
  run.pieces = read_pieces(folder / "fragments.csv");
  result.value = std::move(run);
  return result;
}

}  // namespace sunder
