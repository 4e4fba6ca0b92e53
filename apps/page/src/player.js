// SPDX-License-Identifier: MIT
// Steps the engine, keeps what it computed, and says which frame is shown. Pictures never wait for
// a step nor steps for a picture: at most one request is on its way.
import { largestJump } from './jump.js';
import { readFans, readMaterials } from './layout.js';
import { Recording } from './recording.js';

const perStep = [
  'position', 'drawnPose', 'pose', 'velocity', 'obstacle', 'stress', 'loadRatio', 'speed', 'contact', 'fan', 'fanFace',
];
const perShape = [
  'face', 'faceIsCrack', 'halfFace', 'rest', 'piece', 'restCentre', 'birth', 'body', 'parent', 'tetrahedra',
  'crackFront', 'solid',
];
const savesApart = 60; // steps
const summed = ['tested', 'suspects', 'reached', 'predicted', 'created'];

export class Player {
  /// `events`: frame() when another frame is to be shown, message(text).
  constructor(engine, events) {
    this.engine = engine;
    this.events = events;
    this.recording = new Recording();
    this.playing = false;
    this.pace = 60; // steps a second at most
    this.row = 0;
    this.perShape = perShape;
    this.busy = Promise.resolve();
    this.changing = false; // another scene or an earlier state is on its way: no step is asked for
    this.longest = 0; // ms: that a frame took to be recorded
    this.pull = null; // the newest place of the spring, not yet sent
    this.asked = null; // ms: when the step that is on its way was asked for
  }

  /// One request after the other, in their order.
  ask(work, input) {
    const answer = this.busy.then(() => this.engine.ask(work, input));
    this.busy = answer.catch(() => {});
    return answer;
  }

  async open(scene) {
    this.playing = false;
    const isSmooth = JSON.parse(scene.text).output?.crack_surface === 'smooth';
    this.perShape = isSmooth ? [...perShape, 'smooth'] : perShape;
    await this.change(async () => {
      const { warnings } = await this.ask('load', { scene });
      this.warnings = warnings;
      this.recording.clear();
      const start = await this.ask('read', { columns: [...perStep, ...this.perShape, 'material'] });
      this.materials = readMaterials(start.columns.material);
      delete start.columns.material;
      this.record(start);
    });
    await this.save();
  }

  async change(work) {
    this.changing = true;
    try {
      await work();
    } finally {
      this.changing = false;
    }
  }

  async save() {
    const { step, size } = await this.ask('save');
    this.savedSize = size;
    const forgotten = this.recording.addSaved(step);
    if (forgotten !== null) await this.ask('forget', { step: forgotten });
  }

  record({ report, columns }) {
    const start = performance.now();
    const last = this.recording.last;
    const shape = { ...last?.shape };
    let isNew = false;
    for (const name of this.perShape) {
      if (!columns[name]) continue;
      shape[name] = columns[name];
      delete columns[name];
      isNew = true;
    }
    const sums = Object.fromEntries(summed.map((key) => [key, (last?.sums[key] ?? 0) + report[key]]));
    const follows = this.isAtEnd();
    this.recording.addFans(report.step, readFans(columns.fan, columns.fanFace));
    delete columns.fan;
    delete columns.fanFace;
    const frame = { report, columns, sums, shape: isNew ? shape : last.shape };
    frame.jump = last ? largestJump(last, frame) : { drawn: 0, target: 0 };
    this.recording.add(frame);
    if (follows) this.row = this.recording.frames.length - 1;
    this.longest = Math.max(this.longest, performance.now() - start);
    this.events.frame();
    if (report.failed) {
      this.playing = false;
      this.events.message(report.error);
    }
  }

  async step() {
    const last = this.recording.last;
    if (this.changing || !last || last.report.failed) return; // nothing is loaded yet, or it cannot go on
    this.asked = performance.now();
    const answer = await this.ask('step', {
      count: 1, columns: perStep, shape: last.report.shape, shapeColumns: this.perShape,
    }).finally(() => (this.asked = null));
    if (!answer.report.failed && answer.report.step !== last.report.step + 1) {
      throw new Error('another page has started the scene anew: the program serves one page at a time. Restart takes it back.');
    }
    this.record(answer);
    if (answer.report.step % savesApart === 0) await this.save();
  }

  /// Steps, or shows what is recorded, at the pace that is wanted, until it is paused.
  async run() {
    if (this.isRunning) return;
    this.isRunning = true;
    let due = performance.now();
    while (this.playing) {
      if (this.isAtEnd()) await this.attempt(() => this.step());
      else this.look(this.row + 1);
      due = Math.max(due + 1000 / this.pace, performance.now() - 1000 / this.pace);
      await new Promise((next) => setTimeout(next, due - performance.now()));
    }
    this.isRunning = false;
  }

  attempt(work) {
    return work().catch((error) => {
      this.playing = false;
      this.events.message(error.message);
      this.events.frame();
    });
  }

  play() {
    this.playing = true;
    this.events.frame();
    this.run();
  }

  toggle() {
    if (!this.playing) return this.play();
    this.playing = false;
    this.events.frame();
  }

  /// Pauses, and takes one step or shows one frame more.
  once() {
    this.playing = false;
    if (!this.isAtEnd()) return this.look(this.row + 1);
    return this.attempt(() => this.step());
  }

  /// Shows frame `row` of those recorded; nothing is computed.
  look(row) {
    this.row = Math.min(Math.max(0, row), this.recording.frames.length - 1);
    this.events.frame();
  }

  shown() {
    return this.recording.frames[this.row];
  }

  isAtEnd() {
    return this.row >= this.recording.frames.length - 1;
  }

  /// Goes on from the saved state at or before the frame that is shown; what came after is
  /// forgotten.
  branch() {
    const step = this.recording.savedBefore(this.row);
    return this.change(async () => {
      await this.ask('restore', { step });
      this.recording.cutAfter(step);
      this.row = this.recording.frames.length - 1;
      // A restored engine counts its shapes anew.
      const { report, columns } = await this.ask('read', { columns: [...perStep, ...this.perShape] });
      const same = this.recording.frames.pop();
      this.record({ report: { ...same.report, shape: report.shape }, columns });
    });
  }

  /// Does something to the scene as it is computed last. Of many places of a spring the newest
  /// counts.
  async act(action) {
    if (action.kind === 'pull') {
      const isOnItsWay = this.pull !== null;
      this.pull = action;
      if (isOnItsWay) return;
    }
    this.row = this.recording.frames.length - 1;
    await this.attempt(async () => {
      await this.busy;
      const newest = action.kind === 'pull' ? this.pull : action;
      if (action.kind === 'pull') this.pull = null;
      await this.ask('act', { action: newest });
    });
  }

  inspect(vertex) {
    return this.ask('inspect', { vertex });
  }
}
