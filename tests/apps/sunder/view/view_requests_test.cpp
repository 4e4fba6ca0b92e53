// SPDX-License-Identifier: MIT
#include "apps/sunder/view/view_requests.hpp"

#include <catch2/catch.hpp>

#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/folder.hpp"

using namespace sunder;

namespace {

sunder_report report_of(const ViewAnswer& answer) {
  sunder_report report{};
  REQUIRE(answer.bytes.size() >= sizeof report);
  std::memcpy(&report, answer.bytes.data(), sizeof report);
  return report;
}

/// A body of `load`: JSON behind its size, then files.
std::string load_body(const std::string& text, const std::string& files = {}) {
  std::string body(8, '\0');
  const std::uint64_t size = text.size();
  std::memcpy(body.data(), &size, sizeof size);
  return body + text + files;
}

const std::string own_scene = load_body(R"({"settings": []})");

}  // namespace

TEST_CASE("a page's requests load, step, go back and come to the same again", "[view]") {
  ViewedScene viewed;
  viewed.path = SUNDER_SCENES "/charts/monolith.json";
  CHECK_FALSE(do_view_request(viewed, "step", "{}").fine);
  REQUIRE(do_view_request(viewed, "load", own_scene).fine);
  REQUIRE(do_view_request(viewed, "step", R"({"count": 150})").fine);
  REQUIRE(do_view_request(viewed, "save", "{}").fine);
  const ViewAnswer first = do_view_request(viewed, "step", R"({"count": 60, "columns": [0]})");
  REQUIRE(do_view_request(viewed, "restore", R"({"step": 150})").fine);
  const ViewAnswer second = do_view_request(viewed, "step", R"({"count": 60, "columns": [0]})");
  CHECK(report_of(first).step == 210);
  CHECK(report_of(first).fans_total == report_of(second).fans_total);
  CHECK(first.bytes.substr(sizeof(sunder_report)) == second.bytes.substr(sizeof(sunder_report)));
  CHECK_FALSE(do_view_request(viewed, "restore", R"({"step": 3})").fine);
  CHECK_FALSE(do_view_request(viewed, "act", "short").fine);
  CHECK_FALSE(do_view_request(viewed, "step", "{").fine);
  CHECK_FALSE(do_view_request(viewed, "nothing", "{}").fine);
  const std::string columns = nlohmann::json{{"columns", std::vector<int>(65, 0)}}.dump();
  CHECK_FALSE(do_view_request(viewed, "read", columns).fine);
}

