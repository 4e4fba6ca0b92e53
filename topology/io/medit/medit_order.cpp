// SPDX-License-Identifier: MIT
// Places of nodes: corners by a table, the others as means of corners.
#include "topology/io/medit/medit_order.hpp"
#include "topology/base/split_text.hpp"

#include <algorithm>
#include <string>

namespace sunder::io {
namespace {

/// `corners`: the numbers of each, a digit each. `means`: for each other node the corners that it
/// is the mean of.
struct Shape {
  CellKind kind;
  const char* corners;
  const char* means;
};
constexpr Shape shapes[] = {
    {CellKind::edge3, "0 2", "01"},
    {CellKind::triangle6, "200 020 002", "01 12 20"},
    {CellKind::quad9, "00 20 22 02", "01 12 23 30 0123"},
    {CellKind::tetrahedron10, "2000 0200 0020 0002", "01 12 20 03 13 23"},
    {CellKind::hexahedron27, "000 200 220 020 002 202 222 022",
     "01 12 23 30 45 56 67 74 04 15 26 37 0473 1265 0154 3267 0123 4567 01234567"},
    {CellKind::prism18, "2000 0200 0020 2002 0202 0022",
     "01 12 20 34 45 53 03 14 25 0143 1254 2035"},
    {CellKind::pyramid14, "000 200 220 020 002", "01 12 23 30 04 14 24 34 0123"},
};

}  // namespace

const MeditOrder* medit_order_of(CellKind kind) {
  const auto* const found = std::ranges::find(medit_orders, kind, &MeditOrder::kind);
  return found == std::end(medit_orders) ? nullptr : found;
}

bool needs_medit_order(CellKind kind) {
  return medit_order_of(kind) != nullptr && !is_simplex(linear_kind(kind));
}

std::vector<BezierPlace> bezier_places(CellKind kind) {
  const Shape& shape = *std::ranges::find(shapes, kind, &Shape::kind);
  std::vector<BezierPlace> places;
  for (const std::string_view word : split_text(shape.corners, ' ')) {
    BezierPlace& place = places.emplace_back();
    for (std::size_t k = 0; k < word.size(); ++k) place[k] = word[k] - '0';
  }
  for (const std::string_view word : split_text(shape.means, ' ')) {
    BezierPlace mean{};
    for (const char corner : word) {
      const BezierPlace& place = places[static_cast<std::size_t>(corner - '0')];
      for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += place[k];
    }
    for (std::int64_t& number : mean) number /= static_cast<std::int64_t>(word.size());
    places.push_back(mean);
  }
  return places;
}

std::optional<std::vector<std::uint8_t>> order_of_places(CellKind kind,
                                                         std::span<const BezierPlace> places) {
  const std::vector<BezierPlace> ours = bezier_places(kind);
  if (places.size() != ours.size()) return std::nullopt;
  std::vector<std::uint8_t> order;
  std::vector<bool> is_taken(ours.size(), false);
  for (const BezierPlace& place : places) {
    const auto node = static_cast<std::size_t>(std::ranges::find(ours, place) - ours.begin());
    if (node == ours.size() || is_taken[node]) return std::nullopt;
    is_taken[node] = true;
    order.push_back(static_cast<std::uint8_t>(node));
  }
  return order;
}

}  // namespace sunder::io
