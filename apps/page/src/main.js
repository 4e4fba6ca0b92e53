// SPDX-License-Identifier: MIT
// The page: engine, recording and view tied together.
import * as THREE from 'three';

import { BodyMesh } from './body_mesh.js';
import { ServerEngine, WorkerEngine } from './engines.js';
import { FanView, fanOfVertex } from './fans.js';
import { fragmentRows, showFragments } from './fragments.js';
import { drawGraph } from './graph.js';
import { KeyCursor, turnCamera } from './keys.js';
import { MaterialSliders } from './material.js';
import { counterRows, pascals, showCounters, showVertex } from './panel.js';
import { Player } from './player.js';
import { droppedScene, listedScene, sceneList, withFloor } from './scenes.js';
import { Stage } from './stage.js';
import { Tools } from './tools.js';
import { watchFiles } from './watch.js';

const at = (id) => document.getElementById(id);
const token = new URLSearchParams(location.hash.slice(1)).get('token');
const engine = token ? new ServerEngine(token) : new WorkerEngine();
const stage = new Stage(at('view'));
const looks = {
  concrete: { outside: 0xb4ada2, inside: 0xc9875a, roughness: 0.86, grain: 14 },
  glass: { outside: 0x9fc7c0, inside: 0xe6f4ef, roughness: 0.12, grain: 0 },
};
let body = null;
let scene = null;
let fitted = null; // the scene that sliders and camera are set to
let picked = null;
/// ms: longest that a picture took of the page's thread, in code of ours and in drawing.
const longest = { page: 0, drawing: 0 };

let dirty = true;
const sliders = new MaterialSliders(at, () => attempt(() => again()));
const player = new Player(engine, {
  frame: () => (dirty = true),
  message: (text) => say(text),
});
let shownShape = null;

function say(text) {
  at('message').textContent = text;
  at('message').hidden = !text;
}

/// The look of the first body, by its stiffness: glass has 70 GPa, metals and alumina more.
function look() {
  const { young } = player.materials[0];
  return young > 6e10 && young < 1e11 ? looks.glass : looks.concrete;
}

let opened = Promise.resolve();

/// Opens a scene after those that were asked for before.
function open(next) {
  opened = opened.catch(() => {}).then(() => openNow(next));
  return opened;
}

async function openNow(next) {
  say('');
  at('changed').hidden = true;
  const isNew = next !== fitted;
  scene = next;
  at('about').textContent = at('about').title = JSON.parse(scene.text).description ?? '';
  picked = null;
  at('vertex').hidden = true;
  await player.open({ ...scene, settings: isNew ? [] : sliders.settings() });
  const box = new THREE.Box3().setFromArray(player.recording.last.columns.position);
  if (scene.needsFloor) return openNow(withFloor(scene, box));
  if (isNew) sliders.open(scene.text, player.materials);
  stage.clear();
  if (body) stage.scene.remove(body.group);
  body = new BodyMesh(look());
  stage.scene.add(body.group);
  shownShape = null;
  if (isNew) stage.frame(box);
  fitted = scene;
  mark(-1);
  host.body = body;
  tools.host = host;
  labels();
  dirty = true;
}

/// The same scene from its start, with the sliders as they are; it goes on if it was playing.
async function again() {
  const { playing } = player;
  await open(scene);
  if (playing) player.play();
}

/// Size of balls: a tenth of the body, and the density of steel.
function ball() {
  const radius = Number(at('radius').value) * 0.05 * stage.size;
  return { radius, mass: (7800 * 4 * Math.PI * radius ** 3) / 3, speed: Number(at('ballSpeed').value) };
}

const host = {
  stage,
  body,
  ball,
  play: () => player.play(),
  act: (action) => player.act(action),
  inspect: (vertex) => {
    picked = vertex;
    if (vertex === null) {
      at('vertex').hidden = true;
      stage.hideVertex();
    }
    dirty = true;
    return inspect();
  },
};
const tools = new Tools(at('view'), host);
const cursor = new KeyCursor(at('view'), at('cursor'), tools);

