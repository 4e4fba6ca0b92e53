// SPDX-License-Identifier: MIT
// Parts of check_page.mjs: lists, marks, the topologist's view, display states, keys, the engine's end.
import { mkdtempSync, readdirSync, readFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

/// Waits in node until `holds()` gives something, at most five minutes.
async function until(holds) {
  for (let k = 0; k < 3000; ++k) {
    const found = await holds();
    if (found) return found;
    await new Promise((done) => setTimeout(done, 100));
  }
  return null;
}

const click = (page, id) => page.evaluate((i) => document.getElementById(i).click(), id);

async function checkMarks({ page, expect, picture }) {
  for (const by of ['fanOrder', 'crackAge']) {
    await page.select('#colour', by);
    await picture(`colour_${by}`);
  }
  const high = await page.$eval('#high', (e) => e.textContent);
  expect(/ms$/.test(high), `cracks by age: up to ${high}`);
  await page.select('#colour', 'material');
  await click(page, 'contacts');
  await click(page, 'fronts');
  await picture('contacts_fronts');
  const marks = await page.evaluate(() => {
    const { points, fronts } = sunder.stage.marks;
    const count = (part) => (part.object.visible ? part.object.geometry.drawRange.count : 0);
    const frame = sunder.player.shown();
    return { contacts: count(points), edges: count(fronts) / 2, given: frame.columns.contact.length / 8, rows: frame.shape.crackFront.length / 2 };
  });
  expect(marks.contacts > 0 && marks.contacts === marks.given, `${marks.contacts} contacts drawn`);
  expect(marks.edges > 0 && marks.edges === marks.rows, `${marks.edges} edges of crack fronts drawn`);
  await click(page, 'contacts');
  await click(page, 'fronts');
}

async function checkFragments({ page, expect, picture, last }) {
  await page.evaluate(() => (document.getElementById('pieces').open = true));
  await picture('fragments_list');
  const rows = await page.$$eval('#fragments option', (list) => list.map((o) => o.text));
  const masses = rows.map((row) => Number(row.match(/: ([\d.e+-]+) kg/)[1]));
  const { pieces } = await last();
  expect(rows.length === pieces && masses.every((m, k) => k === 0 || m <= masses[k - 1]), `${rows.length} fragments by mass, the first: ${rows[0]}`);
  await page.select('#fragments', rows[1].split(':')[0]);
  await picture('fragment_marked');
  const marked = await page.evaluate(() => sunder.body().uniforms.marked.value);
  expect(String(marked) === rows[1].split(':')[0], `fragment ${marked} is marked`);
  await click(page, 'unmark');
  await page.evaluate(() => (document.getElementById('pieces').open = false));
}

async function checkPicture({ page, expect }) {
  const folder = mkdtempSync(join(tmpdir(), 'sunder_page_'));
  const session = await page.createCDPSession();
  await session.send('Browser.setDownloadBehavior', { behavior: 'allow', downloadPath: folder });
  await click(page, 'picture');
  const name = await until(() => readdirSync(folder).find((file) => file.endsWith('.png')));
  const bytes = name ? readFileSync(join(folder, name)) : Buffer.alloc(0);
  expect(bytes.subarray(1, 4).toString() === 'PNG' && bytes.length > 20000, `the picture is saved: ${name}, ${bytes.length} bytes`);
}

async function checkFans({ page, expect, picture }) {
  await page.evaluate(() => (document.getElementById('fans').open = true));
  const fan = await page.evaluate(() => sunder.player.recording.fans.findIndex((f) => f.created > 0 && f.faces.length > 2));
  await page.evaluate((row) => sunder.fanView.choose(row), fan);
  const words = [];
  for (;;) {
    words.push(await page.$eval('#fanWords', (e) => e.textContent));
    const [, row, count] = words.at(-1).match(/Face (\d+) of (\d+)/);
    if (row === '2') await picture('fan');
    if (row === count) break;
    await click(page, 'faceAfter');
  }
  await picture('fan_last');
  const [, said, faces] = words[0].match(/oracle said yes after (\d+) of (\d+)/i);
  const yes = words.filter((w) => w.includes('Oracle: yes')).length;
  expect(words.length === Number(faces) && yes === Number(said), `fan ${fan}: ${faces} faces one by one, the oracle said yes after ${yes}`);
  const found = await page.evaluate(() => {
    const { fans } = sunder.player.recording;
    const at = sunder.player.shown().report.step;
    return { vertex: fans[sunder.fanView.fan].vertex, step: fans[sunder.fanView.fan].step, at };
  });
  expect(found.step === found.at, `step ${found.at} of the fan of vertex ${found.vertex} is shown`);
  await page.evaluate(() => (document.getElementById('fans').open = false));
}

async function checkStates({ page, expect, picture }) {
  // The step in which the targets jumped most beyond what is drawn (figure 2).
  const jump = await page.evaluate(() => {
    const { frames } = sunder.player.recording;
    const gap = (frame) => frame.jump.target - frame.jump.drawn;
    const row = frames.reduce((best, frame, k) => (gap(frame) > gap(frames[best]) ? k : best), 0);
    sunder.player.look(row);
    return { row, ...frames[row].jump };
  });
  await picture('smoothing_on');
  const shown = await page.$eval('#jump', (e) => e.textContent);
  await click(page, 'smoothing');
  await picture('smoothing_off');
  await click(page, 'smoothing');
  expect(jump.drawn < jump.target, `at frame ${jump.row} a vertex jumps ${(1000 * jump.drawn).toFixed(3)} mm as drawn, ${(1000 * jump.target).toFixed(3)} without smoothing ("${shown}")`);
  await page.evaluate(() => sunder.player.look(Infinity));
  await page.select('#shape', 'both');
  await picture('both');
  const both = await page.evaluate(() => sunder.body().ghost.visible);
  expect(both, 'reference and deformed at once');
  await page.select('#shape', 'deformed');
  await picture('deformed');
  await page.select('#shape', 'drawn');
  await click(page, 'shade');
  await picture('shade');
  const drawn = await page.evaluate(() => ({ ...sunder.stage.renderer.info.render, has: sunder.stage.hasAmbient }));
  expect(drawn.calls <= 20, `${drawn.calls} draw calls with ambient occlusion ${drawn.has ? 'on' : 'off'}`);
  await click(page, 'shade');
  const other = await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(sunder.stage.hasAmbient)))));
  expect(other !== drawn.has, 'ambient occlusion has a switch');
}

