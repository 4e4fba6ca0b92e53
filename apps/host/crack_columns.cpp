// SPDX-License-Identifier: MIT
// Columns of what is drawn over the bodies: contacts, crack fronts, and the fans of a step.
#include <limits>

#include "apps/host/column.hpp"
#include "apps/host/engine.hpp"
#include "fracture/simulation/queries/poses.hpp"
#include "fracture/simulation/simulation_state.hpp"

namespace sunder {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

void add_contacts(Column& column, const Simulation& simulation) {
  for (const ContactEvent& event : contact_events(simulation)) {
    column.add_floats(event.place);
    column.add_floats(event.duration);
    column.add_floats(event.impulse);
    column.add_floats(0);
  }
}

/// Edges round which the two sides of one crack face meet: where a crack ends inside a body.
void add_crack_fronts(Column& column, const Cells& cells) {
  const VolumeMap& map = cells.map;
  for (std::size_t f = 0; f < 4 * map.tetrahedra(); ++f) {
    if (!is_crack_face(cells, HalfFaceId{f})) continue;
    for (std::size_t j = 0; j < 3; ++j) {
      const DartId dart{3 * f + j};
      DartId end = map.beta2(dart);
      while (!map.is_free(end)) end = map.beta2(map.beta3(end));
      const HalfFaceId other{end.index() / 3};
      if (f > other.index() || !is_crack_face(cells, other)) continue;
      const VertexId apex = map.vertex(map.beta0(dart)), other_apex = map.vertex(map.beta0(end));
      if (map.point_of_vertex(apex) != map.point_of_vertex(other_apex)) continue;
      column.add(map.vertex(dart).value);
      column.add(map.vertex(map.beta1(dart)).value);
    }
  }
}

void add_fan(Column& column, const MadeFan& fan) {
  const FanEvent& e = fan.event;
  const double first = e.components.created > 0 ? e.components.first_new.value : -1.0;
  column.add_doubles({fan.number, fan.time, static_cast<double>(e.vertex.value),
                      static_cast<double>(e.faces.size()),
                      static_cast<double>(e.components.predicted),
                      static_cast<double>(e.components.created), first, e.stress, e.strength,
                      e.normal[0], e.normal[1], e.normal[2], e.rest_position[0], e.rest_position[1],
                      e.rest_position[2], static_cast<double>(e.visited)});
}

void add_fan_face(Column& column, const FaceSplit& face, std::size_t fan) {
  column.add(face.face.value);
  column.add(face.did ? face.opposite.value : none);
  for (const VertexId v : face.vertices) column.add(face.did ? v.value : none);
  for (const VertexId v : face.vertices) {
    std::uint32_t copy = none;
    for (int i = 0; face.did && i < face.vertex_count; ++i) {
      const VertexCopy& split = face.split_vertices[static_cast<std::size_t>(i)];
      if (split.old_row == v) copy = split.new_row.value;
    }
    column.add(copy);
  }
  column.add(std::uint32_t{face.did ? face.split_edges : std::uint8_t{0}});
  column.add(std::uint32_t{oracle_says_new(face)});
  column.add(static_cast<std::uint32_t>(fan));
  column.add(std::uint32_t{0});
}

}  // namespace

void fill_marks(Column& column, const Simulation& simulation, sunder_column kind) {
  if (kind == SUNDER_CONTACT) return add_contacts(column, simulation);
  add_crack_fronts(column, simulation.state->cells);
}

void fill_fans(std::vector<unsigned char>& bytes, std::span<const MadeFan> fans,
               sunder_column kind) {
  Column column(bytes);
  for (std::size_t i = 0; i < fans.size(); ++i) {
    if (kind == SUNDER_FAN) {
      add_fan(column, fans[i]);
    } else {
      for (const FaceSplit& face : fans[i].event.faces) add_fan_face(column, face, i);
    }
  }
}

}  // namespace sunder
