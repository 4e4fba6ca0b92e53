// SPDX-License-Identifier: MIT
// cpp-httplib parses and routes; its connections, threads and bounds are our own.
#include "apps/sunder/view/view_server.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "apps/sunder/view/view_head.hpp"

// Last: it brings httplib.h.
#include "apps/sunder/view/connection.hpp"

namespace sunder {
namespace {

/// On every answer. The page is one script and one style sheet of this server; it computes in this
/// server, or by WebAssembly in a Worker; the empty icon is a data: address. No other page may show
/// it in a frame.
constexpr std::pair<const char*, const char*> safe_headers[] = {
    {"Content-Security-Policy",
     "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; img-src 'self' "
     "data: blob:; connect-src 'self'; worker-src 'self'; base-uri 'none'; form-action 'none'; "
     "frame-ancestors 'none'"},
    {"X-Content-Type-Options", "nosniff"},
    {"X-Frame-Options", "DENY"},
    {"Referrer-Policy", "no-referrer"},
    {"Cross-Origin-Resource-Policy", "same-origin"},
    {"Cache-Control", "no-store"},
};

/// An answer to a head that the library could not read to its end.
std::string answer_to_fault(BoundedStream::HeadFault fault) {
  const bool is_long = fault == BoundedStream::HeadFault::too_long;
  const std::string_view words = is_long ? "the head of the request is too long\n"
                                         : "the head of the request came too slowly\n";
  std::string answer = fmt::format(
      "HTTP/1.1 {}\r\nConnection: close\r\nContent-Type: text/plain\r\nContent-Length: {}\r\n",
      is_long ? "431 Request Header Fields Too Large" : "408 Request Timeout", words.size());
  for (const auto& [name, value] : safe_headers) answer += fmt::format("{}: {}\r\n", name, value);
  return fmt::format("{}\r\n{}", answer, words);
}

std::vector<std::string> values(const httplib::Request& request, const char* name) {
  std::vector<std::string> all;
  const auto [begin, end] = request.headers.equal_range(name);
  for (auto header = begin; header != end; ++header) all.push_back(header->second);
  return all;
}

ViewRequestHead head_of(const httplib::Request& request) {
  return {.method = request.method,
          .path = request.path,
          .hosts = values(request, "Host"),
          .origins = values(request, "Origin"),
          .tokens = values(request, "X-Sunder-Token"),
          .lengths = values(request, "Content-Length"),
          .has_transfer_encoding = request.has_header("Transfer-Encoding")};
}

/// Leaves the headers that this server knows. The library would act on others: pack answers, unpack
/// bodies, part forms. (Ranges are hidden from it by the stream.)
void keep_known_headers(httplib::Request& request) {
  httplib::Headers known;
  for (const char* name : {"Host", "Origin", "X-Sunder-Token", "Content-Length",
                           "Transfer-Encoding", "Connection", "Expect"}) {
    const auto [begin, end] = request.headers.equal_range(name);
    known.insert(begin, end);
  }
  request.headers = std::move(known);
}

/// How many connections there may be at once.
std::size_t most_connections() {
  rlimit files{};
  const bool is_known = getrlimit(RLIMIT_NOFILE, &files) == 0;
  return is_known ? std::clamp<std::size_t>(files.rlim_cur / 2, 8, 256) : 256;
}

/// Threads for connections, made as they are needed. Where there can be no more, a connection that
/// waits is dropped for each that has no thread.
class Workers : public httplib::TaskQueue {
 public:
  Workers(Connections& connections, std::size_t most) : connections_(connections), most_(most) {
    threads_.reserve(most);
    threads_.emplace_back([this] { work(); });
  }
  ~Workers() override { shutdown(); }

  void enqueue(std::function<void()> job) override {
    const std::lock_guard lock(mutex_);
    jobs_.push_back(std::move(job));
    const bool is_served = jobs_.size() + busy_ <= threads_.size() || add_thread();
    connections_.arrive(is_served ? most_ : threads_.size());
    there_is_work_.notify_one();
  }

  void shutdown() override {
    {
      const std::lock_guard lock(mutex_);
      ends_ = true;
    }
    there_is_work_.notify_all();
    connections_.drop_all();
    threads_.clear();  // waits for them
  }

 private:
  bool add_thread() {
    if (threads_.size() >= most_) return false;
    try {
      threads_.emplace_back([this] { work(); });
      return true;
    } catch (const std::system_error&) {
      return false;
    }
  }

  void work() {
    std::unique_lock lock(mutex_);
    while (true) {
      there_is_work_.wait(lock, [this] { return ends_ || !jobs_.empty(); });
      if (jobs_.empty()) return;
      const std::function<void()> job = std::move(jobs_.front());
      jobs_.pop_front();
      ++busy_;
      lock.unlock();
      job();
      lock.lock();
      --busy_;
    }
  }

