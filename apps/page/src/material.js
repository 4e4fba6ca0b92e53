// SPDX-License-Identifier: MIT
// Sliders of strength, toughness, fracture energy and gravity, and the settings that they mean.
import { pascals } from './panel.js';

/// Number of significant digits that a setting needs: a slider has no finer steps.
const digits = (value) => Number(value.toPrecision(4));

/// Fracture energy of a material with a toughness, J/m²: plane strain.
const energyOf = ({ young, poisson }, toughness) => (toughness ** 2 * (1 - poisson ** 2)) / young;

export class MaterialSliders {
  /// `at`: elements of the page by their id. `changed()`: a slider was let go.
  constructor(at, changed) {
    this.at = at;
    this.moved = new Set();
    for (const id of ['strength', 'toughness', 'energy']) {
      at(id).addEventListener('input', () => this.move(id));
    }
    for (const id of ['strength', 'toughness', 'energy', 'gravity']) at(id).addEventListener('change', changed);
  }

  /// A scene with the sliders as it has them. `materials`: those of its bodies, from the engine.
  open(text, materials) {
    this.bodies = materials;
    this.moved.clear();
    const { toughness, energy } = materials[0];
    this.at('strength').value = 0;
    this.at('toughness').value = Math.log10(toughness ?? 1e6);
    this.at('energy').value = Math.log10(energy ?? 30);
    // Both at once would have to agree: a material with one of them keeps to it.
    this.at('toughness').disabled = energy !== undefined && toughness === undefined;
    this.at('energy').disabled = toughness !== undefined && energy === undefined;
    this.acceleration = JSON.parse(text).gravity?.acceleration ?? [0, 0, -9.81];
    this.at('gravity').value = Math.hypot(...this.acceleration);
    this.gravity = this.at('gravity').value;
    this.labels();
  }

  move(id) {
    this.moved.add(id);
    if (id === 'toughness') this.moved.delete('energy');
    if (id === 'energy') this.moved.delete('toughness');
    this.labels();
  }

  /// The value of a slider, in SI units; undefined: neither slider nor scene has one.
  value(id) {
    return this.moved.has(id) ? digits(10 ** Number(this.at(id).value)) : this.bodies[0][id];
  }

  labels() {
    const first = this.bodies[0];
    const toughness = this.value('toughness');
    const energy = this.value('energy') ?? (toughness && energyOf(first, toughness));
    const strength = first.strength * 10 ** Number(this.at('strength').value);
    this.at('strengthValue').textContent = Number.isFinite(strength) ? pascals(strength) : 'none';
    this.at('toughnessValue').textContent = toughness ? `${pascals(toughness)} √m` : 'none';
    this.at('energyValue').textContent = energy ? `${Number(energy.toPrecision(3))} J/m²` : 'none';
    if (this.at('energy').disabled) this.at('energy').value = Math.log10(energy);
  }

  /// Of all bodies that have such a key: "dotted.path=value".
  settings() {
    const list = [];
    const factor = 10 ** Number(this.at('strength').value);
    this.bodies.forEach(({ strength, toughness, energy }, k) => {
      const path = `bodies.${k}.material`;
      if (Number.isFinite(strength) && factor !== 1) list.push(`${path}.tensile_strength=${digits(strength * factor)}`);
      if (this.moved.has('toughness') && !energy) list.push(`${path}.toughness=${this.value('toughness')}`);
      if (this.moved.has('energy') && !toughness) list.push(`${path}.fracture_energy=${this.value('energy')}`);
    });
    if (this.at('gravity').value !== this.gravity) {
      const size = Math.hypot(...this.acceleration);
      const down = size > 0 ? this.acceleration.map((x) => x / size) : [0, 0, -1];
      list.push(`gravity.acceleration=[${down.map((x) => digits(x * Number(this.at('gravity').value)))}]`);
    }
    return list;
  }
}
