// SPDX-License-Identifier: MIT
// What is around the bodies: light, ground, obstacles, camera, clip plane, marks.
import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { RoomEnvironment } from 'three/addons/environments/RoomEnvironment.js';

import { Ambient } from './ambient.js';
import { Marks } from './marks.js';

export class Stage {
  constructor(canvas) {
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFShadowMap;
    this.renderer.toneMapping = THREE.ACESFilmicToneMapping;
    this.renderer.toneMappingExposure = 1.05;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.info.autoReset = false;
    this.renderer.shadowMap.autoUpdate = false;
    this.ambient = new Ambient();
    this.hasAmbient = false;
    this.stale = true; // something is to be drawn otherwise than before, not the camera alone
    this.scene = new THREE.Scene();
    this.scene.background = new THREE.Color(0xdfe3e6);
    this.scene.fog = new THREE.Fog(0xdfe3e6, 10, 40);
    const rooms = new THREE.PMREMGenerator(this.renderer);
    this.scene.environment = rooms.fromScene(new RoomEnvironment(), 0.04).texture;
    this.scene.environmentIntensity = 0.42;
    this.camera = new THREE.PerspectiveCamera(35, 1, 0.01, 200);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = true;
    this.sun = new THREE.DirectionalLight(0xfff2e0, 2.6);
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(2048, 2048);
    this.sun.shadow.bias = -0.0004;
    this.scene.add(this.sun, this.sun.target);
    this.obstacles = [];
    this.plane = new THREE.Plane(new THREE.Vector3(0, 1, 0), 0);
    this.arrow = null;
    this.mark = this.makeMark();
    this.scene.add(this.mark);
    this.marks = new Marks(this.scene);
    this.resize();
  }

  makeMark() {
    const mark = new THREE.Group();
    const ball = new THREE.Mesh(
      new THREE.SphereGeometry(0.012, 20, 12),
      new THREE.MeshBasicMaterial({ color: 0xff3d00, depthTest: false }),
    );
    this.disc = new THREE.Mesh(
      new THREE.CircleGeometry(0.12, 40),
      new THREE.MeshBasicMaterial({
        color: 0xff3d00, transparent: true, opacity: 0.35, side: THREE.DoubleSide, depthTest: false,
      }),
    );
    mark.add(ball, this.disc);
    this.axes = [0xff3d00, 0x2e7d32, 0x1565c0].map((colour) => {
      const line = new THREE.Line(
        new THREE.BufferGeometry().setAttribute('position', new THREE.BufferAttribute(new Float32Array(6), 3)),
        new THREE.LineBasicMaterial({ color: colour, depthTest: false }),
      );
      line.frustumCulled = false;
      mark.add(line);
      return line;
    });
    mark.visible = false;
    mark.renderOrder = 10;
    return mark;
  }

  /// Whether the pictures are computed by the processor: then what costs much starts switched off.
  isSlow() {
    const gl = this.renderer.getContext();
    const named = gl.getExtension('WEBGL_debug_renderer_info');
    return /swiftshader|llvmpipe|software/i.test(named ? gl.getParameter(named.UNMASKED_RENDERER_WEBGL) : '');
  }

