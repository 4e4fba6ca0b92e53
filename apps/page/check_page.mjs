// SPDX-License-Identifier: MIT
// Drives the page in headless Chromium and holds what it shows against the engine's own words:
//   node check_page.mjs FOLDER_OF_THE_PAGE [--program SUNDER] [--run SUNDER] [--pictures FOLDER] [--short]
// With --program its command view serves the page and computes, else WebAssembly does; that program, or the one
// of --run, also runs the scene without a page, to the same fans and pieces.
import { execFileSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { gzipSync } from 'node:zlib';

import { chromium, launch, openPage, option, scenes, serve, view } from './browser.mjs';
import { checkAnew, checkEnd, checkFeatures, checkHands } from './check_features.mjs';

const folder = resolve(process.argv[2]);
const pictures = option('--pictures');
if (pictures) mkdirSync(pictures, { recursive: true });

const short = process.argv.includes('--short'); // what a test of ctest has the time for

const failures = [];
function expect(holds, words) {
  console.log(`${holds ? 'ok    ' : 'FAILED'} ${words}`);
  if (!holds) failures.push(words);
}

if (!chromium()) {
  console.log('skipped: Chromium is not installed (Debian: chromium-headless-shell)');
  process.exit(77);
}
const program = option('--program');
const scene = join(scenes, short ? 'charts/monolith.json' : 'monolith.json');
const viewed = program ? await view(program, folder, scene) : null;
const server = viewed ?? (await serve(folder));
const browser = await launch();
const page = await browser.newPage();
await page.setViewport({ width: 1100, height: 680 });
const said = [];
page.on('console', (m) => ['error', 'warn'].includes(m.type()) && said.push(m.text()));
page.on('pageerror', (error) => said.push(error.message));

const last = () => page.evaluate(() => ({ ...sunder.player.recording.last.report }));
const steps = (count) => page.evaluate(async (n) => {
  for (let i = 0; i < n; ++i) await sunder.player.step();
  return { ...sunder.player.recording.last.report };
}, count);
async function picture(name) {
  await page.evaluate(() => new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn))));
  if (pictures) await page.screenshot({ path: join(pictures, `${name}.png`) });
}
const pause = (ms) => new Promise((done) => setTimeout(done, ms));

console.log(`first picture after ${(await openPage(page, server.address)).toFixed(1)} s`);
await picture('start');

await page.click('#play');
await page.waitForFunction(() => sunder.player.recording.frames.length > 30);
await page.click('#play');
await page.waitForFunction(() => !sunder.player.isRunning); // a step that was on its way has come
const paused = await last();
await pause(300);
expect((await last()).step === paused.step, `paused at step ${paused.step}`);
await page.click('#once');
await page.waitForFunction((n) => sunder.player.recording.last?.report.step === n + 1, {}, paused.step);
expect(true, 'one step more by the button');

const report = await steps(400 - (await last()).step);
console.log(`step ${report.step}: ${report.fansTotal} fans, ${report.pieces} pieces`);
expect(report.fansTotal > 0 && report.pieces > 1, 'the body breaks');
if (program ?? option('--run')) {
  const out = mkdtempSync(join(tmpdir(), 'sunder_run_'));
  const duration = `duration=${report.time}`;
  execFileSync(resolve(program ?? option('--run')), ['run', scene, '-o', out, '--quiet', '--set', duration], { stdio: 'ignore' });
  const run = JSON.parse(readFileSync(join(out, 'report.json')));
  expect(run.steps === report.step && run.fans === report.fansTotal && run.components === report.pieces,
    `the command line: ${run.steps} steps, ${run.fans} fans, ${run.components} pieces`);
}
await picture('broken');
const drawn = await page.evaluate(() => ({ ...sunder.stage.renderer.info.render }));
expect(drawn.calls <= 20, `${drawn.calls} draw calls, ${drawn.triangles} triangles for ${report.pieces} pieces`);

const tools = { page, expect, picture, last, steps, viewed };
if (!short) await checkFeatures(tools);

// Back along the timeline: nothing is computed, and the same frame is the same bytes.
const back = await page.evaluate(() => {
  sunder.player.look(100);
  return { step: sunder.player.shown().report.step, pieces: sunder.player.shown().report.pieces };
});
await picture('scrubbed');
expect(back.pieces === 1 && (await last()).step === report.step, `looked back at step ${back.step}`);
const branched = await page.evaluate(async () => {
  sunder.player.look(200);
  await sunder.player.branch();
  return sunder.player.recording.last.report.step;
});
expect(branched > 0 && branched <= 200, `went back to step ${branched}`);
const again = await steps(400 - branched);
await pause(500);
expect(again.fansTotal === report.fansTotal && again.pieces === report.pieces, 'and came to the same fans and pieces again');

