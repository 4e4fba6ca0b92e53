// SPDX-License-Identifier: MIT
// The Worker: one request after the other, so that the page's thread never waits for a step.
import { WasmEngine } from './wasm_engine.js';

let engine = null;
/// Saved states by the step they were saved at; they stay here, the page knows their steps.
let saved = new Map();

const work = {
  async open({ url }) {
    const module = await WebAssembly.compileStreaming(fetch(url));
    engine = new WasmEngine(module, (text) => console.warn(text));
    return {};
  },
  load({ scene }) {
    saved = new Map();
    return engine.load(scene);
  },
  step({ count, columns, shape, shapeColumns }) {
    const report = engine.step(count);
    const read = engine.read(report.shape === shape ? columns : [...columns, ...shapeColumns]);
    return { report, columns: read };
  },
  read: ({ columns }) => ({ report: engine.report(), columns: engine.read(columns) }),
  act: ({ action }) => ({ report: engine.act(action) }),
  inspect: ({ vertex }) => engine.inspect(vertex),
  save() {
    const bytes = engine.save();
    const { step } = engine.report();
    saved.set(step, bytes);
    return { step, size: bytes.byteLength };
  },
  restore({ step }) {
    return { report: engine.restore(saved.get(step)) };
  },
  forget({ step }) {
    saved.delete(step);
    return {};
  },
};

onmessage = async ({ data }) => {
  try {
    const result = await work[data.work](data.input);
    const buffers = Object.values(result.columns ?? {}).map((array) => array.buffer);
    postMessage({ id: data.id, result }, buffers);
  } catch (error) {
    postMessage({ id: data.id, error: error.message });
  }
};
