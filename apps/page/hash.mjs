// SPDX-License-Identifier: MIT
// Steps a scene by the WebAssembly engine in node and prints what came of it, a line:
//   node hash.mjs sunder.wasm SCENE.json STEPS
// The hash (FNV-1a over the saved state) is that of `sunder_host_hash SCENE.json STEPS`, natively.
import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';

import { meshFiles } from './src/scenes.js';
import { WasmEngine } from './src/wasm_engine.js';

const [wasm, path, steps] = process.argv.slice(2);
const engine = new WasmEngine(new WebAssembly.Module(readFileSync(wasm)), (t) => process.stderr.write(t));
const text = readFileSync(path, 'utf8');
const files = Object.fromEntries(
  meshFiles(JSON.parse(text)).map((mesh) => [mesh, new Uint8Array(readFileSync(join(dirname(path), mesh)))]),
);
engine.load({ text, name: path, files });
const start = performance.now();
const report = engine.step(Number(steps));
const ms = performance.now() - start;
let hash = 0xcbf29ce484222325n;
for (const byte of new Uint8Array(engine.save())) {
  hash = BigInt.asUintN(64, (hash ^ BigInt(byte)) * 0x100000001b3n);
}
console.log(`step ${report.step} fans ${report.fansTotal} pieces ${report.pieces} state ${hash.toString(16).padStart(16, '0')}`);
console.error(`${(ms / Number(steps)).toFixed(3)} ms a step, ${(engine.instance.memory.buffer.byteLength / 1e6).toFixed(0)} MB`);
