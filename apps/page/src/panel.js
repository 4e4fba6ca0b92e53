// SPDX-License-Identifier: MIT
// Words and numbers of the page: counters, the vertex that was picked.

const whole = new Intl.NumberFormat('en-GB');

/// A stress in the unit that leaves few digits.
export function pascals(value) {
  const size = Math.abs(value);
  if (!Number.isFinite(value)) return value > 0 ? '∞' : String(value);
  if (size >= 1e9) return `${(value / 1e9).toPrecision(3)} GPa`;
  if (size >= 1e6) return `${(value / 1e6).toPrecision(3)} MPa`;
  if (size >= 1e3) return `${(value / 1e3).toPrecision(3)} kPa`;
  return `${value.toPrecision(3)} Pa`;
}

/// Counters of a frame; tables 3 and 4 of the paper add up over the run.
export function counterRows(report, sums, drawn) {
  return [
    ['pieces', report.pieces],
    ['fans of cracks', report.fansTotal],
    ['vertices tested', sums.tested],
    ['passed by Gershgorin', sums.suspects],
    ['over their threshold', sums.reached],
    ['oracle: new piece', sums.predicted],
    ['pieces made', sums.created],
    ['contacts', report.contacts],
    ['draw calls', drawn.calls],
    ['triangles', drawn.triangles],
  ].map(([name, value]) => [name, whole.format(value)]);
}

export function showCounters(list, rows) {
  if (list.children.length !== 2 * rows.length) {
    list.replaceChildren(...rows.flatMap(() => [document.createElement('dt'), document.createElement('dd')]));
  }
  rows.forEach(([name, value], k) => {
    list.children[2 * k].textContent = name;
    list.children[2 * k + 1].textContent = value;
  });
}

/// A vertex as the fracture search sees it.
export function showVertex(section, row, v) {
  const [xx, yy, zz, xy, yz, xz] = v.stress.map(pascals);
  const line = (cells) => `<tr>${cells.map((c) => `<td>${c}</td>`).join('')}</tr>`;
  const state = v.principal[0] >= v.threshold ? 'breaks' : 'holds';
  section.innerHTML = `<h2>Vertex ${row}, piece ${v.piece}</h2>
<table aria-label="Stress tensor in the frame of the piece">${line([xx, xy, xz])}${line(['', yy, yz])}${line(['', '', zz])}</table>
<table aria-label="Principal stresses and their directions">${v.principal
    .map((value, i) => line([pascals(value), ...v.direction[i].map((x) => x.toFixed(3))]))
    .join('')}</table>
threshold ${pascals(v.threshold)}: ${state}; Gershgorin's bound ${pascals(v.gershgorin)}<br>
${v.tetrahedra} tetrahedra around it, ${v.fan} faces in its fan; ${v.speed.toPrecision(3)} m/s`;
  section.hidden = false;
}
