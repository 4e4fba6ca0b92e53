// SPDX-License-Identifier: MIT
// The structs and columns of apps/host/sunder.h as bytes: the same on 32 and 64 bits where both
// back ends send them.

/// Columns by their names, in the order of `sunder_column`, and what their rows are made of.
export const columns = {
  position: { id: 0, array: Float32Array },
  rest: { id: 1, array: Float32Array },
  piece: { id: 2, array: Uint32Array },
  face: { id: 3, array: Uint32Array },
  faceIsCrack: { id: 4, array: Uint32Array },
  drawnPose: { id: 5, array: Float32Array },
  pose: { id: 6, array: Float32Array },
  restCentre: { id: 7, array: Float32Array },
  stress: { id: 8, array: Float32Array },
  loadRatio: { id: 9, array: Float32Array },
  speed: { id: 10, array: Float32Array },
  birth: { id: 11, array: Uint32Array },
  body: { id: 12, array: Uint32Array },
  obstacle: { id: 13, array: Float64Array },
  halfFace: { id: 14, array: Uint32Array },
  parent: { id: 15, array: Uint32Array },
  tetrahedra: { id: 16, array: Uint32Array },
  velocity: { id: 17, array: Float32Array },
  smooth: { id: 18, array: Float32Array },
  solid: { id: 19, array: Float32Array },
  contact: { id: 20, array: Float32Array },
  crackFront: { id: 21, array: Uint32Array },
  fan: { id: 22, array: Float64Array },
  fanFace: { id: 23, array: Uint32Array },
  material: { id: 24, array: Float64Array },
};

export const reportSize = 168;
export const actionSize = 80;
export const vertexSize = 208;
export const actions = { shoot: 0, pull: 1, release: 2, cut: 3 };

/// A `sunder_report` at `at`.
export function readReport(view, at) {
  const u32 = (offset) => view.getUint32(at + offset, true);
  const u64 = (offset) => Number(view.getBigUint64(at + offset, true));
  const f64 = (offset) => view.getFloat64(at + offset, true);
  return {
    failed: u32(4) !== 0,
    step: u64(8),
    time: f64(16),
    timeStep: f64(24),
    duration: f64(32),
    stageMs: [f64(40), f64(48), f64(56), f64(64)],
    pieces: u32(72),
    newPieces: u32(76),
    fans: u32(80),
    parts: u32(84),
    shape: u32(88),
    contacts: u32(92),
    fansTotal: u64(96),
    tested: u64(104),
    suspects: u64(112),
    reached: u64(120),
    predicted: u64(128),
    created: u64(136),
    kinetic: f64(144),
    strain: f64(152),
    cracks: f64(160),
  };
}

/// Writes a `sunder_action`; all of it in SI units and world coordinates.
export function writeAction(view, at, action) {
  view.setUint32(at, actionSize, true);
  view.setUint32(at + 4, actions[action.kind], true);
  view.setUint32(at + 8, action.vertex ?? 0, true);
  view.setUint32(at + 12, 0, true);
  const numbers = [
    ...(action.point ?? [0, 0, 0]),
    ...(action.vector ?? [0, 0, 0]),
    action.radius ?? 0,
    action.mass ?? 0,
  ];
  numbers.forEach((value, i) => view.setFloat64(at + 16 + 8 * i, value, true));
}

/// A `sunder_vertex` at `at`.
export function readVertex(view, at) {
  const f64 = (offset, count) =>
    Array.from({ length: count }, (_, i) => view.getFloat64(at + offset + 8 * i, true));
  return {
    piece: view.getUint32(at + 4, true),
    tetrahedra: view.getUint32(at + 8, true),
    fan: view.getUint32(at + 12, true),
    stress: f64(16, 6),
    principal: f64(64, 3),
    direction: [0, 1, 2].map((i) => f64(88 + 24 * i, 3)),
    threshold: f64(160, 1)[0],
    gershgorin: f64(168, 1)[0],
    position: f64(176, 3),
    speed: f64(200, 1)[0],
  };
}

/// Materials of the column `material`, one a body, in SI units.
export function readMaterials(rows) {
  return Array.from({ length: rows.length / 6 }, (_, k) => {
    const [young, poisson, density, strength, toughness, energy] = rows.subarray(6 * k, 6 * k + 6);
    return { young, poisson, density, strength, toughness: toughness || undefined, energy: energy || undefined };
  });
}

/// No row: of a vertex that did not come apart, of a face that was split before.
export const none = 0xffffffff;

/// Fans of the columns `fan` and `fanFace`: plain objects, each with its faces in order.
export function readFans(fan, fanFace) {
  const fans = [];
  for (let at = 0; at < fan.length; at += 16) {
    const [number, time, vertex, , predicted, created, first, stress, threshold] = fan.subarray(at, at + 9);
    fans.push({
      number, time, vertex, predicted, created, first, stress, threshold,
      normal: [...fan.subarray(at + 9, at + 12)],
      rest: [...fan.subarray(at + 12, at + 15)],
      faces: [],
    });
  }
  for (let at = 0; at < fanFace.length; at += 12) {
    const row = fanFace.subarray(at, at + 12);
    fans[row[10]].faces.push({
      halfFace: row[0],
      opposite: row[1],
      vertices: [...row.subarray(2, 5)],
      copies: [...row.subarray(5, 8)],
      edges: row[8],
      oracle: row[9] === 1,
    });
  }
  return fans;
}
