// SPDX-License-Identifier: MIT
// Frames back from VTU, two columns of fragments.csv, obstacles.
#include "apps/sunder/export/result_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <variant>

#include "apps/scene/obstacles_json.hpp"
#include "apps/scene/scene_text.hpp"
#include "mechanics/contact/shapes/obstacle_geometry.hpp"
#include "topology/base/split_text.hpp"
#include "topology/base/whole_number.hpp"
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
    frames.push_back(
        {std::strtod(attribute(pvd, "timestep", at).c_str(), nullptr), attribute(pvd, "file", at)});
  }
  return frames;
}

const DataColumn* column_of(const std::vector<DataColumn>& columns, std::string_view name) {
  const auto found = std::ranges::find(columns, name, &DataColumn::name);
  return found == columns.end() ? nullptr : &*found;
}

Result<ResultFrame> read_frame(const std::filesystem::path& path, double time) {
  Result<FileMesh> mesh = read_file_mesh(path, {.simplices = true});
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
  frame.file = path;
  for (std::size_t v = 0; v < mesh->points.size(); ++v) {
    const Vec3 x(mesh->points[v][0], mesh->points[v][1], mesh->points[v][2]);
    frame.position.push_back(x);
    frame.reference.push_back(x - Vec3(u[3 * v], u[3 * v + 1], u[3 * v + 2]));
  }
  const DataColumn* move = column_of(mesh->point_data, "crack_move");
  if (move != nullptr && std::holds_alternative<std::vector<double>>(move->values)) {
    const auto& m = std::get<std::vector<double>>(move->values);
    for (std::size_t v = 0; v < m.size() / 3; ++v) {
      frame.crack_move.emplace_back(m[3 * v], m[3 * v + 1], m[3 * v + 2]);
    }
    if (frame.crack_move.size() != frame.position.size()) frame.crack_move.clear();
  }
  frame.tetrahedra = mesh->tetrahedra.corners;
  frame.component = std::get<std::vector<std::int64_t>>(component->values);
  result.value = std::move(frame);
  return result;
}

/// A table by the names in its first line; empty where there is none.
struct Table {
  std::vector<std::string_view> names;
  std::vector<std::vector<std::string_view>> rows;
  /// A column as numbers, NaN where a row has none; empty where it is not there.
  std::vector<double> column(std::string_view name) const {
    const auto place = static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
    std::vector<double> values;
    if (place == names.size()) return values;
    for (const std::vector<std::string_view>& row : rows) {
      const bool is_there = place < row.size() && !row[place].empty();
      values.push_back(is_there ? std::strtod(std::string(row[place]).c_str(), nullptr)
                                : std::numeric_limits<double>::quiet_NaN());
    }
    return values;
  }
};

