// SPDX-License-Identifier: MIT
// The server of `sunder view` on this machine's own address.
#pragma once

#include <memory>
#include <string>

#include "apps/sunder/view/page_files.hpp"
#include "apps/sunder/view/view_requests.hpp"

namespace sunder {

/// Answers requests for the page's files and to the engine (`refusal_of` says which). All sizes and
/// times are bounded: a head has 16 KiB and five seconds, a body `most_body` and the time that its
/// size needs on a slow line, an answer the same time. Requests that are refused are answered from
/// their head. Each connection has a thread. When there are as many as may be (256, or half of the
/// files that the process may open), the one that waits longest is dropped for a new one.
class ViewServer {
 public:
  /// `viewed` outlives the server. Throws std::system_error where the system gives no thread.
  ViewServer(ViewedScene& viewed, PageFiles page, std::string token);
  ~ViewServer();

  /// Takes a port of 127.0.0.1, for 0 a free one, and gives it; 0 where it cannot be had.
  /// Connections wait from now on.
  int bind(int port);
  /// Answers until the system gives no more connections.
  void serve();

 private:
  class Http;
  std::unique_ptr<Http> http_;
};

}  // namespace sunder
