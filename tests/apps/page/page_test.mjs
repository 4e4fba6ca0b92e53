// SPDX-License-Identifier: MIT
// What of the page needs no browser: node --test tests/apps/page/page_test.mjs
import assert from 'node:assert/strict';
import test from 'node:test';
import { gzipSync } from 'node:zlib';

const src = new URL('../../../apps/page/src/', import.meta.url);
const { faceWords, fanOfVertex, fanWords } = await import(new URL('fans.js', src));
const { fragmentRows } = await import(new URL('fragments.js', src));
const { largestJump } = await import(new URL('jump.js', src));
const { none, readFans, readMaterials } = await import(new URL('layout.js', src));
const { MaterialSliders } = await import(new URL('material.js', src));
const { Recording } = await import(new URL('recording.js', src));
const { ServerEngine } = await import(new URL('engines.js', src));
const { droppedScene, meshFiles } = await import(new URL('scenes.js', src));
const { Player } = await import(new URL('player.js', src));

/// Two fans: one of two faces, the second of which parts all three vertices; then a cut of one face.
const fan = new Float64Array([
  4, 0.02, 7, 2, 1, 1, 3, 3.1e6, 3e6, 0, 0, 1, 0.5, 0.25, 1, 9,
  -1, 0.03, 8, 1, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 2,
]);
const fanFace = new Uint32Array([
  12, 21, 7, 8, 9, none, none, none, 1, 0, 0, 0,
  13, 22, 7, 9, 10, 40, 41, 42, 7, 1, 0, 0,
  12, none, none, none, none, none, none, none, 0, 0, 1, 0,
]);

test('fans are read with their faces', () => {
  const [first, second] = readFans(fan, fanFace);
  assert.equal(first.faces.length, 2);
  assert.deepEqual(first.faces[1].copies, [40, 41, 42]);
  assert.equal(first.faces[1].oracle, true);
  assert.equal(second.number, -1);
  assert.equal(second.faces[0].opposite, none);
});

test('words of a fan tell what came apart and what the oracle says', () => {
  const [first, cut] = readFans(fan, fanFace);
  first.step = cut.step = 5;
  assert.match(fanWords(first), /Fan 4 of vertex 7: 3.10 MPa reached 3.00 MPa; .* after 1 of 2 faces; piece 3 came off/);
  assert.match(fanWords(cut), /A cut by hand; .* no piece came off/);
  assert.match(faceWords(first.faces[0], 0, 2), /Oracle: no, 0 of three[^]*edges 7–8; no vertex[^]*darts 36, 37, 38 with 63, 64, 65/);
  assert.match(faceWords(first.faces[1], 1, 2), /Oracle: yes[^]*7 \(its copy is 40\), 9 \(its copy is 41\)/);
  assert.match(faceWords(cut.faces[0], 0, 1), /another fan had split it already/);
});

test('a vertex finds its fan by its row, and a copy by its place', () => {
  const fans = readFans(fan, fanFace);
  assert.equal(fanOfVertex(fans, 7, [9, 9, 9]), 0);
  assert.equal(fanOfVertex(fans, 40, [0.5, 0.25, 1]), 0);
  assert.equal(fanOfVertex(fans, 40, [0.5, 0.3, 1]), -1);
});

test('going back forgets fans that came after, and what they opened', () => {
  const recording = new Recording();
  const [first, second] = readFans(fan, fanFace);
  second.faces = [{ ...first.faces[0], halfFace: 30, opposite: 31 }];
  for (const step of [0, 1, 2]) recording.add({ report: { step }, columns: {} });
  recording.addFans(1, [first]);
  recording.addFans(2, [second]);
  assert.deepEqual(recording.opened.get(31), [-1, 0.03]);
  recording.cutAfter(1);
  assert.equal(recording.fans.length, 1);
  assert.deepEqual([...recording.opened.keys()].sort((a, b) => a - b), [12, 13, 21, 22]);
  assert.equal(recording.last.report.step, 1);
});

const identity = [0, 0, 0, 0, 0, 0, 0, 1];

test('the jump of a piece that has come off is that from where its parent drew it', () => {
  const before = {
    columns: { drawnPose: new Float32Array(identity), pose: new Float32Array(identity) },
    shape: { restCentre: new Float32Array([0, 0, 0, 2]) },
  };
  const place = (x, centre) => [centre + x, 0, 0, 0, 0, 0, 0, 1];
  const after = {
    columns: {
      drawnPose: new Float32Array([...place(0.25, -1), ...place(0, 1)]),
      pose: new Float32Array([...place(0.25, -1), ...place(0.5, 1)]),
    },
    shape: {
      rest: new Float32Array([-1, 0, 0, 1, 0, 0]), piece: new Uint32Array([0, 1]), parent: new Uint32Array([none, 0]),
      restCentre: new Float32Array([-1, 0, 0, 1, 1, 0, 0, 1]),
    },
  };
  assert.deepEqual(largestJump(before, after), { drawn: 0.25, target: 0.5 });
});

test('fragments are those that have tetrahedra, the heaviest first', () => {
  const rows = fragmentRows({
    report: { timeStep: 0.5 },
    columns: { velocity: new Float32Array([0, 0, 0, 3, 0, 4, 0, 0, 1]) },
    shape: {
      restCentre: new Float32Array([0, 0, 0, 1, 0, 0, 0, 5, 0, 0, 0, 9]),
      tetrahedra: new Uint32Array([1, 2, 0]), birth: new Uint32Array([0, 6, 0]),
    },
  });
  assert.deepEqual(rows, [
    { id: 1, mass: 5, tetrahedra: 2, birth: 3, speed: 5 },
    { id: 0, mass: 1, tetrahedra: 1, birth: 0, speed: 0 },
  ]);
});

