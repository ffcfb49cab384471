// Pictures of machines for the list of runs: the drawing of a run's page in its initial pose, without
// surroundings and words.
import { read_samples } from './samples.js';
import { Scene } from './scene.js';
import { StandScene } from './stand.js';
import * as parts from './stand_parts.js';
import { theme_of } from './theme.js';
import { Units } from './units.js';

class MachineIcon extends Scene {
  room = { above: 2, margin: 2 };

  draw_world() {}
  draw_force() {}
  draw_scale() {}
  color_of() { return this.theme.actual; }
}

class StandIcon extends StandScene {
  draw_world(ctx, v) {
    parts.beam(ctx, v, true, this.theme);
  }

  draw_machine(ctx, v, t) {
    const state = { ...this.state(t), color: this.theme.actual };
    parts.element(ctx, v, this.spec, state, this.theme);
    parts.weights(ctx, v, this.spec, { ...state, weight: 1 }, '', this.theme);
  }
}

// A muscle with a hanging load, for every stand [m].
const some_stand = { element: '', count: 1, turns: 1.5, bore: 0, load: 'hanging', longest: 0.2, most: 0.2, least: 0.2, shortest: 0.15,
                     heaviest: 1, weight_step: 0, length: 0, diameter: 1, pressure: null, desired: null, tension: null, weight: null,
                     inlet: null, exhaust: null, drawn_from: '' };
const of_one = (value) => ({ time: Float64Array.of(0), values: Float32Array.of(value) });

// The curve of a recording without a machine.
const curve = `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 96 96" fill="none"><path d="M12 16V80H88" stroke="#8a95a5" stroke-width="3"/>
<path d="M16 48C22 12 28 12 34 48S46 80 52 48S62 22 68 48S78 66 84 48" stroke="#2f86c5" stroke-width="4"/></svg>`;

// Returns the picture on light and on dark as addresses of images. `found`: what the program sends (sinew/report/page/content.h).
// `canvas`: any canvas of the page, on which it is drawn.
export async function icons_of(found, canvas) {
  const units = new Units(found.atmosphere ?? 101325);
  let drawing = null;
  if (found.stand) drawing = new StandIcon(canvas, some_stand, [of_one(0.2), of_one(0.03)], units);
  else if (found.scene) drawing = new MachineIcon(canvas, found.scene, await read_samples(found.samples, found.data), units, 0);
  return ['light', 'dark'].map((name) => {
    if (!drawing) return `data:image/svg+xml;charset=utf-8,${encodeURIComponent(curve)}`;
    drawing.theme = theme_of(name);
    drawing.draw(0);
    return canvas.toDataURL();
  });
}
