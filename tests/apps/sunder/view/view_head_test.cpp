// SPDX-License-Identifier: MIT
#include "apps/sunder/view/view_head.hpp"

#include <catch2/catch.hpp>

#include <sys/stat.h>

#include <fstream>

#include "tests/support/folder.hpp"

using namespace sunder;

namespace {

const PageFiles page = {{"/index.html", {"the page", "text/html"}}};
const ViewRules rules{8080, "secret", &page};

ViewRequestHead page_request() {
  return {.method = "GET", .path = "/", .hosts = {"127.0.0.1:8080"}};
}

ViewRequestHead engine_request() {
  return {.method = "POST",
          .path = "/api/step",
          .hosts = {"127.0.0.1:8080"},
          .tokens = {"secret"},
          .lengths = {"2"}};
}

int status(const ViewRequestHead& head) {
  const auto refusal = refusal_of(head, rules);
  return refusal ? refusal->status : 200;
}

}  // namespace

TEST_CASE("only the page itself is answered", "[view]") {
  for (ViewRequestHead head : {page_request(), engine_request()}) {
    CHECK(status(head) == 200);
    for (const char* origin : {"http://127.0.0.1:8080", "http://localhost:8080"}) {
      head.origins = {origin};
      CHECK(status(head) == 200);
    }
    for (const char* origin : {"http://other.example", "null", "http://127.0.0.1:8081", ""}) {
      head.origins = {origin};
      CHECK(status(head) == 403);
    }
    head.origins.clear();
    for (const char* host : {"sunder.example:8080", "127.0.0.1:8081", "127.0.0.1", ""}) {
      head.hosts = {host};
      CHECK(status(head) == 403);
    }
    head.hosts.clear();
    CHECK(status(head) == 403);
    head.hosts = {"localhost:8080"};
    CHECK(status(head) == 200);
    head.hosts = {"localhost:8080", "localhost:8080"};
    CHECK(status(head) == 400);
  }
}

TEST_CASE("a request to the engine is judged by its head", "[view]") {
  const auto changed = [](const auto& change) {
    ViewRequestHead head = engine_request();
    change(head);
    return status(head);
  };
  CHECK(changed([](auto& head) { head.tokens = {"guess"}; }) == 403);
  CHECK(changed([](auto& head) { head.tokens = {""}; }) == 403);
  CHECK(changed([](auto& head) { head.tokens.clear(); }) == 403);
  CHECK(changed([](auto& head) { head.tokens = {"secret", "guess"}; }) == 400);
  CHECK(changed([](auto& head) { head.path = "/api/nothing"; }) == 404);
  CHECK(changed([](auto& head) { head.path = "/api/"; }) == 404);
  CHECK(changed([](auto& head) { head.path = "/api/step/"; }) == 404);
  CHECK(changed([](auto& head) { head.method = "GET"; }) == 405);
  CHECK(changed([](auto& head) { head.method = "PUT"; }) == 405);
  CHECK(changed([](auto& head) { head.lengths.clear(); }) == 411);
  CHECK(changed([](auto& head) { head.has_transfer_encoding = true; }) == 411);
  CHECK(changed([](auto& head) { head.lengths = {"2", "3"}; }) == 400);
  for (const char* length : {"", "-1", "+2", " 2", "2 ", "0x2", "2,2", "18446744073709551616"}) {
    CHECK(changed([&](auto& head) { head.lengths = {length}; }) == 400);
  }
  CHECK(changed([](auto& head) { head.lengths = {"65536"}; }) == 200);
  CHECK(changed([](auto& head) { head.lengths = {"65537"}; }) == 413);
  CHECK(changed([](auto& head) { head.lengths = {"18446744073709551615"}; }) == 413);
  const auto load = [](const char* length) {
    return [=](auto& head) { head.path = "/api/load", head.lengths = {length}; };
  };
  CHECK(changed(load("1073741824")) == 200);
  CHECK(changed(load("1073741825")) == 413);
}

TEST_CASE("the page's files are asked for without a body", "[view]") {
  ViewRequestHead head = page_request();
  head.method = "HEAD";
  CHECK(status(head) == 200);
  for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS"}) {
    head.method = method;
    CHECK(status(head) == 405);
  }
  head = page_request();
  head.lengths = {"0"};
  CHECK(status(head) == 200);
  head.lengths = {"1"};
  CHECK(status(head) == 400);
  head.lengths.clear();
  head.has_transfer_encoding = true;
  CHECK(status(head) == 400);
  head = page_request();
  for (const char* path : {"/other.html", "/../index.html", "//index.html", "", "/index.html/"}) {
    head.path = path;
    CHECK(status(head) == 404);
  }
}

TEST_CASE("the page is read once, files of folders below among it", "[view]") {
  const test::Folder folder;
  CHECK(read_page(folder.path()).findings.at(0).code == "no_page");
  std::filesystem::create_directories(folder.path() / "scenes");
  std::ofstream(folder.path() / "index.html") << "the page";
  std::ofstream(folder.path() / "scenes/a.json") << "{}";
  std::ofstream(folder.path() / "empty.txt");
  REQUIRE(mkfifo((folder.path() / "pipe").c_str(), 0600) == 0);
  const Result<PageFiles> read = read_page(folder.path());
  REQUIRE(read);
  CHECK(read->size() == 3);
  REQUIRE(find_page_file(*read, "/") != nullptr);
  CHECK(find_page_file(*read, "/")->bytes == "the page");
  CHECK(find_page_file(*read, "/scenes/a.json")->type == "application/json");
  CHECK(find_page_file(*read, "/empty.txt")->bytes.empty());
  CHECK(find_page_file(*read, "/scenes") == nullptr);
  std::ofstream(folder.path() / "large.bin");
  std::filesystem::resize_file(folder.path() / "large.bin", 64'000'001);
  CHECK(read_page(folder.path()).findings.at(0).code == "page_too_big");
}
