// SPDX-License-Identifier: MIT
// Steps a scene through the C functions and prints what came of it, as apps/page/hash.mjs does by
// WebAssembly: sunder_host_hash SCENE.json STEPS
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/host/sunder.h"
#include "apps/scene/scene_text.hpp"
#include "topology/base/fnv1a.hpp"

namespace {

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) return std::fprintf(stderr, "usage: sunder_host_hash SCENE.json STEPS\n"), 2;
  const std::filesystem::path path = arguments[1];
  const std::string text = bytes_of(path);
  std::vector<std::string> names, contents;
  const sunder::Result<sunder::SceneText> read = sunder::parse_scene_text(text, arguments[1]);
  if (!read) return std::fprintf(stderr, "%s is no JSON of a scene\n", arguments[1]), 4;
  for (const auto& body : read->root.value("bodies", nlohmann::json::array())) {
    names.push_back(body["mesh"]);
    contents.push_back(bytes_of(path.parent_path() / names.back()));
  }
  std::vector<sunder_file> files;
  for (std::size_t i = 0; i < names.size(); ++i) {
    files.push_back({names[i].c_str(), contents[i].data(), contents[i].size()});
  }
  sunder_scene scene{};
  scene.size = sizeof scene;
  scene.text = text.data();
  scene.text_size = text.size();
  scene.name = arguments[1];
  scene.files = files.data();
  scene.file_count = static_cast<std::uint32_t>(files.size());
  sunder_engine* engine = sunder_create(&scene);
  if (engine == nullptr) return std::fprintf(stderr, "%s", sunder_error(nullptr)), 4;
  const int steps = std::atoi(arguments[2]);
  sunder_report report{};
  report.size = sizeof report;
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < steps && sunder_step(engine, &report) == 0; ++i) {
  }
  const std::chrono::duration<double, std::milli> ms = std::chrono::steady_clock::now() - start;
  sunder_span state{};
  sunder_save(engine, &state);
  sunder::Fnv1a hash;
  hash.add({static_cast<const char*>(state.bytes), state.size});
  std::printf("step %llu fans %llu pieces %u state %016llx\n",
              static_cast<unsigned long long>(report.step),
              static_cast<unsigned long long>(report.fans_total), report.pieces,
              static_cast<unsigned long long>(hash.value));
  std::fprintf(stderr, "%.3f ms a step\n", ms.count() / steps);
  sunder_destroy(engine);
}
