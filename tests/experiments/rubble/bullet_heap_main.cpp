// SPDX-License-Identifier: MIT
// `bullet_heap [seed] [seconds] [steps a second]`: the heap of `rubble_heap` by Bullet (Debian's,
// in floats), with the same masses and inertias, seen by the same judge.
#include <btBulletDynamicsCommon.h>

#include <Eigen/Eigenvalues>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "tests/experiments/rubble/rubble_scenes.hpp"

using namespace sunder;
using namespace sunder::test;

namespace {

double now_ms() {
  return std::chrono::duration<double, std::milli>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

btVector3 to_bullet(const Vec3& v) {
  return {static_cast<btScalar>(v[0]), static_cast<btScalar>(v[1]), static_cast<btScalar>(v[2])};
}

}  // namespace

int main(int argc, char** argv) {
  const unsigned seed = argc > 1 ? static_cast<unsigned>(std::atoi(argv[1])) : 0;
  const double seconds = argc > 2 ? std::atof(argv[2]) : 2;
  const int per_second = argc > 3 ? std::atoi(argv[3]) : 240;
  RubbleScene scene = broken_block({5, 5, 8}, 0.01, {0, 0, 0.02}, 2, seed);
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity({0, 0, -9.81F});
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  std::vector<std::unique_ptr<btRigidBody>> bodies;
  for (const RubbleShape& shape : scene.shapes) {
    const RubbleBody& body = scene.bodies[shape.body];
    if (shape.kind == RubbleShape::Kind::half_space) {
      shapes.push_back(std::make_unique<btStaticPlaneShape>(btVector3(0, 0, 1), 0.0F));
      bodies.push_back(std::make_unique<btRigidBody>(0.0F, nullptr, shapes.back().get()));
    } else {
      auto hull = std::make_unique<btConvexHullShape>();
      // The inertia in principal axes, to which Bullet's bodies are turned.
      const Eigen::SelfAdjointEigenSolver<Mat3> axes(body.inertia);
      Mat3 turn = axes.eigenvectors();
      if (turn.determinant() < 0) turn.col(0) = -turn.col(0);
      for (const Vec3& c : shape.corner) hull->addPoint(to_bullet(turn.transpose() * c), false);
      hull->recalcLocalAabb();
      hull->setMargin(0.0002F);
      shapes.push_back(std::move(hull));
      btRigidBody::btRigidBodyConstructionInfo info(static_cast<btScalar>(body.mass), nullptr,
                                                    shapes.back().get(),
                                                    to_bullet(axes.eigenvalues()));
      const Eigen::Quaterniond q(turn);
      info.m_startWorldTransform.setIdentity();
      info.m_startWorldTransform.setOrigin(to_bullet(body.centre));
      info.m_startWorldTransform.setRotation(
          {static_cast<btScalar>(q.x()), static_cast<btScalar>(q.y()),
           static_cast<btScalar>(q.z()), static_cast<btScalar>(q.w())});
      bodies.push_back(std::make_unique<btRigidBody>(info));
      bodies.back()->setLinearVelocity(to_bullet(body.momentum / body.mass));
    }
    bodies.back()->setFriction(0.7071F);  // Bullet multiplies: one half between two
    world.addRigidBody(bodies.back().get());
  }
  std::puts("time,ms,awake,manifolds,deepest,mean,below,through the floor");
  double spent = 0;
  for (int k = 1; k <= seconds * per_second; ++k) {
    const double start = now_ms();
    world.stepSimulation(static_cast<btScalar>(1.0 / per_second), 0);
    spent += now_ms() - start;
    const int every = per_second / 10;
    if (k % every != 0) continue;
    int awake = 0, through = 0;
    for (std::size_t row = 1; row < bodies.size(); ++row) {
      const btTransform& t = bodies[row]->getWorldTransform();
      const Eigen::SelfAdjointEigenSolver<Mat3> axes(scene.bodies[row].inertia);
      Mat3 turn = axes.eigenvectors();
      if (turn.determinant() < 0) turn.col(0) = -turn.col(0);
      const btQuaternion q = t.getRotation();
      scene.bodies[row].centre = {t.getOrigin().x(), t.getOrigin().y(), t.getOrigin().z()};
      scene.bodies[row].orientation =
          Eigen::Quaterniond(q.w(), q.x(), q.y(), q.z()).normalized() *
          Eigen::Quaterniond(Mat3(turn.transpose()));
      awake += bodies[row]->isActive();
      through += t.getOrigin().z() < 0;
    }
    const Overlaps seen = overlaps_of(scene);
    std::printf("%.3f,%.2f,%d,%d,%.3g,%.3g,%.3g,%d\n", static_cast<double>(k) / per_second,
                spent / every, awake, dispatcher.getNumManifolds(), seen.deepest, seen.mean,
                seen.below, through);
    std::fflush(stdout);
    spent = 0;
  }
}
