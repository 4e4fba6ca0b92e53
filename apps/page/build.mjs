// SPDX-License-Identifier: MIT
// Builds the page: node build.mjs [--out FOLDER] [--wasm sunder.wasm | --without-engine]. Without an
// engine it is that of `sunder view`, which brings its own.
import { build } from 'esbuild';
import { copyFileSync, existsSync, mkdirSync, readFileSync, writeFileSync, statSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';

import { meshFiles } from './src/scenes.js';

const here = dirname(fileURLToPath(import.meta.url));
const option = (name, otherwise) => {
  const at = process.argv.indexOf(name);
  return at < 0 ? otherwise : resolve(process.argv[at + 1]);
};
const out = option('--out', join(here, '../../build/page'));
const wasm = process.argv.includes('--without-engine') ? '' : option('--wasm', join(here, '../../build/wasm/apps/host/sunder.wasm'));

/// Scenes of the page, each with the folder of its file. The bunny's terms keep it out.
const meshes = join(here, '../../meshes/scenes');
const scenes = [
  ['monolith', meshes],
  ['plate', join(here, 'scenes')],
  ['ring', join(here, 'scenes')],
  ['block', meshes],
  ['bar', meshes],
  ['ball', meshes],
  ['vase', meshes],
];

mkdirSync(join(out, 'scenes'), { recursive: true });
await build({
  entryPoints: ['main.js', 'engine_worker.js'].map((name) => join(here, 'src', name)),
  outdir: out,
  bundle: true,
  format: 'esm',
  minify: true,
  target: 'es2022',
  legalComments: 'none',
});
for (const name of ['index.html', 'style.css']) copyFileSync(join(here, name), join(out, name));
copyFileSync(join(here, 'node_modules/three/LICENSE'), join(out, 'three-LICENSE.txt'));
if (existsSync(wasm)) copyFileSync(wasm, join(out, 'sunder.wasm'));

const list = scenes.map(([name, folder]) => {
  const text = readFileSync(join(folder, `${name}.json`), 'utf8');
  const named = meshFiles(JSON.parse(text)).map((file) => {
    const target = file.split('/').at(-1);
    copyFileSync(join(folder, file), join(out, 'scenes', target));
    return [file, target];
  });
  return { name, text, files: Object.fromEntries(named) };
});
writeFileSync(join(out, 'scenes/scenes.json'), JSON.stringify(list));

const parts = ['index.html', 'style.css', 'main.js', 'engine_worker.js', 'sunder.wasm'].filter((n) =>
  existsSync(join(out, n)),
);
let packed = 0;
for (const name of parts) {
  const size = gzipSync(readFileSync(join(out, name)), { level: 9 }).length;
  packed += size;
  console.log(`${name.padEnd(18)} ${statSync(join(out, name)).size} bytes, ${size} packed`);
}
console.log(`page               ${packed} bytes packed`);
