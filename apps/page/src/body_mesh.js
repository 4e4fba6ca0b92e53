// SPDX-License-Identifier: MIT
// All pieces as one mesh, drawn in one call: poses and positions are textures, so that a frame
// uploads those alone and cracks alone upload faces.
import * as THREE from 'three';

import { bodyShader } from './body_shader.js';

const width = 1024; // texels a row
const crease = Math.cos((38 * Math.PI) / 180);

/// A texture of so many RGBA floats, kept larger than needed.
class FloatTexture {
  constructor() {
    this.resize(width);
  }

  resize(texels) {
    const height = Math.ceil(texels / width);
    if (this.texture?.image.height >= height) return;
    this.texture?.dispose();
    const rows = Math.ceil(1.25 * height);
    this.data = new Float32Array(4 * width * rows);
    this.texture = new THREE.DataTexture(
      this.data, width, rows, THREE.RGBAFormat, THREE.FloatType,
    );
  }
}

/// Normals of corners: the mean over the faces around a vertex that are of the same kind and no
/// sharp edge away. `corner`: position of each corner at rest.
function cornerNormals(face, isCrack, rest) {
  const count = face.length / 3;
  const flat = new Float32Array(3 * count);
  const area = new Float32Array(3 * count);
  for (let f = 0; f < count; ++f) {
    const a = 3 * face[3 * f], b = 3 * face[3 * f + 1], c = 3 * face[3 * f + 2];
    const ux = rest[b] - rest[a], uy = rest[b + 1] - rest[a + 1], uz = rest[b + 2] - rest[a + 2];
    const vx = rest[c] - rest[a], vy = rest[c + 1] - rest[a + 1], vz = rest[c + 2] - rest[a + 2];
    const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    const length = Math.sqrt(nx * nx + ny * ny + nz * nz) || 1;
    area[3 * f] = nx;
    area[3 * f + 1] = ny;
    area[3 * f + 2] = nz;
    flat[3 * f] = nx / length;
    flat[3 * f + 1] = ny / length;
    flat[3 * f + 2] = nz / length;
  }
  const first = new Uint32Array(rest.length / 3 + 1);
  for (let k = 0; k < face.length; ++k) ++first[face[k] + 1];
  for (let v = 1; v < first.length; ++v) first[v] += first[v - 1];
  const around = new Uint32Array(face.length);
  const next = first.slice();
  for (let k = 0; k < face.length; ++k) around[next[face[k]]++] = Math.floor(k / 3);
  const normal = new Float32Array(3 * face.length);
  for (let k = 0; k < face.length; ++k) {
    const f = Math.floor(k / 3);
    const fx = flat[3 * f], fy = flat[3 * f + 1], fz = flat[3 * f + 2];
    let x = 0, y = 0, z = 0;
    for (let j = first[face[k]]; j < first[face[k] + 1]; ++j) {
      const g = around[j];
      if (isCrack[g] !== isCrack[f]) continue;
      if (fx * flat[3 * g] + fy * flat[3 * g + 1] + fz * flat[3 * g + 2] < crease) continue;
      x += area[3 * g];
      y += area[3 * g + 1];
      z += area[3 * g + 2];
    }
    const length = Math.sqrt(x * x + y * y + z * z) || 1;
    normal[3 * k] = x / length;
    normal[3 * k + 1] = y / length;
    normal[3 * k + 2] = z / length;
  }
  return normal;
}

