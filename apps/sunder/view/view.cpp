// SPDX-License-Identifier: MIT
// The command line of `sunder view`, and its server on this machine's own address.
#include "apps/sunder/view/view.hpp"

#include <fmt/format.h>
#include <sys/random.h>

#include <atomic>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <vector>

#include "apps/scene/scene_json.hpp"
#include "apps/sunder/program.hpp"
#include "apps/sunder/view/view_requests.hpp"

// Last: it brings resolv.h, whose macro _res stands in the way of Eigen.
#include <httplib.h>

namespace sunder {
namespace {

constexpr const char* view_footer = R"(
The page shows and runs the scene, plays the recording back, and lets you shoot, pull, cut and
inspect (docs/page.md). A restart on the page reads the scene's file again. Only this machine, and
only the page whose address is printed, can reach the server. Ctrl-C ends it.

Exit codes: 0 ended by Ctrl-C, 2 usage, 3 bad scene or mesh, 4 the port is taken, there is no page,
or the system gives no thread or random number.

Examples:
  sunder view meshes/scenes/monolith.json
  sunder view meshes/scenes/bunny.json --headless --port 8080
)";

constexpr const char* built_page = SUNDER_PAGE;

bool has_page(const std::filesystem::path& folder) {
  return std::filesystem::exists(folder / "index.html");
}

struct ViewArguments : Telling {
  std::filesystem::path scene;
  std::filesystem::path page = built_page;
  SceneReach reach = SceneReach::anywhere;
  int port = 0;
  bool headless = false;
};

// A signal handler can reach nothing but a global.
std::atomic<bool> ended = false;

/// What nobody can guess; nothing where the system gives none.
std::optional<std::string> random_token() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) return {};
  return fmt::format("{:02x}", fmt::join(bytes, ""));
}

/// Threads that answer requests: as many as can be had. (The library's own pool ends the program
/// where one of them cannot.)
class Workers : public httplib::TaskQueue {
 public:
  explicit Workers(std::size_t wanted) {
    try {
      while (threads_.size() < wanted) threads_.emplace_back([this] { work(); });
    } catch (const std::system_error&) {
      if (threads_.empty()) throw;
    } catch (...) {
      shutdown();
      throw;
    }
  }
  ~Workers() override { shutdown(); }

  void enqueue(std::function<void()> job) override {
    const std::lock_guard lock(mutex_);
    jobs_.push_back(std::move(job));
    there_is_work_.notify_one();
  }

  void shutdown() override {
    {
      const std::lock_guard lock(mutex_);
      ends_ = true;
    }
    there_is_work_.notify_all();
    threads_.clear();  // waits for them
  }

 private:
  void work() {
    while (true) {
      std::unique_lock lock(mutex_);
      there_is_work_.wait(lock, [this] { return ends_ || !jobs_.empty(); });
      if (jobs_.empty()) return;
      const std::function<void()> job = std::move(jobs_.front());
      jobs_.pop_front();
      lock.unlock();
      job();
    }
  }

  std::mutex mutex_;
  std::condition_variable there_is_work_;
  std::deque<std::function<void()>> jobs_;
  bool ends_ = false;
  std::vector<std::jthread> threads_;
};

ExitCode refuse(const Finding& finding, ExitCode code) {
  tell({finding}, {});
  return code;
}

ViewRequestHead head_of(const httplib::Request& request) {
  return {request.get_header_value("Host"), request.get_header_value("Origin"),
          request.get_header_value("X-Sunder-Token")};
}

/// The page's files by name, and requests to the engine.
void add_routes(httplib::Server& server, ViewedScene& viewed, const ViewArguments& arguments,
                const std::string& token, const int& port) {
  server.set_pre_routing_handler([&](const httplib::Request& request, httplib::Response& response) {
    const bool needs_token = request.path.starts_with("/api/");
    if (is_allowed(head_of(request), port, token, needs_token)) {
      response.set_header("X-Content-Type-Options", "nosniff");
      response.set_header("Cache-Control", "no-store");
      return httplib::Server::HandlerResponse::Unhandled;
    }
    response.status = 403;
    response.set_content("sunder view answers its own page only\n", "text/plain");
    return httplib::Server::HandlerResponse::Handled;
  });
  server.Post(
      R"(/api/([a-z]+))", [&](const httplib::Request& request, httplib::Response& response) {
        const std::string work = request.matches[1];
        const ViewAnswer answer = do_view_request(viewed, work, request.body);
        response.status = answer.fine ? 200 : 400;
        response.set_content(answer.bytes, answer.fine ? "application/octet-stream" : "text/plain");
      });
  server.set_mount_point("/", arguments.page.string());
}

