// SPDX-License-Identifier: MIT
// What three.js's own materials get in addition: where a corner is, and how a face is coloured.

const vertexHead = /* glsl */ `
  uniform highp sampler2D pieces;
  uniform highp sampler2D vertices;
  uniform float explode, deformed, magnify;
  uniform vec3 middle;
  attribute vec3 ids;
  attribute vec2 opened;
  flat varying float vPiece, vCrack, vBirth;
  flat varying vec2 vOpened;
  varying float vScalar;
  varying vec3 vRest, vWire;
  vec4 texel(highp sampler2D from, int row) { return texelFetch(from, ivec2(row % 1024, row / 1024), 0); }
  vec3 turned(vec4 q, vec3 v) { return v + 2. * cross(q.xyz, cross(q.xyz, v) + q.w * v); }
`;

const normalPart = /* glsl */ `
  int pieceRow = 3 * int(ids.y);
  vec4 pieceTurn = texel(pieces, pieceRow + 1);
  vec3 objectNormal = turned(pieceTurn, normal);
`;

const placePart = /* glsl */ `
  int row = 3 * int(ids.y);
  vec4 centre = texel(pieces, row);
  vec4 restCentre = texel(pieces, row + 2);
  vec4 own = texel(vertices, int(ids.x));
  vec3 transformed = turned(texel(pieces, row + 1), position - restCentre.xyz) + centre.xyz;
  transformed += deformed * magnify * (own.xyz - transformed);
  transformed += explode * (centre.xyz - middle);
  vPiece = ids.y;
  vCrack = ids.z;
  vBirth = centre.w;
  vOpened = opened;
  vScalar = own.w;
  vRest = position;
  int corner = gl_VertexID % 3;
  vWire = vec3(corner == 0, corner == 1, corner == 2);
`;

const fragmentHead = /* glsl */ `
  uniform int colourBy; // 0 material, 1 a number a vertex, 2 piece, 3 age, 4 order of fans, 5 age of a crack
  uniform vec2 range;
  uniform float wires, grain, now, marked, ghost;
  uniform vec3 outside, inside;
  flat varying float vPiece, vCrack, vBirth;
  flat varying vec2 vOpened; // number of the fan, s
  varying float vScalar;
  varying vec3 vRest, vWire;
  vec3 sunderGlow; // numbers are read off their colour, so light matters less
  float hash(vec3 p) { return fract(sin(dot(p, vec3(127.1, 311.7, 74.7))) * 43758.5453); }
  float noise(vec3 p) {
    vec3 i = floor(p), f = fract(p);
    f = f * f * (3. - 2. * f);
    vec4 a = vec4(hash(i), hash(i + vec3(1, 0, 0)), hash(i + vec3(0, 1, 0)), hash(i + vec3(1, 1, 0)));
    vec4 b = vec4(hash(i + vec3(0, 0, 1)), hash(i + vec3(1, 0, 1)), hash(i + vec3(0, 1, 1)), hash(i + vec3(1)));
    vec4 c = mix(a, b, f.z);
    return mix(mix(c.x, c.y, f.x), mix(c.z, c.w, f.x), f.y);
  }
  vec3 scale(float t) { // dark blue over green to yellow, even in lightness
    t = clamp(t, 0., 1.);
    const vec3 c0 = vec3(.2777, .0054, .3341), c1 = vec3(.1051, 1.4046, 1.3846), c2 = vec3(-.3309, .2148, .0951);
    const vec3 c3 = vec3(-4.6342, -5.7991, -19.3324), c4 = vec3(6.2283, 14.1799, 56.6906);
    const vec3 c5 = vec3(4.7764, -13.7451, -65.3530), c6 = vec3(-5.4355, 4.6459, 26.3124);
    return c0 + t * (c1 + t * (c2 + t * (c3 + t * (c4 + t * (c5 + t * c6)))));
  }
  vec3 hue(float id) {
    vec3 p = abs(fract(vec3(id * .61803399) + vec3(0., .3333, .6667)) * 6. - 3.) - 1.;
    return mix(vec3(.75), clamp(p, 0., 1.), .55) * (.65 + .35 * fract(id * .7548777));
  }
`;

const colourPart = /* glsl */ `
  bool isInside = vCrack > .5 || !gl_FrontFacing;
  vec3 own = isInside ? inside : outside;
  float n = noise(vRest * grain) * .5 + noise(vRest * grain * 2.7) * .3 + noise(vRest * grain * 7.1) * .2;
  own *= .82 + .36 * n;
  if (colourBy == 1) own = pow(scale((vScalar - range.x) / max(range.y - range.x, 1e-30)), vec3(2.2));
  if (colourBy == 2) own = pow(hue(vPiece + 1.), vec3(2.2));
  if (colourBy == 3) own = vBirth < .5 ? vec3(.35) : pow(scale(vBirth / max(now, 1.)), vec3(2.2));
  if (colourBy > 3) {
    float t = colourBy == 4 ? vOpened.x / max(range.y, 1.) : (range.y - vOpened.y) / max(range.y, 1e-30);
    own = vCrack < .5 ? vec3(.35) : pow(scale(t), vec3(2.2));
  }
  if (ghost > 0.) own = vec3(.05, .22, .6);
  if (vPiece == marked) own = mix(own, vec3(1., .25, 0.), .7);
  if (colourBy > 0 && !gl_FrontFacing) own *= .4;
  if (wires > 0.) {
    vec3 edge = vWire / max(fwidth(vWire), vec3(1e-6));
    own = mix(own, vec3(.03), wires * .75 * (1. - smoothstep(.6, 1.4, min(edge.x, min(edge.y, edge.z)))));
  }
  diffuseColor.rgb = colourBy > 0 ? .45 * own : own;
  sunderGlow = colourBy > 0 ? .38 * own : vec3(0.);
  if (vPiece == marked) sunderGlow = max(sunderGlow, .3 * own);
`;

/// Makes `material` draw a BodyMesh. `hasColour`: false for shadows.
export function bodyShader(material, uniforms, hasColour) {
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, uniforms);
    shader.vertexShader = vertexHead + shader.vertexShader
      .replace('#include <beginnormal_vertex>', normalPart)
      .replace('#include <begin_vertex>', placePart);
    if (!hasColour) return;
    shader.fragmentShader = fragmentHead + shader.fragmentShader
      .replace('#include <emissivemap_fragment>', '#include <emissivemap_fragment>\n  totalEmissiveRadiance += sunderGlow;')
      .replace('#include <color_fragment>', `#include <color_fragment>\n${colourPart}`);
  };
  material.customProgramCacheKey = () => `sunder-${hasColour}`;
}
