// SPDX-License-Identifier: MIT
// One connection of `sunder view` as cpp-httplib reads and writes it, with bounds on bytes and time
// that the library does not have: its lines and its number of headers have none, and its times hold
// for each read.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <list>
#include <mutex>
#include <string>
#include <string_view>

// Last: it brings resolv.h, which has a macro _res that breaks Eigen.
#include <httplib.h>

namespace sunder {

/// A socket with a deadline. The head of a request is read up to `most_head` bytes.
class BoundedStream : public httplib::Stream {
 public:
  /// How the reading of a head went wrong.
  enum class HeadFault { none, too_long, too_slow };

  static constexpr std::size_t most_head = 16384;
  static constexpr std::chrono::seconds time_for_head{5}, time_for_next{60};

  explicit BoundedStream(socket_t socket) : socket_(socket) {}

  /// Waits for the first byte of a request, up to `time_for_next`; false where none comes. The rest
  /// of the head must then come within `time_for_head`.
  bool begin_head();
  /// The head has been read; its body of `size` bytes follows.
  void begin_body(std::uint64_t size);
  HeadFault head_fault() const { return fault_; }
  bool is_in_head() const { return in_head_; }
  /// Sends an answer of our own, once the library's is held back for a fault of the head.
  void send_after_fault(std::string_view answer);
  /// Closes the sending side and throws away arriving bytes for a while: a socket that is closed
  /// with bytes unread resets the connection, and the client loses the answer.
  void part();

  bool is_readable() const override { return true; }
  bool is_writable() const override { return true; }
  ssize_t read(char* to, size_t size) override;
  ssize_t write(const char* bytes, size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  socket_t socket() const override { return socket_; }

 private:
  using Clock = std::chrono::steady_clock;

  bool wait(short event, Clock::time_point until) const;
  ssize_t receive(char* to, size_t size);
  void hide_range(char& next);

  socket_t socket_;
  std::array<char, 4096> ahead_{};
  std::size_t at_ = 0, end_ = 0;
  Clock::time_point deadline_;
  bool in_head_ = false, at_line_begin_ = false;
  std::size_t head_bytes_ = 0;
  HeadFault fault_ = HeadFault::none;
};

/// The connections that are open. Each has a thread, and the number of threads is bounded. For each
/// connection beyond them, the one that waits longest is dropped; those without the token go first.
class Connections {
 public:
  struct Connection {
    socket_t socket;
    std::chrono::steady_clock::time_point since;  ///< the begin of its wait
    bool has_had_token = false;
    bool is_at_work = false;  ///< a request with the token: it is not dropped
    bool is_dropped = false;  ///< its thread is about to leave
  };
  using Entry = std::list<Connection>::iterator;

  /// The connection that arrived first has a thread now.
  Entry enter(socket_t socket);
  void begin_work(Entry entry);
  void end_work(Entry entry);
  /// Before the socket is closed: another may get its number.
  void leave(Entry entry);
  /// One more connection came, and there can be `most` threads. Those beyond are dropped: their
  /// reading and writing end, and their threads then leave. Where too few are open yet, the rest
  /// are dropped as they enter or end their work.
  void arrive(std::size_t most);
  void drop_all();

 private:
  void drop_those_beyond();

  std::mutex mutex_;
  std::list<Connection> open_;
  std::size_t without_thread_ = 0, most_ = 0;
};

}  // namespace sunder
