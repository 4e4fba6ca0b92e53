// SPDX-License-Identifier: MIT
// What the pointer does: shoot, pull, cut, inspect. Dragging beside a piece turns the camera.
import * as THREE from 'three';

const hints = {
  shoot: 'Click: a ball flies there.',
  pull: 'Press on a body and move: a spring pulls it.',
  cut: 'Draw a line across a body: it cuts. Shift and drag turns.',
  pick: 'Click a body: the stress there.',
};

export class Tools {
  /// `host`: what a tool needs of the page: stage, body, act(action), inspect(vertex), ball().
  constructor(canvas, host) {
    this.canvas = canvas;
    this.host = host;
    this.press = null;
    canvas.addEventListener('pointerdown', (event) => this.down(event), true);
    canvas.addEventListener('pointermove', (event) => this.move(event), true);
    canvas.addEventListener('pointerup', (event) => this.up(event), true);
    this.choose('shoot');
  }

  choose(tool) {
    this.tool = tool;
    for (const button of document.querySelectorAll('[data-tool]')) {
      button.setAttribute('aria-pressed', String(button.dataset.tool === tool));
    }
    document.getElementById('hint').textContent = hints[tool];
  }

  ray(event) {
    return this.host.stage.ray(event.clientX, event.clientY);
  }

  down(event) {
    if (event.button !== 0) return;
    this.press = { x: event.clientX, y: event.clientY, event };
    const ray = this.ray(event);
    if (this.tool === 'pull') {
      const met = this.host.body.pick(ray);
      if (!met) return;
      this.press.vertex = met.vertex;
      this.press.plane = new THREE.Plane().setFromNormalAndCoplanarPoint(
        this.host.stage.camera.getWorldDirection(new THREE.Vector3()), met.at,
      );
      this.host.stage.controls.enabled = false;
      this.host.play();
    }
    if (this.tool === 'cut' && event.shiftKey === false) this.host.stage.controls.enabled = false;
  }

  move(event) {
    if (this.press?.vertex === undefined || this.tool !== 'pull') return;
    const at = this.ray(event).intersectPlane(this.press.plane, new THREE.Vector3());
    if (at) this.host.act({ kind: 'pull', vertex: this.press.vertex, point: at.toArray() });
  }

  up(event) {
    const press = this.press;
    this.press = null;
    this.host.stage.controls.enabled = true;
    if (!press) return;
    const moved = Math.hypot(event.clientX - press.x, event.clientY - press.y);
    if (this.tool === 'pull') {
      if (press.vertex !== undefined) this.host.act({ kind: 'release' });
    } else if (this.tool === 'cut') {
      if (moved > 12) this.cut(press.event, event);
    } else if (moved < 5) {
      if (this.tool === 'shoot') this.shoot(event);
      else this.pick(event);
    }
  }

  shoot(event) {
    const ray = this.ray(event);
    const { radius, speed, mass } = this.host.ball();
    // Soon there: from a third of the body's size before what it is aimed at.
    const { stage, body } = this.host;
    const way = body.pick(ray)?.distance ?? ray.origin.distanceTo(stage.controls.target);
    const from = ray.at(Math.max(stage.camera.near, way - radius - stage.size / 3), new THREE.Vector3());
    this.host.act({
      kind: 'shoot', point: from.toArray(), vector: ray.direction.clone().multiplyScalar(speed).toArray(), radius, mass,
    });
    this.host.play();
  }

  /// The plane through the eye and the line that was drawn.
  cut(from, to) {
    const a = this.ray(from), b = this.ray(to);
    const normal = a.direction.clone().cross(b.direction).normalize();
    this.host.act({ kind: 'cut', point: a.origin.toArray(), vector: normal.toArray() });
    this.host.play();
  }

  pick(event) {
    const met = this.host.body.pick(this.ray(event));
    if (met) this.host.inspect(met.vertex);
    else this.host.inspect(null);
  }
}
