// SPDX-License-Identifier: MIT
// What scripts that drive the page share: its files served, `sunder view` started, Chromium without a display.
import puppeteer from 'puppeteer-core';
import { spawn } from 'node:child_process';
import { createServer } from 'node:http';
import { copyFileSync, existsSync, mkdirSync, mkdtempSync, readFileSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, dirname, extname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

import { meshFiles } from './src/scenes.js';

export const scenes = join(dirname(fileURLToPath(import.meta.url)), '../../meshes/scenes');

/// The value behind `--name` on the command line; null where it is not there.
export function option(name) {
  const at = process.argv.indexOf(name);
  return at < 0 ? null : process.argv[at + 1];
}

const types = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm', '.json': 'application/json' };

/// A server of the files in `folder`, as any would do: {address, close()}.
export async function serve(folder) {
  const server = createServer((request, response) => {
    const path = join(folder, request.url === '/' ? 'index.html' : request.url.split('?')[0]);
    if (!path.startsWith(folder) || !existsSync(path)) return response.writeHead(404).end();
    response.writeHead(200, { 'Content-Type': types[extname(path)] ?? 'application/octet-stream' });
    response.end(readFileSync(path));
  });
  await new Promise((ready) => server.listen(0, '127.0.0.1', ready));
  return { address: `http://127.0.0.1:${server.address().port}/`, close: () => server.close() };
}

/// Every `--set dotted.path=value` of the command line done to a scene.
function changed(scene) {
  process.argv.forEach((word, k) => {
    if (process.argv[k - 1] !== '--set') return;
    const [path, value] = word.split('=');
    const keys = path.split('.');
    const last = keys.pop();
    keys.reduce((part, key) => (part[key] ??= {}), scene)[last] = JSON.parse(value);
  });
  return scene;
}

/// `sunder view` on a copy of a scene that may be saved anew: {address, scene, child, close()}.
export async function view(program, folder, path = join(scenes, 'monolith.json')) {
  const home = mkdtempSync(join(tmpdir(), 'sunder_view_'));
  const scene = join(home, 'scenes', 'one', basename(path)); // meshes lie up to two folders above
  mkdirSync(dirname(scene), { recursive: true });
  const content = changed(JSON.parse(readFileSync(path)));
  writeFileSync(scene, JSON.stringify(content));
  for (const mesh of meshFiles(content)) copyFileSync(join(dirname(path), mesh), join(dirname(scene), mesh));
  const child = spawn(resolve(program), ['view', scene, '--headless', '--page', folder], { stdio: ['ignore', 'pipe', 'inherit'] });
  process.on('exit', () => child.kill());
  const address = await new Promise((ready, fail) => {
    child.stdout.once('data', (line) => ready(String(line).trim()));
    child.once('exit', (code) => fail(new Error(`sunder view ended with ${code}`)));
  });
  return { address, scene, child, close: () => child.kill() };
}

/// Debian's Chromium: the small one without windows, or the whole; null where neither is there.
export function chromium() {
  const known = [process.env.CHROMIUM, '/usr/bin/chromium-headless-shell', '/usr/bin/chromium'];
  return known.find((path) => path && existsSync(path)) ?? null;
}

/// A browser that draws without a graphics card too, by SwiftShader, slowly.
export function launch() {
  const executablePath = chromium();
  if (!executablePath) throw new Error('there is no Chromium: apt-get install chromium-headless-shell');
  return puppeteer.launch({
    executablePath,
    headless: executablePath.includes('headless-shell') ? 'shell' : true,
    args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
    protocolTimeout: 0,
  });
}

/// Opens the page and waits for its first picture; gives the seconds that took.
export async function openPage(page, address) {
  page.setDefaultTimeout(300000); // a machine may be slow: that is no failure
  const began = performance.now();
  await page.goto(address);
  await page.waitForFunction(() => window.sunder?.player.recording.frames.length > 0);
  await page.waitForFunction(() => sunder.stage.renderer.info.render.triangles > 0);
  return (performance.now() - began) / 1000;
}
