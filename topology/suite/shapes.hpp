// SPDX-License-Identifier: MIT
// Generators of the meshes that tests run on; all volumes positive unless said otherwise.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "topology/tet_mesh.hpp"

namespace sunder::suite {

/// Number of cubes along each axis.
using Cells = std::array<int, 3>;

/// Row of grid point (i, j, k) of a box of cubes: (k (ny + 1) + j) (nx + 1) + i.
std::uint32_t grid_point(const Cells& cells, int i, int j, int k);

/// A box of cubes with edge length `cell` (m), each cut into its 6 Kuhn tetrahedra: the monotone
/// paths from its lowest to its highest corner. 6 nx ny nz tetrahedra.
TetMesh kuhn_box(const Cells& cells, double cell = 1.0);

/// The same with only the cubes that `keep(i, j, k)` lets stand. Points are not renumbered: those
/// that no cube needs stay, unused.
TetMesh kuhn_cubes(const Cells& cells, const std::function<bool(int, int, int)>& keep,
                   double cell = 1.0);

/// A flat ring: a box less the inside of its outline in x and y. ring({3, 3, 1}) is figure 4's.
TetMesh ring(const Cells& cells, double cell = 1.0);
/// A box less its inside: a cavity that touches no face.
TetMesh shell(const Cells& cells, double cell = 1.0);
/// 3 x 3 x 3 cubes less two channels along x and y that cross in the middle. b1 = 3.
TetMesh crossing_channels();

/// k tetrahedra round the edge 0-1; rim points 2, 3, ... Closed needs k >= 3 (one turn).
TetMesh closed_fan(int k);
TetMesh open_fan(int k);
/// Eight tetrahedra: centre 0, equator 1 to 4, poles 5 and 6.
TetMesh octahedron_star();
TetMesh one_tetrahedron();
/// {0 1 2 3} and {1 0 2 4}, one common face.
TetMesh two_tetrahedra();
TetMesh two_tetrahedra_sharing_an_edge();
TetMesh two_tetrahedra_sharing_a_vertex();

/// A bar of k x 1 x 1 cubes bent into a full turn, its ends touching without being joined; then
/// every point (k, y, z) listed in `joined` becomes the point (0, y, z).
TetMesh bent_bar(int k, const std::vector<std::array<int, 2>>& joined);
/// The ends of a bent bar joined whole: a ring; with a twist (k, y, z) ~ (0, z, y) it is not
/// orientable, and its volumes at the seam mean nothing.
TetMesh joined_ring(int k, bool twisted);
/// The five tetrahedra of the boundary of the 4-simplex: closed, no boundary; one volume is
/// necessarily negative in space.
TetMesh closed_simplex_boundary();

/// Bodies side by side in one mesh.
TetMesh side_by_side(const TetMesh& a, const TetMesh& b);
/// Moves each point by up to `amplitude` (m) along each axis.
TetMesh jittered(TetMesh mesh, double amplitude, std::uint64_t seed);
/// The same body with points and tetrahedra in another order and corners evenly permuted.
TetMesh shuffled(const TetMesh& mesh, std::uint64_t seed);

/// A number below `end`, the same on every machine (std's distributions are not).
std::size_t below(std::mt19937_64& random, std::size_t end);
/// A number in [0, 1).
double unit(std::mt19937_64& random);

struct NamedMesh {
  std::string name;
  TetMesh mesh;
};

/// Bodies of many topologies, 1 to 384 tetrahedra, for tests that hold for every body. All can be
/// built with warnings allowed (`bad_volume`).
std::vector<NamedMesh> all_shapes();

}  // namespace sunder::suite
