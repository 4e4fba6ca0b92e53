// SPDX-License-Identifier: MIT
// What the page costs for one scene, in headless Chromium:
//   node measure_page.mjs FOLDER_OF_THE_PAGE SCENE STEPS [--picture FILE.png]
//   node measure_page.mjs FOLDER_OF_THE_PAGE SCENE.json STEPS --program SUNDER [--set KEY=VALUE]... [--picture FILE.png]
// The first by WebAssembly, SCENE being one of the page's list; the second with `sunder view` behind the page.
import { readFileSync } from 'node:fs';
import { resolve } from 'node:path';

import { launch, openPage, option, serve, view } from './browser.mjs';

const [folder, scene, steps] = [resolve(process.argv[2]), process.argv[3], Number(process.argv[4])];
const program = option('--program');
const server = program ? await view(program, folder, scene) : await serve(folder);
const browser = await launch();
const page = await browser.newPage();
await page.setViewport({ width: 1100, height: 680 });
const first = await openPage(page, server.address);
if (!program && (await page.evaluate(() => sunder.scene().name)) !== `${scene}.json`) {
  const before = await page.evaluateHandle(() => sunder.player.recording.last);
  await page.select('#scene', scene);
  await page.waitForFunction((old) => sunder.player.recording.last && sunder.player.recording.last !== old, {}, before);
}

const ran = await page.evaluate(async (count) => {
  const { player, stage } = sunder;
  player.pace = 1000;
  const began = performance.now();
  let crack = null;
  const drawn = { calls: 0, triangles: 0 };
  for (let k = 0; k < count; ++k) {
    await player.step();
    const { report } = player.recording.last;
    if (report.failed) break;
    if (!crack && report.fansTotal > 0) crack = { step: report.step, seconds: (performance.now() - began) / 1000 };
    if (k % 10 !== 0) continue;
    await new Promise((next) => requestAnimationFrame(() => requestAnimationFrame(next)));
    const { render } = stage.renderer.info;
    drawn.calls = Math.max(drawn.calls, render.calls);
    drawn.triangles = Math.max(drawn.triangles, render.triangles);
  }
  const { frames } = player.recording;
  const mean = frames.slice(1).reduce((sum, f) => sum + f.report.stageMs.reduce((a, b) => a + b, 0), 0) / (frames.length - 1);
  return { crack, drawn, mean, report: { ...frames.at(-1).report }, frames: player.recording.bytes, saved: player.savedSize };
}, steps);

// All that can be drawn at once, over the body as it is now.
const most = await page.evaluate(async () => {
  for (const id of ['wires', 'shade', 'contacts', 'fronts']) document.getElementById(id).checked = true;
  document.getElementById('shape').value = 'both';
  document.getElementById('explode').value = 0.4;
  document.getElementById('explode').dispatchEvent(new Event('input'));
  await new Promise((next) => requestAnimationFrame(() => requestAnimationFrame(next)));
  return { ...sunder.stage.renderer.info.render };
});
const picture = option('--picture');
if (picture) await page.screenshot({ path: picture });

// Pictures from a click to the ball: counted by the frames of the browser.
const click = await page.evaluate(async () => {
  const balls = () => sunder.player.shown().columns.obstacle.length / 16;
  const before = balls();
  const box = sunder.stage.renderer.domElement.getBoundingClientRect();
  const at = { clientX: box.width / 2, clientY: box.height / 2, button: 0, bubbles: true };
  for (const kind of ['pointerdown', 'pointerup']) sunder.stage.renderer.domElement.dispatchEvent(new PointerEvent(kind, at));
  for (let pictures = 1; ; ++pictures) {
    await new Promise((next) => requestAnimationFrame(next));
    if (balls() > before) return pictures;
  }
});

const { pieces, fansTotal } = ran.report;
const heap = (await page.metrics()).JSHeapUsedSize;
console.log(`${scene}, ${ran.report.step} steps by ${program ? 'the native engine' : 'WebAssembly'}: ${fansTotal} fans, ${pieces} pieces`);
console.log(`first picture after ${first.toFixed(1)} s; first crack ${ran.crack ? `in step ${ran.crack.step}, ${ran.crack.seconds.toFixed(1)} s after the start` : 'none'}; ${ran.mean.toFixed(1)} ms a step`);
console.log(`${ran.drawn.calls} draw calls, ${ran.drawn.triangles} triangles; with all that can be shown ${most.calls} draw calls, ${most.triangles} triangles`);
if (program) {
  const peak = readFileSync(`/proc/${server.child.pid}/status`, 'utf8').match(/VmHWM:\s+(\d+)/)[1];
  console.log(`program ${(peak / 1e3).toFixed(0)} MB at most, saved states of ${(ran.saved / 1e6).toFixed(1)} MB among them`);
}
console.log(`page ${(heap / 1e6).toFixed(0)} MB of JavaScript, ${(ran.frames / 1e6).toFixed(1)} MB of frames; ${click} pictures from a click to the ball`);
await browser.close();
server.close();
process.exit(0);
