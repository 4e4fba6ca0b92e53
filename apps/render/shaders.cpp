// SPDX-License-Identifier: MIT
// GLSL: shadow map, visibility (occlusion and soft shadow), and the shading that uses them.
#include "apps/render/shaders.hpp"

namespace sunder::render {
namespace {

const char* const header = "#version 330 core\n";

// A pixel's place in the world from its depth along the view: eye + depth * (ray through it).
const char* const camera_part = R"glsl(
uniform vec3 eye, forward, ray_right, ray_up;
uniform vec2 pixels;
vec3 ray_through(vec2 pixel) {
  vec2 place = 2.0 * pixel / pixels - 1.0;
  return forward + place.x * ray_right + place.y * ray_up;
}
)glsl";

const char* const fullscreen_vertex = R"glsl(
void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(corner, 0.0, 1.0);
}
)glsl";

const char* const mesh_vertex = R"glsl(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 color;
uniform mat4 world_to_clip;
out vec3 world;
out vec3 world_normal;
flat out vec3 albedo;
void main() {
  world = position;
  world_normal = normal;
  vec3 c = color.rgb;
  albedo = mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), step(0.04045, c));
  gl_Position = world_to_clip * vec4(position, 1.0);
}
)glsl";

// A plane is a square of two triangles, wide enough to fade out before it ends.
const char* const plane_vertex = R"glsl(
uniform mat4 world_to_clip;
uniform vec3 plane_center, plane_u, plane_v, plane_normal;
uniform float plane_radius;
out vec3 world;
out vec3 world_normal;
void main() {
  float x = gl_VertexID == 1 || gl_VertexID == 2 || gl_VertexID == 4 ? 1.0 : -1.0;
  float y = gl_VertexID == 2 || gl_VertexID == 4 || gl_VertexID == 5 ? 1.0 : -1.0;
  world = plane_center + plane_radius * (x * plane_u + y * plane_v);
  world_normal = plane_normal;
  gl_Position = world_to_clip * vec4(world, 1.0);
}
)glsl";

const char* const normals_fragment = R"glsl(
in vec3 world;
in vec3 world_normal;
uniform vec3 eye, forward;
out vec4 normal_and_depth;
void main() {
  vec3 n = normalize(world_normal);
  normal_and_depth = vec4(gl_FrontFacing ? n : -n, dot(world - eye, forward));
}
)glsl";

// Occlusion after McGuire, Mara and Luebke (2012), "Scalable ambient obscurance"; soft shadows
// after Fernando (2005), "Percentage-closer soft shadows". Sixteen rotations of the sample
// patterns repeat every 4 x 4 pixels, and the smoothing averages just that square.
const char* const visibility_fragment = R"glsl(
uniform sampler2D normal_and_depth;
uniform sampler2D shadow_depth;
uniform sampler2DShadow shadow_test;
uniform vec3 light_center, light_u, light_v, to_light;
uniform float light_radius, light_tangent, occlusion_radius, pixels_per_ray;
out vec3 visibility;

// Points spread evenly over the unit disc; `turn` rotates them.
uniform vec2 disc[12];
uniform int taps;

float sky_visibility(vec2 pixel, vec3 p, vec3 n, float depth, mat2 turn) {
  float reach = min(occlusion_radius / depth * pixels_per_ray, 0.25 * pixels.y);
  float sum = 0.0;
  for (int i = 0; i < 12; ++i) {
    vec2 tap = floor(pixel + reach * (turn * disc[i])) + 0.5;
    if (any(lessThan(tap, vec2(0.0))) || any(greaterThan(tap, pixels))) continue;
    float tap_depth = texelFetch(normal_and_depth, ivec2(tap), 0).w;
    if (tap_depth == 0.0) continue;
    vec3 v = (eye + tap_depth * ray_through(tap) - p) / occlusion_radius;
    float square = dot(v, v);
    float near = max(1.0 - square, 0.0);
    sum += near * near * near * max(dot(v, n) - 0.015, 0.0) / (square + 0.01);
  }
  return max(1.0 - 2.6 * sum / 12.0, 0.0);
}

float key_visibility(vec3 p, vec3 n, mat2 turn) {
  float slope = dot(n, to_light);
  if (slope <= 0.0) return 0.0;
  vec3 q = (p - light_center) / light_radius;
  vec3 place = vec3(dot(q, light_u), dot(q, light_v), -dot(q, to_light));
  if (max(abs(place.x), abs(place.y)) > 1.0) return 1.0;
  // The depth of the receiver's own plane at a tap: no surface shades itself.
  vec2 tilt = clamp(vec2(dot(n, light_u), dot(n, light_v)) / slope, -6.0, 6.0);
  float texel = 2.0 / float(textureSize(shadow_depth, 0).x);
  float bias = texel * (1.5 + 0.75 * length(tilt));
  float search = min(light_tangent * (place.z + 1.0), 0.3) + 2.0 * texel;
  float blockers = 0.0, blocked_at = 0.0;
  for (int i = 0; i < 12; ++i) {
    vec2 offset = search * (turn * disc[i]);
    float nearest = 2.0 * texture(shadow_depth, 0.5 * (place.xy + offset) + 0.5).r - 1.0;
    if (nearest < place.z + dot(tilt, offset) - bias) {
      blockers += 1.0;
      blocked_at += nearest;
    }
  }
  if (blockers == 0.0) return 1.0;
  float width = max(light_tangent * (place.z - blocked_at / blockers), 1.5 * texel);
  float lit = 0.0;
  for (int i = 0; i < taps; ++i) {  // a count unknown to the compiler: it stops where all are lit
    vec2 offset = width * (turn * disc[i]);
    float reference = min(place.z + dot(tilt, offset) - bias, 0.999);
    lit += texture(shadow_test, vec3(0.5 * (place.xy + offset) + 0.5, 0.5 * reference + 0.5));
  }
  return lit / float(taps);
}

