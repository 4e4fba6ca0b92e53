// SPDX-License-Identifier: MIT
// Requests of the page to the native engine, as bytes in and out; no socket here.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "apps/host/engine.hpp"
#include "apps/scene/scene_json.hpp"
#include "topology/base/finding.hpp"

namespace sunder {

/// The scene that is viewed, its engine and the states to go back to. Requests come on any thread
/// and are done one after the other.
struct ViewedScene {
  std::filesystem::path path;
  SceneReach reach = SceneReach::anywhere;
  std::unique_ptr<sunder_engine> engine;
  std::string words;                           ///< warnings, or the failure
  std::map<std::uint64_t, std::string> saved;  ///< by their step
  std::mutex one_at_a_time;
};

/// The answer to a request.
struct ViewAnswer {
  bool fine = true;
  std::string bytes;  ///< the answer, or the fault in words
};

/// Does `work` ("load", "step", "read", "act", "inspect", "save", "restore", "forget", "scene",
/// "stamp", "open") with the `body` that apps/page/src/engines.js makes: a `sunder_action` for act,
/// for load the size of a JSON text (8 bytes), the text and files that were dropped on the page,
/// else JSON. Answers with a `sunder_report`, words, and columns (id, size, content padded to 8
/// bytes).
ViewAnswer do_view_request(ViewedScene& viewed, std::string_view work, std::string_view body);

/// Whether `do_view_request` knows a word.
bool is_view_work(std::string_view work);

}  // namespace sunder