  /// Shows a vertex: a ball, the plane of its largest stress, its principal axes by magnitude.
  showVertex(at, vertex) {
    this.mark.visible = this.stale = true;
    this.mark.position.copy(at);
    this.mark.scale.setScalar(this.size / 2);
    const normal = new THREE.Vector3(...vertex.direction[0]);
    this.disc.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), normal);
    const largest = Math.max(...vertex.principal.map(Math.abs), 1e-30);
    this.axes.forEach((line, i) => {
      const half = vertex.direction[i].map((x) => (0.16 * x * Math.abs(vertex.principal[i])) / largest);
      line.geometry.attributes.position.array.set([...half.map((x) => -x), ...half]);
      line.geometry.attributes.position.needsUpdate = true;
    });
  }

  hideVertex() {
    this.mark.visible = false;
    this.stale = true;
  }

  resize() {
    this.stale = true;
    const { clientWidth, clientHeight } = this.renderer.domElement;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / Math.max(1, clientHeight);
    this.camera.updateProjectionMatrix();
  }

  /// Camera and light for a body in `box`, the one before if it is left out.
  frame(box = this.box) {
    this.box = box;
    const centre = box.getCenter(new THREE.Vector3());
    this.size = box.getSize(new THREE.Vector3()).length();
    const seen = centre.clone().add(new THREE.Vector3(0, 0, -0.07 * this.size)); // above the footer
    this.controls.target.copy(seen);
    const away = new THREE.Vector3(0.62, -0.72, 0.34).multiplyScalar(2.3 * this.size);
    this.camera.position.copy(seen).add(away);
    this.camera.near = 0.01 * this.size;
    this.camera.far = 60 * this.size;
    this.camera.updateProjectionMatrix();
    this.scene.fog.near = 6 * this.size;
    this.scene.fog.far = 16 * this.size;
    const reach = 1.5 * this.size;
    this.sun.position.copy(centre).add(new THREE.Vector3(0.5, -0.45, 1.1).multiplyScalar(2 * this.size));
    this.sun.target.position.copy(centre);
    Object.assign(this.sun.shadow.camera, {
      left: -reach, right: reach, top: reach, bottom: -reach, near: 0.05 * this.size, far: 6 * this.size,
    });
    this.sun.shadow.camera.updateProjectionMatrix();
    this.sun.shadow.normalBias = 0.004 * this.size;
    this.controls.update();
  }

  /// Obstacles as they are now; `rows`: the column `obstacle`, `solids`: triangles of those that are
  /// meshes.
  setObstacles(rows, solids) {
    for (let k = 0; k < rows.length / 16; ++k) {
      const row = rows.subarray(16 * k, 16 * k + 16);
      const mesh = (this.obstacles[k] ??= this.makeObstacle(row, k, solids));
      mesh.visible = true;
      if (row[0] === 0) continue;
      mesh.position.set(row[1], row[2], row[3]);
      if (row[0] >= 2) mesh.quaternion.set(row[8], row[9], row[10], row[11]);
    }
    this.obstacles.forEach((mesh, k) => (mesh.visible = k < rows.length / 16));
  }

  makeObstacle(row, k, solids) {
    const isBall = row[0] === 1;
    const material = new THREE.MeshStandardMaterial({
      color: isBall ? 0x3b4148 : 0x9aa0a4, roughness: isBall ? 0.32 : 0.85, metalness: isBall ? 0.7 : 0,
    });
    let mesh;
    if (row[0] === 0) {
      mesh = new THREE.Mesh(new THREE.CircleGeometry(20 * this.size, 64), material);
      material.color.set(0xc9cccb);
      const normal = new THREE.Vector3(row[1], row[2], row[3]);
      mesh.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), normal);
      mesh.position.copy(this.controls.target).projectOnPlane(normal).addScaledVector(normal, row[4] - 0.001 * this.size);
    } else if (isBall) {
      mesh = new THREE.Mesh(new THREE.SphereGeometry(row[4], 40, 24), material);
    } else if (row[0] === 3) {
      const corners = [];
      for (let at = 0; at < solids.length; at += 10) {
        if (solids[at] === k) corners.push(...solids.subarray(at + 1, at + 10));
      }
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute('position', new THREE.Float32BufferAttribute(corners, 3));
      geometry.computeVertexNormals();
      mesh = new THREE.Mesh(geometry, material);
    } else {
      mesh = new THREE.Mesh(new THREE.BoxGeometry(2 * row[5], 2 * row[6], 2 * row[7]), material);
    }
    mesh.castShadow = row[0] !== 0;
    mesh.receiveShadow = true;
    this.scene.add(mesh);
    return mesh;
  }

  /// Forgets the obstacles and marks of the scene before.
  clear() {
    for (const mesh of this.obstacles) {
      this.scene.remove(mesh);
      mesh.geometry.dispose();
    }
    this.obstacles = [];
    this.hideVertex();
  }

  /// The ray through a place of the canvas, in pixels of the page.
  ray(x, y) {
    const box = this.renderer.domElement.getBoundingClientRect();
    const caster = new THREE.Raycaster();
    caster.setFromCamera(
      new THREE.Vector2(((x - box.left) / box.width) * 2 - 1, 1 - ((y - box.top) / box.height) * 2),
      this.camera,
    );
    return caster.ray;
  }

  /// Draws, where anything is otherwise than in the picture before. Returns whether it drew.
  draw() {
    if (!this.controls.update() && !this.stale) return false;
    this.renderer.shadowMap.needsUpdate = this.stale;
    this.stale = false;
    this.renderer.info.reset();
    if (this.hasAmbient) this.ambient.draw(this.renderer, this.scene, this.camera, 0.07 * this.size);
    else this.renderer.render(this.scene, this.camera);
    return true;
  }
}
