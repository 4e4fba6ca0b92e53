// SPDX-License-Identifier: MIT
// The topologist's view: fans in their order, each face by face, with what came apart and the
// oracle's word.
import { none } from './layout.js';
import { pascals } from './panel.js';

const darts = (halfFace) => `${3 * halfFace}, ${3 * halfFace + 1}, ${3 * halfFace + 2}`;

/// What splitting one face did, in words. `row`: its place in the fan, from 0.
export function faceWords(face, row, count) {
  const head = `Face ${row + 1} of ${count}`;
  if (face.opposite === none) return `${head}, half-face ${face.halfFace}: another fan had split it already, nothing came apart.`;
  const names = face.vertices.map(String);
  const copies = face.copies.flatMap((copy, i) => (copy === none ? [] : [`${names[i]} (its copy is ${copy})`]));
  const edges = names.flatMap((name, i) => (face.edges & (1 << i) ? [`${name}–${names[(i + 1) % 3]}`] : []));
  const apart = [
    edges.length ? `edges ${edges.join(', ')}` : 'no edge',
    copies.length ? `vertices ${copies.join(', ')}` : 'no vertex',
  ].join('; ');
  const word = face.oracle
    ? 'Oracle: yes, all three vertices came apart, so a piece may have come off.'
    : `Oracle: no, ${copies.length} of three vertices came apart, so its two sides still hang together.`;
  return `${head}. ${word}
Vertices ${names.join(', ')}. Came apart: ${apart}.
Half-face ${face.halfFace} against ${face.opposite}, of tetrahedra ${face.halfFace >> 2} and ${face.opposite >> 2}. Three β3 links are taken away: of darts ${darts(face.halfFace)} with ${darts(face.opposite)}.`;
}

/// What the whole fan was, in words.
export function fanWords(fan) {
  const isCut = fan.number < 0;
  const name = isCut ? 'A cut by hand' : `Fan ${fan.number} of vertex ${fan.vertex}`;
  const cause = isCut ? '' : `: ${pascals(fan.stress)} reached ${pascals(fan.threshold)}`;
  const made = ['no piece came off', `piece ${fan.first} came off`][fan.created] ?? `${fan.created} pieces came off, from ${fan.first} on`;
  return `${name}${cause}; step ${fan.step}, ${(1000 * fan.time).toFixed(2)} ms. The oracle said yes after ${fan.predicted} of ${fan.faces.length} faces; ${made}.`;
}

/// Row of the last fan that a vertex had, by its own row or by its place at rest; -1 for none.
export function fanOfVertex(fans, vertex, rest) {
  const isHere = (fan) => fan.rest.every((x, i) => Math.abs(x - rest[i]) <= 1e-6 * (1 + Math.abs(x)));
  return fans.findLastIndex((fan) => fan.vertex === vertex || isHere(fan));
}

export class FanView {
  /// `parts`: the elements section, number, count, before, after, words; `shown(fan, face)` is
  /// called when another fan or face is to be seen, with null for none.
  constructor(parts, shown) {
    Object.assign(this, { parts, shown, fans: [], fan: -1, face: 0 });
    parts.number.addEventListener('change', () => this.choose(Number(parts.number.value)));
    parts.before.addEventListener('click', () => this.move(-1));
    parts.after.addEventListener('click', () => this.move(1));
    parts.section.addEventListener('toggle', () => this.choose(this.fan, this.face));
  }

  /// The fans there are now; of another recording none is chosen.
  update(fans) {
    if (fans !== this.fans || this.fan >= fans.length) {
      this.fans = fans;
      this.choose(-1);
    }
    this.parts.number.max = Math.max(0, fans.length - 1);
    this.parts.count.textContent = `of ${fans.length}`;
  }

  choose(row, face = 0) {
    this.fan = Number.isInteger(row) && row >= 0 && row < this.fans.length ? row : -1;
    const fan = this.fans[this.fan];
    this.face = fan ? Math.min(Math.max(0, face), fan.faces.length - 1) : 0;
    const { number, before, after, words, section } = this.parts;
    number.value = fan ? this.fan : '';
    before.disabled = after.disabled = !fan;
    words.textContent = fan
      ? `${fanWords(fan)}\n${faceWords(fan.faces[this.face], this.face, fan.faces.length)}`
      : 'Give the number of a fan, or inspect a vertex that broke.';
    this.shown(section.open && fan ? fan : null, this.face);
  }

  /// One face on or back, and on to the next fan or back to the one before.
  move(by) {
    const fan = this.fans[this.fan];
    const face = this.face + by;
    if (face >= 0 && face < fan.faces.length) return this.choose(this.fan, face);
    if (this.fan + by < 0 || this.fan + by >= this.fans.length) return;
    this.choose(this.fan + by, by < 0 ? Infinity : 0);
  }
}
