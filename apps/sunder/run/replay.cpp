// SPDX-License-Identifier: MIT
// Reading an event log: every line held to its check, then to its place, then to its keys.
#include "apps/sunder/run/replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sunder/version.hpp>

#include "apps/scene/scene_text.hpp"
#include "apps/sunder/run/report/counters_json.hpp"
#include "topology/base/counted.hpp"

namespace sunder {
namespace {

using nlohmann::ordered_json;

constexpr const char* mend = "replay the log as the run wrote it; edited logs are refused";

/// A log while it is read.
struct LogReader {
  const ReplayedScene& scene;
  Replay replay = {};
  std::string check = {};  ///< of the line before
  std::size_t line = 0;    ///< from 1
  SearchPlace place = {};  ///< of the last fan or release
  bool ended = false;      ///< the last line has been read
  std::vector<Finding> findings = {};

  bool refuse(const char* code, std::string text, const char* remedy = mend) {
    findings.push_back({.code = code,
                        .text = std::move(text),
                        .remedy = remedy,
                        .file = replay.file,
                        .line = line});
    return false;
  }
};

bool is_count(const ordered_json& object, const char* key) {
  const auto value = object.find(key);
  return value != object.end() && value->is_number_unsigned();
}

/// Whether the line's check is that of its text after the line before it.
bool holds_check(LogReader& reader, std::string_view text) {
  constexpr std::string_view before = ",\"check\":\"";
  const std::size_t body = text.size() < check_length ? 0 : text.size() - check_length;
  if (body == 0 || text.substr(body, before.size()) != before) {
    return reader.refuse("bad_event_log", "has no check at its end");
  }
  const std::string check = line_check(std::string(text.substr(0, body)) + "}", reader.check);
  if (text.substr(body + before.size(), check.size()) != check) {
    return reader.refuse("bad_event_log",
                         "was changed after it was written, or a line before it: its check is not "
                         "that of the text");
  }
  reader.check = check;
  return true;
}

bool read_head(LogReader& reader, const ordered_json& head, std::string_view text) {
  if (head.value("log", ordered_json()) != "sunder events" || !is_count(head, "format")) {
    return reader.refuse("other_log_format", "is not the head of an event log",
                         "give the events.jsonl of a run; logs of formats before 2 have no head "
                         "and cannot be replayed");
  }
  if (head["format"] != event_log_format) {
    return reader.refuse("other_log_format",
                         fmt::format("says format {}; this program reads {}", head["format"].dump(),
                                     event_log_format),
                         "replay it with the program that wrote it (`sunder` in its first line)");
  }
  if (!holds_check(reader, text)) return false;
  if (const ordered_json theirs = head.value("scene_hash", ordered_json());
      theirs != reader.scene.hash) {
    return reader.refuse(
        "other_scene",
        fmt::format("is of a scene with the hash {}; this one has \"{}\"", theirs.dump(),
                    reader.scene.hash),
        "give the scene and the --set changes that the run had; a changed mesh is another scene");
  }
  if (const ordered_json theirs = head.value("sunder", ordered_json()); theirs != SUNDER_VERSION) {
    reader.refuse(
        "other_program",
        fmt::format("is by sunder {}; this is " SUNDER_VERSION ", whose run may depart from it",
                    theirs.dump()),
        "if it departs, replay it with the version that wrote it");
    reader.findings.back().severity = Severity::warning;
  }
  if (head.contains("branched_at")) {
    return reader.refuse(
        "branched_log",
        fmt::format("is of a run whose settings changed after step {}: no scene describes it from "
                    "its start",
                    head["branched_at"].dump()),
        "replay the log of the run that it branched from");
  }
  reader.check = reader.scene.hash;
  return true;
}

bool is_vector(const ordered_json& fan, const char* key) {
  const auto vector = fan.find(key);
  return vector != fan.end() && vector->is_array() && vector->size() == 3 &&
         std::ranges::all_of(*vector, [](const auto& x) { return x.is_number(); });
}

Vec3 vector_of(const ordered_json& numbers) {
  return {numbers[0].get<double>(), numbers[1].get<double>(), numbers[2].get<double>()};
}

/// The fault in the keys of a fan; empty where there is none.
std::string misfit(const ordered_json& fan) {
  for (const char* key : {"fan", "step", "part", "round", "vertex"}) {
    if (!is_count(fan, key)) return fmt::format("has no whole number \"{}\"", key);
  }
  for (const char* key : {"part", "round", "vertex"}) {
    if (fan[key] > ordered_json(0xfffffffeu)) return fmt::format("has too large a \"{}\"", key);
  }
  if (!is_vector(fan, "normal")) return "has no normal of three numbers";
  if (fan.contains("crack")) {
    if (!is_count(fan, "crack") || fan["crack"] > ordered_json(0xfffffffeu)) {
      return "has a crack that is no row";
    }
    if (!is_vector(fan, "anchor")) return "has no anchor of three numbers";
    for (const char* side : {"positive", "negative"}) {
      const auto rows = fan.find(side);
      const bool are_rows =
          rows != fan.end() && rows->is_array() && std::ranges::all_of(*rows, [](const auto& t) {
            return t.is_number_unsigned() && t <= ordered_json(0xfffffffeu);
          });
      if (!are_rows) return fmt::format("has no list of tetrahedra \"{}\"", side);
    }
  }
  const auto stress = fan.find("stress");
  if (stress == fan.end() || !stress->is_number()) return "has no stress";
  return {};
}

bool comes_next(LogReader& reader, SearchPlace place) {
  if (place < reader.place) {
    return reader.refuse("bad_event_log", "comes before what is in the line above it");
  }
  reader.place = place;
  return true;
}

bool read_fan(LogReader& reader, const ordered_json& fan, std::string_view text) {
  FanScript& script = reader.replay.script;
  if (const std::string wrong = misfit(fan); !wrong.empty()) {
    return reader.refuse("bad_event_log", wrong);
  }
  if (fan["fan"] != script.fans.size()) {
    return reader.refuse("bad_event_log",
                         fmt::format("is fan {} where fan {} is due: a line is missing or there "
                                     "twice",
                                     fan["fan"].dump(), script.fans.size()));
  }
  if (!holds_check(reader, text)) return false;
  ScriptedFan wanted{{fan["step"].get<std::uint64_t>(), fan["part"].get<std::uint32_t>()},
                     fan["round"].get<std::uint32_t>(),
                     VertexId{fan["vertex"].get<std::uint32_t>()}};
  wanted.normal = vector_of(fan["normal"]);
  wanted.stress = fan["stress"].get<double>();
  if (is_count(fan, "crack")) {
    wanted.crack = CrackId{fan["crack"].get<std::uint32_t>()};
    wanted.anchor = vector_of(fan["anchor"]);
    for (const bool positive : {true, false}) {
      for (const ordered_json& t : fan[positive ? "positive" : "negative"]) {
        wanted.labels.push_back({wanted.crack, TetId{t.get<std::uint32_t>()}, positive});
      }
    }
  }
  const auto strength = fan.find("strength");
  if (strength != fan.end() && strength->is_number()) wanted.strength = strength->get<double>();
  if (!comes_next(reader, wanted.place)) return false;
  script.fans.push_back(wanted);
  reader.replay.line_of_fan.push_back(reader.line);
  return true;
}

/// A replay finds releases out by itself: here a line has only to be in its place.
bool read_release(LogReader& reader, const ordered_json& release, std::string_view text) {
  for (const char* key : {"release", "step", "part"}) {
    if (is_count(release, key)) continue;
    return reader.refuse("bad_event_log", fmt::format("has no whole number \"{}\"", key));
  }
  if (release["part"] > ordered_json(0xfffffffeu)) {
    return reader.refuse("bad_event_log", "has too large a \"part\"");
  }
  if (release["release"] != reader.replay.releases) {
    return reader.refuse("bad_event_log",
                         fmt::format("is release {} where release {} is due: a line is missing or "
                                     "there twice",
                                     release["release"].dump(), reader.replay.releases));
  }
  if (!holds_check(reader, text)) return false;
  ++reader.replay.releases;
  return comes_next(reader,
                    {release["step"].get<std::uint64_t>(), release["part"].get<std::uint32_t>()});
}

bool read_end(LogReader& reader, const ordered_json& end, std::string_view text) {
  Replay& replay = reader.replay;
  if (!is_count(end, "fans") || !is_count(end, "releases") || !is_count(end, "steps") ||
      !end["end"].is_string()) {
    return reader.refuse("bad_event_log", "is neither a fan, a release nor the end of a log");
  }
  if (end["fans"] != replay.script.fans.size()) {
    return reader.refuse("bad_event_log",
                         fmt::format("says fans {}, and there are {}: lines are missing",
                                     end["fans"].dump(), replay.script.fans.size()));
  }
  if (end["releases"] != replay.releases) {
    return reader.refuse("bad_event_log",
                         fmt::format("says releases {}, and there are {}: lines are missing",
                                     end["releases"].dump(), replay.releases));
  }
  if (!holds_check(reader, text)) return false;
  const auto word = end["end"].get<std::string>();
  bool known = false;
  for (const RunEnd e : {RunEnd::finished, RunEnd::interrupted, RunEnd::failed}) {
    if (word != to_string(e)) continue;
    replay.end = e;
    known = true;
  }
  SearchCounts unused;
  replay.counts = end.value("search", ordered_json());
  if (!known || !read_counters(unused, replay.counts)) {
    return reader.refuse("bad_event_log", "is not the end of a log");
  }
  replay.steps = end["steps"].get<std::uint64_t>();
  const std::uint64_t all = reader.scene.steps;
  if (replay.steps > all || (replay.end == RunEnd::finished && replay.steps < all)) {
    return reader.refuse("bad_event_log", fmt::format("says {} after {}; the scene has {}", word,
                                                      counted(replay.steps, "step"), all));
  }
  reader.ended = true;
  return true;
}

bool read_line(LogReader& reader, std::string_view text) {
  if (reader.ended) return reader.refuse("bad_event_log", "stands after the end of the log");
  const ordered_json line = parse_line(text);
  if (!line.is_object()) {
    return reader.refuse("bad_event_log",
                         "is not a JSON object; the file was cut off or is no event log");
  }
  if (reader.line == 1) return read_head(reader, line, text);
  if (line.contains("release")) return read_release(reader, line, text);
  return line.contains("end") ? read_end(reader, line, text) : read_fan(reader, line, text);
}

/// The line of `text` that begins at `begin`, without its end.
std::string_view line_at(std::string_view text, std::size_t begin) {
  return text.substr(begin, text.find('\n', begin) - begin);
}

/// Which key of two lines differs, and how.
std::string first_difference(std::string_view theirs, std::string_view ours) {
  const ordered_json a = parse_line(theirs);
  const ordered_json b = parse_line(ours);
  for (const auto& [key, value] : a.items()) {
    const ordered_json here = b.value(key, ordered_json());
    if (value.dump() == here.dump()) continue;
    return fmt::format("{} is {} in the log and {} in the replay", key,
                       shown(nlohmann::json(value)), shown(nlohmann::json(here)));
  }
  return "is not what the replay writes, byte by byte";
}

Finding departed(const Replay& replay, std::size_t line, std::string text) {
  return {.code = "replay_departed",
          .text = std::move(text),
          .remedy =
              "the log was written by another program, on another scene, or edited; the "
              "files of this run hold the part that was the same",
          .file = replay.file,
          .line = line};
}

}  // namespace

Result<Replay> read_replay(const std::filesystem::path& path, const ReplayedScene& scene) {
  std::ifstream in(path, std::ios::binary);
  std::error_code not_a_folder;
  if (!in || std::filesystem::is_directory(path, not_a_folder)) {
    return Finding{.code = "cannot_open",
                   .text = fmt::format("cannot open the event log {}", path.string()),
                   .remedy = "give the events.jsonl of an earlier run",
                   .file = path.string()};
  }
  const std::string bytes(std::istreambuf_iterator<char>(in), {});
  LogReader reader{scene};
  reader.replay.file = path.string();
  bool fine = true;
  for (std::size_t begin = 0; fine && begin < bytes.size();) {
    const std::string_view text = line_at(bytes, begin);
    ++reader.line;
    fine = read_line(reader, text);
    begin += text.size() + 1;
    if (reader.line == 1 && begin < bytes.size()) reader.replay.lines = bytes.substr(begin);
  }
  if (fine && (!reader.ended || !bytes.ends_with('\n'))) {
    reader.refuse("bad_event_log", "is the last one, and not the end of a log: it was cut off");
  }
  Result<Replay> result;
  if (!has_error(reader.findings)) result.value = std::move(reader.replay);
  result.findings = std::move(reader.findings);
  make_plain(result.findings);
  return result;
}

std::optional<Finding> compare_logs(Replay& replay, std::string_view text, bool finished) {
  text.remove_prefix(std::min(text.size(), text.find('\n') + 1));
  const std::string_view theirs = replay.lines;
  const std::string_view fresh = text.substr(replay.compared);
  const std::string_view wanted = theirs.substr(replay.compared);
  if (finished ? wanted == fresh : wanted.starts_with(fresh)) {
    replay.compared = text.size();
    return std::nullopt;
  }
  std::size_t line = 2, begin = 0;
  while (begin < text.size() && begin < theirs.size() &&
         line_at(text, begin) == line_at(theirs, begin)) {
    begin += line_at(text, begin).size() + 1;
    ++line;
  }
  if (begin >= text.size()) return departed(replay, line, "the replay ends before this line");
  if (begin >= theirs.size()) return departed(replay, line, "the replay goes on after the log");
  return departed(replay, line, first_difference(line_at(theirs, begin), line_at(text, begin)));
}

Finding departure(const Replay& replay, const ScriptDeparture& departure) {
  return departed(replay, replay.line_of_fan[departure.fan], departure.reason);
}

Finding missed_failure(const Replay& replay) {
  // The first line is the head.
  const auto last = static_cast<std::size_t>(1 + std::ranges::count(replay.lines, '\n'));
  return departed(
      replay, last,
      fmt::format("the run of the log failed in step {}, the replay did not", replay.steps));
}

}  // namespace sunder