/// The vertex that was picked, asked of the engine: only where what is shown is its present state.
async function inspect() {
  if (picked === null || !player.isAtEnd()) return;
  const vertex = picked;
  const seen = await player.inspect(vertex);
  if (picked !== vertex) return;
  const isNew = at('vertex').hidden || at('vertex').dataset.row !== String(vertex);
  if (isNew) {
    at('vertex').dataset.row = vertex;
    const { rest } = player.recording.last.shape;
    const row = fanOfVertex(player.recording.fans, vertex, rest.subarray(3 * vertex, 3 * vertex + 3));
    if (at('fans').open) fanView.choose(row);
  }
  showVertex(at('vertex'), vertex, seen);
  if (isNew) at('vertex').scrollIntoView({ block: 'nearest' });
  stage.showVertex(body.drawnPlace(vertex, new THREE.Vector3()), seen);
}

/// The fan that is stepped through: the frame after its step is looked at.
function showFan(fan, face) {
  if (!fan) stage.marks.hideFan();
  if (fan) {
    const row = player.recording.frames.findIndex((frame) => frame.report.step >= fan.step);
    if (row >= 0 && fan !== shownFan?.fan) {
      player.playing = false;
      player.look(row);
    }
  }
  shownFan = fan && { fan, face };
  dirty = true;
}
let shownFan = null;
const fanView = new FanView(
  { section: at('fans'), number: at('fanNumber'), count: at('fanCount'), before: at('faceBefore'), after: at('faceAfter'), words: at('fanWords') },
  showFan,
);

const colours = { material: 0, stress: 1, loadRatio: 1, speed: 1, piece: 2, age: 3, fanOrder: 4, crackAge: 5 };
const ms = (time) => `${(1000 * time).toPrecision(3)} ms`;
const legends = {
  stress: pascals, loadRatio: (x) => x.toFixed(0), speed: (x) => `${x.toPrecision(2)} m/s`,
  fanOrder: (x) => (x === 0 ? 'start' : `fan ${x - 1}`), crackAge: ms,
};

function colour(frame) {
  const by = at('colour').value;
  const u = body.uniforms;
  u.colourBy.value = colours[by];
  u.now.value = player.recording.last.report.step;
  at('scale').hidden = !legends[by];
  if (!legends[by]) return null;
  const scalar = frame.columns[by] ?? null;
  let low = Infinity, high = -Infinity;
  for (const value of scalar ?? []) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  if (by === 'loadRatio') [low, high] = [0, 1];
  if (by === 'fanOrder') [low, high] = [0, frame.report.fansTotal];
  if (by === 'crackAge') [low, high] = [0, frame.report.time];
  u.range.value.set(low, high);
  at('low').textContent = legends[by](low);
  at('high').textContent = legends[by](high);
  return scalar;
}

/// What is drawn over the bodies, as it is asked for.
function showMarks(frame) {
  const place = (v) => body.drawnPlace(v, new THREE.Vector3()).toArray();
  stage.marks.showContacts(at('contacts').checked ? frame.columns.contact : [], 0.15 * stage.size);
  stage.marks.showFronts(at('fronts').checked ? frame.shape.crackFront : [], place);
  if (shownFan) stage.marks.showFan(shownFan.fan.faces, shownFan.face, place);
}

let listed = 0; // when the fragments were listed last

function showLists(frame) {
  fanView.update(player.recording.fans);
  if (!at('pieces').open || (player.playing && performance.now() - listed < 250)) return;
  listed = performance.now();
  showFragments(at('fragments'), fragmentRows(frame));
}

/// A fragment in another colour; -1: none.
function mark(piece) {
  if (body) body.uniforms.marked.value = piece;
  if (piece < 0) at('fragments').selectedIndex = -1;
  dirty = true;
}

function savePicture() {
  stage.renderer.domElement.toBlob((blob) => {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(blob);
    link.download = `sunder_${at('clock').textContent.match(/\d+/)[0]}.png`;
    link.click();
    URL.revokeObjectURL(link.href);
  });
}

