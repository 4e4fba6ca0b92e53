// SPDX-License-Identifier: MIT
// `sunder view` from outside: the clients it answers, its message if it cannot start, how it ends.
#include <catch2/catch.hpp>

#include <signal.h>
#include <stdio.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <memory>
#include <string>

#include "tests/support/program.hpp"

// Last: it brings resolv.h with a macro _res that collides with Eigen.
#include <httplib.h>

using namespace sunder::test;

namespace {

/// A server of the monolith with a page of one line.
class Server {
 public:
  explicit Server(const Workplace& here, const std::string& environment = "",
                  const std::string& how = "--headless") {
    std::filesystem::create_directories(here.path("page"));
    here.write("page/index.html", "the page");
    const std::string command =
        "echo $$; exec env " + environment +
        " '" SUNDER_PROGRAM "' view '" SUNDER_SCENES "/charts/monolith.json' " + how + " --page '" +
        here.path("page") + "' 2>'" + here.path("said") + "'";
    pipe_ = popen(command.c_str(), "r");
    process_ = std::stoi(line());
    const std::string address = line();
    port = std::stoi(address.substr(address.rfind(':') + 1));
    token = address.substr(address.rfind('=') + 1);
  }
  ~Server() {
    if (pipe_ != nullptr) end(SIGKILL);
  }
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// Ends it by a signal and gives its exit code.
  int end(int signal) {
    kill(process_, signal);
    const int status = pclose(pipe_);
    pipe_ = nullptr;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  /// The status of a request to the engine with these headers in place of the page's own.
  int status(const char* work, const httplib::Headers& other,
             const std::string& body = "{}") const {
    httplib::Headers headers = other;
    if (!headers.contains("X-Sunder-Token")) headers.emplace("X-Sunder-Token", token);
    httplib::Client client("127.0.0.1", port);
    const httplib::Result answer =
        client.Post("/api/" + std::string(work), headers, body, "application/octet-stream");
    return answer ? answer->status : 0;
  }

  int port = 0;
  std::string token;

 private:
  std::string line() const {
    char text[256] = "";
    if (fgets(text, sizeof text, pipe_) == nullptr) return "-1";
    std::string words = text;
    while (!words.empty() && words.back() == '\n') words.pop_back();
    return words;
  }

  FILE* pipe_ = nullptr;
  pid_t process_ = 0;
};

std::string body_of_load() {
  const std::string text = R"({"settings": []})";
  const std::uint64_t size = text.size();
  return std::string(reinterpret_cast<const char*>(&size), sizeof size) + text;
}

/// Sends a request and goes away before it is answered, as a page does that is closed.
void ask_and_leave(const Server& server, const std::string& body) {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port = htons(static_cast<std::uint16_t>(server.port));
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  REQUIRE(::connect(socket, reinterpret_cast<const sockaddr*>(&place), sizeof place) == 0);
  const std::string host = "127.0.0.1:" + std::to_string(server.port);
  const std::string request =
      "POST /api/step HTTP/1.1\r\nHost: " + host + "\r\nX-Sunder-Token: " + server.token +
      "\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
  REQUIRE(::send(socket, request.data(), request.size(), 0) ==
          static_cast<ssize_t>(request.size()));
  ::close(socket);
}

}  // namespace

TEST_CASE("sunder view answers its own page alone, on this machine's own address", "[view]") {
  const Workplace here;
  Server server(here);
  REQUIRE(server.port > 0);
  REQUIRE(server.token.size() == 32);
  const std::string own = "127.0.0.1:" + std::to_string(server.port);
  httplib::Client page("127.0.0.1", server.port);
  const httplib::Result index = page.Get("/");
  REQUIRE(index);
  CHECK(index->status == 200);
  CHECK(index->body == "the page");
  CHECK(page.Get("/", {{"Host", "sunder.example"}})->status == 403);
  CHECK(page.Get("/../said")->status == 404);
  CHECK(server.status("open", {}) == 200);
  CHECK(server.status("open", {{"Origin", "http://" + own}}) == 200);
  CHECK(server.status("open", {{"X-Sunder-Token", "guess"}}) == 403);
  CHECK(server.status("open", {{"X-Sunder-Token", ""}}) == 403);
  CHECK(server.status("open", {{"Host", "sunder.example"}}) == 403);
  CHECK(server.status("open", {{"Host", "127.0.0.1:1"}}) == 403);
  CHECK(server.status("open", {{"Origin", "http://other.example"}}) == 403);
  CHECK(server.status("open", {{"Origin", "null"}}) == 403);
  CHECK_FALSE(httplib::Client("127.0.0.2", server.port).Get("/"));  // bound to 127.0.0.1 alone
  CHECK(server.end(SIGINT) == 0);
  CHECK(bytes_of(here.path("said")).find("ssh -L " + std::to_string(server.port)) !=
        std::string::npos);
}

TEST_CASE("every answer of sunder view says what its page may load, and that no frame may show it",
          "[view]") {
  const Workplace here;
  Server server(here);
  httplib::Client page("127.0.0.1", server.port);
  const httplib::Headers token = {{"X-Sunder-Token", server.token}};
  const httplib::Result answers[] = {page.Get("/"),
                                     page.Head("/"),
                                     page.Get("/none"),
                                     page.Get("/", {{"Host", "other.example"}}),
                                     page.Post("/api/open", token, "{}", "text/plain"),
                                     page.Post("/api/step", token, "", ""),
                                     page.Post("/api/open"),
                                     page.Get("/", {{"X", std::string(9000, 'x')}}),
                                     page.Get("/", {{"X", std::string(40'000, 'x')}})};
  for (const httplib::Result& answer : answers) {
    REQUIRE(answer);
    CAPTURE(answer->status);
    const std::string policy = answer->get_header_value("Content-Security-Policy");
    CHECK(policy.find("default-src 'none'") != std::string::npos);
    CHECK(policy.find("frame-ancestors 'none'") != std::string::npos);
    CHECK(policy.find("unsafe-inline") == std::string::npos);
    CHECK(answer->get_header_value("X-Content-Type-Options") == "nosniff");
    CHECK(answer->get_header_value("Referrer-Policy") == "no-referrer");
    CHECK(answer->get_header_value_count("X-Content-Type-Options") == 1);
  }
  CHECK(page.Get("/", {{"Range", "bytes=0-1,0-1,0-1"}})->status == 200);
  CHECK(page.Get("/", {{"Range", "bytes=0-1,0-1,0-1"}})->body == "the page");
}

TEST_CASE("the token is in no argument of the browser", "[view]") {
  namespace fs = std::filesystem;
  const Workplace here;
  std::filesystem::create_directories(here.path("bin"));
  std::filesystem::create_directories(here.path("own"));
  const std::string browser = here.write(
      "bin/xdg-open", "#!/bin/sh\ncp \"$1\" '" + here.path("copy") +
                          "'\nstat -c '%a' \"$1\" "
                          "\"${1%/*}\" >'" +
                          here.path("modes") + "'\nprintf '%s|' \"$@\" >'" + here.path("part") +
                          "'\nmv '" + here.path("part") + "' '" + here.path("arguments") + "'\n");
  fs::permissions(browser, fs::perms::owner_all);
  Server server(here,
                "DISPLAY=:0 PATH='" + here.path("bin") + "':\"$PATH\" XDG_RUNTIME_DIR='" +
                    here.path("own") + "'",
                "");
  while (!fs::exists(here.path("arguments"))) usleep(1000);
  const std::string arguments = bytes_of(here.path("arguments"));
  CHECK(arguments.find(server.token) == std::string::npos);
  CHECK(arguments.starts_with(here.path("own") + "/sunder-view-"));
  CHECK(arguments.find('|') == arguments.size() - 1);
  CHECK(bytes_of(here.path("modes")) == "600\n700\n");
  CHECK(bytes_of(here.path("copy"))
            .find("location.replace(\"http://127.0.0.1:" + std::to_string(server.port) +
                  "/#token=" + server.token + "\")") != std::string::npos);
  CHECK(fs::exists(arguments.substr(0, arguments.size() - 1)));
  CHECK(server.end(SIGTERM) == 0);
  CHECK(fs::is_empty(here.path("own")));
  CHECK(bytes_of(here.path("said")).empty());
}

TEST_CASE("sunder view outlives a page that is closed while it waits", "[view]") {
  const Workplace here;
  Server server(here);
  REQUIRE(server.status("load", {}, body_of_load()) == 200);
  for (int k = 0; k < 3; ++k) ask_and_leave(server, R"({"count": 20, "columns": [0, 1, 2, 3]})");
  CHECK(server.status("step", {}) == 200);
  CHECK(server.end(SIGTERM) == 0);
}

TEST_CASE("sunder view says what is wrong with a scene, a port and a page", "[view]") {
  const Workplace here;
  const Server server(here);
  const std::string scene = SUNDER_SCENES "/charts/monolith.json";
  const auto taken = here.run({"view", scene, "--headless", "--page", here.path("page"), "--port",
                               std::to_string(server.port)});
  CHECK(taken.exit_code == 4);
  CHECK(taken.err.find("port_taken") != std::string::npos);
  CHECK(taken.err.find("leave out --port") != std::string::npos);
  const auto no_page = here.run({"view", scene, "--headless", "--page", here.path("nowhere")});
  CHECK(no_page.exit_code == 4);
  CHECK(no_page.err.find("./bootstrap all") != std::string::npos);
  const std::string broken = here.write("broken.json", "{\n  \"bodies\": [}\n");
  const auto refused = here.run({"view", broken, "--headless", "--page", here.path("page")});
  CHECK(refused.exit_code == 3);
  CHECK(refused.err.find("broken.json:2") != std::string::npos);
  CHECK(here.run({"view", here.path("none.json"), "--headless"}).exit_code == 3);
  CHECK(here.run({"view", scene, "--port", "0"}).exit_code == 2);
}
