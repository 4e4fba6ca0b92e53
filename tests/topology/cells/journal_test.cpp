// SPDX-License-Identifier: MIT
// Contents of a journal, forgotten and refused steps; random_cells_test checks that bytes come
// back.
#include "topology/cells/journal.hpp"

#include <set>

#include "tests/support/built.hpp"
#include "topology/cells/subdivide.hpp"

using namespace sunder;
using namespace sunder::suite;
using namespace sunder::test;

TEST_CASE("a journal: undone in order, done again, forgotten after something new",
          "[topology][cells]") {
  for (const MapKernel kernel : {MapKernel::dense, MapKernel::lcc}) {
    VolumeMap map = built(two_tetrahedra());
    map.set_kernel(kernel);
    Journal journal;
    CHECK_FALSE(undo(map, journal));
    CHECK_FALSE(redo(map, journal));
    const Cells5 at_first = cells(map);
    enter(journal, insert_vertex(map, {TetId{0}, 0}).undo);
    const Cells5 divided = cells(map);
    const FaceSplit split = split_face(map, face_on(map, {1, 2, 5}), journal);
    REQUIRE(split.did);
    const Cells5 apart = cells(map);
    CHECK(apart != divided);
    REQUIRE(undo(map, journal));
    CHECK(cells(map) == divided);
    REQUIRE(undo(map, journal));
    CHECK(cells(map) == at_first);
    CHECK_FALSE(undo(map, journal));
    REQUIRE(redo(map, journal));
    CHECK(cells(map) == divided);
    REQUIRE(redo(map, journal));
    CHECK(cells(map) == apart);
    REQUIRE(undo(map, journal));
    enter(journal, insert_vertex(map, {TetId{1}, 5}).undo);
    CHECK_FALSE(redo(map, journal));
    CHECK(journal.undo.size() == 2);
  }
}

TEST_CASE("a face on the boundary does not split and is not entered", "[topology][cells]") {
  VolumeMap map = built(two_tetrahedra());
  Journal journal;
  CHECK_FALSE(split_face(map, face_on(map, {0, 1, 3}), journal).did);
  CHECK(journal.undo.empty());
}

TEST_CASE("what a split enters names each tetrahedron once", "[topology][cells]") {
  VolumeMap map = built(kuhn_box({2, 2, 2}));
  Journal journal;
  for (const HalfFaceId f : interior_faces(map)) {
    REQUIRE(split_face(map, f, journal).did);
    std::set<TetId> rows;
    for (const CellChange::Cell& cell : journal.undo.back().cells) rows.insert(cell.row);
    CHECK(rows.size() == journal.undo.back().cells.size());
  }
}
