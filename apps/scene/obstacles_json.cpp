// SPDX-License-Identifier: MIT
#include "apps/scene/obstacles_json.hpp"

#include <memory>
#include <variant>

#include "mechanics/contact/shapes/solid_surface.hpp"

namespace sunder {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

ordered_json numbers(const Vec3& v) { return {v[0], v[1], v[2]}; }
ordered_json numbers(const Eigen::Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }

Vec3 vec(const json& v) {
  return {v.at(0).get<double>(), v.at(1).get<double>(), v.at(2).get<double>()};
}

Eigen::Quaterniond quaternion(const json& q) {
  return {q.at(0).get<double>(), q.at(1).get<double>(), q.at(2).get<double>(),
          q.at(3).get<double>()};
}

struct WriteShape {
  ordered_json operator()(const Plane& p) const {
    return {{"plane", {{"normal", numbers(p.normal)}, {"offset", p.offset}}}};
  }
  ordered_json operator()(const Sphere& s) const {
    return {{"sphere", {{"center", numbers(s.center)}, {"radius", s.radius}}}};
  }
  ordered_json operator()(const Box& b) const {
    return {{"box",
             {{"center", numbers(b.center)},
              {"half_extent", numbers(b.half_extent)},
              {"orientation", numbers(b.orientation)}}}};
  }
  ordered_json operator()(const Solid& s) const {
    ordered_json points = ordered_json::array();
    for (const Vec3& p : s.surface->points) points.push_back(numbers(p));
    return {{"mesh",
             {{"points", std::move(points)},
              {"triangles", s.surface->triangles},
              {"translation", numbers(s.translation)},
              {"orientation", numbers(s.orientation)}}}};
  }
};

Result<Shape> read_solid(const json& mesh) {
  TriangleSurface triangles;
  for (const json& p : mesh.at("points")) triangles.points.push_back(vec(p));
  triangles.triangles = mesh.at("triangles").get<std::vector<std::array<std::uint32_t, 3>>>();
  Result<SolidSurface> surface = make_solid_surface(std::move(triangles));
  Result<Shape> result;
  result.findings = std::move(surface.findings);
  if (!surface) return result;
  result.value = Solid{std::make_shared<const SolidSurface>(std::move(*surface)),
                       vec(mesh.at("translation")), quaternion(mesh.at("orientation"))};
  return result;
}

Result<Shape> read_shape(const json& one) {
  if (one.contains("plane")) {
    const json& p = one["plane"];
    return Shape(Plane{vec(p.at("normal")), p.at("offset").get<double>()});
  }
  if (one.contains("sphere")) {
    const json& s = one["sphere"];
    return Shape(Sphere{vec(s.at("center")), s.at("radius").get<double>()});
  }
  if (one.contains("box")) {
    const json& b = one["box"];
    return Shape(
        Box{vec(b.at("center")), quaternion(b.at("orientation")), vec(b.at("half_extent"))});
  }
  return read_solid(one.at("mesh"));
}

}  // namespace

ordered_json obstacles_json(std::span<const Obstacle> obstacles) {
  ordered_json array = ordered_json::array();
  for (const Obstacle& o : obstacles) {
    ordered_json one = std::visit(WriteShape{}, o.shape);
    one["velocity"] = numbers(o.velocity);
    if (o.mass) one["mass"] = *o.mass;
    array.push_back(std::move(one));
  }
  return array;
}

Result<std::vector<Obstacle>> read_obstacles(const json& array) {
  Result<std::vector<Obstacle>> result;
  std::vector<Obstacle> obstacles;
  try {
    for (const json& one : array) {
      Result<Shape> shape = read_shape(one);
      for (Finding& f : shape.findings) result.findings.push_back(std::move(f));
      if (!shape) return result;
      Obstacle o{.shape = std::move(*shape), .velocity = vec(one.at("velocity"))};
      if (one.contains("mass")) o.mass = one["mass"].get<double>();
      obstacles.push_back(std::move(o));
    }
  } catch (const json::exception& error) {
    result.findings.push_back({.code = "bad_obstacles",
                               .text = std::string("obstacles of the report: ") + error.what(),
                               .remedy = "take the report.json that sunder run wrote"});
    return result;
  }
  result.value = std::move(obstacles);
  return result;
}

}  // namespace sunder