/// The text of a file next to the frames. Runs of earlier versions may lack it: then it is empty.
/// A file that is there must be readable.
std::string text_of(const std::filesystem::path& path, std::vector<Finding>& findings) {
  std::ifstream in(path, std::ios::binary);
  std::error_code unknown;
  if (!in && std::filesystem::exists(path, unknown)) {
    findings.push_back(no_result(path, "cannot be read"));
  }
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Holds views of the text.
Table read_table(const std::string& text) {
  Table table;
  for (const std::string_view line : lines_of(text)) {
    (table.names.empty() ? table.names : table.rows.emplace_back()) = split_text(line, ',');
  }
  return table;
}

std::map<std::int64_t, ResultPiece> read_pieces(const std::string& text) {
  const Table table = read_table(text);
  const std::vector<double> component = table.column("component"), mass = table.column("mass"),
                            birth = table.column("birth_step");
  std::map<std::int64_t, ResultPiece> pieces;
  if (mass.size() != component.size() || birth.size() != component.size()) return pieces;
  for (std::size_t k = 0; k < component.size(); ++k) {
    if (std::isnan(component[k]) || std::isnan(mass[k])) continue;
    // Bodies as they began have no birth.
    pieces[whole_number<std::int64_t>(std::round(component[k]))] = {
        mass[k], whole_number<std::int64_t>(std::round(birth[k]))};
  }
  return pieces;
}

/// Where free obstacles were at moments, rows of obstacles.csv.
struct Places {
  std::vector<double> time, row;
  std::array<std::vector<double>, 7> pose;
  bool is_whole() const {
    const auto fits = [&](const std::vector<double>& column) {
      return column.size() == time.size() &&
             std::ranges::none_of(column, [](double x) { return std::isnan(x); });
    };
    return std::ranges::all_of(pose, fits) && fits(row);
  }
};

Places read_places(const std::string& text) {
  const Table table = read_table(text);
  Places places{table.column("time"), table.column("obstacle"), {}};
  constexpr const char* names[] = {"center_x",      "center_y",      "center_z",
                                   "orientation_w", "orientation_x", "orientation_y",
                                   "orientation_z"};
  for (std::size_t k = 0; k < 7; ++k) places.pose[k] = table.column(names[k]);
  return places;
}

/// Driven obstacles go on as they began, free ones are where the table has them.
std::vector<Obstacle> obstacles_at(double time, std::vector<Obstacle> obstacles,
                                   const Places& places) {
  for (Obstacle& o : obstacles) {
    if (!o.mass) translate(o.shape, time * o.velocity);
  }
  for (std::size_t k = 0; k < places.time.size(); ++k) {
    if (!(places.row[k] >= 0)) continue;  // no number
    const auto row = whole_number<std::size_t>(places.row[k]);
    if (row >= obstacles.size() || std::abs(places.time[k] - time) > 1e-9) continue;
    const auto& p = places.pose;
    put(obstacles[row].shape,
        {Vec3(p[0][k], p[1][k], p[2][k]), Eigen::Quaterniond(p[3][k], p[4][k], p[5][k], p[6][k])});
  }
  return obstacles;
}

/// Gravity and obstacles of report.json, which older runs do not have.
std::vector<Finding> add_world(RunResult& run, const std::filesystem::path& folder) {
  std::vector<Finding> unread;
  const std::string text = text_of(folder / "report.json", unread);
  const std::string moved = text_of(folder / "obstacles.csv", unread);
  if (!unread.empty()) return unread;
  const Result<SceneText> read = parse_scene_text(text, (folder / "report.json").string());
  if (!read) return read.findings;
  const nlohmann::json& report = read->root;
  if (!report.is_object() || !report.contains("obstacles") || !report.contains("gravity"))
    return {};
  Result<std::vector<Obstacle>> obstacles = read_obstacles(report["obstacles"]);
  if (!obstacles) return std::move(obstacles.findings);
  const std::vector<double> gravity = report["gravity"].get<std::vector<double>>();
  if (gravity.size() == 3) run.gravity = Vec3(gravity[0], gravity[1], gravity[2]);
  const Places places = read_places(moved);
  for (ResultFrame& frame : run.frames) {
    frame.obstacles = obstacles_at(frame.time, *obstacles, places.is_whole() ? places : Places{});
  }
  return {};
}

}  // namespace

std::array<std::uint32_t, 3> face_of(const std::array<std::uint32_t, 4>& t, int place) {
  constexpr int corners[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  const auto& c = corners[place];
  return {t[static_cast<std::size_t>(c[0])], t[static_cast<std::size_t>(c[1])],
          t[static_cast<std::size_t>(c[2])]};
}

std::vector<char> boundary_of(const ResultFrame& frame) {
  std::map<std::array<std::uint32_t, 3>, std::size_t> open;
  std::vector<char> is_boundary(4 * frame.tetrahedra.size(), 1);
  for (std::size_t f = 0; f < is_boundary.size(); ++f) {
    std::array<std::uint32_t, 3> key = face_of(frame.tetrahedra[f / 4], static_cast<int>(f % 4));
    std::ranges::sort(key);
    const auto [place, is_new] = open.try_emplace(key, f);
    if (is_new) continue;
    is_boundary[f] = is_boundary[place->second] = 0;
  }
  return is_boundary;
}

Result<RunResult> read_run_result(const std::filesystem::path& folder) {
  std::ifstream in(folder / "frames.pvd", std::ios::binary);
  if (!in) return no_result(folder / "frames.pvd", "is not there");
  const std::string pvd(std::istreambuf_iterator<char>(in), {});
  Result<RunResult> result;
  RunResult run;
  for (const NamedFrame& named : named_frames(pvd)) {
    const std::filesystem::path inside = std::filesystem::path(named.file).lexically_normal();
    if (inside.is_absolute() || inside.string().starts_with("..")) {
      return no_result(folder / "frames.pvd", "names a frame outside its folder");
    }
    Result<ResultFrame> frame = read_frame(folder / named.file, named.time);
    for (Finding& f : frame.findings) result.findings.push_back(std::move(f));
    if (!frame) return result;
    run.frames.push_back(std::move(*frame));
  }
  if (run.frames.empty()) return no_result(folder / "frames.pvd", "names no frame");
  run.pieces = read_pieces(text_of(folder / "fragments.csv", result.findings));
  for (Finding& f : add_world(run, folder)) result.findings.push_back(std::move(f));
  if (has_error(result.findings)) return result;
  result.value = std::move(run);
  return result;
}

}  // namespace sunder
