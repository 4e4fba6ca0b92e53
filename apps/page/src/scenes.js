// SPDX-License-Identifier: MIT
// Where scenes come from: the page's own, the server's, files dropped on the page.

/// The scenes to choose from: {name, text, files: {name in the scene: file}}.
export async function sceneList(token) {
  if (token) {
    const answer = await fetch('api/scene', { method: 'POST', headers: { 'X-Sunder-Token': token } });
    return [{ ...(await answer.json()), files: {} }];
  }
  return (await fetch('scenes/scenes.json')).json();
}

/// A scene of the list with the bytes of its files.
export async function listedScene(scene) {
  const files = await Promise.all(
    Object.entries(scene.files).map(async ([name, file]) => {
      const answer = await fetch(`scenes/${file}`);
      return [name, new Uint8Array(await answer.arrayBuffer())];
    }),
  );
  return { name: `${scene.name}.json`, text: scene.text, files: Object.fromEntries(files) };
}

/// Names of the mesh files of a scene: bodies of the key `shape` have none.
export function meshFiles({ bodies, obstacles = [] }) {
  return [...new Set([...bodies, ...obstacles].map((part) => part.mesh).filter(Boolean))];
}

/// A file's bytes, unpacked where it is packed: the engine of the page has no zlib.
async function bytesOf(file) {
  const bytes = new Uint8Array(await file.arrayBuffer());
  if (bytes[0] !== 0x1f || bytes[1] !== 0x8b) return bytes;
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/// Calls `found(text)` for every text in a scene that has the bare name of a file.
function eachName(value, files, found) {
  if (typeof value === 'string') {
    if (value.split('/').at(-1) in files) found(value);
  } else if (value && typeof value === 'object') {
    for (const part of Object.values(value)) eachName(part, files, found);
  }
}

function parsed(name, text) {
  try {
    return JSON.parse(text);
  } catch (error) {
    throw new Error(`${name} is no JSON: ${error.message}`);
  }
}

/// A scene in JSON with the files that it names, or a mesh alone, which then falls on a floor.
export async function droppedScene(dropped) {
  const scene = dropped.find((file) => file.name.endsWith('.json'));
  const files = {};
  for (const file of dropped) {
    if (file !== scene) files[file.name] = await bytesOf(file);
  }
  if (!scene) return fallingMesh(Object.keys(files)[0], files);
  const text = await scene.text();
  // A scene names its files with folders, a drop has none.
  eachName(parsed(scene.name, text), files, (name) => (files[name] = files[name.split('/').at(-1)]));
  return { name: scene.name, text, files, isDropped: true };
}

function fallingMesh(mesh, files) {
  const scene = {
    name: mesh,
    description: `${mesh} of concrete falls on a floor.`,
    bodies: [{
      name: mesh,
      mesh,
      material: { young_modulus: 30e9, poisson_ratio: 0.2, density: 2400, tensile_strength: 3e6 },
      velocity: [0, 0, -6],
    }],
    time_step: 2e-4,
    duration: 1,
    fracture: { crack: 'object' },
  };
  return { name: `${mesh}.json`, text: JSON.stringify(scene, null, 2), files, isDropped: true, needsFloor: true };
}

/// The same scene with a floor a little below what is lowest.
export function withFloor(scene, box) {
  const content = JSON.parse(scene.text);
  const offset = box.min.z - 0.02 * (box.max.z - box.min.z);
  content.obstacles = [{ plane: { normal: [0, 0, 1], offset }, friction: 0.6 }];
  return { ...scene, text: JSON.stringify(content, null, 2), needsFloor: false };
}