void main() {
  vec4 surface = texelFetch(normal_and_depth, ivec2(gl_FragCoord.xy), 0);
  visibility = vec3(1.0, 1.0, surface.w);
  if (surface.w == 0.0) return;
  vec3 p = eye + surface.w * ray_through(gl_FragCoord.xy);
  ivec2 cell = ivec2(gl_FragCoord.xy) & 3;
  int rotation = (cell.x * 4 + cell.y) * 7 & 15;
  float angle = 6.2831853 * float(rotation) / 16.0;
  mat2 turn = mat2(cos(angle), sin(angle), -sin(angle), cos(angle));
  visibility.x = sky_visibility(gl_FragCoord.xy, p, surface.xyz, surface.w, turn);
  visibility.y = key_visibility(p, surface.xyz, turn);
}
)glsl";

// Four taps along x, then four along y; a tap off the pixel's own tangent plane does not count.
const char* const smoothing_fragment = R"glsl(
uniform sampler2D normal_and_depth;
uniform sampler2D seen;
uniform vec2 along;
out vec3 visibility;
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec4 surface = texelFetch(normal_and_depth, at, 0);
  visibility = texelFetch(seen, at, 0).xyz;
  if (surface.w == 0.0) return;
  vec3 p = eye + surface.w * ray_through(gl_FragCoord.xy);
  vec2 sum = vec2(0.0);
  float weights = 0.0;
  for (int i = -2; i < 2; ++i) {
    vec2 tap = clamp(gl_FragCoord.xy + float(i) * along, vec2(0.5), pixels - 0.5);
    vec3 there = texelFetch(seen, ivec2(tap), 0).xyz;
    float off = dot(eye + there.z * ray_through(tap) - p, surface.xyz);
    float weight = max(1.0 - abs(off) / (0.004 * surface.w), 0.0) + 1e-4;
    sum += weight * there.xy;
    weights += weight;
  }
  visibility.xy = sum / weights;
}
)glsl";

// Key light with shadow and a broad highlight, sky and ground light with occlusion, a fill from
// the eye. The curve is the identity up to 0.7 and then bends towards 1 without a kink, so that a
// surface in full light has very nearly the color it was given.
const char* const shading_part = R"glsl(
uniform vec3 to_light, sky_up, key_light, sky_light, below_light;
uniform float fill_light, occlusion;
uniform int neighbors;
uniform sampler2D seen;

vec2 visibility_at(vec3 p, vec3 n, float depth) {
  ivec2 last = textureSize(seen, 0) - 1;
  vec2 sum = vec2(0.0);
  float weights = 0.0;
  for (int i = 0; i < neighbors; ++i) {
    vec2 step = vec2(i == 1 ? 1.0 : i == 2 ? -1.0 : 0.0, i == 3 ? 1.0 : i == 4 ? -1.0 : 0.0);
    vec2 tap = floor(gl_FragCoord.xy) + 0.5 + step;
    vec3 there = texelFetch(seen, clamp(ivec2(tap), ivec2(0), last), 0).xyz;
    float off = abs(dot(eye + there.z * ray_through(tap) - p, n)) / (0.002 * depth);
    float weight = (i == 0 ? 1.0 : 0.1) / (0.01 + off * off);
    sum += weight * there.xy;
    weights += weight;
    if (weights > 10.0) break;  // nearly always the pixel's own surface
  }
  return sum / weights;
}

float power_5(float x) { return x * x * x * x * x; }
float power_24(float x) {
  float x8 = x * x * x * x * x * x * x * x;
  return x8 * x8 * x8;
}

vec3 shoulder(vec3 light) {
  vec3 over = max(light - 0.7, 0.0);
  return min(light, 0.7) + 0.3 * (1.0 - exp(-over / 0.3));
}

vec3 shade(vec3 albedo, vec3 p, vec3 n, float gloss) {
  vec3 to_eye = normalize(eye - p);
  vec2 seen_here = visibility_at(p, n, dot(p - eye, forward));
  float sky = mix(1.0, seen_here.x, occlusion);
  float key = seen_here.y * max(dot(n, to_light), 0.0);
  vec3 ambient = mix(below_light, sky_light, 0.5 + 0.5 * dot(n, sky_up));
  vec3 diffuse = key_light * key + sky * (ambient + fill_light * max(dot(n, to_eye), 0.0));
  vec3 halfway = normalize(to_eye + to_light);
  float highlight = gloss * key * power_24(max(dot(n, halfway), 0.0));
  float rim = gloss * 0.6 * sky * power_5(1.0 - max(dot(n, to_eye), 0.0));
  return shoulder(albedo * diffuse + key_light * highlight + sky_light * rim);
}
)glsl";

