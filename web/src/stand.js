// Side view of the test stand: an element hangs from a beam, with a load at its lower end. Lengths, the
// diameter of the braid and the turns of its threads are true to scale.
import { between } from './samples.js';
import { Scene } from './scene.js';
import * as parts from './stand_parts.js';

// Returns the stand in the form of a machine's scene, for the code that draws both; the
// stand's element is its only muscle.
export const as_scene = (stand) => ({
  ...stand, muscles: [{ name: stand.element, pressure: stand.pressure, inlet: stand.inlet, exhaust: stand.exhaust }],
});

export class StandScene extends Scene {
  constructor(canvas, stand, columns, units) {
    super(canvas, as_scene(stand), columns, units);
  }

  refit() {
    const { spec } = this;
    this.reach = spec.bore > 0 ? 1.8 * spec.stroke : Math.max(spec.longest, spec.most, 1e-3);
    this.start = this.at(spec.length, 0);
    this.pressures = this.pressure_range();
  }

  at(column, t) {
    return column === null ? NaN : between(this.columns[column], t);
  }

  note() {
    return `${this.spec.drawn_from}; true to scale`;
  }

  legend() {
    return this.spec.desired === null ? [] : [['desired', 'length desired']];
  }

  // --- drawing ---

  draw_world(ctx, v, t) {
    parts.beam(ctx, v, this.spec.load === 'hanging', this.theme);
    if (this.spec.load !== 'hanging') parts.columns(ctx, v, this.spec.most, this.theme);
    this.draw_ruler(ctx, v, this.state(t));
  }

  draw_machine(ctx, v, t) {
    const state = this.state(t);
    parts.feed(ctx, v, this.spec, state, this.theme);
    parts.element(ctx, v, this.spec, state, this.theme);
    this.draw_load(ctx, v, state);
  }

  // The ruler shows the scale, and text the force.
  draw_scale() {}
  draw_force() {}

  // Returns the values of everything that moves, at t.
  state(t) {
    const { spec } = this;
    const open = (valve) => valve !== null && this.is_open(valve, t);
    const inlet = open(spec.inlet);
    return {
      length: this.at(spec.length, t), desired: this.at(spec.desired, t), diameter: this.at(spec.diameter, t),
      tension: this.at(spec.tension, t), weight: this.at(spec.weight, t), inlet,
      // A 3-way valve connects the element to the room whenever it does not connect it to the supply.
      exhaust: spec.air === '3-way' ? !inlet : open(spec.exhaust),
      color: this.color_of(spec.pressure, t),
    };
  }

  // Returns the transformation from meters to pixels: x from the element's axis, y downwards from its upper
  // end. The element's lower end is at `zero` plus its length.
  place(ctx, width, height) {
    const { spec, reach } = this;
    const barrel = spec.bore > 0 ? 1.25 * spec.stroke : 0;
    const deep = barrel + Math.max(spec.most + 0.46 * reach, spec.longest + 0.03 * reach), above = 0.16 * reach;
    const room = 26;
    const scale = Math.min((height - room - 6) / (deep + above), width / (2.1 * reach));
    const middle = Math.max(0, (height - room - scale * (deep + above)) / 2);
    const left = 0.52 * width, top = room + middle + scale * above;
    return { width, height, unit: scale * reach, barrel, zero: barrel,
             x: (m) => left + scale * m, y: (m) => top + scale * m, px: (m) => scale * m, reach };
  }

  // Returns the unit of length; millimetres in place of metres, since an element is small.
  length_unit() {
    const unit = this.units.of('m');
    return unit.label === 'm' ? { label: 'mm', scale: 1e3 } : unit;
  }

  // Returns a length to about a tenth of a millimetre.
  length_text(meters, sign = false) {
    const { label, scale } = this.length_unit();
    const words = (meters * scale).toFixed(Math.max(0, Math.ceil(4 - Math.log10(scale))));
    return `${sign && meters >= 0 ? '+' : ''}${words} ${label}`.replace('-', '−');
  }

  force_text(newtons) {
    const { label } = this.units.of('N'), value = this.units.convert(newtons, 'N');
    return `${value.toFixed(Math.abs(value) < 10 ? 2 : 1)} ${label}`.replace('-', '−');
  }

  draw_ruler(ctx, v, state) {
    const { label, scale } = this.length_unit();
    const { spec, theme } = this;
    const x = v.x(-0.74 * this.reach);
    parts.ruler(ctx, v, x, { to: Math.max(spec.most, spec.longest), shortest: spec.shortest, longest: spec.longest,
                             unit: 1 / scale, label }, theme);
    if (Number.isFinite(this.start) && spec.most > spec.least)
      parts.pointer(ctx, v, x, this.start, theme.quiet, [1, 3], '', theme, -1);
    // Uses the longest text that fits next to the element.
    const half = Math.max(0.08 * this.reach, 0.6 * spec.count * (state.diameter || 0), 0.6 * spec.bore);
    const room = v.x(-half) - x - 14;
    const longest = (...texts) => texts.find((text) => parts.width(ctx, text, theme) < room) ?? texts.at(-1);
    const now = this.length_text(state.length), desired = this.length_text(state.desired);
    if (Number.isFinite(state.desired))
      parts.pointer(ctx, v, x, state.desired, theme.desired, [5, 4], longest(`desired ${desired}`, desired), theme,
                    state.desired < state.length ? -1 : 1);
    const moved = spec.most > spec.least ? `${now}  (${this.length_text(state.length - this.start, true)})` : now;
    parts.pointer(ctx, v, x, state.length, theme.actual, [], longest(moved, now), theme,
                  state.desired < state.length ? 1 : -1);
  }

  draw_load(ctx, v, state) {
    const { spec, theme } = this;
    const tension = Number.isFinite(state.tension) ? `tension ${this.force_text(state.tension)}` : '';
    parts.load_cell(ctx, v, state.length, tension, theme);
    if (spec.load === 'hanging')
      parts.weights(ctx, v, spec, state, `load ${this.force_text(state.weight)}`, theme);
    else parts.crosshead(ctx, v, spec, state.length, theme);
  }
}