TEST_CASE("lists in lists end no request and no server", "[view]") {
  const test::Folder folder;
  const std::string deep(60'000, '[');
  ViewedScene viewed;
  viewed.path = folder.path() / "scene.json";
  std::ofstream(viewed.path) << R"({"bodies": )" << deep << std::string(60'000, ']') << "}";
  CHECK(do_view_request(viewed, "stamp", "").fine);
  const ViewAnswer scene = do_view_request(viewed, "load", own_scene);
  CHECK_FALSE(scene.fine);
  CHECK(scene.bytes.find("nested_too_deeply") != std::string::npos);
  viewed.path = SUNDER_SCENES "/charts/monolith.json";
  REQUIRE(do_view_request(viewed, "load", own_scene).fine);
  const std::string closed = deep + std::string(60'000, ']');
  for (const std::string& text : {deep, closed, R"({"count": )" + closed + "}"}) {
    CHECK_FALSE(do_view_request(viewed, "step", text).fine);
    CHECK_FALSE(do_view_request(viewed, "load", load_body(text)).fine);
  }
  CHECK(do_view_request(viewed, "step", "{}").fine);
}

TEST_CASE("a page reads no other files than the scene names, and sees none that is no mesh",
          "[view]") {
  const test::Folder folder;
  std::ofstream(folder.path() / "secret") << "root:x:0:0:secret\n";
  const std::string mesh = nlohmann::json(SUNDER_IO_DATA "/meshio_zlib.vtu").dump();
  const auto write_scene = [&](const std::string& body) {
    std::ofstream(folder.path() / "scene.json")
        << R"({"bodies": [{)" << body
        << R"(, "material": {"young_modulus": 1e9, "poisson_ratio": 0.2, "density": 1000}}]})";
  };
  ViewedScene viewed;
  viewed.path = folder.path() / "scene.json";
  write_scene(R"("mesh": )" + mesh);
  REQUIRE(do_view_request(viewed, "load", own_scene).fine);
  REQUIRE(do_view_request(viewed, "load",
                          load_body(R"({"settings": ["gravity.acceleration=[0,0,-1]"]})"))
              .fine);
  for (const std::string setting : {"bodies.0.mesh=secret", R"(bodies=[{\"mesh\":\"secret\"}])",
                                    R"(bodies.0={\"mesh\":1})", "bodies.0.mesh", "=", ""}) {
    const ViewAnswer set =
        do_view_request(viewed, "load", load_body(R"({"settings": [")" + setting + R"("]})"));
    CAPTURE(setting, set.bytes);
    CHECK_FALSE(set.fine);
    CHECK(set.bytes.find("numbers only") != std::string::npos);
  }
  const std::pair<std::string, std::string> scenes[] = {
      {R"("mesh": "secret")", "unknown_format"},
      {R"("mesh": )" + mesh + R"(, "cuts": [{"faces": "secret"}])", "bad_face"}};
  for (const auto& [body, code] : scenes) {
    write_scene(body);
    const ViewAnswer named = do_view_request(viewed, "load", own_scene);
    CAPTURE(named.bytes);
    CHECK_FALSE(named.fine);
    CHECK(named.bytes.find(code) != std::string::npos);
    CHECK(named.bytes.find("root") == std::string::npos);
  }
}

TEST_CASE("a scene dropped on the page comes with its files", "[view]") {
  const std::string mesh = test::bytes_of(SUNDER_IO_DATA "/meshio_zlib.vtu");
  const nlohmann::json scene = {{"bodies",
                                 {{{"mesh", "meshes/own.vtu"},
                                   {"material",
                                    {{"young_modulus", 1e9},
                                     {"poisson_ratio", 0.2},
                                     {"density", 1000},
                                     {"tensile_strength", 1e6}}}}}}};
  nlohmann::json request = {{"settings", {"time_step=5e-4"}},
                            {"text", scene.dump()},
                            {"name", "own.json"},
                            {"files", {"meshes/own.vtu"}},
                            {"sizes", {mesh.size()}}};
  ViewedScene viewed;
  viewed.path = SUNDER_SCENES "/charts/monolith.json";
  const ViewAnswer loaded = do_view_request(viewed, "load", load_body(request.dump(), mesh));
  REQUIRE(loaded.fine);
  CHECK(report_of(loaded).pieces == 1);
  CHECK(report_of(loaded).time_step == 5e-4);
  // Cut short in any of its parts: a message in words, and the loaded body stays.
  const std::string whole = load_body(request.dump(), mesh);
  for (const std::size_t size : {std::size_t{3}, std::size_t{20}, whole.size() - 50}) {
    const ViewAnswer cut = do_view_request(viewed, "load", whole.substr(0, size));
    CHECK_FALSE(cut.fine);
    CHECK(cut.bytes.size() > 10);
  }
  request["sizes"] = nlohmann::json::array();
  CHECK_FALSE(do_view_request(viewed, "load", load_body(request.dump(), mesh)).fine);
  request["sizes"] = {mesh.size()};
  request["files"] = {"other.vtu"};
  const ViewAnswer missing = do_view_request(viewed, "load", load_body(request.dump(), mesh));
  CHECK_FALSE(missing.fine);
  CHECK(missing.bytes.find("meshes/own.vtu") != std::string::npos);
  CHECK(do_view_request(viewed, "step", "{}").fine);
  REQUIRE(do_view_request(viewed, "load", own_scene).fine);
}

TEST_CASE("a page learns that the scene or a mesh of it was saved", "[view]") {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / "sunder_view_stamp";
  fs::create_directories(folder);
  std::ofstream(folder / "body.msh") << "one";
  std::ofstream(folder / "scene.json") << R"({"bodies": [{"mesh": "body.msh"}]})";
  ViewedScene viewed;
  viewed.path = folder / "scene.json";
  const std::string first = do_view_request(viewed, "stamp", "").bytes;
  CHECK(do_view_request(viewed, "stamp", "").bytes == first);
  fs::last_write_time(folder / "body.msh",
                      fs::file_time_type::clock::now() + std::chrono::seconds(5));
  const std::string second = do_view_request(viewed, "stamp", "").bytes;
  CHECK(second != first);
  std::ofstream(folder / "scene.json") << R"({"bodies": [{"mesh": "body.)";  // half saved
  CHECK(do_view_request(viewed, "stamp", "").bytes != second);
  fs::remove_all(folder);
}