test('a dropped scene finds its files by their bare names, and packed files are unpacked', async () => {
  const text = JSON.stringify({ bodies: [{ mesh: '../meshes/own.mesh' }], obstacles: [{ mesh: 'in/die.stl' }], name: 'none.stl' });
  const own = await droppedScene([
    new File([gzipSync('tetrahedra')], 'own.mesh'), new File([text], 'own.json'), new File(['solid'], 'die.stl'),
  ]);
  const words = (name) => new TextDecoder().decode(own.files[name]);
  assert.equal(own.name, 'own.json');
  assert.equal(words('../meshes/own.mesh'), 'tetrahedra');
  assert.equal(words('in/die.stl'), 'solid');
  assert.equal('none.stl' in own.files, false);
  await assert.rejects(droppedScene([new File(['{'], 'broken.json')]), /broken\.json is no JSON/);
});

test('a mesh alone is dropped on a floor', async () => {
  const own = await droppedScene([new File(['tetrahedra'], 'own.mesh')]);
  assert.equal(own.needsFloor, true);
  assert.equal(JSON.parse(own.text).bodies[0].mesh, 'own.mesh');
});

test('a dropped scene goes to the server with its files, the own scene without', async () => {
  const engine = new ServerEngine('secret');
  const scene = { settings: ['a=1'], text: '{}', name: 'x.json', files: { 'a.msh': new Uint8Array([7, 8]) } };
  const parts = async (body) => {
    const bytes = await body.arrayBuffer();
    const size = Number(new DataView(bytes).getBigUint64(0, true));
    return [JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 8, size))), [...new Uint8Array(bytes, 8 + size)]];
  };
  assert.deepEqual(await parts(engine.body('load', { scene })), [{ settings: ['a=1'] }, []]);
  assert.deepEqual(await parts(engine.body('load', { scene: { ...scene, isDropped: true } })), [
    { settings: ['a=1'], text: '{}', name: 'x.json', files: ['a.msh'], sizes: [2] }, [7, 8],
  ]);
});

test('a page learns that another has started the scene anew', async () => {
  const player = new Player({ ask: async () => ({ report: { step: 1 }, columns: {} }) }, {});
  player.recording.add({ report: { step: 40 }, columns: {} });
  await assert.rejects(player.step(), /another page/);
});

test('no step is asked for while another scene or an earlier state is on its way', async () => {
  const asked = [];
  const none = new Float64Array();
  const columns = () => ({ face: new Uint32Array(), pose: none, drawnPose: none, fan: none, fanFace: new Uint32Array(), material: none });
  const report = { step: 0, shape: 0 };
  const engine = {
    ask: async (work) => {
      asked.push(work);
      return work === 'load' ? { warnings: [] } : work === 'save' ? { step: 0, size: 1 } : { report, columns: columns() };
    },
  };
  const player = new Player(engine, { frame() {}, message() {} });
  await player.open({ text: '{}' });
  const again = player.open({ text: '{}' });
  await player.step();
  await again;
  player.look(0);
  const back = player.branch();
  await player.step();
  await back;
  assert.deepEqual(asked, ['load', 'read', 'save', 'load', 'read', 'save', 'restore', 'read']);
});

/// Sliders over plain objects, opened with bodies of these materials (rows of the column `material`).
function slidersOf(scene, ...rows) {
  const elements = {};
  const listeners = {};
  const at = (id) => (elements[id] ??= {
    value: '', disabled: false, textContent: '',
    addEventListener: (event, call) => (listeners[`${id} ${event}`] = call),
  });
  let changes = 0;
  const sliders = new MaterialSliders(at, () => ++changes);
  sliders.open(JSON.stringify(scene), readMaterials(new Float64Array(rows.flat())));
  const slide = (id, value) => {
    at(id).value = value;
    listeners[`${id} input`]?.();
    listeners[`${id} change`]();
  };
  return { sliders, at, slide, changes: () => changes };
}
const glass = [70e9, 0.22, 2500, 45e6, 0.75e6, 0];
const brick = [15e9, 0.15, 1800, 2e6, 0, 100];

test('sliders show the material that the engine has, also of a scene with its name alone', () => {
  const { at } = slidersOf({ bodies: [{ shape: {}, material: 'glass' }] }, glass);
  assert.deepEqual(['strength', 'toughness', 'energy'].map((id) => at(`${id}Value`).textContent), ['45.0 MPa', '750 kPa √m', '7.65 J/m²']);
  assert.equal(at('energy').disabled, true);
  const endless = slidersOf({}, [70e9, 0.22, 2500, Infinity, 0, 0]);
  assert.deepEqual(['strength', 'toughness', 'energy'].map((id) => endless.at(`${id}Value`).textContent), ['none', 'none', 'none']);
});

test('a slider that is let go acts, on the bodies that have its key', () => {
  const { sliders, slide, changes } = slidersOf({ gravity: { acceleration: [0, -10, 0] } }, glass, brick);
  slide('strength', Math.log10(2));
  slide('toughness', 6);
  slide('gravity', 5);
  assert.equal(changes(), 3);
  assert.deepEqual(sliders.settings(), [
    'bodies.0.material.tensile_strength=90000000', 'bodies.0.material.toughness=1000000',
    'bodies.1.material.tensile_strength=4000000', 'gravity.acceleration=[0,-5,0]',
  ]);
});

test('files of a scene are those of its meshes: a shape has none', () => {
  const scene = { bodies: [{ mesh: 'a.msh' }, { shape: {} }, { mesh: 'a.msh' }], obstacles: [{ mesh: 'b.stl' }, { plane: {} }] };
  assert.deepEqual(meshFiles(scene), ['a.msh', 'b.stl']);
});