  Connections& connections_;
  std::size_t most_;
  std::mutex mutex_;
  std::condition_variable there_is_work_;
  std::deque<std::function<void()>> jobs_;
  std::size_t busy_ = 0;
  bool ends_ = false;
  std::vector<std::jthread> threads_;
};

}  // namespace

class ViewServer::Http : public httplib::Server {
 public:
  Http(ViewedScene& viewed, PageFiles page, std::string token)
      : viewed_(viewed), page_(std::move(page)), rules_{0, std::move(token), &page_} {
    new_task_queue = [this] { return new Workers(connections_, most_connections()); };
    set_tcp_nodelay(true);
    // The library's default shares a port with any process that has it.
    set_socket_options([](socket_t socket) {
      const int yes = 1;
      setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    httplib::Headers headers;
    for (const auto& [name, value] : safe_headers) headers.emplace(name, value);
    set_default_headers(std::move(headers));
    set_payload_max_length(most_body("load"));
    add_routes();
  }

  int bind(int port) {
    rules_.port = port;
    if (port == 0) {
      rules_.port = std::max(bind_to_any_port("127.0.0.1"), 0);
    } else if (!bind_to_port("127.0.0.1", port)) {
      rules_.port = 0;
    }
    // The library lets five connections wait, and the system delays a sixth by a second.
    if (rules_.port != 0) ::listen(svr_sock_, 512);
    return rules_.port;
  }

 private:
  /// Refusals and the page's files are answered from the head; only requests to the engine
  /// are left for a route, which reads the body.
  void add_routes() {
    set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
      if (const auto refusal = refusal_of(head_of(request), rules_)) {
        response.status = refusal->status;
        response.set_content(refusal->words, "text/plain");
        return HandlerResponse::Handled;
      }
      if (!work_of(request.path).empty()) return HandlerResponse::Unhandled;
      send_page_file(*find_page_file(page_, request.path), response);
      return HandlerResponse::Handled;
    });
    Post("/api/([a-z]+)", [this](const httplib::Request& request, httplib::Response& response) {
      ViewAnswer answer = do_view_request(viewed_, work_of(request.path), request.body);
      response.status = answer.fine ? 200 : 400;
      response.body = std::move(answer.bytes);
      response.set_header("Content-Type", answer.fine ? "application/octet-stream" : "text/plain");
    });
  }

  /// From the one copy in memory, however many clients take it slowly.
  static void send_page_file(const PageFile& file, httplib::Response& response) {
    response.set_content_provider(
        file.bytes.size(), file.type,
        [&file](std::size_t offset, std::size_t size, httplib::DataSink& sink) {
          return sink.write(file.bytes.data() + offset, size);
        });
  }

  bool process_and_close_socket(socket_t socket) override {
    const Connections::Entry connection = connections_.enter(socket);
    BoundedStream stream(socket);
    while (answer_one(stream, connection)) {
    }
    connections_.leave(connection);
    ::close(socket);
    return true;
  }

  /// Reads and answers one request; whether another may come on this connection.
  bool answer_one(BoundedStream& stream, Connections::Entry connection) {
    if (!stream.begin_head()) return false;
    bool is_refused = false, is_last = false;
    const bool is_answered = process_request(
        stream, false, is_last,
        [&](httplib::Request& request) { is_refused = !accept_head(request, stream, connection); });
    connections_.end_work(connection);
    if (stream.head_fault() != BoundedStream::HeadFault::none) {
      stream.send_after_fault(answer_to_fault(stream.head_fault()));
    }
    // Bytes of a head or a body that were not read would be taken for the next request.
    if (stream.is_in_head() || is_refused) stream.part();
    return is_answered && !is_last && !is_refused && !stream.is_in_head();
  }

  /// The head has been read: whether its request will be answered. The answer to one that is
  /// refused says that the connection ends.
  bool accept_head(httplib::Request& request, BoundedStream& stream,
                   Connections::Entry connection) {
    keep_known_headers(request);
    const ViewRequestHead head = head_of(request);
    stream.begin_body(body_size(head));
    if (refusal_of(head, rules_)) {
      request.headers.erase("Connection");
      request.headers.erase("Expect");  // no body is asked for
      request.headers.emplace("Connection", "close");
      return false;
    }
    if (!work_of(head.path).empty()) connections_.begin_work(connection);
    return true;
  }

  ViewedScene& viewed_;
  PageFiles page_;
  ViewRules rules_;
  Connections connections_;
};

ViewServer::ViewServer(ViewedScene& viewed, PageFiles page, std::string token)
    : http_(std::make_unique<Http>(viewed, std::move(page), std::move(token))) {}
ViewServer::~ViewServer() = default;

int ViewServer::bind(int port) { return http_->bind(port); }
void ViewServer::serve() { http_->listen_after_bind(); }

}  // namespace sunder
