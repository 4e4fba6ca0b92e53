// SPDX-License-Identifier: MIT
// Ambient occlusion from the depth of a picture: less light where surfaces stand close together.
import * as THREE from 'three';
import { FullScreenQuad } from 'three/addons/postprocessing/Pass.js';

const shader = /* glsl */ `
  uniform sampler2D colour, depth;
  uniform mat4 inverseProjection;
  uniform vec2 size; // pixels
  uniform float reach, focal; // m; pixels that a metre has at a distance of 1 m
  varying vec2 at;
  vec3 place(vec2 uv) {
    vec4 p = inverseProjection * vec4(vec3(uv, texture2D(depth, uv).r) * 2. - 1., 1.);
    return p.xyz / p.w;
  }
  float shade() {
    vec3 p = place(at);
    vec2 e = 1. / size;
    vec3 l = p - place(at - vec2(e.x, 0.)), r = place(at + vec2(e.x, 0.)) - p;
    vec3 d = p - place(at - vec2(0., e.y)), u = place(at + vec2(0., e.y)) - p;
    vec3 n = normalize(cross(abs(l.z) < abs(r.z) ? l : r, abs(d.z) < abs(u.z) ? d : u));
    float turn = 6.2832 * fract(52.9829 * fract(dot(gl_FragCoord.xy, vec2(.06711, .00584))));
    float pixels = min(focal * reach / -p.z, 90.), sum = 0.;
    for (int k = 0; k < 20; ++k) {
      float a = turn + 2.39996 * float(k), s = sqrt((float(k) + .5) / 20.);
      vec3 v = place(at + s * pixels * vec2(cos(a), sin(a)) * e) - p;
      float away = length(v);
      sum += max(0., dot(n, v) / max(away, 1e-9) - .12) * clamp(2. - 2. * away / reach, 0., 1.);
    }
    return clamp(1. - 2.4 * sum / 20., 0., 1.);
  }
  void main() {
    gl_FragColor = texture2D(colour, at);
    vec3 empty = gl_FragColor.rgb;
    bool isEmpty = texture2D(depth, at).r >= 1.;
    if (!isEmpty) gl_FragColor.rgb *= shade();
    #include <tonemapping_fragment>
    if (isEmpty) gl_FragColor.rgb = empty;
    #include <colorspace_fragment>
  }
`;

export class Ambient {
  constructor() {
    this.target = new THREE.WebGLRenderTarget(1, 1, {
      type: THREE.HalfFloatType, samples: 4, depthTexture: new THREE.DepthTexture(1, 1),
    });
    this.uniforms = {
      colour: { value: this.target.texture },
      depth: { value: this.target.depthTexture },
      inverseProjection: { value: new THREE.Matrix4() },
      size: { value: new THREE.Vector2() },
      reach: { value: 1 },
      focal: { value: 1 },
    };
    this.quad = new FullScreenQuad(new THREE.ShaderMaterial({
      uniforms: this.uniforms,
      vertexShader: 'varying vec2 at; void main() { at = uv; gl_Position = vec4(position.xy, 0., 1.); }',
      fragmentShader: shader,
      depthTest: false,
    }));
  }

  /// Draws the scene to the canvas; what is nearer than `reach` (m) takes light away.
  draw(renderer, scene, camera, reach) {
    const { size } = this.uniforms;
    renderer.getDrawingBufferSize(size.value);
    this.target.setSize(size.value.x, size.value.y);
    renderer.setRenderTarget(this.target);
    renderer.render(scene, camera);
    renderer.setRenderTarget(null);
    this.uniforms.inverseProjection.value.copy(camera.projectionMatrixInverse);
    this.uniforms.reach.value = reach;
    this.uniforms.focal.value = 0.5 * size.value.y * camera.projectionMatrix.elements[5];
    this.quad.render(renderer);
  }
}
