// SPDX-License-Identifier: MIT
// Levels of refinement, in which green tetrahedra are made again rather than divided.
#include "topology/cells/refine.hpp"

#include <algorithm>
#include <set>

namespace sunder {
namespace {

constexpr std::size_t divided_red = static_cast<std::size_t>(-1);

/// Where a tetrahedron comes from: for a green one the level that made it and its parent's row
/// before; and the tetrahedron of the beginning.
struct Origin {
  std::size_t level = divided_red;
  TetId parent;
  TetId root;
  /// One of eight: its corners are ordered so that few classes of shapes arise.
  bool is_one_of_eight = false;
};

/// Tetrahedra that divided into other than eight gave their children the origin `level`.
void note_origins(std::vector<Origin>& origins, const CellEdit& edit, std::size_t level) {
  for (std::size_t i = 0, end = 0; i < edit.cells.size(); i = end) {
    while (end < edit.cells.size() && edit.cells[end].parent == edit.cells[i].parent) ++end;
    const TetId root = origins[edit.cells[i].parent.index()].root;
    const Origin origin = end - i == 8 ? Origin{divided_red, {}, root, true}
                                       : Origin{level, edit.cells[i].parent, root};
    for (std::size_t k = i; k < end; ++k) {
      const std::size_t row = edit.cells[k].tetrahedron.index();
      if (row >= origins.size()) origins.resize(row + 1);
      origins[row] = origin;
    }
  }
}

class Levels {
 public:
  Levels(VolumeMap& map, std::size_t levels, const WantedCells& wanted, std::size_t most)
      : map_(map), wanted_(wanted), most_(most), forced_(levels) {
    origins_.emplace_back();
    for (std::size_t t = 0; t < map.tetrahedra(); ++t)
      origins_[0].push_back({divided_red, {}, TetId{t}});
    while (done_.size() < levels && make_next()) {
    }
  }

  std::vector<RefinedLevel> done() && { return std::move(done_); }

 private:
  /// False: it would be too many tetrahedra.
  bool make_next() {
    const std::size_t level = done_.size();
    std::set<TetId> marked = forced_[level];
    for (std::size_t t = 0; t < map_.tetrahedra(); ++t) {
      if (wanted_(map_, TetId{t}, origins_[level][t].root)) marked.insert(TetId{t});
    }
    const std::vector<TetId> list(marked.begin(), marked.end());
    if (map_.tetrahedra() + 7 * list.size() > most_) return false;
    std::vector<char> as_they_stand;
    for (const Origin& from : origins_[level]) as_they_stand.push_back(from.is_one_of_eight);
    RefinedLevel made = refine_marked(map_, list, as_they_stand);
    std::size_t back = divided_red;  // the lowest level on which a green one was divided
    for (const ChildCell& cell : made.edit.cells) {
      back = std::min(back, origins_[level][cell.parent.index()].level);
    }
    if (back == divided_red) {
      origins_.push_back(origins_[level]);
      note_origins(origins_.back(), made.edit, level);
      done_.push_back(std::move(made));
      return true;
    }
    for (const ChildCell& cell : made.edit.cells) {
      const Origin& from = origins_[level][cell.parent.index()];
      if (from.level == back) forced_[back].insert(from.parent);
    }
    map_.apply(made.edit.undo);
    while (done_.size() > back) {
      map_.apply(done_.back().edit.undo);
      done_.pop_back();
      origins_.pop_back();
    }
    for (std::size_t k = back + 1; k < forced_.size(); ++k) forced_[k].clear();
    return true;
  }

  VolumeMap& map_;
  const WantedCells& wanted_;
  const std::size_t most_;
  std::vector<std::set<TetId>> forced_;       // of each level: parents of green ones to be divided
  std::vector<std::vector<Origin>> origins_;  // before each level
  std::vector<RefinedLevel> done_;
};

}  // namespace

std::vector<RefinedLevel> refine(VolumeMap& map, std::size_t levels, const WantedCells& wanted,
                                 std::size_t most) {
  return Levels(map, levels, wanted, most).done();
}

}  // namespace sunder
