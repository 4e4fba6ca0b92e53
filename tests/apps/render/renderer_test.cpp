// SPDX-License-Identifier: MIT
// Pictures drawn without a display: their size, colors, depth, shadows and repeatability.
#include "apps/render/renderer.hpp"

#include <epoxy/gl.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <optional>

#include "apps/render/headless_context.hpp"

using namespace sunder;
using namespace sunder::render;

namespace {

constexpr int width = 160, height = 120;

/// A renderer, or nothing on a machine without a driver; CTest then counts the test as skipped.
std::optional<Renderer> renderer_or_skip() {
  Result<Renderer> renderer = Renderer::offscreen();
  if (renderer) return std::move(*renderer);
  WARN("no OpenGL without a display here: " << renderer.findings.at(0).text);
  return std::nullopt;
}

/// A square across the y axis at `y`, of half side `half`, facing the camera.
Surface square(float y, float half, FaceClass face_class) {
  return {.positions = {{-half, y, -half}, {half, y, -half}, {half, y, half}, {-half, y, half}},
          .triangles = {{0, 1, 2}, {0, 2, 3}},
          .face_class = {face_class, face_class}};
}

Camera from_front() { return {.eye = {0, -5, 0}}; }

Image draw(Renderer& renderer, const FrameScene& scene, const Camera& camera = from_front()) {
  Result<Image> image = renderer.render(scene, camera, width, height);
  REQUIRE(image);
  return std::move(*image);
}

/// Skin is nearly grey, cracks are orange.
bool is_crack_colored(std::array<std::uint8_t, 3> p) { return p[0] > 2 * p[2]; }
bool is_skin_colored(std::array<std::uint8_t, 3> p) {
  return std::abs(p[0] - p[2]) < 40 && p[0] > 60;
}

int brightness(std::array<std::uint8_t, 3> p) { return p[0] + p[1] + p[2]; }

FrameScene cracked_scene() {
  FrameScene scene;
  scene.surfaces.push_back(square(0, 0.5f, FaceClass::skin));
  scene.surfaces.push_back(square(0.2f, 1.0f, FaceClass::crack));
  scene.planes.push_back({.point = {0, 0, -1}});
  scene.spheres.push_back({.center = {1, 0, -0.7f}, .radius = 0.3f});
  scene.boxes.push_back({.center = {-1, 0, -0.7f}, .half_extent = {0.2f, 0.2f, 0.3f}});
  return scene;
}

}  // namespace

TEST_CASE("a picture has the size asked for, and every size can follow every other",
          "[render][renderer]") {
  auto renderer = renderer_or_skip();
  if (!renderer) return;
  for (const auto& [w, h] : {std::pair{1, 1}, {33, 7}, {160, 120}, {7, 33}}) {
    const Result<Image> image = renderer->render(cracked_scene(), from_front(), w, h);
    REQUIRE(image);
    CHECK(image->width == w);
    CHECK(image->height == h);
    CHECK(image->rgb.size() == static_cast<std::size_t>(3 * w * h));
  }
}

TEST_CASE("an empty scene shows the background, its top above", "[render][renderer]") {
  auto renderer = renderer_or_skip();
  if (!renderer) return;
  FrameScene scene;
  scene.background = {.top = {0, 0, 1}, .bottom = {1, 0, 0}};
  const Image image = draw(*renderer, scene);
  CHECK(pixel(image, 80, 0)[2] >= 250);
  CHECK(pixel(image, 80, 0)[0] <= 10);
  CHECK(pixel(image, 80, height - 1)[0] >= 250);
}

TEST_CASE("the nearer surface hides the farther, in whatever order they come",
          "[render][renderer]") {
  auto renderer = renderer_or_skip();
  if (!renderer) return;
  FrameScene scene;
  scene.surfaces = {square(0, 0.5f, FaceClass::skin), square(1, 1.5f, FaceClass::crack)};
  const Image image = draw(*renderer, scene);
  CHECK(is_skin_colored(pixel(image, width / 2, height / 2)));
  CHECK(is_crack_colored(pixel(image, width / 2 - 45, height / 2)));
  std::swap(scene.surfaces[0], scene.surfaces[1]);
  CHECK(draw(*renderer, scene) == image);
  scene.surfaces[1] = square(2, 0.5f, FaceClass::skin);
  CHECK(is_crack_colored(pixel(draw(*renderer, scene), width / 2, height / 2)));
}

