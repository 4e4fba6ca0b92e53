// SPDX-License-Identifier: MIT
// Sliders of strength, toughness, fracture energy and gravity, and the settings that they mean.
import { pascals } from './panel.js';

/// Number of significant digits that a setting needs: a slider has no finer steps.
const digits = (value) => Number(value.toPrecision(4));

export class MaterialSliders {
  /// `at`: elements of the page by their id.
  constructor(at) {
    this.at = at;
    this.moved = new Set();
    for (const id of ['strength', 'toughness', 'energy']) {
      at(id).addEventListener('input', () => this.move(id));
    }
  }

  /// A scene with the sliders as it has them.
  open(text) {
    const scene = JSON.parse(text);
    this.bodies = (scene.bodies ?? []).map((body) => body.material ?? {});
    this.moved.clear();
    const { toughness, fracture_energy: energy } = this.bodies[0] ?? {};
    this.at('strength').value = 0;
    this.at('toughness').value = Math.log10(toughness ?? 1e6);
    this.at('energy').value = Math.log10(energy ?? 30);
    this.first = { toughness, energy };
    // Both at once would have to agree: who has the one keeps to it.
    this.at('toughness').disabled = energy !== undefined && toughness === undefined;
    this.at('energy').disabled = toughness !== undefined && energy === undefined;
    this.at('gravity').value = Math.hypot(...(scene.gravity?.acceleration ?? [0, 0, -9.81]));
    this.gravity = this.at('gravity').value;
    this.labels();
  }

  move(id) {
    this.moved.add(id);
    if (id === 'toughness') this.moved.delete('energy');
    if (id === 'energy') this.moved.delete('toughness');
    this.labels();
  }

  /// What a slider says, in SI units; undefined: the scene's own, and that has none.
  value(id) {
    return this.moved.has(id) ? digits(10 ** Number(this.at(id).value)) : this.first[id];
  }

  labels() {
    const { tensile_strength: strength } = this.bodies[0] ?? {};
    const toughness = this.value('toughness'), energy = this.value('energy');
    const factor = 10 ** Number(this.at('strength').value);
    this.at('strengthValue').textContent = strength ? pascals(strength * factor) : 'none';
    this.at('toughnessValue').textContent = toughness ? `${pascals(toughness)} √m` : 'none';
    this.at('energyValue').textContent = energy ? `${energy.toPrecision(3)} J/m²` : 'none';
  }

  /// Of all bodies: "dotted.path=value".
  settings() {
    const list = [];
    this.bodies.forEach((material, k) => {
      const path = `bodies.${k}.material`;
      const factor = 10 ** Number(this.at('strength').value);
      if (material.tensile_strength && factor !== 1) {
        list.push(`${path}.tensile_strength=${digits(material.tensile_strength * factor)}`);
      }
      if (this.moved.has('toughness')) list.push(`${path}.toughness=${this.value('toughness')}`);
      if (this.moved.has('energy')) list.push(`${path}.fracture_energy=${this.value('energy')}`);
    });
    if (this.at('gravity').value !== this.gravity) {
      list.push(`gravity.acceleration=[0,0,${-Number(this.at('gravity').value)}]`);
    }
    return list;
  }
}