async function checkSliders({ page, expect, last, steps }) {
  const threshold = () => page.evaluate(async () => (await sunder.player.inspect(0)).threshold);
  const text = (id) => page.$eval(`#${id}`, (e) => e.textContent);
  const slide = (id, value) => page.evaluate(async (i, v) => {
    document.getElementById(i).value = v;
    for (const event of ['input', 'change']) document.getElementById(i).dispatchEvent(new Event(event));
    await new Promise((begun) => setTimeout(begun));
    await sunder.opened();
  }, id, value);
  await page.evaluate(() => sunder.open(sunder.scene()));
  const before = await threshold();
  await steps(3);
  await slide('strength', 0.3);
  const after = await threshold();
  expect(Math.abs(after / before - 10 ** 0.3) < 1e-3 && (await last()).step === 0, `strength ${before} Pa became ${after} Pa as the slider was let go`);
  await slide('toughness', 5.5);
  const list = await page.evaluate(() => sunder.sliders.settings());
  expect(list.includes('bodies.0.material.toughness=316200') && (await text('message')) === '', `settings ${list.join(' ')}`);
  const energy = 316200 ** 2 * 0.96 / 30e9;
  expect((await text('energyValue')) === `${Number(energy.toPrecision(3))} J/m²`, `the fracture energy follows: ${await text('energyValue')}`);
  await page.evaluate(() => {
    sunder.sliders.open(sunder.scene().text, sunder.sliders.bodies);
    return sunder.open(sunder.scene());
  });
  expect(Math.abs((await threshold()) - before) < 1, 'sliders back as the scene has them');
}

