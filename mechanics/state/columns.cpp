// SPDX-License-Identifier: MIT
// Growth of the vertex columns at a split.
#include "mechanics/state/columns.hpp"

#include "topology/base/assert.hpp"

namespace sunder {

VertexId append_copy(VertexColumns& vertices, VertexId from) {
  SUNDER_ASSERT(from.index() < vertices.size(), "append_copy: no such vertex row");
  const auto repeat = [row = from.index()](auto& column) {
    const auto value = column[row];  // a copy: push_back may move the column away
    column.push_back(value);
  };
  const VertexId copy{vertices.size()};
  repeat(vertices.rest_position);
  repeat(vertices.position);
  repeat(vertices.velocity);
  repeat(vertices.mass);
  repeat(vertices.component);
  repeat(vertices.displacement);
  repeat(vertices.displacement_rate);
  repeat(vertices.displacement_acceleration);
  repeat(vertices.support);
  return copy;
}

}  // namespace sunder
