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

TEST_CASE("only the page itself is answered", "[view]") {
  const std::string own = "127.0.0.1:8080";
  CHECK(is_allowed({own, "", "secret"}, 8080, "secret", true));
  CHECK(is_allowed({own, "http://127.0.0.1:8080", "secret"}, 8080, "secret", true));
  CHECK(is_allowed({"localhost:8080", "http://localhost:8080", ""}, 8080, "secret", false));
  CHECK_FALSE(is_allowed({own, "", "guess"}, 8080, "secret", true));
  CHECK_FALSE(is_allowed({own, "", ""}, 8080, "secret", true));
  CHECK_FALSE(is_allowed({"sunder.example:8080", "", "secret"}, 8080, "secret", true));
  CHECK_FALSE(is_allowed({"127.0.0.1:8081", "", "secret"}, 8080, "secret", true));
  CHECK_FALSE(is_allowed({own, "http://other.example", "secret"}, 8080, "secret", true));
  CHECK_FALSE(is_allowed({own, "null", "secret"}, 8080, "secret", true));
}

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
}

TEST_CASE("a scene dropped on the page comes with its files", "[view]") {
  const std::string mesh = test::bytes_of(SUNDER_IO_DATA "/meshio_zlib.vtu");
  const nlohmann::json scene = {{"bodies",
                                 {{{"mesh", "meshes/own.vtu"},
                                   {"material",
                                    {{"young_modulus", 1e9}, {"poisson_ratio", 0.2}, {"density", 1000},
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
  // Cut short in any of its parts: words, and what is loaded stays.
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
  fs::last_write_time(folder / "body.msh", fs::file_time_type::clock::now() + std::chrono::seconds(5));
  const std::string second = do_view_request(viewed, "stamp", "").bytes;
  CHECK(second != first);
  std::ofstream(folder / "scene.json") << R"({"bodies": [{"mesh": "body.)";  // half saved
  CHECK(do_view_request(viewed, "stamp", "").bytes != second);
  fs::remove_all(folder);
}
