// SPDX-License-Identifier: MIT
#include "apps/sunder/view/view_head.hpp"

#include <fmt/format.h>

#include <charconv>

#include "apps/sunder/view/view_requests.hpp"

namespace sunder {
namespace {

constexpr std::string_view api = "/api/";

/// A length as RFC 9110 has it: digits alone.
std::optional<std::uint64_t> number(std::string_view digits) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size()) return {};
  return value;
}

/// Two values of one header: two programs on the way may each take another for the true one.
bool is_ambiguous(const ViewRequestHead& head) {
  return head.hosts.size() > 1 || head.origins.size() > 1 || head.tokens.size() > 1 ||
         head.lengths.size() > 1;
}

bool is_from_own_page(const ViewRequestHead& head, int port) {
  const std::string own = fmt::format("127.0.0.1:{}", port);
  const std::string named = fmt::format("localhost:{}", port);
  if (head.hosts.empty() || (head.hosts[0] != own && head.hosts[0] != named)) return false;
  return head.origins.empty() || head.origins[0] == "http://" + own ||
         head.origins[0] == "http://" + named;
}

std::optional<ViewRefusal> refusal_of_page_file(const ViewRequestHead& head,
                                                const ViewRules& rules) {
  if (head.method != "GET" && head.method != "HEAD") {
    return ViewRefusal{405, "the page's files answer GET and HEAD\n"};
  }
  if (head.has_transfer_encoding || (!head.lengths.empty() && head.lengths[0] != "0")) {
    return ViewRefusal{400, "a request for a file of the page has no body\n"};
  }
  if (find_page_file(*rules.page, head.path) == nullptr) {
    return ViewRefusal{404, "the page has no such file\n"};
  }
  return {};
}

std::optional<ViewRefusal> refusal_of_work(const ViewRequestHead& head, const ViewRules& rules) {
  if (head.tokens.empty() || head.tokens[0] != rules.token) {
    return ViewRefusal{403, "sunder view answers its own page only\n"};
  }
  const std::string_view work = work_of(head.path);
  if (!is_view_work(work)) return ViewRefusal{404, "there is no such request\n"};
  if (head.method != "POST") return ViewRefusal{405, "requests to the engine are POST\n"};
  if (head.has_transfer_encoding || head.lengths.empty()) {
    return ViewRefusal{411, "a request to the engine says its Content-Length\n"};
  }
  const std::optional<std::uint64_t> size = number(head.lengths[0]);
  if (!size) return ViewRefusal{400, "Content-Length is a number of bytes\n"};
  if (*size > most_body(work)) {
    return ViewRefusal{413, fmt::format("the body of {} has at most {} bytes; these are {}\n", work,
                                        most_body(work), *size)};
  }
  return {};
}

}  // namespace

std::optional<ViewRefusal> refusal_of(const ViewRequestHead& head, const ViewRules& rules) {
  if (is_ambiguous(head)) return ViewRefusal{400, "a header stands twice in the request\n"};
  if (!is_from_own_page(head, rules.port)) {
    return ViewRefusal{403, "sunder view answers its own page only\n"};
  }
  return head.path.starts_with(api) ? refusal_of_work(head, rules)
                                    : refusal_of_page_file(head, rules);
}

std::uint64_t most_body(std::string_view work) {
  return work == "load" ? std::uint64_t{1} << 30 : std::uint64_t{1} << 16;
}

std::uint64_t body_size(const ViewRequestHead& head) {
  return head.lengths.empty() ? 0 : number(head.lengths[0]).value_or(0);
}

std::string_view work_of(std::string_view path) {
  return path.starts_with(api) ? path.substr(api.size()) : std::string_view();
}

}  // namespace sunder
