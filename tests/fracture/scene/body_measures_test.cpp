// SPDX-License-Identifier: MIT
// Measures of boxes with known numbers.
#include "fracture/scene/body_measures.hpp"

#include <catch2/catch.hpp>

#include "topology/suite/fixtures/shapes.hpp"

using namespace sunder;

namespace {

BodySettings box(std::array<int, 3> cells) {
  BodySettings body;
  body.mesh = suite::kuhn_box(cells, 0.1);
  body.translation = {1, 2, 3};
  body.rotation = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 2).normalized());
  return body;
}

}  // namespace

TEST_CASE("a box turned and moved has the measures of a box", "[fracture][settings]") {
  const BodySettings body = box({6, 3, 2});
  const BodyMeasures m = measure(body);
  CHECK(m.volume == Approx(0.036));
  CHECK(m.cell == Approx(0.1));
  CHECK(m.extent == Approx(0.7));
  const Vec3 centre = body.rotation * Vec3(0.3, 0.15, 0.1) + body.translation;
  CHECK((m.centre - centre).norm() < 1e-12);
  CHECK(m.box.contains(centre));
  CHECK(m.outside.size() == 2 * 2 * (18 + 12 + 6));
  CHECK(m.wave_speed == Approx(compression_wave_speed(body.material)));
  CHECK(m.strength == body.material.tensile_strength);
  CHECK(measure(box({20, 2, 2})).slenderness == Approx(10));
  CHECK(measure(box({7, 1, 2})).slenderness == Approx(7));  // whatever the layers
}

TEST_CASE("layers are counted through the thin side, whatever its turn", "[fracture][settings]") {
  for (const int layers : {1, 2, 3, 5}) {
    const BodySettings body = box({12, layers, 11});
    CHECK(layers_through(body, measure(body)) == Approx(layers));
  }
}