function show() {
  const frame = player.shown();
  if (!frame || !body) return;
  if (frame.shape !== shownShape) {
    shownShape = frame.shape;
    body.setShape(frame.shape, player.recording.opened);
  }
  const u = body.uniforms;
  u.explode.value = Number(at('explode').value);
  const shape = at('shape').value;
  u.deformed.value = ['deformed', 'magnified'].includes(shape) ? 1 : 0;
  u.magnify.value = shape === 'magnified' ? 100 : 1;
  body.ghost.visible = shape === 'both';
  stage.hasAmbient = at('shade').checked;
  const drawnPose = frame.columns[at('smoothing').checked ? 'drawnPose' : 'pose'];
  u.wires.value = at('wires').checked ? 1 : 0;
  body.setState({ ...frame.columns, drawnPose, scalar: colour(frame) });
  stage.setObstacles(frame.columns.obstacle, frame.shape.solid);
  showMarks(frame);
  showLists(frame);
  const mm = (jump) => (1000 * jump).toFixed(2);
  at('jump').textContent = `Largest jump from the frame before: ${mm(frame.jump.drawn)} mm; without smoothing ${mm(frame.jump.target)} mm`;
  const clip = Number(at('clip').value);
  stage.renderer.clippingPlanes = [];
  stage.renderer.localClippingEnabled = true;
  const target = stage.controls.target;
  stage.plane.constant = -target.y + stage.size * (0.5 - clip);
  body.mesh.material.clippingPlanes = body.ghost.material.clippingPlanes = clip > 0 ? [stage.plane] : [];
  at('time').max = player.recording.frames.length - 1;
  at('time').value = player.row;
  const computed = frame.report.stageMs.reduce((sum, part) => sum + part, 0);
  at('cost').textContent = `${computed.toPrecision(3)} ms a step, ${between.toFixed(0)} ms a picture`;
  at('clock').textContent = `step ${frame.report.step}, ${(1000 * frame.report.time).toFixed(2)} ms`;
  at('branch').hidden = player.isAtEnd();
  at('play').textContent = player.playing ? '❚❚' : '▶';
  at('play').setAttribute('aria-label', player.playing ? 'Pause' : 'Play');
  const { calls, triangles } = stage.renderer.info.render;
  showCounters(at('counters'), counterRows(frame.report, frame.sums, { calls, triangles }));
  drawGraph(at('graph'), player.recording.frames, player.row);
  saves();
}

function saves() {
  const count = Math.max(1, player.recording.frames.length - 1);
  const first = player.recording.frames[0].report.step;
  at('saves').replaceChildren(
    ...player.recording.saved.map((step) => {
      const mark = document.createElement('i');
      mark.style.left = `${Math.min(100, (100 * (step - first)) / count)}%`;
      return mark;
    }),
  );
}

let drawn = null; // when the last picture was drawn, unless one was left out since
let between = 0; // ms from picture to picture

function draw(now) {
  requestAnimationFrame(draw);
  if (drawn !== null) between += (between ? 0.2 : 1) * (now - drawn - between);
  const start = performance.now();
  if (dirty) {
    dirty = false;
    show();
    stage.stale = true;
    if (picked !== null) inspect();
  }
  const waited = start - (player.asked ?? start);
  if (waited > 500) at('cost').textContent = `computing for ${(waited / 1000).toFixed(1)} s`;
  longest.page = Math.max(longest.page, performance.now() - start);
  const drawing = performance.now();
  drawn = stage.draw() ? now : null;
  longest.drawing = Math.max(longest.drawing, performance.now() - drawing);
}

function labels() {
  sliders.labels();
  at('gravityValue').textContent = `${Number(at('gravity').value).toFixed(2)} m/s²`;
  const { radius, mass } = ball();
  at('radiusValue').textContent = `${(2000 * radius).toFixed(0)} mm, ${mass.toPrecision(2)} kg`;
  at('ballSpeedValue').textContent = `${at('ballSpeed').value} m/s`;
}

const attempt = (work) => Promise.resolve().then(work).catch((error) => say(error.message));