// A vertex that is picked has the engine's stress.
await page.click('[data-tool="pick"]');
const place = await page.evaluate(() => {
  const box = sunder.stage.renderer.domElement.getBoundingClientRect();
  for (let k = 0; k < 400; ++k) {
    const x = box.width * (0.3 + 0.4 * ((k * 0.618) % 1)), y = box.height * (0.2 + 0.5 * ((k * 0.381) % 1));
    if (sunder.body().pick(sunder.stage.ray(x, y))) return { x, y };
  }
  return null;
});
await page.mouse.click(place.x, place.y);
await page.waitForFunction(() => !document.getElementById('vertex').hidden);
const seen = await page.evaluate(async () => {
  const row = Number(document.querySelector('#vertex h2').textContent.match(/\d+/)[0]);
  const asked = await sunder.player.inspect(row);
  const columns = sunder.player.recording.last.columns;
  const cells = [...document.querySelectorAll('#vertex table:last-of-type td')].map((cell) => cell.textContent);
  return { row, principal: asked.principal, column: columns.stress[row], words: [cells[0], cells[4], cells[8]] };
});
const unit = { Pa: 1, kPa: 1e3, MPa: 1e6, GPa: 1e9 };
const read = seen.words.map((text) => Number(text.split(' ')[0]) * unit[text.split(' ')[1]]);
const largest = seen.principal[0];
expect(Math.abs(largest - seen.column) <= 1e-6 * Math.abs(largest), `vertex ${seen.row}: ${largest} Pa, the column says ${seen.column}`);
expect(read.every((value, i) => Math.abs(value - seen.principal[i]) <= 5.1e-3 * Math.abs(seen.principal[i])), `and the page shows ${seen.words.join(', ')}`);
await picture('vertex');

// A ball at the cursor.
await page.click('[data-tool="shoot"]');
const balls = await page.evaluate(() => sunder.player.recording.last.columns.obstacle.length / 16);
await page.mouse.click(place.x, place.y);
await page.waitForFunction((n) => sunder.player.recording.last?.columns.obstacle.length / 16 > n, {}, balls);
expect(true, 'a ball flies');
await page.evaluate(() => (sunder.player.playing = false));

if (!short) {
  await checkHands(tools, place);
  await checkAnew(tools);
}
const longest = await page.evaluate(() => ({ ...sunder.longest, record: sunder.player.longest }));
console.log(`on the wall, with all that runs here: ${longest.page.toFixed(1)} ms to show and ${longest.record.toFixed(1)} ms to record a frame, ${longest.drawing.toFixed(1)} ms of drawing (shaders compiled among it)`);

// Saved files: the page offers to restart, and at the start it does so by itself.
if (viewed && !short) {
  const save = (change) => writeFileSync(viewed.scene, JSON.stringify({ ...JSON.parse(readFileSync(viewed.scene)), ...change }));
  await page.evaluate(() => sunder.player.busy);
  save({ description: 'saved once' });
  await page.waitForFunction(() => !document.getElementById('changed').hidden);
  await picture('saved');
  await page.click('#reload');
  await page.waitForFunction(() => document.getElementById('about').textContent === 'saved once');
  save({ description: 'saved twice' });
  await page.waitForFunction(() => document.getElementById('about').textContent === 'saved twice');
  expect((await last()).step === 0, 'a saved scene is offered, and taken at once at the start');
}

// A mesh of one's own, dropped, packed as it is: 1 320 tetrahedra beside each other fall. Draw calls are not more for them.
const corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]];
const places = Array.from({ length: 1320 }, (_, k) => [k % 12, Math.floor(k / 12) % 10, Math.floor(k / 120)].map((i) => 1.5 * i));
const vertices = places.flatMap((at) => corners.map((c) => `${c.map((x, i) => x + at[i]).join(' ')} 0`));
const own = `MeshVersionFormatted 2\nDimension 3\nVertices\n${vertices.length}\n${vertices.join('\n')}
Tetrahedra\n${places.length}\n${places.map((_, k) => `${[1, 2, 3, 4].map((i) => 4 * k + i).join(' ')} 0`).join('\n')}\nEnd\n`;
await page.evaluate((bytes) => {
  const drop = new DataTransfer();
  drop.items.add(new File([new Uint8Array(bytes)], 'own.mesh.gz'));
  window.dispatchEvent(new DragEvent('drop', { dataTransfer: drop, cancelable: true }));
}, [...gzipSync(own)]);
await page.waitForFunction(() => document.getElementById('about').textContent.startsWith('own.mesh'));
await page.evaluate(() => sunder.opened());
const fallen = await steps(4);
expect(fallen.step === 4, `a mesh dropped on the page falls: ${fallen.pieces} pieces`);
await page.evaluate(() => {
  for (const id of ['wires', 'shade', 'contacts', 'fronts']) document.getElementById(id).checked = true;
  document.getElementById('shape').value = 'both';
  document.getElementById('shape').dispatchEvent(new Event('input'));
});
await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
const most = await page.evaluate(() => ({ ...sunder.stage.renderer.info.render }));
expect(fallen.pieces >= 1200 && most.calls <= 20, `${most.calls} draw calls, ${most.triangles} triangles for ${fallen.pieces} pieces with all that can be shown`);
await picture('dropped');

// A page of another origin is not answered.
if (viewed) {
  const other = await serve(folder);
  const stranger = await browser.newPage();
  await stranger.goto(`${other.address}style.css`);
  const token = new URL(viewed.address).hash.split('=')[1];
  const asked = await stranger.evaluate(({ url, headers }) => fetch(url, { method: 'POST', headers }).then((r) => r.type, (e) => e.name),
    { url: new URL('/api/scene', viewed.address).href, headers: { 'X-Sunder-Token': token } });
  expect(asked === 'TypeError', `a page of another origin, token and all: ${asked}`);
  await stranger.close();
  other.close();
}

expect(said.length === 0, `console without errors${said.length ? `: ${said.join(' | ')}` : ''}`);
await checkEnd({ page, expect, end: viewed
  ? () => new Promise((done) => viewed.child.once('exit', done).kill())
  : () => page.evaluate(() => sunder.engine.worker.onerror({ preventDefault() {}, message: 'out of memory' })) });
await picture('ended');
await browser.close();
server.close();
process.exit(failures.length ? 1 : 0);
