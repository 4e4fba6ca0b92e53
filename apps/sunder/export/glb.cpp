// SPDX-License-Identifier: MIT
// Buffers, accessors and nodes of a GLB file.
#include "apps/sunder/export/glb.hpp"

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>

#include "apps/scene/json_text.hpp"

namespace sunder {
namespace {

// Numbers of the format.
constexpr int float_type = 5126, index_type = 5125;
constexpr int vertex_target = 34962, index_target = 34963;

template <class T>
void append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

class GlbWriter {
 public:
  nlohmann::json root = {{"asset", {{"version", "2.0"}, {"generator", "sunder"}}}};

  /// Appends floats as rows of `width`; gives the accessor. Bounds where they are asked for.
  std::size_t add_floats(const std::vector<float>& values, std::size_t width, bool has_bounds,
                         int target = 0) {
    const std::size_t view = add_view(values, target);
    constexpr const char* types[] = {"", "SCALAR", "", "VEC3", "VEC4"};
    nlohmann::json accessor = {{"bufferView", view},
                               {"componentType", float_type},
                               {"count", values.size() / width},
                               {"type", types[width]}};
    if (has_bounds) {
      std::vector<float> low(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(width));
      std::vector<float> high = low;
      for (std::size_t i = 0; i < values.size(); ++i) {
        low[i % width] = std::min(low[i % width], values[i]);
        high[i % width] = std::max(high[i % width], values[i]);
      }
      accessor["min"] = low;
      accessor["max"] = high;
    }
    return add("accessors", std::move(accessor));
  }

  std::size_t add_triangles(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    std::vector<std::uint32_t> rows;
    for (const auto& t : triangles) rows.insert(rows.end(), t.begin(), t.end());
    const std::size_t view = add_view(rows, index_target);
    return add("accessors", {{"bufferView", view},
                             {"componentType", index_type},
                             {"count", rows.size()},
                             {"type", "SCALAR"}});
  }

  std::size_t add(const char* list, nlohmann::json item) {
    nlohmann::json& items = root[list];
    if (items.is_null())
      items = nlohmann::json::array();  // a null cannot become one where memory runs out
    items.push_back(std::move(item));
    return items.size() - 1;
  }

  std::string bytes() {
    root["buffers"] = nlohmann::json::array({{{"byteLength", binary_.size()}}});
    std::string text = json_text(root, -1);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string file = "glTF";
    append(file, std::uint32_t{2});
    append(file, static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + binary_.size()));
    append(file, static_cast<std::uint32_t>(text.size()));
    file += "JSON" + text;
    append(file, static_cast<std::uint32_t>(binary_.size()));
    file += std::string("BIN\0", 4) + binary_;
    return file;
  }

 private:
  template <class T>
  std::size_t add_view(const std::vector<T>& values, int target) {
    nlohmann::json view = {
        {"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", values.size() * sizeof(T)}};
    if (target != 0) view["target"] = target;
    for (const T value : values) append(binary_, value);
    return add("bufferViews", std::move(view));
  }

  std::string binary_;
};

enum Material { outside, crack, obstacle };

/// The materials that a file has, each where it is used for the first time.
class Materials {
 public:
  std::size_t row(GlbWriter& glb, Material material) {
    constexpr const char* names[] = {"outside", "crack", "obstacle"};
    constexpr std::array<double, 4> colours[] = {
        {0.46, 0.42, 0.36, 1}, {0.58, 0.24, 0.1, 1}, {0.1, 0.15, 0.22, 1}};
    std::optional<std::size_t>& known = rows_[material];
    if (!known) {
      known = glb.add("materials", {{"name", names[material]},
                                    {"pbrMetallicRoughness",
                                     {{"baseColorFactor", colours[material]},
                                      {"metallicFactor", 0.0},
                                      {"roughnessFactor", 0.9}}}});
    }
    return *known;
  }