const char* const mesh_fragment = R"glsl(
in vec3 world;
in vec3 world_normal;
flat in vec3 albedo;
out vec4 color;
void main() {
  vec3 n = normalize(world_normal);
  color = vec4(shade(albedo, world, gl_FrontFacing ? n : -n, 0.10), 1.0);
}
)glsl";

const char* const plane_fragment = R"glsl(
in vec3 world;
in vec3 world_normal;
uniform vec3 plane_center, plane_u, plane_v, plane_color;
uniform float plane_radius, grid_spacing, grid_strength;
out vec4 color;

float lines(vec2 place, float half_width) {
  vec2 width = fwidth(place);
  vec2 off = abs(fract(place - 0.5) - 0.5) / width;
  vec2 line = clamp(half_width + 0.5 - off, 0.0, 1.0) * clamp(1.2 - 4.0 * width, 0.0, 1.0);
  return max(line.x, line.y);
}

void main() {
  float distance_part = length(world - plane_center) / plane_radius;
  vec2 place = vec2(dot(world, plane_u), dot(world, plane_v)) / grid_spacing;
  float grid = max(0.55 * lines(place, 0.4), lines(place / 5.0, 0.6));
  vec3 albedo = plane_color * (1.0 - grid_strength * grid * (1.0 - distance_part));
  float opacity = 1.0 - smoothstep(0.25, 1.0, distance_part);
  color = vec4(shade(albedo, world, world_normal, 0.0), opacity);
}
)glsl";

const char* const background_fragment = R"glsl(
uniform vec3 top, bottom;
uniform vec2 pixels;
out vec4 color;
void main() {
  color = vec4(mix(bottom, top, smoothstep(0.0, 1.0, gl_FragCoord.y / pixels.y)), 1.0);
}
)glsl";

// Two triangles along the edge, widened on the picture. Drawn a little nearer than it is, so that
// the adjacent faces do not hide it.
const char* const edge_vertex = R"glsl(
layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in vec4 color;
uniform mat4 world_to_clip;
uniform vec3 eye, forward;
uniform vec2 pixels;
uniform float near, half_width;
noperspective out float across;
flat out vec3 line_color;

vec3 nearer(vec3 p, vec3 other) {
  float depth = dot(p - eye, forward), other_depth = dot(other - eye, forward);
  if (depth < near && other_depth > near) p = mix(p, other, (near - depth) / (other_depth - depth));
  return eye + 0.9985 * (p - eye);
}

void main() {
  bool at_end = gl_VertexID == 1 || gl_VertexID == 3 || gl_VertexID == 5;
  float side = gl_VertexID == 0 || gl_VertexID == 1 || gl_VertexID == 3 ? 1.0 : -1.0;
  vec4 a = world_to_clip * vec4(nearer(from, to), 1.0);
  vec4 b = world_to_clip * vec4(nearer(to, from), 1.0);
  vec2 run = (b.xy / b.w - a.xy / a.w) * pixels;
  vec2 direction = length(run) > 1e-6 ? normalize(run) : vec2(1.0, 0.0);
  across = side * (half_width + 1.0);
  gl_Position = at_end ? b : a;
  gl_Position.xy += across * vec2(-direction.y, direction.x) * 2.0 / pixels * gl_Position.w;
  vec3 c = color.rgb;
  line_color = mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), step(0.04045, c));
}
)glsl";

const char* const edge_fragment = R"glsl(
noperspective in float across;
flat in vec3 line_color;
uniform float half_width, opacity;
out vec4 color;
void main() {
  float cover = clamp(half_width + 0.5 - abs(across), 0.0, 1.0);
  color = vec4(line_color, opacity * cover);
}
)glsl";

template <class... Parts>
std::string source(Parts... parts) {
  std::string all = header;
  (all.append(parts), ...);
  return all;
}

}  // namespace

ShaderSource shadow_source() { return {source(mesh_vertex), source("void main() {}\n")}; }

ShaderSource mesh_normals_source() { return {source(mesh_vertex), source(normals_fragment)}; }

ShaderSource plane_normals_source() { return {source(plane_vertex), source(normals_fragment)}; }

ShaderSource visibility_source() {
  return {source(fullscreen_vertex), source(camera_part, visibility_fragment)};
}

ShaderSource smoothing_source() {
  return {source(fullscreen_vertex), source(camera_part, smoothing_fragment)};
}

ShaderSource background_source() {
  return {source(fullscreen_vertex), source(background_fragment)};
}

ShaderSource plane_source() {
  return {source(plane_vertex), source(camera_part, shading_part, plane_fragment)};
}

ShaderSource mesh_source() {
  return {source(mesh_vertex), source(camera_part, shading_part, mesh_fragment)};
}

ShaderSource edge_source() { return {source(edge_vertex), source(edge_fragment)}; }

}  // namespace sunder::render
