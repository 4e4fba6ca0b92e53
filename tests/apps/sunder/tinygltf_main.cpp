// SPDX-License-Identifier: MIT
// Reads an exported run with TinyGLTF, which knows nothing of ours, and holds each piece's node
// against the rigid references of the run's frames: sunder_tinygltf RESULT FILE.glb
#include <fmt/format.h>
#include <tiny_gltf.h>

#include <Eigen/Geometry>

#include <cstdio>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/sunder/export/result_frames.hpp"

namespace {

using sunder::ResultFrame;
using sunder::RunResult;
using sunder::Vec3;

constexpr double allowed = 1e-6;  // m

void require(bool holds, const std::string& words) {
  if (!holds) throw std::runtime_error(words);
}

/// Rows of `width` floats that an accessor covers.
std::vector<std::vector<double>> rows_of(const tinygltf::Model& model, int accessor,
                                         std::size_t width) {
  const tinygltf::Accessor& a = model.accessors.at(static_cast<std::size_t>(accessor));
  require(a.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT, "an accessor holds no floats");
  const tinygltf::BufferView& view = model.bufferViews.at(static_cast<std::size_t>(a.bufferView));
  const auto stride = static_cast<std::size_t>(a.ByteStride(view));
  const unsigned char* bytes = model.buffers.at(static_cast<std::size_t>(view.buffer)).data.data() +
                               view.byteOffset + a.byteOffset;
  std::vector<std::vector<double>> rows(a.count, std::vector<double>(width));
  for (std::size_t k = 0; k < a.count; ++k) {
    for (std::size_t i = 0; i < width; ++i) {
      float value = 0;
      std::memcpy(&value, bytes + k * stride + i * sizeof value, sizeof value);
      rows[k][i] = static_cast<double>(value);
    }
  }
  return rows;
}

Eigen::Quaterniond rotation_of(const std::vector<double>& q) {
  return q.size() == 4 ? Eigen::Quaterniond(q[3], q[0], q[1], q[2])
                       : Eigen::Quaterniond::Identity();
}

/// The animation of a node, a row per key.
struct Track {
  std::vector<double> time;
  std::vector<std::vector<double>> centre, turn;
};

std::map<int, Track> tracks_of(const tinygltf::Model& model) {
  std::map<int, Track> tracks;
  require(model.animations.size() == 1, "there is not one animation");
  const tinygltf::Animation& animation = model.animations.front();
  for (const tinygltf::AnimationChannel& channel : animation.channels) {
    const auto& sampler = animation.samplers.at(static_cast<std::size_t>(channel.sampler));
    Track& track = tracks[channel.target_node];
    track.time.clear();
    for (const auto& row : rows_of(model, sampler.input, 1)) track.time.push_back(row[0]);
    const bool is_turn = channel.target_path == "rotation";
    (is_turn ? track.turn : track.centre) = rows_of(model, sampler.output, is_turn ? 4 : 3);
  }
  return tracks;
}

/// Corners (4 t + place) of a piece's tetrahedra in the last frame.
std::vector<std::size_t> corners_of(const ResultFrame& last, std::int64_t component) {
  std::vector<std::size_t> corners;
  for (std::size_t t = 0; t < last.component.size(); ++t) {
    if (last.component[t] != component) continue;
    for (std::size_t i = 0; i < 4; ++i) corners.push_back(4 * t + i);
  }
  return corners;
}

Vec3 reference_of(const ResultFrame& frame, std::size_t corner) {
  return frame.reference[frame.tetrahedra[corner / 4][corner % 4]];
}

/// Where a node's vertices are at one key, in the file's own y up turned back to z up.
std::vector<Vec3> placed(const std::vector<std::vector<double>>& vertices, const Track& track,
                         std::size_t key, const Eigen::Quaterniond& above) {
  const Eigen::Quaterniond turn = rotation_of(track.turn.at(key));
  const auto& c = track.centre.at(key);
  std::vector<Vec3> places;
  for (const auto& v : vertices) {
    const Vec3 y_up = above * (turn * Vec3(v[0], v[1], v[2]) + Vec3(c[0], c[1], c[2]));
    places.emplace_back(y_up.x(), -y_up.z(), y_up.y());
  }
  return places;
}

/// For each place the corner with the nearest rigid reference.
std::vector<std::size_t> nearest(const std::vector<Vec3>& places, const ResultFrame& frame,
                                 const std::vector<std::size_t>& corners) {
  std::vector<std::size_t> found;
  for (const Vec3& place : places) {
    const auto gap = [&](std::size_t corner) {
      return (reference_of(frame, corner) - place).norm();
    };
    std::size_t best = corners.front();
    for (const std::size_t corner : corners) {
      if (gap(corner) < gap(best)) best = corner;
    }
    found.push_back(best);
  }
  return found;
}

/// The largest distance of a node's vertices from the rigid references, over all frames.
double departure_of(const tinygltf::Model& model, const tinygltf::Node& node, const Track& track,
                    const Eigen::Quaterniond& above, const RunResult& run) {
  const std::int64_t component = std::stoll(node.name.substr(6));
  const std::vector<std::size_t> corners = corners_of(run.frames.back(), component);
  require(!corners.empty(), node.name + " is no piece of the last frame");
  require(node.extras.Get("mass").GetNumberAsDouble() == run.pieces.at(component).mass,
          node.name + " has another mass than in fragments.csv");
  const auto& mesh = model.meshes.at(static_cast<std::size_t>(node.mesh));
  const auto vertices = rows_of(model, mesh.primitives.front().attributes.at("POSITION"), 3);
  const std::size_t keys = run.frames.size();
  require(track.time.size() == keys && track.centre.size() == keys && track.turn.size() == keys,
          node.name + " has not a key a frame");
  const auto matched =
      nearest(placed(vertices, track, keys - 1, above), run.frames.back(), corners);
  double most = 0;
  for (std::size_t key = 0; key < keys; ++key) {
    const double time = run.frames[key].time - run.frames.front().time;
    require(std::abs(track.time[key] - time) < 1e-6, node.name + " has a key at another time");
    const std::vector<Vec3> places = placed(vertices, track, key, above);
    for (std::size_t i = 0; i < places.size(); ++i) {
      most = std::max(most, (places[i] - reference_of(run.frames[key], matched[i])).norm());
    }
  }
  return most;
}

void check(const std::string& result, const std::string& path) {
  const sunder::Result<RunResult> run = sunder::read_run_result(result);
  require(static_cast<bool>(run), result + " is no result of a run");
  tinygltf::Model model;
  tinygltf::TinyGLTF reader;
  std::string error, warning;
  const bool is_read = reader.LoadBinaryFromFile(&model, &error, &warning, path);
  require(is_read && error.empty() && warning.empty(), path + ": " + error + warning);
  const std::map<int, Track> tracks = tracks_of(model);
  const auto top = model.scenes.at(static_cast<std::size_t>(model.defaultScene)).nodes;
  require(top.size() == 1, "there is not one node above all");
  const tinygltf::Node& above = model.nodes.at(static_cast<std::size_t>(top.front()));
  std::size_t pieces = 0;
  double most = 0;
  for (const int row : above.children) {
    const tinygltf::Node& node = model.nodes.at(static_cast<std::size_t>(row));
    if (!node.name.starts_with("piece_")) continue;
    ++pieces;
    most = std::max(most,
                    departure_of(model, node, tracks.at(row), rotation_of(above.rotation), *run));
  }
  require(pieces == run->pieces.size(),
          fmt::format("{} pieces, fragments.csv has {}", pieces, run->pieces.size()));
  require(most <= allowed, fmt::format("a piece is {:.2e} m from its rigid reference", most));
  fmt::print(
      "{}: TinyGLTF reads {} pieces with {} keys, at most {:.1e} m from their rigid references\n",
      path, pieces, run->frames.size(), most);
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) return std::fprintf(stderr, "usage: sunder_tinygltf RESULT FILE.glb\n"), 2;
  try {
    check(arguments[1], arguments[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "sunder_tinygltf: %s\n", error.what());
    return 1;
  }
  return 0;
}
