// SPDX-License-Identifier: MIT
// Lines of the event log and the checks at their ends.
#include "apps/sunder/run/event_log.hpp"

#include <array>
#include <sunder/version.hpp>
#include <utility>

#include "apps/scene/json_text.hpp"
#include "apps/scene/scene_hash.hpp"

namespace sunder {
namespace {

using nlohmann::ordered_json;

ordered_json numbers(const Vec3& v) { return {v[0], v[1], v[2]}; }

ordered_json face_of(const FaceSplit& split, const VolumeMap& map) {
  ordered_json points = ordered_json::array(), copies = ordered_json::array(),
               edges = ordered_json::array();
  for (const VertexId v : corners_of_face(map.corners(tetrahedron_of(split.face)), split.face)) {
    points.push_back(map.point_of_vertex(v));
  }
  for (int i = 0; i < split.vertex_count; ++i) {
    const VertexCopy& copy = split.split_vertices[static_cast<std::size_t>(i)];
    copies.push_back({copy.old_row.value, copy.new_row.value});
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (split.split_edges >> i & 1) edges.push_back({points[i], points[(i + 1) % 3]});
  }
  return {{"points", points},
          {"split_vertices", copies},
          {"split_edges", edges},
          {"oracle", oracle_says_new(split)}};
}

ordered_json created_by(const ComponentUpdate& components) {
  ordered_json created = ordered_json::array();
  for (std::size_t i = 0; i < components.created; ++i) {
    created.push_back(components.first_new.value + i);
  }
  return created;
}

/// Tetrahedra that the crack decided on with a fan, on one of its sides.
ordered_json labelled(const FanEvent& event, bool positive) {
  ordered_json rows = ordered_json::array();
  for (const CrackLabel& label : event.labels) {
    if (label.positive == positive) rows.push_back(label.tetrahedron.value);
  }
  return rows;
}

}  // namespace

std::string_view to_string(RunEnd end) {
  constexpr std::array<std::string_view, 4> ends = {"finished", "interrupted", "failed", "running"};
  return ends[static_cast<std::size_t>(end)];
}

ordered_json parse_line(std::string_view text) {
  constexpr int most = 64;
  bool is_too_deep = false;
  const auto watch = [&](int depth, ordered_json::parse_event_t, ordered_json&) {
    is_too_deep = is_too_deep || depth > most;
    return !is_too_deep;
  };
  ordered_json line = ordered_json::parse(text, watch, false);
  return is_too_deep ? ordered_json(ordered_json::value_t::discarded) : line;
}

ordered_json event_of(const FanEvent& event, const EventTime& when, const VolumeMap& map) {
  ordered_json faces = ordered_json::array();
  for (const FaceSplit& split : event.faces) faces.push_back(face_of(split, map));
  ordered_json line = {{"fan", when.number},
                       {"step", when.step},
                       {"part", when.part},
                       {"round", event.round},
                       {"time", when.time},
                       {"vertex", event.vertex.value},
                       {"point", event.point},
                       {"rest_position", numbers(event.rest_position)},
                       {"normal", numbers(event.normal)},
                       {"stress", event.stress},
                       {"strength", event.strength},
                       {"faces", faces},
                       {"oracle", event.components.predicted},
                       {"new_components", created_by(event.components)}};
  if (!event.crack.is_none()) {
    line["crack"] = event.crack.value;
    line["anchor"] = numbers(event.anchor);
    line["positive"] = labelled(event, true);
    line["negative"] = labelled(event, false);
  }
  return line;
}

ordered_json event_of(const TieRelease& release, const EventTime& when, const VolumeMap& map) {
  ordered_json faces = ordered_json::array();
  for (std::size_t k = 0; k < release.faces.size(); ++k) {
    const Tie& tie = release.ties[k];
    faces.push_back(face_of(release.faces[k], map));
    faces.back()["crack"] = tie.crack.value;
    faces.back()["projected_area"] = area_of(tie);
    faces.back()["energy"] = taken_by(tie);
  }
  return {{"release", when.number},
          {"step", when.step},
          {"part", when.part},
          {"time", when.time},
          {"faces", faces},
          {"oracle", release.components.predicted},
          {"new_components", created_by(release.components)}};
}

std::vector<ordered_json> events_of(const StepReport& report, std::uint64_t fans,
                                    std::uint64_t releases, const VolumeMap& map) {
  std::vector<ordered_json> lines;
  auto release = report.releases.begin();
  const auto add_releases = [&](std::uint32_t up_to) {
    for (; release != report.releases.end() && release->part <= up_to; ++release) {
      lines.push_back(
          event_of(*release, {releases++, report.step, release->part, release->time}, map));
    }
  };
  for (std::size_t k = 0; k < report.fracture.fans.size(); ++k) {
    add_releases(report.fan_part[k]);
    lines.push_back(event_of(report.fracture.fans[k],
                             {fans++, report.step, report.fan_part[k], report.fan_time[k]}, map));
  }
  add_releases(report.parts);
  return lines;
}

ordered_json event_log_head(const SceneFile& file, const std::string& hash) {
  return {{"log", "sunder events"},
          {"format", event_log_format},
          {"sunder", SUNDER_VERSION},
          {"scene", file.scene.name},
          {"scene_hash", hash}};
}

std::string line_check(std::string_view line, std::string_view before) {
  Fnv1a hash;
  hash.add(before);
  hash.add(line);
  return hex_digits(hash.value);
}

EventLog::EventLog(const ordered_json& head, std::string hash) {
  add(head);
  check_ = std::move(hash);
}

EventLog::EventLog(const SceneFile& file)
    : EventLog(event_log_head(file, scene_hash(file)), scene_hash(file)) {}

void EventLog::add(const ordered_json& line) { add_line(json_text(line, -1)); }

std::optional<EventLog> EventLog::of(const SceneFile& file, std::string_view text,
                                     std::optional<std::uint64_t> branched_at) {
  std::optional<EventLog> log;
  std::string before;  // the check before a line, as it was written
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    if (end == text.npos || end < check_length) return std::nullopt;
    std::string line = std::string(text.substr(0, end - check_length)) + "}";
    const std::string check(text.substr(end - 18, 16));
    if (line_check(line, before) != check) return std::nullopt;
    text.remove_prefix(end + 1);
    before = check;
    if (log) {
      log->add_line(std::move(line));
      continue;
    }
    ordered_json head = parse_line(line);
    if (!head.is_object() || !head.value("scene_hash", ordered_json()).is_string()) {
      return std::nullopt;
    }
    before = head["scene_hash"].get<std::string>();
    const std::string hash = scene_hash(file);
    head["scene_hash"] = hash;
    if (branched_at) head["branched_at"] = *branched_at;
    log = EventLog(head, hash);
  }
  return log;
}

void EventLog::add_line(std::string text) {
  check_ = line_check(text, check_);
  text.insert(text.size() - 1, ",\"check\":\"" + check_ + "\"");
  text_ += text + "\n";
}

}  // namespace sunder
