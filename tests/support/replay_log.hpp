// SPDX-License-Identifier: MIT
// Scenes run by the program, and their event logs read and forged.
#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/sunder/run/event_log.hpp"
#include "tests/support/program.hpp"
#include "tests/support/struck_scene.hpp"

namespace sunder::test {

/// A folder with the scene that is run in it.
struct Place : Folder {
  std::filesystem::path scene;
};

/// `sunder run` on the scene into the folder `out`.
inline Outcome run(const Place& place, const std::string& out, const std::string& words = "") {
  return run_program("run " + place.scene.string() + " --force --frames 3 -o " +
                     (place.path() / out).string() + " " + words);
}

inline Place place_of(const nlohmann::json& scene) {
  Place place;
  place.scene = place.path() / "scene.json";
  std::ofstream(place.scene) << scene.dump(1);
  return place;
}

inline std::vector<std::string> lines_of(const std::filesystem::path& log) {
  std::ifstream in(log, std::ios::binary);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

inline void write_lines(const std::filesystem::path& log, const std::vector<std::string>& lines) {
  std::ofstream out(log, std::ios::binary);
  for (const std::string& line : lines) out << line << "\n";
}

/// The log with one fan changed, and every check renewed: a change that only a run can find.
inline void forge(const std::filesystem::path& from, const std::filesystem::path& to,
                  const std::function<void(std::vector<nlohmann::ordered_json>&)>& change) {
  std::vector<nlohmann::ordered_json> lines;
  for (const std::string& line : lines_of(from)) {
    lines.push_back(nlohmann::ordered_json::parse(line));
    lines.back().erase("check");
  }
  change(lines);
  std::vector<std::string> text;
  std::string check;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    std::string line = lines[k].dump();
    check = line_check(line, check);
    line.insert(line.size() - 1, ",\"check\":\"" + check + "\"");
    text.push_back(line);
    if (k == 0) check = lines[0]["scene_hash"].get<std::string>();
  }
  write_lines(to, text);
}

}  // namespace sunder::test
