// SPDX-License-Identifier: MIT
// Keys of a body from which the reader of scene files makes its mesh: a simple solid, or the unit
// and scale of a file. The simulation knows the mesh alone.
#pragma once

#include <cstdint>
#include <optional>
#include <variant>

#include "apps/scene/reading/length_unit.hpp"
#include "fracture/scene/scene_fields.hpp"

namespace sunder {

struct BoxShape {
  Eigen::Vector3d size = {1, 1, 1};  ///< m
};
struct PlateShape {
  double width = 1, length = 1, thickness = 0.1;  ///< m, along x, y and z
  std::uint32_t layers = 3;
};
struct CylinderShape {
  double radius = 0.5, height = 1;  ///< m
};
struct TubeShape {
  double inner_radius = 0.4, outer_radius = 0.5, height = 1;  ///< m
};
struct BallShape {
  double radius = 0.5;  ///< m
};

/// A solid without a mesh file, about the origin.
struct ShapeSettings {
  std::variant<BoxShape, PlateShape, CylinderShape, TubeShape, BallShape> solid;
  /// m, the edge of a cube of six tetrahedra; it replaces `tetrahedra`.
  std::optional<double> cell;
  /// Their number, to come near to.
  std::uint32_t tetrahedra = 4000;
};

/// Metres per unit of a mesh file: the unit's times `scale`.
struct FileScale {
  LengthUnit units = LengthUnit::m;
  double scale = 1;
};

inline double metres_of(const FileScale& file) { return metres_of(file.units) * file.scale; }

namespace fields {

inline const Names<LengthUnit>& names_of(LengthUnit) {
  static const Names<LengthUnit> names = [] {
    Names<LengthUnit> all;
    for (const LengthUnitTraits& traits : length_units) all.emplace_back(traits.unit, traits.name);
    return all;
  }();
  return names;
}

template <class V>
void describe(V& v, BoxShape& b) {
  v.field(Key{"size", "m", "Lengths along x, y and z", above(0), true}, b.size);
}
template <class V>
void describe(V& v, PlateShape& p) {
  v.field(Key{"width", "m", "Length along x", above(0), true}, p.width);
  v.field(Key{"length", "m", "Length along y", above(0), true}, p.length);
  v.field(Key{"thickness", "m", "Length along z", above(0), true}, p.thickness);
  v.field(Key{"layers", "",
              "Layers of cells through the thickness; cells are as flat as that makes them",
              between(1, 1000)},
          p.layers);
}
template <class V>
void describe(V& v, CylinderShape& c) {
  v.field(Key{"radius", "m", "Radius", above(0), true}, c.radius);
  v.field(Key{"height", "m", "Length along z", above(0), true}, c.height);
}
template <class V>
void describe(V& v, TubeShape& t) {
  v.field(Key{"inner_radius", "m", "Radius of the hole", above(0), true}, t.inner_radius);
  v.field(Key{"outer_radius", "m", "Radius of the tube", above(0), true}, t.outer_radius);
  v.field(Key{"height", "m", "Length along z", above(0), true}, t.height);
}
template <class V>
void describe(V& v, BallShape& b) {
  v.field(Key{"radius", "m", "Radius", above(0), true}, b.radius);
}

template <class V>
void describe(V& v, ShapeSettings& s) {
  v.alternative(Key{"box", "", "A box"}, BoxShape{}, s.solid);
  v.alternative(Key{"plate", "", "A flat box with a number of layers of its own"}, PlateShape{},
                s.solid);
  v.alternative(Key{"cylinder", "", "A cylinder about the z axis"}, CylinderShape{}, s.solid);
  v.alternative(Key{"tube", "", "A tube about the z axis"}, TubeShape{}, s.solid);
  v.alternative(Key{"sphere", "", "A ball"}, BallShape{}, s.solid);
  v.field(
      Key{"cell", "m",
          "Size of cells: the edge of a cube of six tetrahedra. It replaces tetrahedra", above(0)},
      s.cell);
  v.field(Key{"tetrahedra", "", "Number of tetrahedra to come near to", between(1, 1e8)},
          s.tetrahedra);
}

template <class V>
void describe(V& v, FileScale& f) {
  v.field(Key{"units", "", "Unit of length of the mesh file"}, f.units);
  v.field(Key{"scale", "",
              "Factor of the coordinates of the mesh file, after its unit. The mesh's own "
              "coordinates of other keys are those after both",
              above(0)},
          f.scale);
}

inline Key shape_key() {
  return {"shape", "",
          "A simple solid in place of a mesh file, with its middle at the origin of its own "
          "coordinates"};
}

}  // namespace fields
}  // namespace sunder
