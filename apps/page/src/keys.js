// SPDX-License-Identifier: MIT
// The view without a mouse: a cursor that keys move, and a camera that keys turn.
import * as THREE from 'three';

/// Turns the camera round what it looks at by angles (rad), and brings it nearer by a factor.
export function turnCamera({ camera, controls }, aside, up, nearer) {
  const arm = camera.position.clone().sub(controls.target);
  const ball = new THREE.Spherical().setFromVector3(new THREE.Vector3(arm.x, arm.z, -arm.y));
  ball.theta += aside;
  ball.phi = Math.min(Math.max(0.05, ball.phi - up), Math.PI - 0.05);
  ball.radius *= nearer;
  arm.setFromSpherical(ball);
  camera.position.set(arm.x, -arm.z, arm.y).add(controls.target);
}

/// Keys of the canvas while it has the focus: arrows move the cursor, Enter is a click of the tool
/// there. Pull and cut take two: the first presses, the second lets go.
export class KeyCursor {
  constructor(canvas, mark, tools) {
    Object.assign(this, { canvas, mark, tools, x: 0.5, y: 0.45, isDown: false, byPointer: false });
    canvas.addEventListener('blur', () => this.leave());
    canvas.addEventListener('pointerdown', () => {
      this.byPointer = true;
      mark.hidden = true;
    });
  }

  event() {
    const box = this.canvas.getBoundingClientRect();
    return { button: 0, shiftKey: false, clientX: box.left + this.x * box.width, clientY: box.top + this.y * box.height };
  }

  show() {
    const { clientX, clientY } = this.event();
    Object.assign(this.mark.style, { left: `${clientX}px`, top: `${clientY}px` });
    this.mark.hidden = false;
    this.mark.classList.toggle('down', this.isDown);
  }

  move(dx, dy) {
    this.x = Math.min(Math.max(0, this.x + dx), 1);
    this.y = Math.min(Math.max(0, this.y + dy), 1);
    this.show();
    if (this.isDown) this.tools.move(this.event());
  }

  press() {
    if (!this.isDown) this.tools.down(this.event());
    const staysDown = !this.isDown && ['pull', 'cut'].includes(this.tools.tool);
    if (!staysDown) this.tools.up(this.event());
    this.isDown = staysDown;
    this.show();
  }

  leave() {
    if (this.isDown) this.press();
    this.byPointer = false;
    this.mark.hidden = true;
  }

  /// True where the key was one of these. Who came with a pointer gets the cursor by Enter.
  key(event) {
    if (this.byPointer) {
      if (event.key !== 'Enter') return false;
      this.byPointer = false;
      this.show();
      return true;
    }
    const step = event.shiftKey ? 0.05 : 0.0125;
    const known = {
      ArrowLeft: () => this.move(-step, 0),
      ArrowRight: () => this.move(step, 0),
      ArrowUp: () => this.move(0, -step),
      ArrowDown: () => this.move(0, step),
      Enter: () => this.press(),
    }[event.key];
    known?.();
    return Boolean(known);
  }
}
