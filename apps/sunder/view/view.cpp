// SPDX-License-Identifier: MIT
// The command line of `sunder view`.
#include "apps/sunder/view/view.hpp"

#include <fmt/format.h>
#include <sys/random.h>

#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>
#include <thread>

#include "apps/scene/scene_json.hpp"
#include "apps/sunder/process/run_process.hpp"
#include "apps/sunder/program.hpp"
#include "apps/sunder/view/open_page.hpp"
#include "apps/sunder/view/view_requests.hpp"
#include "apps/sunder/view/view_server.hpp"
#include "topology/io/files/printing.hpp"

namespace sunder {
namespace {

constexpr const char* view_footer = R"(
The page shows and runs the scene, plays the recording back, and lets you shoot, pull, cut and
inspect (docs/howto/look_and_export.md). A restart on the page reads the scene's file again. Only this
machine, and only the page whose address is printed, can reach the server. Ctrl-C ends it, also
while a step is computed.

Exit codes: 0 ended by Ctrl-C or SIGTERM, 2 usage, 3 bad scene or mesh, 4 the port is taken, there is no page,
or the system gives no thread, connection or random number.

Examples:
  sunder view meshes/scenes/monolith.json
  sunder view meshes/scenes/bunny.json --headless --port 8080
)";

/// The page of an installed program, share/sunder/page near its own folder, or that of the build.
std::filesystem::path usual_page() {
  std::error_code unknown;
  const std::filesystem::path program = own_program();
  const std::filesystem::path installed = program.parent_path().parent_path() / "share/sunder/page";
  if (!program.empty() && std::filesystem::is_directory(installed, unknown)) return installed;
  return SUNDER_PAGE;
}

struct ViewArguments : Telling {
  std::filesystem::path scene;
  std::filesystem::path page = usual_page();
  SceneReach reach = SceneReach::anywhere;
  int port = 0;
  bool headless = false;
};

// A signal handler can reach nothing but a global.
std::atomic<bool> ended = false;

/// A token that nobody can guess; nothing where the system gives no random bytes.
std::optional<std::string> random_token() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) return {};
  return fmt::format("{:02x}", fmt::join(bytes, ""));
}

ExitCode refuse(const Finding& finding, ExitCode code) {
  tell({finding}, {});
  return code;
}

/// Ends the process at once when a signal has come. A step that is being computed cannot be taken
/// back to a safe place and need not: nothing but the way in lies outside this process.
void end_when_told(const std::optional<std::filesystem::path>& way_in) {
  while (!ended) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  if (way_in) remove_way_in(*way_in);
  std::_Exit(static_cast<int>(ExitCode::fine));
}

ExitCode view(const ViewArguments& arguments) {
  const Result<SceneFile> file = read_scene(arguments.scene, {}, arguments.reach);
  tell(file.findings, arguments);
  if (!file) return ExitCode::bad_input;
  Result<PageFiles> page = read_page(arguments.page);
  if (!page) return refuse(page.findings.front(), ExitCode::not_written);
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
  ViewServer server(viewed, std::move(*page), *token);
  const int port = server.bind(arguments.port);
  if (port == 0) {
    return refuse(
        {.code = "port_taken",
         .text = fmt::format("port {} of 127.0.0.1 is taken or not allowed", arguments.port),
         .remedy = "leave out --port: the program then takes a free one"},
        ExitCode::not_written);
  }
  std::signal(SIGINT, [](int) { ended = true; });
  std::signal(SIGTERM, [](int) { ended = true; });
  const std::string url = fmt::format("http://127.0.0.1:{}/#token={}", port, *token);
  print("{}\n", url);
  std::fflush(stdout);
  std::optional<std::filesystem::path> way_in;
  if (!arguments.headless) way_in = open_page(url);
  if (!way_in) {
    remark(fmt::format("Open this address in a browser on this machine. From another machine, "
                       "first run: ssh -L "
                       "{0}:127.0.0.1:{0} HOST\nCtrl-C ends the server.\n",
                       port),
           arguments);
  }
  std::thread(end_when_told, way_in).detach();
  server.serve();
  if (way_in) remove_way_in(*way_in);
  return refuse({.code = "no_connections",
                 .text = "the system gives the server no more connections",
                 .remedy = "start it again"},
                ExitCode::not_written);
}

}  // namespace

bool page_is_built() { return std::filesystem::exists(usual_page() / "index.html"); }

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