TEST_CASE("a face is shaded alike from both of its sides", "[render][renderer]") {
  auto renderer = renderer_or_skip();
  if (!renderer) return;
  FrameScene scene;
  scene.surfaces = {square(0, 0.5f, FaceClass::crack)};
  const Image image = draw(*renderer, scene);
  for (auto& t : scene.surfaces[0].triangles) std::swap(t[1], t[2]);
  const auto turned = pixel(draw(*renderer, scene), width / 2, height / 2);
  CHECK(turned == pixel(image, width / 2, height / 2));
}

TEST_CASE("a body darkens the ground away from the light, and nowhere else", "[render][renderer]") {
  auto renderer = renderer_or_skip();
  if (!renderer) return;
  FrameScene scene;
  scene.planes.push_back({.grid = 0});
  scene.light.to_key = {-1, 0, 1};
  scene.light.key_angle = 0.01f;
  const Camera above{.eye = {0, 0, 12}, .up = {0, 1, 0}};
  // A plate at height 2 throws its shadow 2 to the right, next to it: 15 pixels to the meter.
  scene.boxes.push_back({.center = {0, 0, 2}, .half_extent = {0.4f, 0.4f, 0.02f}});
  const Image image = draw(*renderer, scene, above);
  const int per_two_meters = static_cast<int>(2 * height / (2 * 12 * std::tan(0.24)));
  const int shadow = brightness(pixel(image, width / 2 + per_two_meters, height / 2));
  const int lit = brightness(pixel(image, width / 2 - per_two_meters, height / 2));
  CHECK(shadow < lit - 90);
  CHECK(brightness(pixel(image, width / 2, height / 2 + per_two_meters)) > lit - 15);
}

TEST_CASE("a wireframe shows what is behind it, a filled surface does not", "[render][renderer]") {
  auto renderer = renderer_or_skip();
  if (!renderer) return;
  FrameScene scene;
  scene.surfaces = {square(-1, 0.8f, FaceClass::skin), square(1, 0.5f, FaceClass::crack)};
  const auto at = [&](const Image& image) { return pixel(image, width / 2 - 6, height / 2 - 20); };
  const auto filled = draw(*renderer, scene);
  CHECK(is_skin_colored(at(filled)));
  scene.surfaces[0].style = SurfaceStyle::wireframe;
  const auto wire = draw(*renderer, scene);
  CHECK(is_crack_colored(pixel(wire, width / 2 - 10, height / 2 - 4)));
  scene.surfaces[0].style = SurfaceStyle::filled_with_edges;
  CHECK(draw(*renderer, scene) != filled);
}

TEST_CASE("the same scene gives the same bytes, from one renderer and from another",
          "[render][renderer]") {
  auto renderer = renderer_or_skip();
  if (!renderer) return;
  const Image image = draw(*renderer, cracked_scene());
  CHECK(draw(*renderer, cracked_scene()) == image);
  auto other = renderer_or_skip();
  REQUIRE(other);
  CHECK(draw(*other, cracked_scene()) == image);
  CHECK(draw(*renderer, cracked_scene()) == image);
  Renderer moved = std::move(*other);
  CHECK(draw(moved, cracked_scene()) == image);
}

TEST_CASE("a scene drawn into a framebuffer of another context is the same picture",
          "[render][renderer]") {
  Result<HeadlessContext> context = HeadlessContext::create();
  if (!context) {
    WARN("no OpenGL without a display here");
    return;
  }
  REQUIRE(context->make_current());
  GLuint framebuffer = 0, buffer = 0;
  glGenFramebuffers(1, &framebuffer);
  glGenRenderbuffers(1, &buffer);
  glBindRenderbuffer(GL_RENDERBUFFER, buffer);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffer);
  Image image{.width = width, .height = height};
  image.rgb.resize(3 * width * height);
  {
    Result<Renderer> window = Renderer::in_current_context();
    REQUIRE(window);
    REQUIRE(window->draw(cracked_scene(), from_front(), {framebuffer, width, height}).empty());
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, image.rgb.data());
  }
  auto renderer = renderer_or_skip();
  REQUIRE(renderer);
  const Image expected = draw(*renderer, cracked_scene());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (pixel(image, x, height - 1 - y) != pixel(expected, x, y)) FAIL(x << ", " << y);
    }
  }
}

