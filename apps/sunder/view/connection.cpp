// SPDX-License-Identifier: MIT
#include "apps/sunder/view/connection.hpp"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <tuple>

namespace sunder {
namespace {

using std::chrono::seconds;

/// Time for a whole body or answer: slow lines (ssh from afar) bring 256 KiB in a second.
seconds time_for(std::uint64_t bytes) {
  return seconds(10) + seconds(static_cast<std::int64_t>(bytes >> 18));
}

constexpr seconds time_to_part{2};

bool may_come_later(ssize_t result) {
  return result < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR);
}

}  // namespace

bool BoundedStream::wait(short event, Clock::time_point until) const {
  while (true) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now()).count();
    if (left <= 0) return false;
    pollfd one{socket_, event, 0};
    const int ready = poll(&one, 1, static_cast<int>(left));
    if (ready > 0) return true;  // also where the connection has ended: the next call says so
    if (ready < 0 && errno != EINTR) return false;
  }
}

bool BoundedStream::begin_head() {
  in_head_ = true;
  at_line_begin_ = false;
  head_bytes_ = 0;
  if (at_ == end_ && !wait(POLLIN, Clock::now() + time_for_next)) return false;
  deadline_ = Clock::now() + time_for_head;
  return true;
}

void BoundedStream::begin_body(std::uint64_t size) {
  in_head_ = false;
  deadline_ = Clock::now() + time_for(size);
}

ssize_t BoundedStream::receive(char* to, size_t size) {
  while (true) {
    const ssize_t got = recv(socket_, to, size, MSG_DONTWAIT);
    if (!may_come_later(got)) return got;
    if (wait(POLLIN, deadline_)) continue;
    if (in_head_) fault_ = HeadFault::too_slow;
    return -1;
  }
}

/// The library reads the header Range by a regular expression that calls itself for each character,
/// before it asks anybody: one of 8 kB overflows a stack of 4 MB. It shall not find it. No header
/// that begins with R is known here.
void BoundedStream::hide_range(char& next) {
  if (at_line_begin_ && (next == 'R' || next == 'r')) next = '-';
  at_line_begin_ = next == '\n';
}

ssize_t BoundedStream::read(char* to, size_t size) {
  if (fault_ != HeadFault::none) return -1;
  // One that sends byte by byte never waits long.
  if (in_head_ && Clock::now() > deadline_) fault_ = HeadFault::too_slow;
  if (in_head_ && ++head_bytes_ > most_head) fault_ = HeadFault::too_long;
  if (fault_ != HeadFault::none) return -1;
  if (!in_head_ && Clock::now() > deadline_) return -1;
  if (at_ == end_) {
    if (!in_head_ && size >= ahead_.size()) return receive(to, size);
    const ssize_t got = receive(ahead_.data(), ahead_.size());
    if (got <= 0) return got;
    at_ = 0;
    end_ = static_cast<std::size_t>(got);
  }
  // The library reads heads byte by byte, so that bytes counted are reads counted.
  const std::size_t given = in_head_ ? 1 : std::min(size, end_ - at_);
  std::memcpy(to, ahead_.data() + at_, given);
  at_ += given;
  if (in_head_) hide_range(*to);
  return static_cast<ssize_t>(given);
}

ssize_t BoundedStream::write(const char* bytes, size_t size) {
  if (fault_ != HeadFault::none) return static_cast<ssize_t>(size);
  const Clock::time_point until = Clock::now() + time_for(size);
  for (std::size_t sent = 0; sent < size;) {
    const ssize_t more = send(socket_, bytes + sent, size - sent, MSG_DONTWAIT | MSG_NOSIGNAL);
    if (more > 0) {
      sent += static_cast<std::size_t>(more);
    } else if (!may_come_later(more)) {
      return -1;
    }
    // One that takes a byte now and then never waits long.
    if (sent < size && (Clock::now() > until || !wait(POLLOUT, until))) return -1;
  }
  return static_cast<ssize_t>(size);
}

void BoundedStream::send_after_fault(std::string_view answer) {
  // Short: the socket has room for it, or the client takes nothing.
  send(socket_, answer.data(), answer.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
}

void BoundedStream::part() {
  shutdown(socket_, SHUT_WR);
  deadline_ = Clock::now() + time_to_part;
  while (Clock::now() < deadline_ && receive(ahead_.data(), ahead_.size()) > 0) {
  }
}

void BoundedStream::get_remote_ip_and_port(std::string& ip, int& port) const {
  ip = "127.0.0.1";  // nobody else can reach the server
  port = 0;
}

void BoundedStream::get_local_ip_and_port(std::string& ip, int& port) const {
  get_remote_ip_and_port(ip, port);
}

void Connections::arrive(std::size_t most) {
  const std::lock_guard lock(mutex_);
  ++without_thread_;
  most_ = most;
  drop_those_beyond();
}

Connections::Entry Connections::enter(socket_t socket) {
  const std::lock_guard lock(mutex_);
  --without_thread_;
  const Entry entry =
      open_.insert(open_.end(), {.socket = socket, .since = std::chrono::steady_clock::now()});
  drop_those_beyond();
  return entry;
}

void Connections::begin_work(Entry entry) {
  const std::lock_guard lock(mutex_);
  entry->has_had_token = entry->is_at_work = true;
}

void Connections::end_work(Entry entry) {
  const std::lock_guard lock(mutex_);
  entry->is_at_work = false;
  entry->since = std::chrono::steady_clock::now();
  drop_those_beyond();
}

void Connections::leave(Entry entry) {
  const std::lock_guard lock(mutex_);
  open_.erase(entry);
}

void Connections::drop_those_beyond() {
  const auto rank = [](const Connection& c) {
    return std::tuple(c.is_dropped || c.is_at_work, c.has_had_token, c.since);
  };
  const auto leaving =
      static_cast<std::size_t>(std::ranges::count_if(open_, &Connection::is_dropped));
  for (std::size_t left = without_thread_ + open_.size() - leaving; left > most_; --left) {
    const auto longest = std::ranges::min_element(open_, {}, rank);
    if (longest == open_.end() || longest->is_dropped || longest->is_at_work) return;
    shutdown(longest->socket, SHUT_RDWR);
    longest->is_dropped = true;
  }
}

void Connections::drop_all() {
  const std::lock_guard lock(mutex_);
  for (const Connection& c : open_) shutdown(c.socket, SHUT_RDWR);
}

}  // namespace sunder