/// A body of the key `shape`, of a material that has a name, struck: in the engine of the page.
async function checkNamed({ page, expect, picture, steps }) {
  await page.evaluate(() => sunder.open({
    name: 'named.json', files: {},
    text: JSON.stringify({
      bodies: [{ shape: { box: { size: [0.3, 0.2, 0.1] }, tetrahedra: 600 }, material: 'glass', translation: [0, 0, 0.0505], velocity: [0, 0, -12] }],
      obstacles: [{ plane: { normal: [0, 0, 1] } }],
      time_step: 2e-4,
      duration: 0.02,
    }),
  }));
  const { pieces } = await steps(20);
  await picture('named');
  const labels = await page.evaluate(() => ['strength', 'toughness', 'energy'].map((id) => document.getElementById(`${id}Value`).textContent));
  expect(labels.join() === '45.0 MPa,750 kPa √m,7.65 J/m²' && pieces > 1, `a box of glass, by its name: ${labels.join(', ')}; ${pieces} pieces`);
}

async function checkKeys({ page, expect, picture, steps }) {
  await steps(20);
  await page.evaluate(() => document.activeElement.blur()); // a mouse was there before
  await page.focus('#view');
  const camera = () => page.evaluate(() => sunder.stage.camera.position.toArray());
  const from = await camera();
  await page.keyboard.press('d');
  await page.keyboard.press('w');
  await page.keyboard.press('+');
  await picture('keys');
  const to = await camera();
  expect(to.some((x, i) => Math.abs(x - from[i]) > 1e-3), 'keys turn the camera');
  await page.keyboard.press('r');
  await page.evaluate(() => sunder.opened());
  await picture('restarted');
  const kept = await camera();
  await page.keyboard.press('c');
  const back = await camera();
  const equal = (a, b) => a.every((x, i) => Math.abs(x - b[i]) < 1e-3);
  expect(equal(kept, to) && equal(back, from), 'a restart keeps the camera, and a key brings it back');
  await page.keyboard.press('4');
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('ArrowLeft');
  await page.keyboard.press('Enter');
  await page.waitForFunction(() => !document.getElementById('vertex').hidden);
  await picture('key_cursor');
  expect(true, 'a vertex is inspected by keys alone');
  await page.keyboard.press('1');
  const balls = () => page.evaluate(() => sunder.player.recording.last.columns.obstacle.length / 16);
  const count = await balls();
  await page.keyboard.press('Enter');
  const more = await until(async () => (await balls()) > count);
  expect(more, 'a ball is shot by keys alone');
  await page.evaluate(() => (sunder.player.playing = false));
  const named = await page.evaluate(() => {
    const without = (e) => !(e.labels?.length || e.getAttribute('aria-label') || e.textContent.trim());
    return [...document.querySelectorAll('button, input, select, canvas')].filter(without).map((e) => e.id);
  });
  expect(named.length === 0, `everything to operate has a name${named.length ? `, but: ${named}` : ''}`);
}

/// Processor time of the page's own thread in one go, drawing calls and a breaking body among it;
/// time on the wall would count what else runs on the machine.
async function checkThread({ page, expect }) {
  await page.evaluate(() => sunder.open(sunder.scene()));
  await page.tracing.start({ categories: ['devtools.timeline', 'disabled-by-default-devtools.timeline'] });
  await page.evaluate(async () => {
    for (let i = 0; i < 200; ++i) {
      await sunder.player.step();
      if (i % 2 === 0) await new Promise((drawn) => requestAnimationFrame(drawn));
    }
  });
  const { traceEvents } = JSON.parse(new TextDecoder().decode(await page.tracing.stop()));
  const frame = traceEvents.find((e) => e.name === 'FireAnimationFrame');
  const own = traceEvents.filter((e) => e.ph === 'X' && e.pid === frame.pid && e.tid === frame.tid);
  const most = (name) => own.filter((e) => e.name === name).reduce((max, e) => Math.max(max, e.tdur ?? 0), 0) / 1000;
  const [all, drawing] = [most('RunTask'), most('FireAnimationFrame')];
  const { fansTotal, pieces } = await page.evaluate(() => ({ ...sunder.player.recording.last.report }));
  expect(all > 0 && all < 50 && fansTotal > 0, `page's thread: at most ${all.toFixed(1)} ms of processor at once, ${drawing.toFixed(1)} ms in a picture (${fansTotal} fans, ${pieces} pieces)`);
}