TEST_CASE("triangles that are not finite are left out and told of", "[render][renderer]") {
  auto renderer = renderer_or_skip();
  if (!renderer) return;
  FrameScene scene = cracked_scene();
  const Image image = draw(*renderer, scene);
  Surface lost = square(-1, 1, FaceClass::crack);
  for (auto& p : lost.positions) p.x() = std::numeric_limits<float>::quiet_NaN();
  scene.surfaces.push_back(lost);
  const Result<Image> result = renderer->render(scene, from_front(), width, height);
  REQUIRE(result);
  CHECK(*result == image);
  REQUIRE(result.findings.size() == 1);
  CHECK(result.findings[0].code == "not_finite");
  CHECK(result.findings[0].count == 2);
}

TEST_CASE("what cannot be drawn is a finding, and the next picture is sound",
          "[render][renderer]") {
  auto renderer = renderer_or_skip();
  if (!renderer) return;
  const auto code = [&](const FrameScene& scene, const Camera& camera, int w, int h) {
    const Result<Image> result = renderer->render(scene, camera, w, h);
    CHECK_FALSE(result);
    return result.findings.size() == 1 ? result.findings[0].code : std::string();
  };
  CHECK(code({}, from_front(), 0, 10) == "image_size");
  CHECK(code({}, from_front(), 10, -1) == "image_size");
  CHECK(code({}, from_front(), 1 << 30, 10) == "image_too_large");
  CHECK(code({}, {.eye = {0, 0, 0}}, 10, 10) == "degenerate_camera");
  FrameScene scene = cracked_scene();
  scene.surfaces[0].triangles[0][0] = 99;
  CHECK(code(scene, from_front(), 10, 10) == "index_out_of_range");
  draw(*renderer, cracked_scene());
}

TEST_CASE("with an extent given, the ground does not change as pieces fly away",
          "[render][renderer]") {
  auto renderer = renderer_or_skip();
  if (!renderer) return;
  FrameScene scene;
  scene.planes.push_back({.point = {0, 0, -1}, .grid = 1});
  scene.spheres.push_back({.radius = 0.5f});
  const Camera camera{.eye = {0, -6, 2}};
  const auto ground = [&](float flown) {
    scene.spheres.resize(1);
    scene.spheres.push_back({.center = {flown, 30 * flown, 0}, .radius = 0.05f});
    const Image image = draw(*renderer, scene, camera);
    return std::vector<std::uint8_t>(image.rgb.end() - 3 * width * 20, image.rgb.end());
  };
  CHECK(ground(0) != ground(1));
  scene.extent = Bounds(Eigen::Vector3f(-1, -1, -1), Eigen::Vector3f(1, 1, 1));
  CHECK(ground(0) == ground(1));
}

TEST_CASE("bodies of a millimeter and of a kilometer look alike", "[render][renderer]") {
  auto renderer = renderer_or_skip();
  if (!renderer) return;
  const auto scaled = [&](float k) {
    FrameScene scene = cracked_scene();
    for (auto& s : scene.surfaces) {
      for (auto& p : s.positions) p *= k;
    }
    scene.planes[0].point *= k;
    scene.spheres[0].center *= k;
    scene.spheres[0].radius *= k;
    scene.boxes[0].center *= k;
    scene.boxes[0].half_extent *= k;
    return draw(*renderer, scene, {.eye = {0, -5 * k, 0}});
  };
  const Image one = scaled(1);
  for (const float k : {0.0009765625f, 1024.0f}) {  // powers of two: only the grid's steps differ
    const Image other = scaled(k);
    int differing = 0;
    for (std::size_t i = 0; i < one.rgb.size(); ++i) {
      differing += std::abs(one.rgb[i] - other.rgb[i]) > 24 ? 1 : 0;
    }
    CHECK(differing < static_cast<int>(one.rgb.size() / 50));  // a few lines of the grid
  }
}

TEST_CASE("without a driver the renderer says what to install", "[.no-driver]") {
  const Result<Renderer> renderer = Renderer::offscreen();
  CHECK_FALSE(renderer);
  REQUIRE(renderer.findings.size() == 1);
  CHECK(renderer.findings[0].code == "no_headless_display");
  CHECK_THAT(renderer.findings[0].remedy, Catch::Contains("apt-get install libegl-mesa0"));
}
