// SPDX-License-Identifier: MIT
// The list of fragments: pieces that are there, the heaviest first.

/// Rows of the pieces of a frame: {id, mass, tetrahedra, birth (s), speed}, by mass.
export function fragmentRows(frame) {
  const { restCentre, tetrahedra, birth } = frame.shape;
  const { velocity } = frame.columns;
  const rows = [];
  for (let id = 0; id < tetrahedra.length; ++id) {
    if (tetrahedra[id] === 0) continue;
    rows.push({
      id,
      mass: restCentre[4 * id + 3],
      tetrahedra: tetrahedra[id],
      birth: birth[id] * frame.report.timeStep,
      speed: Math.hypot(...velocity.subarray(3 * id, 3 * id + 3)),
    });
  }
  return rows.sort((a, b) => b.mass - a.mass || a.id - b.id);
}

const words = (row) =>
  `${row.id}: ${row.mass.toPrecision(3)} kg, ${row.tetrahedra} tets, ${(1000 * row.birth).toFixed(1)} ms, ${row.speed.toFixed(2)} m/s`;

/// Fills a list box, and keeps its choice by the piece's id.
export function showFragments(list, rows) {
  const chosen = list.value;
  while (list.options.length > rows.length) list.remove(list.options.length - 1);
  while (list.options.length < rows.length) list.add(new Option());
  rows.forEach((row, k) => {
    const option = list.options[k];
    const text = words(row);
    if (option.text !== text) option.text = text;
    if (option.value !== String(row.id)) option.value = row.id;
  });
  list.value = chosen;
}
