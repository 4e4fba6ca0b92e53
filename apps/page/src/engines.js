// SPDX-License-Identifier: MIT
// The two back ends behind one promise: `ask(work, input)`.
import { columns as known, readReport, readVertex, actionSize, writeAction } from './layout.js';

/// WebAssembly in a Worker, from static files.
export class WorkerEngine {
  constructor() {
    this.worker = new Worker('engine_worker.js', { type: 'module' });
    this.waiting = new Map();
    this.last = 0;
    this.worker.onmessage = ({ data }) => {
      const { settle, refuse } = this.waiting.get(data.id);
      this.waiting.delete(data.id);
      if (data.error === undefined) settle(data.result);
      else refuse(new Error(data.error));
    };
    this.worker.onerror = (event) => {
      event.preventDefault();
      this.lost = new Error(`the engine has ended (${event.message ?? 'its program could not be loaded'}): load the page again`);
      for (const { refuse } of this.waiting.values()) refuse(this.lost);
      this.waiting.clear();
    };
  }

  ask(work, input = {}) {
    if (this.lost) return Promise.reject(this.lost);
    return new Promise((settle, refuse) => {
      this.waiting.set(++this.last, { settle, refuse });
      this.worker.postMessage({ id: this.last, work, input });
    });
  }
}

/// The size of a JSON text, the text, and of a scene that was dropped the files: the server has its own.
function loadBody({ settings, isDropped, text, name, files }) {
  const names = isDropped ? Object.keys(files) : [];
  const contents = names.map((file) => files[file]);
  const request = { settings, ...(isDropped && { text, name, files: names, sizes: contents.map((c) => c.length) }) };
  const words = new TextEncoder().encode(JSON.stringify(request));
  return new Blob([new BigUint64Array([BigInt(words.length)]), words, ...contents]);
}

/// `sunder view`: the native engine, which this page came from.
export class ServerEngine {
  constructor(token) {
    this.token = token;
  }

  async ask(work, input = {}) {
    const answer = await fetch(`api/${work}`, {
      method: 'POST',
      headers: { 'X-Sunder-Token': this.token, 'Content-Type': 'application/octet-stream' },
      body: this.body(work, input),
    }).catch(() => {
      throw new Error('the program sunder view no longer answers: it was ended. Start it again and open the address that it prints.');
    });
    if (!answer.ok) throw new Error(await answer.text());
    return this.result(work, await answer.arrayBuffer());
  }

  body(work, input) {
    if (work === 'act') {
      const bytes = new ArrayBuffer(actionSize);
      writeAction(new DataView(bytes), 0, input.action);
      return bytes;
    }
    if (work === 'load') return loadBody(input.scene);
    const request = { ...input };
    for (const list of ['columns', 'shapeColumns']) {
      if (input[list]) request[list] = input[list].map((name) => known[name].id);
    }
    return JSON.stringify(request);
  }

  /// "report" (168 bytes), then columns: id and size (4 bytes each), content, padded to 8 bytes.
  result(work, bytes) {
    const view = new DataView(bytes);
    if (work === 'open' || work === 'forget') return {};
    if (work === 'stamp') return { stamp: new TextDecoder().decode(bytes) };
    if (work === 'inspect') return readVertex(view, 0);
    if (work === 'save') return { step: Number(view.getBigUint64(0, true)), size: Number(view.getBigUint64(8, true)) };
    const result = { report: readReport(view, 0), columns: {} };
    let at = view.getUint32(0, true);
    const words = view.getUint32(at, true);
    const text = new TextDecoder().decode(new Uint8Array(bytes, at + 8, words));
    if (result.report.failed) result.report.error = text;
    else result.warnings = text;
    at += 8 + 8 * Math.ceil(words / 8);
    while (at < bytes.byteLength) {
      const id = view.getUint32(at, true);
      const size = view.getUint32(at + 4, true);
      const name = Object.keys(known).find((key) => known[key].id === id);
      result.columns[name] = new known[name].array(bytes.slice(at + 8, at + 8 + size));
      at += 8 + 8 * Math.ceil(size / 8);
    }
    return result;
  }
}