export class BodyMesh {
  constructor(look) {
    this.pieces = new FloatTexture();
    this.vertices = new FloatTexture();
    this.uniforms = {
      pieces: { value: this.pieces.texture },
      vertices: { value: this.vertices.texture },
      explode: { value: 0 },
      middle: { value: new THREE.Vector3() },
      deformed: { value: 0 },
      magnify: { value: 1 },
      colourBy: { value: 0 },
      range: { value: new THREE.Vector2(0, 1) },
      wires: { value: 0 },
      outside: { value: new THREE.Color(look.outside) },
      inside: { value: new THREE.Color(look.inside) },
      grain: { value: look.grain },
      now: { value: 0 },
      marked: { value: -1 },
      ghost: { value: 0 },
    };
    const material = new THREE.MeshStandardMaterial({
      roughness: look.roughness, metalness: 0, side: THREE.DoubleSide, clipShadows: true,
    });
    bodyShader(material, this.uniforms, true);
    const depth = new THREE.MeshDepthMaterial({
      depthPacking: THREE.RGBADepthPacking, side: THREE.DoubleSide,
    });
    bodyShader(depth, this.uniforms, false);
    this.mesh = new THREE.Mesh(new THREE.BufferGeometry(), material);
    this.mesh.customDepthMaterial = depth;
    this.mesh.castShadow = this.mesh.receiveShadow = true;
    this.mesh.frustumCulled = false;
    this.ghost = this.makeGhost();
    this.group = new THREE.Group();
    this.group.add(this.mesh, this.ghost);
  }

  /// The deformed state over the rigid reference, as in figure 1: blue, with wires, seen through.
  makeGhost() {
    const material = new THREE.MeshStandardMaterial({
      roughness: 1, transparent: true, opacity: 0.4, depthWrite: false, side: THREE.DoubleSide, clipShadows: true,
      polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -1,
    });
    const own = { deformed: { value: 1 }, ghost: { value: 1 }, wires: { value: 1 } };
    bodyShader(material, { ...this.uniforms, ...own }, true);
    const ghost = new THREE.Mesh(this.mesh.geometry, material);
    ghost.frustumCulled = false;
    ghost.visible = false;
    return ghost;
  }

  /// Faces, vertices and pieces as they are from now on. `opened`: by half-face, as a recording has
  /// it.
  setShape(shape, opened) {
    this.shape = shape;
    const { face, faceIsCrack, halfFace, piece, restCentre } = shape;
    const rest = (this.rest = shape.smooth ?? shape.rest);
    const corners = face.length;
    const at = new Float32Array(3 * corners);
    const ids = new Float32Array(3 * corners); // vertex, piece, 1 on a crack
    const since = new Float32Array(2 * corners); // number of the fan from 1, s; 0: cut by hand or at the start
    for (let k = 0; k < corners; ++k) {
      const v = face[k], p = piece[v];
      for (let i = 0; i < 3; ++i) at[3 * k + i] = rest[3 * v + i];
      ids[3 * k] = v;
      ids[3 * k + 1] = p;
      ids[3 * k + 2] = faceIsCrack[Math.floor(k / 3)];
      const fan = opened.get(halfFace[Math.floor(k / 3)]);
      if (!fan) continue;
      since[2 * k] = fan[0] + 1;
      since[2 * k + 1] = fan[1];
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(at, 3));
    geometry.setAttribute('normal', new THREE.BufferAttribute(cornerNormals(face, faceIsCrack, rest), 3));
    geometry.setAttribute('ids', new THREE.BufferAttribute(ids, 3));
    geometry.setAttribute('opened', new THREE.BufferAttribute(since, 2));
    this.mesh.geometry.dispose();
    this.mesh.geometry = this.ghost.geometry = geometry;
    this.pieces.resize((3 * restCentre.length) / 4);
    this.vertices.resize(rest.length / 3);
    this.uniforms.pieces.value = this.pieces.texture;
    this.uniforms.vertices.value = this.vertices.texture;
    const used = new Uint8Array(restCentre.length / 4);
    for (let k = 0; k < corners; ++k) used[piece[face[k]]] = 1;
    this.used = used;
  }

