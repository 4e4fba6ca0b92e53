// SPDX-License-Identifier: MIT
// The page: engine, recording and view tied together.
import * as THREE from 'three';

import { BodyMesh } from './body_mesh.js';
import { ServerEngine, WorkerEngine } from './engines.js';
import { drawGraph } from './graph.js';
import { counterRows, pascals, showCounters, showVertex } from './panel.js';
import { Player } from './player.js';
import { droppedScene, listedScene, sceneList, withFloor } from './scenes.js';
import { Stage } from './stage.js';
import { Tools } from './tools.js';

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
let picked = null;
/// ms: longest that a picture took of the page's thread, in code of ours and in drawing.
const longest = { page: 0, drawing: 0 };

let dirty = true;
const player = new Player(engine, {
  frame: () => (dirty = true),
  message: (text) => say(text),
});
let shownShape = null;

function say(text) {
  at('message').textContent = text;
  at('message').hidden = !text;
}

/// What the material of the first body is called after its density and stiffness.
function lookOf(text) {
  const material = JSON.parse(text).bodies?.[0]?.material ?? {};
  return material.young_modulus >= 6e10 ? looks.glass : looks.concrete;
}

function settings() {
  const list = [];
  const material = JSON.parse(scene.text).bodies?.[0]?.material;
  const factor = 10 ** Number(at('strength').value);
  if (material?.tensile_strength && factor !== 1) {
    list.push(`bodies.0.material.tensile_strength=${material.tensile_strength * factor}`);
  }
  const gravity = Number(at('gravity').value);
  if (gravity !== 9.81) list.push(`gravity.acceleration=[0,0,${-gravity}]`);
  return list;
}

async function open(next) {
  say('');
  scene = next;
  at('about').textContent = JSON.parse(scene.text).description ?? '';
  picked = null;
  at('vertex').hidden = true;
  await player.open({ ...scene, settings: settings() });
  const box = new THREE.Box3().setFromArray(player.recording.last.columns.position);
  if (scene.needsFloor) return open(withFloor(scene, box));
  stage.clear();
  if (body) stage.scene.remove(body.mesh);
  body = new BodyMesh(lookOf(scene.text));
  stage.scene.add(body.mesh);
  shownShape = null;
  const { obstacle } = player.recording.last.columns;
  stage.frame(box);
  stage.setObstacles(obstacle);
  host.body = body;
  tools.host = host;
  labels();
  dirty = true;
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

/// The vertex that was picked, asked of the engine: only where what is shown is its present state.
async function inspect() {
  if (picked === null || !player.isAtEnd()) return;
  const vertex = picked;
  const seen = await player.inspect(vertex);
  if (picked !== vertex) return;
  showVertex(at('vertex'), vertex, seen);
  stage.showVertex(body.drawnPlace(vertex, new THREE.Vector3()), seen);
}

const colours = { material: 0, stress: 1, loadRatio: 1, speed: 1, piece: 2, age: 3 };

function colour(frame) {
  const by = at('colour').value;
  const u = body.uniforms;
  u.colourBy.value = colours[by];
  u.now.value = player.recording.last.report.step;
  at('scale').hidden = colours[by] !== 1;
  const scalar = frame.columns[by];
  if (!scalar) return null;
  let low = Infinity, high = -Infinity;
  for (const value of scalar) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  if (by === 'loadRatio') [low, high] = [0, 1];
  u.range.value.set(low, high);
  const show = { stress: pascals, loadRatio: (x) => x.toFixed(0), speed: (x) => `${x.toPrecision(2)} m/s` }[by];
  at('low').textContent = show(low);
  at('high').textContent = show(high);
  return scalar;
}

function show() {
  const frame = player.shown();
  if (!frame || !body) return;
  if (frame.shape !== shownShape) {
    shownShape = frame.shape;
    body.setShape(frame.shape);
  }
  const u = body.uniforms;
  u.explode.value = Number(at('explode').value);
  u.deformed.value = at('shape').value === 'drawn' ? 0 : 1;
  u.magnify.value = at('shape').value === 'magnified' ? 100 : 1;
  u.wires.value = at('wires').checked ? 1 : 0;
  body.setState({ ...frame.columns, scalar: colour(frame) });
  stage.setObstacles(frame.columns.obstacle);
  const clip = Number(at('clip').value);
  stage.renderer.clippingPlanes = [];
  stage.renderer.localClippingEnabled = true;
  const target = stage.controls.target;
  stage.plane.constant = -target.y + stage.size * (0.5 - clip);
  body.mesh.material.clippingPlanes = clip > 0 ? [stage.plane] : [];
  at('time').max = player.recording.frames.length - 1;
  at('time').value = player.row;
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

function draw() {
  requestAnimationFrame(draw);
  const start = performance.now();
  if (dirty) {
    dirty = false;
    show();
    if (picked !== null) inspect();
  }
  longest.page = Math.max(longest.page, performance.now() - start);
  const drawing = performance.now();
  stage.draw();
  longest.drawing = Math.max(longest.drawing, performance.now() - drawing);
}

function labels() {
  const strength = JSON.parse(scene.text).bodies?.[0]?.material?.tensile_strength;
  at('strengthValue').textContent = strength ? pascals(strength * 10 ** Number(at('strength').value)) : '';
  at('gravityValue').textContent = `${Number(at('gravity').value).toFixed(2)} m/s²`;
  const { radius, mass } = ball();
  at('radiusValue').textContent = `${(2000 * radius).toFixed(0)} mm, ${mass.toPrecision(2)} kg`;
  at('ballSpeedValue').textContent = `${at('ballSpeed').value} m/s`;
}

const attempt = (work) => Promise.resolve().then(work).catch((error) => say(error.message));

function listen(known) {
  for (const id of ['colour', 'explode', 'clip', 'wires', 'shape']) {
    at(id).addEventListener('input', () => (dirty = true));
  }
  for (const id of ['strength', 'gravity', 'radius', 'ballSpeed']) at(id).addEventListener('input', labels);
  at('time').addEventListener('input', () => player.look(Number(at('time').value)));
  at('play').addEventListener('click', () => player.toggle());
  at('once').addEventListener('click', () => player.once());
  at('restart').addEventListener('click', () => attempt(() => open(scene)));
  at('branch').addEventListener('click', () => attempt(() => player.branch()));
  at('pace').addEventListener('change', () => (player.pace = Number(at('pace').value)));
  at('message').addEventListener('click', () => say(''));
  for (const button of document.querySelectorAll('[data-tool]')) {
    button.addEventListener('click', () => tools.choose(button.dataset.tool));
  }
  at('scene').addEventListener('change', () =>
    attempt(async () => open(await listedScene(known[at('scene').selectedIndex]))),
  );
  addEventListener('resize', () => stage.resize());
  addEventListener('keydown', (event) => {
    if (['SELECT', 'INPUT', 'BUTTON'].includes(event.target.tagName)) return;
    const keys = { ' ': () => player.toggle(), '.': () => player.once(), r: () => attempt(() => open(scene)) };
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
    if (!token) attempt(async () => open(await droppedScene([...event.dataTransfer.files])));
  });
}

async function begin() {
  await engine.ask('open', { url: new URL('sunder.wasm', location.href).href });
  const known = await sceneList(token);
  at('scene').replaceChildren(...known.map((s) => new Option(s.name)));
  listen(known);
  await open(await listedScene(known[0]));
  requestAnimationFrame(draw);
}

begin().catch((error) => say(error.message));
/// For tests that drive the page.
window.sunder = { player, stage, engine, body: () => body, longest, open };