function listen(known) {
  /// Files of one's own: a scene with its meshes or a mesh, in the list from now on.
  const openOwn = (files) => files.length > 0 && attempt(async () => {
    const own = await droppedScene(files);
    await open(own);
    known.push(own);
    at('scene').add(new Option(own.name.replace(/\.json$/, ''), '', true, true));
  });
  for (const id of ['colour', 'explode', 'clip', 'wires', 'shape', 'smoothing', 'shade', 'contacts', 'fronts']) {
    at(id).addEventListener('input', () => (dirty = true));
  }
  for (const id of ['gravity', 'radius', 'ballSpeed']) at(id).addEventListener('input', labels);
  at('fragments').addEventListener('change', () => mark(Number(at('fragments').value)));
  at('unmark').addEventListener('click', () => mark(-1));
  at('pieces').addEventListener('toggle', () => (dirty = true));
  at('picture').addEventListener('click', savePicture);
  at('reload').addEventListener('click', () => attempt(reload));
  at('time').addEventListener('input', () => player.look(Number(at('time').value)));
  at('play').addEventListener('click', () => player.toggle());
  at('once').addEventListener('click', () => player.once());
  at('restart').addEventListener('click', () => attempt(() => open(scene)));
  at('home').addEventListener('click', () => stage.frame());
  at('branch').addEventListener('click', () => attempt(() => player.branch()));
  at('pace').addEventListener('change', () => (player.pace = Number(at('pace').value)));
  at('message').addEventListener('click', () => say(''));
  for (const button of document.querySelectorAll('[data-tool]')) {
    button.addEventListener('click', () => tools.choose(button.dataset.tool));
  }
  at('scene').addEventListener('change', () =>
    attempt(async () => {
      const chosen = known[at('scene').selectedIndex];
      await open(chosen.isDropped ? chosen : await listedScene(chosen));
    }),
  );
  addEventListener('resize', () => stage.resize());
  addEventListener('keydown', (event) => {
    if (['SELECT', 'INPUT', 'BUTTON', 'SUMMARY'].includes(event.target.tagName)) return;
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.target === at('view') && cursor.key(event)) return event.preventDefault();
    const turn = (aside, up, nearer) => () => turnCamera(stage, aside, up, nearer);
    const keys = {
      ' ': () => player.toggle(), '.': () => player.once(), r: () => attempt(() => open(scene)),
      b: () => at('branch').hidden || attempt(() => player.branch()), p: savePicture, c: () => stage.frame(),
      a: turn(-0.1, 0, 1), d: turn(0.1, 0, 1), w: turn(0, 0.1, 1), s: turn(0, -0.1, 1),
      '+': turn(0, 0, 0.9), '-': turn(0, 0, 1 / 0.9),
      '[': () => at('faceBefore').click(), ']': () => at('faceAfter').click(),
    };
    ['shoot', 'pull', 'cut', 'pick'].forEach((tool, k) => (keys[k + 1] = () => tools.choose(tool)));
    if (event.key === 'ArrowLeft') keys[event.key] = () => player.look(player.row - 1);
    if (event.key === 'ArrowRight') keys[event.key] = () => player.look(player.row + 1);
    if (!keys[event.key]) return;
    event.preventDefault();
    keys[event.key]();
  });
  addEventListener('dragover', (event) => event.preventDefault());
  addEventListener('drop', (event) => {
    event.preventDefault();
    openOwn([...event.dataTransfer.files]);
  });
  at('own').addEventListener('click', () => at('files').click());
  at('files').addEventListener('change', () => openOwn([...at('files').files]));
}

/// The scene as the server has it on the disk now.
async function reload() {
  const [known] = await sceneList(token);
  at('scene').selectedIndex = 0;
  await open(await listedScene(known));
}

/// Of what was saved the page makes nothing by itself but at the start, where nothing is lost.
function saved() {
  if (scene.isDropped || player.recording.last?.report.step > 0) at('changed').hidden = false;
  else attempt(reload);
}

async function begin() {
  await engine.ask('open', { url: new URL('sunder.wasm', location.href).href });
  const known = await sceneList(token);
  at('scene').replaceChildren(...known.map((s) => new Option(s.name)));
  listen(known);
  at('shade').checked = !stage.isSlow();
  await open(await listedScene(known[0]));
  if (token) watchFiles(engine, { changed: saved, gone: say });
  requestAnimationFrame(draw);
}

begin().catch((error) => say(error.message));
/// For tests that drive the page.
window.sunder = { player, stage, engine, body: () => body, longest, open, opened: () => opened, fanView, sliders, scene: () => scene };
