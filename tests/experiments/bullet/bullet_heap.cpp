// SPDX-License-Identifier: MIT
// `bullet_heap SEED SECONDS PER_SECOND [MARGIN mm] [sat|gjk] [ours a second]`: the same chips by
// the rubble solver and by Bullet in double, in one run. Not part of the build:
// docs/lab/rubble_measured.md has the line that compiles it.
#include <btBulletDynamicsCommon.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "tests/experiments/rubble/outside_judge.hpp"
#include "tests/experiments/rubble/rubble_scenes.hpp"
#include "tests/experiments/rubble/thread_clock.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

/// Lengths in Bullet's world for each metre: its threshold of contacts is 2 cm, whatever their
/// size.
constexpr double scale = 100;

btVector3 to_bullet(const Vec3& x) { return {x[0], x[1], x[2]}; }

/// How Bullet is asked.
struct BulletWay {
  double margin = 1e-4;  ///< m; hulls are made smaller by it, so that with it they are the chips
  bool sat = false;      ///< clipped faces in place of points from GJK
};

struct Bullet {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  std::vector<std::unique_ptr<btRigidBody>> bodies;
  std::vector<std::array<Vec3, 4>> corners;  ///< m, in the body's principal axes

  Bullet(const RubbleScene& scene, const BulletWay& way) {
    world.setGravity({0, 0, -9.81 * scale});
    world.getDispatchInfo().m_enableSatConvex = way.sat;
    auto plane = std::make_unique<btStaticPlaneShape>(btVector3(0, 0, 1), 0);
    plane->setMargin(0);
    add(std::move(plane), 0, {0, 0, 0}, btTransform::getIdentity(), scene.bodies[0].friction);
    for (const RubbleShape& shape : scene.shapes) {
      if (shape.kind == RubbleShape::Kind::tetrahedron) add_chip(scene, shape, way);
    }
  }
  ~Bullet() {
    for (const auto& body : bodies) world.removeRigidBody(body.get());
  }

  btRigidBody& add(std::unique_ptr<btCollisionShape> shape, double mass, const btVector3& inertia,
                   const btTransform& pose, double friction) {
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shape.get(), inertia);
    info.m_startWorldTransform = pose;
    info.m_friction = std::sqrt(friction);  // Bullet multiplies the two.
    bodies.push_back(std::make_unique<btRigidBody>(info));
    shapes.push_back(std::move(shape));
    world.addRigidBody(bodies.back().get());
    return *bodies.back();
  }

  void add_chip(const RubbleScene& scene, const RubbleShape& shape, const BulletWay& way) {
    const RubbleBody& b = scene.bodies[shape.body];
    Eigen::SelfAdjointEigenSolver<Mat3> principal(b.inertia);
    Mat3 axes = principal.eigenvectors();
    if (axes.determinant() < 0) axes.col(0) *= -1;
    auto& own = corners.emplace_back();
    std::array<double, 4> area{};
    double volume = 0;
    for (std::size_t k = 0; k < 4; ++k) own[k] = axes.transpose() * shape.corner[k];
    volume = (own[1] - own[0]).cross(own[2] - own[0]).dot(own[3] - own[0]) / 6;
    Vec3 incentre = Vec3::Zero();
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3 &p = own[(k + 1) % 4], &q = own[(k + 2) % 4], &r = own[(k + 3) % 4];
      area[k] = 0.5 * (q - p).cross(r - p).norm();
      incentre += area[k] * own[k];
      sum += area[k];
    }
    incentre /= sum;
    const double shrink = 1 - way.margin / (3 * volume / sum);
    auto hull = std::make_unique<btConvexHullShape>();
    for (const Vec3& c : own) {
      hull->addPoint(to_bullet(scale * (incentre + shrink * (c - incentre))));
    }
    hull->setMargin(scale * way.margin);
    if (way.sat) hull->initializePolyhedralFeatures();
    const Eigen::Quaterniond q = b.orientation * Eigen::Quaterniond(axes);
    const btTransform pose({q.x(), q.y(), q.z(), q.w()}, to_bullet(scale * b.centre));
    btRigidBody& body = add(std::move(hull), b.mass,
                            to_bullet(scale * scale * principal.eigenvalues()), pose, b.friction);
    body.setLinearVelocity(to_bullet(scale * b.momentum / b.mass));
  }

  /// Places of the chips, m.
  std::vector<SeenPart> parts() const {
    std::vector<SeenPart> result;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const btTransform& pose = bodies[k + 1]->getWorldTransform();
      std::array<Vec3, 4> at;
      for (std::size_t c = 0; c < 4; ++c) {
        const btVector3 x = pose * to_bullet(scale * corners[k][c]);
        at[c] = Vec3(x[0], x[1], x[2]) / scale;
      }
      result.push_back({make_tetrahedron(at), static_cast<std::uint32_t>(k)});
    }
    return result;
  }
};

