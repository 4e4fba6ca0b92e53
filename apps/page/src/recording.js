// SPDX-License-Identifier: MIT
// What has been computed: a frame a step, looked back on without computing anything again.
import { none } from './layout.js';

const mostBytes = 400e6;
const mostSaved = 8;

/// The bytes of a frame's columns.
function bytesOf(frame) {
  return Object.values(frame.columns).reduce((sum, array) => sum + array.byteLength, 0);
}

export class Recording {
  constructor() {
    this.clear();
  }

  clear() {
    this.frames = [];
    this.bytes = 0;
    this.saved = []; // steps that the engine can go back to, rising
    this.fans = []; // all fans, in order, with the step that they are of
    this.opened = new Map(); // by half-face on a crack: [number of its fan, s]
  }

  /// Notes fans of a step; a face was opened by the first that split it.
  addFans(step, fans) {
    for (const fan of fans) {
      fan.step = step;
      this.fans.push(fan);
      for (const { halfFace, opposite } of fan.faces) {
        if (opposite === none) continue;
        this.opened.set(halfFace, [fan.number, fan.time]).set(opposite, [fan.number, fan.time]);
      }
    }
  }

  get last() {
    return this.frames.at(-1);
  }

  /// Appends {report, columns, shape}; of a recording that has become too large every second frame of
  /// its older half goes.
  add(frame) {
    this.frames.push(frame);
    this.bytes += bytesOf(frame);
    if (this.bytes < mostBytes) return;
    const half = Math.floor(this.frames.length / 2);
    this.frames = this.frames.filter((f, k) => k >= half || k % 2 === 0);
    this.bytes = this.frames.reduce((sum, f) => sum + bytesOf(f), 0);
  }

  /// Notes a saved state; gives the step of one to forget where there are too many, or null.
  addSaved(step) {
    this.saved.push(step);
    if (this.saved.length <= mostSaved) return null;
    // The one whose neighbours are nearest to each other; never the first nor the last.
    let least = 1;
    for (let k = 1; k + 1 < this.saved.length; ++k) {
      const gap = (j) => this.saved[j + 1] - this.saved[j - 1];
      if (gap(k) < gap(least)) least = k;
    }
    return this.saved.splice(least, 1)[0];
  }

  /// The saved step at or before that of frame `k`; undefined for none.
  savedBefore(k) {
    const { step } = this.frames[k].report;
    return this.saved.filter((s) => s <= step).at(-1);
  }

  /// Forgets all after `step`.
  cutAfter(step) {
    this.frames = this.frames.filter((f) => f.report.step <= step);
    this.saved = this.saved.filter((s) => s <= step);
    const before = this.fans.filter((f) => f.step <= step);
    this.fans = [];
    this.opened.clear();
    for (const fan of before) this.addFans(fan.step, [fan]);
    this.bytes = this.frames.reduce((sum, f) => sum + bytesOf(f), 0);
  }
}