  /// Poses to draw by, the simulation's own, positions, and one number a vertex, for its colour.
  setState({ drawnPose, pose, position, scalar }) {
    const { restCentre, birth } = this.shape;
    if (this.shape.smooth) position = this.smoothed(pose, position);
    const data = this.pieces.data;
    const middle = new THREE.Vector3();
    let mass = 0;
    for (let p = 0; p < drawnPose.length / 8; ++p) {
      data.set(drawnPose.subarray(8 * p, 8 * p + 8), 12 * p);
      data.set(restCentre.subarray(4 * p, 4 * p + 3), 12 * p + 8);
      data[12 * p + 3] = birth[p];
      if (!this.used[p]) continue;
      const m = restCentre[4 * p + 3];
      mass += m;
      middle.x += m * drawnPose[8 * p];
      middle.y += m * drawnPose[8 * p + 1];
      middle.z += m * drawnPose[8 * p + 2];
    }
    if (mass > 0) middle.divideScalar(mass);
    this.uniforms.middle.value.copy(middle);
    for (let v = 0; v < position.length / 3; ++v) {
      this.vertices.data[4 * v] = position[3 * v];
      this.vertices.data[4 * v + 1] = position[3 * v + 1];
      this.vertices.data[4 * v + 2] = position[3 * v + 2];
      this.vertices.data[4 * v + 3] = scalar ? scalar[v] : 0;
    }
    this.pieces.texture.needsUpdate = true;
    this.vertices.texture.needsUpdate = true;
    this.state = { drawnPose, position };
  }

  /// Positions with points on cracks moved as they are at rest.
  smoothed(pose, position) {
    const { rest, smooth, piece } = this.shape;
    const move = new THREE.Vector3();
    const turn = new THREE.Quaternion();
    const moved = position.slice();
    for (let v = 0; v < piece.length; ++v) {
      move.set(smooth[3 * v] - rest[3 * v], smooth[3 * v + 1] - rest[3 * v + 1], smooth[3 * v + 2] - rest[3 * v + 2]);
      if (move.x === 0 && move.y === 0 && move.z === 0) continue;
      move.applyQuaternion(turn.fromArray(pose, 8 * piece[v] + 4));
      moved[3 * v] += move.x;
      moved[3 * v + 1] += move.y;
      moved[3 * v + 2] += move.z;
    }
    return moved;
  }

  /// Where a vertex is drawn; what the vertex shader does.
  drawnPlace(v, target) {
    const { restCentre, piece } = this.shape;
    const { rest } = this;
    const p = piece[v];
    const { deformed, explode, middle } = this.uniforms;
    const pose = this.state.drawnPose;
    const centre = new THREE.Vector3().fromArray(pose, 8 * p);
    const q = new THREE.Quaternion().fromArray(pose, 8 * p + 4);
    target.set(
      rest[3 * v] - restCentre[4 * p],
      rest[3 * v + 1] - restCentre[4 * p + 1],
      rest[3 * v + 2] - restCentre[4 * p + 2],
    );
    target.applyQuaternion(q).add(centre);
    if (deformed.value > 0) {
      const own = new THREE.Vector3().fromArray(this.state.position, 3 * v);
      target.addScaledVector(own.sub(target.clone()), deformed.value * this.uniforms.magnify.value);
    }
    return target.addScaledVector(centre.sub(middle.value), explode.value);
  }

  /// The nearest face that a ray meets, and its vertex nearest to that place; null for none.
  pick(ray) {
    const { face } = this.shape;
    const corner = [new THREE.Vector3(), new THREE.Vector3(), new THREE.Vector3()];
    const meet = new THREE.Vector3();
    let best = null;
    for (let f = 0; f < face.length / 3; ++f) {
      corner.forEach((c, i) => this.drawnPlace(face[3 * f + i], c));
      if (!ray.intersectTriangle(...corner, false, meet)) continue;
      const distance = meet.distanceTo(ray.origin);
      if (best && best.distance <= distance) continue;
      const gaps = corner.map((c) => c.distanceTo(meet));
      const vertex = face[3 * f + gaps.indexOf(Math.min(...gaps))];
      best = { distance, vertex, face: f, place: meet.clone(), at: this.drawnPlace(vertex, new THREE.Vector3()) };
    }
    return best;
  }
}
