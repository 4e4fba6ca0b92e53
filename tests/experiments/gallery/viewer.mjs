// SPDX-License-Identifier: MIT
// Takes the gallery's pictures of the viewer: the struck monolith in pieces, and the stress in the bar
// just before it cracks.
//   node tests/experiments/gallery/viewer.mjs FOLDER_OF_THE_PAGE SUNDER FOLDER_OF_PICTURES
// Needs the page's packages (npm ci in apps/page) and Debian's chromium-headless-shell.
import { join, resolve } from 'node:path';

import { launch, openPage, scenes, view } from '../../../apps/page/browser.mjs';

const [folder, program, pictures] = process.argv.slice(2).map((path) => resolve(path));
const browser = await launch();
let page;

/// Opens a scene and computes it while `holds(report)`; the last report.
async function run(name, holds) {
  if (page) await page.close();
  page = await browser.newPage();
  await page.setViewport({ width: 1200, height: 720 });
  const server = await view(program, folder, join(scenes, `${name}.json`));
  await openPage(page, server.address);
  let report;
  do report = await page.evaluate(async () => {
    await sunder.player.step();
    return { ...sunder.player.recording.last.report };
  }); while (holds(report));
  console.log(`${name}: ${report.pieces} pieces at ${report.time} s, step ${report.step}`);
  return report;
}
async function shot(name, step) {
  await page.evaluate((k) => sunder.player.look(k), step);
  await page.evaluate(() => new Promise((drawn) => setTimeout(() => requestAnimationFrame(drawn), 1500)));
  await page.screenshot({ path: join(pictures, `${name}.png`) });
}

const pulled = await run('bar', (report) => !report.fansTotal);
await page.select('#colour', 'stress');
await page.select('#shape', 'magnified');
await shot('viewer_stress', pulled.step - 1);

const struck = await run('monolith', (report) => report.time < 0.07);
await shot('viewer', struck.step);
await browser.close();
process.exit(0);
