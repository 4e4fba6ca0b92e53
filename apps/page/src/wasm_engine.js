// SPDX-License-Identifier: MIT
// The engine as WebAssembly behind plain calls; runs in a Worker, and in node for tests.
import {
  actionSize,
  columns as known,
  readReport,
  readVertex,
  reportSize,
  vertexSize,
  writeAction,
} from './layout.js';
import { wasiImports } from './wasi.js';

/// An instance of `module` and what its functions need. A scene has an instance of its own: what
/// went wrong in one is gone with it.
class Instance {
  constructor(module, say) {
    const memory = () => this.memory;
    const thrown = (at, size) => {
      throw new Error(this.text(at, size));
    };
    const instance = new WebAssembly.Instance(module, {
      wasi_snapshot_preview1: wasiImports(memory, say),
      sunder: { thrown },
    });
    this.call = instance.exports;
    this.memory = instance.exports.memory;
    this.call._initialize();
    this.room = this.call.malloc(1024);
  }

  view() {
    return new DataView(this.memory.buffer);
  }

  text(at, size) {
    return new TextDecoder().decode(new Uint8Array(this.memory.buffer, at, size).slice());
  }

  words(at) {
    const bytes = new Uint8Array(this.memory.buffer);
    return this.text(at, bytes.indexOf(0, at) - at);
  }

  bytes(content) {
    const data = typeof content === 'string' ? new TextEncoder().encode(content) : content;
    const at = this.call.malloc(data.length + 1);
    if (at === 0) throw new Error(`there is no memory for ${data.length} bytes`);
    new Uint8Array(this.memory.buffer).set(data, at);
    new Uint8Array(this.memory.buffer)[at + data.length] = 0;
    return { at, size: data.length };
  }

  /// What a `sunder_span` in the room covers, copied.
  span() {
    const at = this.view().getUint32(this.room, true);
    const size = this.view().getUint32(this.room + 4, true);
    return this.memory.buffer.slice(at, at + size);
  }
}

export class WasmEngine {
  constructor(module, say = () => {}) {
    this.module = module;
    this.say = say;
    this.instance = null;
    this.saved = new Map();
  }

  /// A scene at its start. `scene`: {text, name, files: {name: bytes or text}, settings: [..]}.
  load(scene) {
    const i = new Instance(this.module, this.say);
    const held = [];
    const put = (content) => {
      held.push(i.bytes(content));
      return held.at(-1);
    };
    const files = Object.entries(scene.files).map(([name, content]) => [put(name), put(content)]);
    const settings = (scene.settings ?? []).map(put);
    const text = put(scene.text);
    const name = put(scene.name);
    const fileRows = put(new Uint8Array(12 * files.length)).at;
    const settingRows = put(new Uint8Array(4 * settings.length)).at;
    const view = i.view();
    files.forEach(([file, content], k) => {
      view.setUint32(fileRows + 12 * k, file.at, true);
      view.setUint32(fileRows + 12 * k + 4, content.at, true);
      view.setUint32(fileRows + 12 * k + 8, content.size, true);
    });
    settings.forEach((setting, k) => view.setUint32(settingRows + 4 * k, setting.at, true));
    [32, files.length, text.at, text.size, name.at, fileRows, settingRows, settings.length].forEach(
      (word, k) => view.setUint32(i.room + 4 * k, word, true),
    );
    const engine = i.call.sunder_create(i.room);
    const words = i.words(i.call.sunder_error(0));
    if (engine === 0) throw new Error(words);
    held.forEach(({ at }) => i.call.free(at));
    this.instance = i;
    this.engine = engine;
    return { report: this.report(), warnings: words };
  }

  report() {
    const i = this.instance;
    i.view().setUint32(i.room, reportSize, true);
    i.call.sunder_last_report(this.engine, i.room);
    return readReport(i.view(), i.room);
  }

  /// Up to `count` steps; ends at a failure. Gives the report of the last.
  step(count = 1) {
    for (let k = 0; k < count; ++k) {
      if (this.instance.call.sunder_step(this.engine, 0) !== 0) break;
    }
    const report = this.report();
    if (report.failed) report.error = this.error();
    return report;
  }

  error() {
    return this.instance.words(this.instance.call.sunder_error(this.engine));
  }

  /// Columns by name as typed arrays of their own.
  read(names) {
    const i = this.instance;
    const result = {};
    for (const name of names) {
      i.call.sunder_read(this.engine, known[name].id, i.room);
      result[name] = new known[name].array(i.span());
    }
    return result;
  }

  act(action) {
    const i = this.instance;
    writeAction(i.view(), i.room, action);
    if (i.call.sunder_act(this.engine, i.room) !== 0) throw new Error(this.error());
    return this.report();
  }

  inspect(vertex) {
    const i = this.instance;
    i.view().setUint32(i.room, vertexSize, true);
    if (i.call.sunder_inspect(this.engine, vertex, i.room) !== 0) {
      throw new Error(`there is no vertex ${vertex}`);
    }
    return readVertex(i.view(), i.room);
  }

  save() {
    this.instance.call.sunder_save(this.engine, this.instance.room);
    return this.instance.span();
  }

  restore(bytes) {
    const i = new Instance(this.module, this.say);
    const { at, size } = i.bytes(new Uint8Array(bytes));
    const engine = i.call.sunder_restore(at, size);
    if (engine === 0) throw new Error(i.words(i.call.sunder_error(0)));
    i.call.free(at);
    this.instance = i;
    this.engine = engine;
    return this.report();
  }
}
