// SPDX-License-Identifier: MIT
// Manifolds against all axes, and by their required properties.
#include "mechanics/contact/shapes/manifold.hpp"

#include <catch2/catch.hpp>

#include <random>

using namespace sunder;

namespace {

class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}
  Vec3 point() { return {any_(random_), any_(random_), any_(random_)}; }
  double number() { return any_(random_); }

  Polytope tetrahedron(const Vec3& at) {
    for (;;) {
      std::array<Vec3, 4> c = {at + point(), at + point(), at + point(), at + point()};
      const double six = (c[1] - c[0]).cross(c[2] - c[0]).dot(c[3] - c[0]);
      if (std::abs(six) < 0.05) continue;
      if (six < 0) std::swap(c[2], c[3]);
      return make_tetrahedron(c);
    }
  }
  Polytope box(const Vec3& at) {
    const Eigen::Quaterniond q =
        Eigen::Quaterniond(number(), number(), number(), number()).normalized();
    return make_box(at, q.toRotationMatrix(), point().cwiseAbs() + Vec3::Constant(0.1));
  }
  Polytope solid(const Vec3& at) { return number() > 0 ? tetrahedron(at) : box(at); }

 private:
  std::mt19937 random_;
  std::uniform_real_distribution<double> any_{-1, 1};
};

/// m, how far a point is outside of a solid; negative: inside.
double outside(const Polytope& p, const Vec3& x) {
  double most = -1e9;
  for (std::size_t f = 0; f < p.kind->faces; ++f) {
    most = std::max(most, p.normal[f].dot(x - p.vertex[p.kind->face[f].vertex[0]]));
  }
  return most;
}

}  // namespace

TEST_CASE("two solids touch where no axis of all parts them, at the least depth", "[rubble]") {
  Draw draw(1);
  int touching = 0;
  for (int k = 0; k < 20000; ++k) {
    const Polytope a = draw.solid(Vec3::Zero()), b = draw.solid(1.5 * draw.point());
    const double truth = separation_by_all_axes(a, b);
    PairAxis axis;
    const Manifold m = collide(a, b, {}, axis);
    if (std::abs(truth) < 1e-9) continue;
    REQUIRE((m.count > 0) == (truth < 0));
    PairAxis kept = axis;
    const Manifold again = collide(a, b, {}, kept);
    REQUIRE(again.count == m.count);
    if (m.count == 0) continue;
    ++touching;
    double deepest = 0;
    for (int i = 0; i < m.count; ++i) {
      const Manifold::Point& p = m.point[static_cast<std::size_t>(i)];
      deepest = std::min(deepest, p.separation);
      CHECK(p.separation == Approx(m.normal.dot(p.on_a - p.on_b)).margin(1e-12));
      // Feet on either side lie along the normal from each other.
      CHECK((p.on_a - p.on_b - p.separation * m.normal).norm() < 1e-7);
      CHECK(std::min(outside(a, p.on_a), outside(b, p.on_b)) < 1e-9);
    }
    // Patches are cut by the sides of a face: their deepest point is no deeper than the solids,
    // but where a face is taken for an edge that is better by less than a hair.
    constexpr double hair = 5e-3;
    CHECK(deepest >= truth - hair);
    CHECK(deepest < 0);
    // Moved by the depth along the normal they part.
    Polytope moved = b;
    for (std::size_t v = 0; v < moved.kind->vertices; ++v) {
      moved.vertex[v] += (truth - hair) * m.normal;
    }
    CHECK(separation_by_all_axes(a, moved) > -1e-9);
  }
  CHECK(touching > 4000);
}

TEST_CASE("what may come nearer is found before it touches, what goes away is not", "[rubble]") {
  const Polytope a = make_box({0, 0, 2.1}, Mat3::Identity(), {1, 1, 1});
  const Polytope b = make_box({0, 0, 0}, Mat3::Identity(), {1, 1, 1});
  PairAxis axis;
  CHECK(collide(a, b, {}, axis).count == 0);
  CHECK(collide(a, b, {Vec3(0, 0, -0.2), 0}, axis).count == 4);
  CHECK(collide(a, b, {Vec3(0, 0, 0.2), 0}, axis).count == 0);
  CHECK(collide(a, b, {Vec3(0.5, 0, 0), 0}, axis).count == 0);
  CHECK(collide(a, b, {Vec3(0, 0, 0), 0.15}, axis).count == 4);
  const Manifold m = collide(a, b, {Vec3(0, 0, -0.2), 0}, axis);
  CHECK((m.normal - Vec3(0, 0, 1)).norm() < 1e-12);
  CHECK(m.point[0].separation == Approx(0.1));
}

TEST_CASE("faces inside of a body push nothing", "[rubble]") {
  const std::array<Vec3, 4> right = {Vec3(0, -1, 0), Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, -1)};
  const std::array<Vec3, 4> chip = {Vec3(-0.02, 0, -0.4), Vec3(-1, 0.4, -0.4), Vec3(-1, -0.3, -0.5),
                                    Vec3(-1, 0, -0.1)};
  const Polytope beside = make_tetrahedron(chip);
  PairAxis axis;
  const Approach near{Vec3::Zero(), 0.05};
  // The chip's tip is before the face x = 0, which is opposite vertex 2.
  const Manifold open = collide(beside, make_tetrahedron(right), near, axis);
  REQUIRE(open.count > 0);
  CHECK(open.normal[0] < -0.9);
  axis = {};
  CHECK(collide(beside, make_tetrahedron(right, 15u & ~4u), near, axis).count == 0);
}

TEST_CASE("balls meet solids at their nearest points", "[rubble]") {
  Draw draw(3);
  int touching = 0;
  for (int k = 0; k < 5000; ++k) {
    const Polytope b = draw.solid(Vec3::Zero());
    const Vec3 centre = 1.8 * draw.point();
    const double radius = 0.3;
    const Manifold m = collide_ball(centre, radius, b, {});
    // By rays: the nearest point of a convex solid, by projections onto it in turn.
    const double out = outside(b, centre);
    if (out < 0) {
      REQUIRE(m.count == 1);
      CHECK(m.point[0].separation == Approx(out - radius));
      continue;
    }
    if (m.count == 0) {
      CHECK(out > -1e-12);
      continue;
    }
    ++touching;
    const Manifold::Point& p = m.point[0];
    CHECK(outside(b, p.on_b) < 1e-9);
    CHECK((centre - p.on_b).norm() - radius == Approx(p.separation).margin(1e-9));
    // No vertex nor mixture of vertices is nearer: the solid lies behind the plane there.
    for (std::size_t v = 0; v < b.kind->vertices; ++v) {
      CHECK(m.normal.dot(b.vertex[v] - p.on_b) < 1e-9);
    }
  }
  CHECK(touching > 200);
}
