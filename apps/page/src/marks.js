// SPDX-License-Identifier: MIT
// What is drawn over the bodies on demand: contacts with their impulses, crack fronts, a fan.
import * as THREE from 'three';

import { none } from './layout.js';

/// Lines or triangles whose corners change from frame to frame, kept larger than needed.
class Strokes {
  constructor(Kind, material, order) {
    this.object = new Kind(new THREE.BufferGeometry(), material);
    this.object.frustumCulled = false;
    this.object.renderOrder = order;
    this.object.visible = false;
    this.room = 0;
  }

  /// `points`: numbers, three a corner; none: nothing is drawn.
  set(points) {
    const { object } = this;
    object.visible = points.length > 0;
    if (points.length === 0) return;
    if (points.length > this.room) {
      object.geometry.dispose();
      object.geometry = new THREE.BufferGeometry();
      this.room = 6 * points.length;
      object.geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(this.room), 3));
    }
    object.geometry.attributes.position.array.set(points);
    object.geometry.attributes.position.needsUpdate = true;
    object.geometry.setDrawRange(0, points.length / 3);
  }
}

const through = { depthTest: false, transparent: true };

export class Marks {
  constructor(scene) {
    const lines = (color) => new Strokes(THREE.LineSegments, new THREE.LineBasicMaterial({ color, ...through }), 11);
    const faces = (color, opacity) =>
      new Strokes(THREE.Mesh, new THREE.MeshBasicMaterial({ color, opacity, side: THREE.DoubleSide, ...through }), 10);
    this.points = new Strokes(
      THREE.Points, new THREE.PointsMaterial({ color: 0x0b7285, size: 6, sizeAttenuation: false, ...through }), 12,
    );
    this.impulses = lines(0x0b7285);
    this.fronts = lines(0xe8590c);
    this.fanEdges = lines(0x22272b);
    this.fanDone = faces(0xf2b705, 0.45);
    this.fanFace = faces(0xe8590c, 0.8);
    for (const name of ['points', 'impulses', 'fronts', 'fanDone', 'fanFace', 'fanEdges']) scene.add(this[name].object);
  }

  /// Rows of the column `contact`; a line is as long as `longest` (m) for the largest force.
  showContacts(rows, longest) {
    const points = [], ends = [], forces = [];
    for (let at = 0; at < rows.length; at += 8) {
      forces.push(Math.hypot(rows[at + 4], rows[at + 5], rows[at + 6]) / rows[at + 3]);
    }
    const most = forces.reduce((a, b) => Math.max(a, b), 0);
    forces.forEach((force, k) => {
      const [x, y, z, step, jx, jy, jz] = rows.subarray(8 * k, 8 * k + 7);
      const scale = (longest * Math.sqrt(force / most)) / (force * step); // roots: small ones are seen too
      points.push(x, y, z);
      ends.push(x, y, z, x + scale * jx, y + scale * jy, z + scale * jz);
    });
    this.points.set(points);
    this.impulses.set(ends);
  }

  /// `edges`: vertices of crack fronts, two an edge; `place(v)`: where one is drawn.
  showFronts(edges, place) {
    this.fronts.set(Array.from(edges, place).flat());
  }

  /// The faces of a fan: those before `now` as split, that one, and those to come as edges.
  showFan(faces, now, place) {
    const corners = faces.map((face) => (face.opposite === none ? [] : face.vertices.map(place)));
    this.fanDone.set(corners.slice(0, now).flat(2));
    this.fanFace.set(corners.slice(now, now + 1).flat(2));
    this.fanEdges.set(corners.filter((c) => c.length).flatMap(([a, b, c]) => [...a, ...b, ...b, ...c, ...c, ...a]));
  }

  hideFan() {
    for (const part of [this.fanDone, this.fanFace, this.fanEdges]) part.set([]);
  }
}