/// A scene with cracks that are surfaces, drawn near them.
async function checkSmooth({ page, expect, picture, steps }) {
  await page.evaluate(() => {
    const scene = sunder.scene();
    const text = JSON.stringify({ ...JSON.parse(scene.text), fracture: { crack: 'object' }, output: { crack_surface: 'smooth' } });
    return sunder.open({ ...scene, text });
  });
  const { pieces } = await steps(260);
  await page.evaluate(() => (document.getElementById('explode').value = 0.4));
  await picture('smooth');
  const moved = await page.evaluate(() => {
    document.getElementById('explode').value = 0;
    const { rest, smooth } = sunder.player.shown().shape;
    return rest.reduce((most, x, i) => Math.max(most, Math.abs(x - smooth[i])), 0);
  });
  expect(moved > 1e-3 && pieces > 1, `cracks as surfaces: points moved by up to ${(1000 * moved).toFixed(0)} mm, ${pieces} pieces`);
}

/// The engine ends: the page says so in words.
export async function checkEnd({ page, expect, end }) {
  await end();
  await page.evaluate(() => sunder.player.once());
  const words = await page.$eval('#message', (e) => e.textContent);
  expect(/ended/.test(words), `when the engine goes away: "${words}"`);
}

async function checkLooks({ page, picture }) {
  for (const by of ['stress', 'loadRatio', 'speed', 'piece', 'age']) {
    await page.select('#colour', by);
    await picture(`colour_${by}`);
  }
  await page.select('#colour', 'material');
  await page.evaluate(() => {
    document.getElementById('explode').value = 0.5;
    document.getElementById('wires').checked = true;
    document.getElementById('wires').dispatchEvent(new Event('input'));
  });
  await picture('exploded');
  await page.evaluate(() => {
    document.getElementById('explode').value = 0;
    document.getElementById('wires').checked = false;
    document.getElementById('clip').value = 0.5;
    document.getElementById('clip').dispatchEvent(new Event('input'));
  });
  await picture('clipped');
  await page.evaluate(() => {
    document.getElementById('clip').value = 0;
    document.getElementById('clip').dispatchEvent(new Event('input'));
  });
}

/// A spring from a vertex to the pointer, and a cut across the body at `place`.
export async function checkHands({ page, expect, picture, last }, place) {
  await page.click('[data-tool="pull"]');
  const pulled = await page.evaluate(({ x, y }) => sunder.body().pick(sunder.stage.ray(x, y)).vertex, place);
  const speed = () => page.evaluate((v) => sunder.player.recording.last.columns.speed[v], pulled);
  const atRest = await speed();
  await page.mouse.move(place.x, place.y);
  await page.mouse.down();
  await page.mouse.move(place.x + 90, place.y - 90, { steps: 4 });
  const start = (await last()).step;
  await page.waitForFunction((n) => sunder.player.recording.last?.report.step >= n, {}, start + 25);
  const moving = await speed();
  await page.mouse.up();
  await page.evaluate(() => (sunder.player.playing = false));
  expect(moving > atRest + 0.1, `vertex ${pulled} is pulled: ${atRest.toFixed(3)} m/s before, ${moving.toFixed(3)} m/s after 25 steps`);

  // A cut across.
  await page.click('[data-tool="cut"]');
  const before = (await last()).pieces;
  await page.mouse.move(place.x - 200, place.y - 20);
  await page.mouse.down();
  await page.mouse.move(place.x + 200, place.y + 20, { steps: 5 });
  await page.mouse.up();
  await page.waitForFunction((n) => sunder.player.recording.last?.report.pieces > n, {}, before);
  await page.evaluate(() => (sunder.player.playing = false));
  expect(true, `cut: ${before} pieces became ${(await last()).pieces}`);
  await picture('cut');
}

/// Needs: a recording in which the body has broken, shown at its end.
export async function checkFeatures(tools) {
  await checkMarks(tools);
  await checkFragments(tools);
  await checkPicture(tools);
  await checkFans(tools);
  await checkStates(tools);
  await checkLooks(tools);
}

/// These begin the scene anew.
export async function checkAnew(tools) {
  await checkSliders(tools);
  await checkKeys(tools);
  await checkThread(tools);
  if (tools.viewed) return; // sunder view has the scene that is on the disk
  await checkSmooth(tools);
  await checkNamed(tools);
}