void print(const char* who, double time, double ms, const std::vector<SeenPart>& parts) {
  const SeenOverlaps seen = see_overlaps(parts);
  std::vector<SeenMass> masses;
  std::size_t below = 0, lost = 0;
  double deepest = 0;
  for (const SeenPart& p : parts) {
    // Each by its volume: all are of one density.
    const auto& x = p.solid.vertex;
    masses.push_back({p.solid.centre, (x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0])});
    double low = 0;
    for (std::size_t v = 0; v < 4; ++v) low = std::min(low, x[v].z());
    below += low < -0.02 * seen.edge;
    lost += p.solid.centre.z() < 0;
    deepest = std::max(deepest, -low);
  }
  const HeapShape heap = see_heap(masses);
  std::printf("%s,%.3f,%.3f,%zu,%.3f,%.4f,%zu,%zu,%.3f,%.2f,%.2f,%.2f\n", who, time, ms, seen.pairs,
              100 * seen.deepest / seen.edge, 100 * seen.mean / seen.edge, below, lost,
              100 * deepest / seen.edge, 1e3 * heap.height, 1e3 * heap.radius, 1e3 * heap.centre);
  std::fflush(stdout);
}

/// A chip let go above the floor: its final position by both programs.
void one_chip(const BulletWay& way, int per_second) {
  RubbleScene scene = ground();
  add_tetrahedron(
      scene,
      {Vec3(0, 0, 1e-3), Vec3(0.01, 0, 1e-3), Vec3(0.01, 0.01, 1e-3), Vec3(0.01, 0.01, 0.011)},
      2400);
  Bullet bullet(scene, way);
  RubbleSettings settings;
  settings.gravity = {0, 0, -9.81};
  settings.length = 1.0 / per_second;
  RubbleScratch scratch;
  for (int k = 0; k < 2 * per_second; ++k) {
    advance_rubble(scene.bodies, scene.shapes, scene.memory, settings, scratch);
    bullet.world.stepSimulation(settings.length, 0);
  }
  const btRigidBody& b = *bullet.bodies[1];
  std::printf(
      "# one chip after 2 s: ours centre %.5f mm, speed %.2g m/s; Bullet centre %.5f mm, speed "
      "%.2g m/s, %s\n",
      1e3 * scene.bodies[1].centre.z(), scene.bodies[1].momentum.norm() / scene.bodies[1].mass,
      1e3 * b.getWorldTransform().getOrigin().z() / scale, b.getLinearVelocity().length() / scale,
      b.isActive() ? "awake" : "asleep");
}

}  // namespace

int main(int argc, char** argv) {
  const auto seed = static_cast<unsigned>(argc > 1 ? std::atoi(argv[1]) : 1);
  const double seconds = argc > 2 ? std::atof(argv[2]) : 1;
  const int per_second = argc > 3 ? std::atoi(argv[3]) : 240;
  BulletWay way;
  if (argc > 4) way.margin = 1e-3 * std::atof(argv[4]);
  way.sat = argc > 5 && std::string(argv[5]) == "sat";
  const int ours_per_second = argc > 6 ? std::atoi(argv[6]) : 240;
  one_chip(way, per_second);
  RubbleScene scene = broken_block({5, 5, 8}, 0.01, {0, 0, 0.02}, 2, seed);
  Bullet bullet(scene, way);
  RubbleSettings settings;
  settings.gravity = {0, 0, -9.81};
  settings.length = 1.0 / ours_per_second;
  RubbleScratch scratch;
  std::puts(
      "who,time,ms a step,pairs,deepest %,mean %,below floor,lost,deepest below %,height mm,radius "
      "mm,centre mm");
  for (double time = 0; time < seconds - 1e-9; time += 0.25) {
    double start = thread_ms();
    for (int k = 0; k < ours_per_second / 4; ++k) {
      advance_rubble(scene.bodies, scene.shapes, scene.memory, settings, scratch);
    }
    const double ours = (thread_ms() - start) * 4 / ours_per_second;
    print("rubble", time + 0.25, ours, parts_of(scene));
    start = thread_ms();
    for (int k = 0; k < per_second / 4; ++k) bullet.world.stepSimulation(1.0 / per_second, 0);
    const double theirs = (thread_ms() - start) * 4 / per_second;
    print("bullet", time + 0.25, theirs, bullet.parts());
  }
}