 private:
  std::array<std::optional<std::size_t>, 3> rows_;
};

std::size_t add_mesh(GlbWriter& glb, Materials& materials, const PieceTrack& track) {
  std::vector<float> place;
  for (const Vec3& x : track.vertex) {
    for (int i = 0; i < 3; ++i) place.push_back(static_cast<float>(x[i]));
  }
  const std::size_t position = glb.add_floats(place, 3, true, vertex_target);
  nlohmann::json primitives = nlohmann::json::array();
  for (const Material material : {outside, crack}) {
    const auto& triangles = material == outside ? track.outer : track.crack;
    if (triangles.empty()) continue;
    primitives.push_back(
        {{"attributes", {{"POSITION", position}}},
         {"indices", glb.add_triangles(triangles)},
         {"material", materials.row(glb, track.is_obstacle ? obstacle : material)}});
  }
  return glb.add("meshes", {{"name", track.name}, {"primitives", primitives}});
}

/// A unit quaternion in floats, normalised as such: rounding alone takes it off by more than
/// validators allow.
std::array<float, 4> in_floats(const Eigen::Quaterniond& q) {
  Eigen::Vector4f f = q.coeffs().cast<float>();
  f.normalize();
  return {f[0], f[1], f[2], f[3]};
}

struct Animation {
  std::size_t times = 0;
  nlohmann::json channels = nlohmann::json::array(), samplers = nlohmann::json::array();
};

void add_channel(Animation& animation, std::size_t node, const char* path, std::size_t output) {
  animation.channels.push_back(
      {{"sampler", animation.samplers.size()}, {"target", {{"node", node}, {"path", path}}}});
  animation.samplers.push_back(
      {{"input", animation.times}, {"interpolation", "LINEAR"}, {"output", output}});
}

void add_track(GlbWriter& glb, Animation& animation, const PieceTrack& track, std::size_t node) {
  std::vector<float> centres, turns;
  for (std::size_t k = 0; k < track.centre.size(); ++k) {
    for (int i = 0; i < 3; ++i) centres.push_back(static_cast<float>(track.centre[k][i]));
    const std::array<float, 4> q = in_floats(track.orientation[k]);
    turns.insert(turns.end(), q.begin(), q.end());
  }
  add_channel(animation, node, "translation", glb.add_floats(centres, 3, false));
  add_channel(animation, node, "rotation", glb.add_floats(turns, 4, false));
}

}  // namespace

std::string glb_bytes(const std::vector<PieceTrack>& tracks, const std::vector<double>& times,
                      const std::map<std::int64_t, ResultPiece>& pieces) {
  GlbWriter glb;
  Materials materials;
  std::vector<float> seconds;
  for (const double t : times) seconds.push_back(static_cast<float>(t - times.front()));
  Animation animation;
  if (times.size() > 1) animation.times = glb.add_floats(seconds, 1, true);
  nlohmann::json children = nlohmann::json::array();
  for (const PieceTrack& track : tracks) {
    const Vec3& c = track.centre.front();
    nlohmann::json node = {{"name", track.name},
                           {"mesh", add_mesh(glb, materials, track)},
                           {"translation", {c[0], c[1], c[2]}},
                           {"rotation", in_floats(track.orientation.front())}};
    const auto piece = track.is_obstacle ? pieces.end() : pieces.find(track.component);
    if (piece != pieces.end()) {
      node["extras"] = {{"mass", piece->second.mass}, {"birth_step", piece->second.birth_step}};
    }
    const std::size_t row = glb.add("nodes", std::move(node));
    children.push_back(row);
    if (times.size() > 1) add_track(glb, animation, track, row);
  }
  constexpr double half = 0.70710678118654752;
  const std::size_t top = glb.add(
      "nodes", {{"name", "z_up"}, {"rotation", {-half, 0, 0, half}}, {"children", children}});
  glb.root["scenes"] = nlohmann::json::array({{{"nodes", {top}}}});
  glb.root["scene"] = 0;
  if (times.size() > 1) {
    glb.root["animations"] = nlohmann::json::array({{{"name", "breaking"},
                                                     {"channels", animation.channels},
                                                     {"samplers", animation.samplers}}});
  }
  return glb.bytes();
}

}  // namespace sunder
