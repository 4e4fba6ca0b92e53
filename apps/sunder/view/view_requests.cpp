// SPDX-License-Identifier: MIT
// The page's requests over the C functions' own room.
#include "apps/sunder/view/view_requests.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "apps/scene/scene_json.hpp"
#include "apps/scene/scene_text.hpp"
#include "apps/scene/words.hpp"

namespace sunder {
namespace {

ViewAnswer refusal(std::string words) { return {false, std::move(words)}; }

/// A request that cannot be understood.
struct BadRequest : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// JSON of the page, by the reader of scenes: it bounds how deeply lists may lie in lists, since
/// code that walks through them calls itself.
nlohmann::json json_of(std::string_view text) {
  Result<SceneText> read = parse_scene_text(text, "");
  if (!read) throw BadRequest(read.findings.front().text);
  return std::move(read->root);
}

template <class T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void pad(std::string& bytes) { bytes.resize((bytes.size() + 7) / 8 * 8); }

/// The report of the last step with its words, and columns by their ids.
std::string answer_of(ViewedScene& viewed, const std::vector<std::uint32_t>& columns) {
  std::string bytes;
  sunder_report report{};
  report.size = sizeof report;
  sunder_last_report(viewed.engine.get(), &report);
  append(bytes, report);
  const std::string words = report.outcome != 0 ? sunder_error(viewed.engine.get()) : viewed.words;
  append(bytes, static_cast<std::uint64_t>(words.size()));
  bytes += words;
  pad(bytes);
  for (const std::uint32_t column : columns) {
    sunder_span span{};
    if (sunder_read(viewed.engine.get(), column, &span) != 0) continue;
    append(bytes, column);
    append(bytes, static_cast<std::uint32_t>(span.size));
    bytes.append(static_cast<const char*>(span.bytes), span.size);
    pad(bytes);
  }
  return bytes;
}

/// Ids of columns. More than there are would be the same ones again, and make an answer of any
/// size.
std::vector<std::uint32_t> ids(const nlohmann::json& request, const char* key) {
  constexpr std::size_t most = 64;
  auto list = request.value(key, std::vector<std::uint32_t>{});
  if (list.size() > most) throw BadRequest(fmt::format("more than {} columns", most));
  return list;
}

/// Whether a setting puts in a number or a list of numbers, as the sliders of the page do.
bool sets_numbers(const std::string& setting) {
  const std::size_t equals = setting.find('=');
  if (equals == std::string::npos) return false;
  const Result<SceneText> value = parse_scene_text(setting.substr(equals + 1), "");
  if (!value) return false;
  const nlohmann::json& root = value->root;
  const auto is_number = [](const nlohmann::json& part) { return part.is_number(); };
  return root.is_number() || (root.is_array() && std::ranges::all_of(root, is_number));
}

/// Reads the file again: a restart has the text that was saved in the meantime. Which files are
/// read is the scene's affair, never the page's.
std::unique_ptr<sunder_engine> engine_of_file(ViewedScene& viewed,
                                              const std::vector<std::string>& settings) {
  for (const std::string& setting : settings) {
    if (sets_numbers(setting)) continue;
    viewed.words = fmt::format("{}: the page sets numbers only\n", setting);
    return nullptr;
  }
  Result<SceneFile> file = read_scene(viewed.path, settings, viewed.reach);
  viewed.words = finding_lines(file.findings);
  if (!file) return nullptr;
  Result<Simulation> simulation = build_simulation(std::move(file->scene));
  viewed.words += finding_lines(simulation.findings);
  return simulation ? make_engine(std::move(*simulation)) : nullptr;
}

/// A scene that was dropped on the page: its text, and the `bytes` of its files one after the
/// other.
std::unique_ptr<sunder_engine> engine_of_drop(ViewedScene& viewed, const nlohmann::json& dropped,
                                              const std::vector<std::string>& settings,
                                              std::string_view bytes) {
  const std::string text = dropped.at("text"), name = dropped.at("name");
  const std::vector<std::string> names = dropped.at("files");
  const std::vector<std::size_t> sizes = dropped.at("sizes");
  std::vector<sunder_file> files;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string_view file = bytes.substr(0, sizes.at(i));
    files.push_back({names[i].c_str(), file.data(), file.size()});
    bytes.remove_prefix(file.size());
  }
  std::vector<const char*> changes;
  for (const std::string& setting : settings) changes.push_back(setting.c_str());
  sunder_scene scene{};
  scene.size = sizeof scene;
  scene.text = text.data();
  scene.text_size = text.size();
  scene.name = name.c_str();
  scene.files = files.data();
  scene.file_count = static_cast<std::uint32_t>(files.size());
  scene.settings = changes.data();
  scene.setting_count = static_cast<std::uint32_t>(changes.size());
  std::unique_ptr<sunder_engine> engine(sunder_create(&scene));
  viewed.words = sunder_error(nullptr);
  return engine;
}

/// The body: the size of a JSON text in 8 bytes, the text, the bytes of files that were dropped.
ViewAnswer load(ViewedScene& viewed, std::string_view body) {
  std::uint64_t size = 0;
  if (body.size() < sizeof size) return refusal("a scene to load begins with 8 bytes");
  std::memcpy(&size, body.data(), sizeof size);
  body.remove_prefix(sizeof size);
  const nlohmann::json request = json_of(body.substr(0, size));
  body.remove_prefix(std::min<std::size_t>(size, body.size()));
  const std::vector<std::string> settings = request.at("settings");
  std::unique_ptr<sunder_engine> engine = request.contains("text")
                                              ? engine_of_drop(viewed, request, settings, body)
                                              : engine_of_file(viewed, settings);
  if (engine == nullptr) return refusal(viewed.words);
  viewed.engine = std::move(engine);
  viewed.saved.clear();
  return {true, answer_of(viewed, {})};
}

ViewAnswer step(ViewedScene& viewed, const nlohmann::json& request) {
  for (int left = request.value("count", 1); left > 0; --left) {
    if (sunder_step(viewed.engine.get(), nullptr) != 0) break;
  }
  std::vector<std::uint32_t> columns = ids(request, "columns");
  if (viewed.engine->report.shape != request.value("shape", 0u)) {
    const std::vector<std::uint32_t> more = ids(request, "shapeColumns");
    columns.insert(columns.end(), more.begin(), more.end());
  }
  return {true, answer_of(viewed, columns)};
}

ViewAnswer act(ViewedScene& viewed, std::string_view body) {
  sunder_action action{};
  if (body.size() != sizeof action) return refusal("an action has 80 bytes");
  std::memcpy(&action, body.data(), sizeof action);
  if (sunder_act(viewed.engine.get(), &action) != 0) {
    return refusal(sunder_error(viewed.engine.get()));
  }
  return {true, answer_of(viewed, {})};
}

ViewAnswer inspect(ViewedScene& viewed, const nlohmann::json& request) {
  sunder_vertex vertex{};
  vertex.size = sizeof vertex;
  const auto row = request.at("vertex").get<std::uint32_t>();
  if (sunder_inspect(viewed.engine.get(), row, &vertex) != 0) {
    return refusal(fmt::format("there is no vertex {}", row));
  }
  ViewAnswer answer;
  append(answer.bytes, vertex);
  return answer;
}

ViewAnswer save(ViewedScene& viewed) {
  sunder_span span{};
  sunder_save(viewed.engine.get(), &span);
  if (span.bytes == nullptr) return refusal(sunder_error(viewed.engine.get()));
  const std::uint64_t at = viewed.engine->report.step;
  viewed.saved[at].assign(static_cast<const char*>(span.bytes), span.size);
  ViewAnswer answer;
  append(answer.bytes, at);
  append(answer.bytes, static_cast<std::uint64_t>(span.size));
  return answer;
}

ViewAnswer restore_saved(ViewedScene& viewed, const nlohmann::json& request) {
  const auto state = viewed.saved.find(request.at("step").get<std::uint64_t>());
  if (state == viewed.saved.end()) return refusal("that step was not saved");
  sunder_engine* engine = sunder_restore(state->second.data(), state->second.size());
  if (engine == nullptr) return refusal(sunder_error(nullptr));
  viewed.engine.reset(engine);
  return {true, answer_of(viewed, {})};
}

ViewAnswer scene_text(const ViewedScene& viewed) {
  std::ifstream in(viewed.path, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(in), {});
  return {true, nlohmann::json{{"name", viewed.path.stem().string()}, {"text", text}}.dump()};
}

/// Adds to `stamp` every string in a scene that names a file in its folder, and the time when that
/// file was last written.
void stamp_files(std::string& stamp, const std::filesystem::path& folder,
                 const nlohmann::json& value) {
  if (value.is_structured()) {
    for (const nlohmann::json& part : value) stamp_files(stamp, folder, part);
  } else if (value.is_string()) {
    const std::filesystem::path file = folder / value.get<std::string>();
    std::error_code none;
    if (!std::filesystem::is_regular_file(file, none)) return;
    const auto written = std::filesystem::last_write_time(file, none).time_since_epoch().count();
    stamp += fmt::format("{} {}\n", file.string(), written);
  }
}

/// Another text whenever the scene or a file that it names was saved.
ViewAnswer stamp_of(const ViewedScene& viewed) {
  std::ifstream in(viewed.path, std::ios::binary);
  ViewAnswer answer{true, std::string(std::istreambuf_iterator<char>(in), {})};
  const Result<SceneText> scene = parse_scene_text(answer.bytes, "");
  if (scene) stamp_files(answer.bytes, viewed.path.parent_path(), scene->root);
  return answer;
}

ViewAnswer do_work(ViewedScene& viewed, std::string_view work, std::string_view body) {
  if (work == "open") return {};
  if (work == "scene") return scene_text(viewed);
  if (work == "stamp") return stamp_of(viewed);
  if (work != "load" && viewed.engine == nullptr) return refusal("no scene is loaded");
  if (work == "act") return act(viewed, body);
  if (work == "load") return load(viewed, body);
  const nlohmann::json request = json_of(body);
  if (work == "step") return step(viewed, request);
  if (work == "read") return {true, answer_of(viewed, ids(request, "columns"))};
  if (work == "inspect") return inspect(viewed, request);
  if (work == "save") return save(viewed);
  if (work == "restore") return restore_saved(viewed, request);
  if (work == "forget") {
    viewed.saved.erase(request.at("step").get<std::uint64_t>());
    return {};
  }
  return refusal(fmt::format("there is no request {}", work));
}

}  // namespace

ViewAnswer do_view_request(ViewedScene& viewed, std::string_view work, std::string_view body) {
  const std::lock_guard<std::mutex> alone(viewed.one_at_a_time);
  try {
    return do_work(viewed, work, body);
  } catch (const BadRequest& error) {
    return refusal(fmt::format("the request cannot be read: {}", error.what()));
  } catch (const nlohmann::json::exception& error) {
    return refusal(fmt::format("the request cannot be read: {}", error.what()));
  } catch (const std::out_of_range&) {
    return refusal("the request cannot be read: it has fewer sizes than files");
  }
}

bool is_view_work(std::string_view work) {
  constexpr std::string_view known[] = {"open", "scene",   "stamp", "load",    "act",   "step",
                                        "read", "inspect", "save",  "restore", "forget"};
  return std::ranges::find(known, work) != std::end(known);
}

}  // namespace sunder
