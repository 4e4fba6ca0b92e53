// SPDX-License-Identifier: MIT
// Which requests are answered: decided from the head of a request, before any of its body is read.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/sunder/view/page_files.hpp"

namespace sunder {

/// The parts of a request's head that decide on it. A header that comes several times has several
/// values.
struct ViewRequestHead {
  std::string method, path;
  std::vector<std::string> hosts, origins, tokens, lengths;
  /// Its body has Transfer-Encoding, which says no length.
  bool has_transfer_encoding = false;
};

/// The server's own address and token, with which requests are compared.
struct ViewRules {
  int port = 0;
  std::string token;
  const PageFiles* page = nullptr;
};

/// Why a request is not answered: an HTTP status from 400 on, and words for people.
struct ViewRefusal {
  int status = 400;
  std::string words;
};

/// The refusal of a request, or nothing where it is answered. Every request needs this server's
/// Host and no other page's Origin (403). GET and HEAD reach the page's files, without a body
/// (400). POST reaches the requests to the engine, "/api/" and their word, with the token (403) and
/// a Content-Length (411) that is a number (400) up to `most_body` (413). Other methods: 405, other
/// paths: 404.
std::optional<ViewRefusal> refusal_of(const ViewRequestHead& head, const ViewRules& rules);

/// The largest body of a request to the engine, in bytes: 1 GiB for "load", which brings the files
/// that were dropped on the page, else 64 KiB.
std::uint64_t most_body(std::string_view work);

/// The bytes of a body as the head of an answered request says; 0 without a body.
std::uint64_t body_size(const ViewRequestHead& head);

/// "step" of "/api/step"; empty for the page's files.
std::string_view work_of(std::string_view path);

}  // namespace sunder
