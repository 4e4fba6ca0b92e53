// SPDX-License-Identifier: MIT
// CGAL's managed unsew<3> on the darts of a map.
#include "topology/suite/kernels/managed_unsew.hpp"

#include <time.h>

#include "topology/kernel/dart_map.hpp"

namespace sunder::suite {
namespace {

MapRows rows_of(const VolumeMap& map) {
  MapRows rows;
  rows.corners.assign(map.corners().begin(), map.corners().end());
  rows.neighbours.assign(map.neighbours().begin(), map.neighbours().end());
  rows.points.assign(map.points().begin(), map.points().end());
  rows.point_of_vertex.assign(map.point_of_vertex().begin(), map.point_of_vertex().end());
  return rows;
}

double thread_us() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e6 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_nsec);
}

}  // namespace

double managed_unsew_us(const VolumeMap& map, std::span<const HalfFaceId> faces) {
  DartMap darts(rows_of(map));
  DartComplex& complex = darts.complex();
  complex.set_automatic_attributes_management(true);
  const double start = thread_us();
  for (const HalfFaceId f : faces) {
    complex.unsew<3>(darts.dart_at(tetrahedron_of(f), 3 * place_of(f)));
  }
  return (thread_us() - start) / static_cast<double>(faces.size());
}

}  // namespace sunder::suite