/// Starts a browser where there is a display and one to start.
bool open_browser(const std::string& url) {
  if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return false;
  // The address is ours: digits, letters and marks that no shell takes for its own but within ''.
  const std::string command =
      fmt::format("command -v xdg-open >/dev/null && {{ xdg-open '{}' >/dev/null 2>&1 & }}", url);
  return std::system(command.c_str()) == 0;
}

ExitCode view(const ViewArguments& arguments) {
  const Result<SceneFile> file = read_scene(arguments.scene, {}, arguments.reach);
  tell(file.findings, arguments);
  if (!file) return ExitCode::bad_input;
  if (!has_page(arguments.page)) {
    return refuse(
        {.code = "no_page",
         .text = fmt::format("there is no page in {}", arguments.page.string()),
         .remedy =
             "build the page with `./bootstrap all` (needs npm), or name the folder of a built "
             "page with --page"},
        ExitCode::not_written);
  }
  ViewedScene viewed;
  viewed.path = arguments.scene;
  viewed.reach = arguments.reach;
  const std::optional<std::string> token = random_token();
  if (!token) {
    return refuse(
        {.code = "no_token",
         .text = "the system gives no random numbers, so the address cannot be kept secret",
         .remedy = "run it where getrandom(2) works"},
        ExitCode::not_written);
  }
  httplib::Server server;
  server.new_task_queue = [] { return new Workers(CPPHTTPLIB_THREAD_POOL_COUNT); };
  server.set_keep_alive_max_count(1u << 20);
  server.set_tcp_nodelay(true);
  // The library's default shares a port with whoever has it.
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  int port = arguments.port;
  add_routes(server, viewed, arguments, *token, port);
  if (port == 0) {
    port = server.bind_to_any_port("127.0.0.1");
  } else if (!server.bind_to_port("127.0.0.1", port)) {
    return refuse({.code = "port_taken",
                   .text = fmt::format("port {} of 127.0.0.1 is taken or not allowed", port),
                   .remedy = "leave out --port: the program then takes a free one"},
                  ExitCode::not_written);
  }
  const std::string url = fmt::format("http://127.0.0.1:{}/#token={}", port, *token);
  fmt::print("{}\n", url);
  std::fflush(stdout);
  if (arguments.headless || !open_browser(url)) {
    remark(fmt::format("Open this address in a browser on this machine. From another machine, "
                       "first run: ssh -L "
                       "{0}:127.0.0.1:{0} HOST\nCtrl-C ends the server.\n",
                       port),
           arguments);
  }
  ended = false;
  std::signal(SIGINT, [](int) { ended = true; });
  std::signal(SIGTERM, [](int) { ended = true; });
  std::jthread watch([&](const std::stop_token& done) {
    while (!ended && !done.stop_requested()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    server.stop();
  });
  server.listen_after_bind();
  return ExitCode::fine;
}

}  // namespace

bool page_is_built() { return has_page(built_page); }

void add_view_command(CLI::App& program, ExitCode& exit_code) {
  const auto arguments = std::make_shared<ViewArguments>();
  CLI::App* command =
      program.add_subcommand("view", "Show a scene in the browser and run it there");
  command->add_option("SCENE", arguments->scene, "Scene file (JSON)")->required();
  command->add_option("--port", arguments->port, "Port on 127.0.0.1; default: a free one")
      ->check(CLI::Range(1, 65535));
  command->add_option("--page", arguments->page, "Folder of the built page")->type_name("DIR");
  add_confined_flag(*command, arguments->reach);
  add_quiet_flag(*command, *arguments);
  command->add_flag("--headless", arguments->headless, "Print the address and start no browser");
  command->footer(view_footer);
  command->callback([arguments, &exit_code] { exit_code = view(*arguments); });
}

}  // namespace sunder
