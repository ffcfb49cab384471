// Drawing of the machines of all runs: the first one in full, the others over it as translucent ghosts in
// their runs' colors. Parts without data are omitted: a recording with only angles gives links and
// muscles, but no pressures or valves.
import { between } from './samples.js';
import { letter_of } from './runs.js';
import { Scene } from './scene.js';
import * as shapes from './shapes.js';
import { StandScene } from './stand.js';
import * as parts from './stand_parts.js';

const opacity = 0.45;  // of a ghost

// Canvas on which a ghost is drawn before it is blended over the picture, so that its parts do not show
// through each other.
class GhostLayer {
  constructor() {
    this.canvas = document.createElement('canvas');
  }

  // Draws with `paint(ctx)`, in the coordinates of `onto`, and blends the result over `onto`.
  blend(onto, paint) {
    const { width, height } = onto.canvas;
    Object.assign(this.canvas, { width, height });
    const ctx = this.canvas.getContext('2d');
    ctx.setTransform(onto.getTransform());
    paint(ctx);
    onto.save();
    onto.setTransform(1, 0, 0, 1, 0, 0);
    onto.globalAlpha = opacity;
    onto.drawImage(this.canvas, 0, 0);
    onto.restore();
  }
}

// Returns the theme with all parts of a machine in one color.
const in_color = (theme, color) => ({ ...theme, ink: color, metal: color, 'metal-edge': color, tendon: color,
                                     actual: color, ground: color, 'ground-edge': color });

class Ghost extends Scene {
  draw() {}  // the drawing of the first machine calls paint()

  draw_muscle(ctx, view, m, t) {
    const length = between(this.column(m.length), t), diameter = between(this.column(m.diameter), t);
    if (Number.isFinite(length)) shapes.muscle(ctx, view, m, { length, diameter, color: this.color }, this.theme);
  }

  color_of() {
    return this.color;
  }

  is_open() {
    return false;
  }

  // `base`: position of the first machine's body, to which this one is moved; null: it is not moved.
  paint(ctx, view, t, base, color) {
    this.color = color;
    this.theme = in_color(this.theme, color);
    const own = this.pose(0, t);
    ctx.save();
    if (base) ctx.translate(base.x - own.x, base.y - own.y);
    this.draw_trails(ctx, view, t);
    this.draw_machine(ctx, view, t);
    ctx.restore();
  }

  // Draws the foot's path without the desired one, which belongs to the first machine.
  draw_trails(ctx, view, t) {
    for (const foot of this.spec.feet ?? []) this.draw_path(ctx, view, t, { ...foot, desired: null });
  }
}

class GhostStand extends StandScene {
  draw() {}

  // Draws this stand at the position of the first one.
  paint(ctx, v, t, base, color) {
    const state = { ...this.state(t), color, inlet: false, exhaust: false };
    if (!Number.isFinite(state.length)) return;
    const theme = in_color(this.theme, color);
    parts.element(ctx, v, this.spec, state, theme);
    parts.load_cell(ctx, v, state.length, '', theme);
  }
}

// Returns a drawing with ghosts over it. `ghosts_at(t)` returns those that have data at t.
const with_ghosts = (Drawing) => class extends Drawing {
  draw_machine(ctx, view, t) {
    if (!this.hidden) super.draw_machine(ctx, view, t);
    const base = this.follow && this.spec.frames ? this.pose(0, t) : null;
    for (const { scene, color } of this.ghosts_at?.(t) ?? [])
      this.ghost_layer.blend(ctx, (on) => scene.paint(on, view, t, base, color));
  }

  draw_force(ctx, view, t) {
    if (!this.hidden) super.draw_force(ctx, view, t);
  }
};

const union = (a, b) => [Math.min(a[0], b[0]), Math.max(a[1], b[1])];

export class Machines {
  // `shown`: whether each run is shown; the page changes it. Nothing is drawn if no run has poses.
  constructor(canvas, runs, columns, units, shown) {
    Object.assign(this, { runs, shown });
    const kind = runs.find((r) => r.scene || r.stand)?.scene ? 'scene' : 'stand';
    this.drawn = runs.flatMap((run, i) => (run[kind] ? [i] : []));
    this.there = this.drawn.length > 0;
    if (!this.there) return;
    const made = (Of, run) => new Of(canvas, runs[run][kind], columns, units, runs[run].last_s);
    const [of_first, of_others] = kind === 'scene' ? [with_ghosts(Scene), Ghost] : [with_ghosts(StandScene), GhostStand];
    this.first = made(of_first, this.drawn[0]);
    this.ghosts = this.drawn.slice(1).map((run) => ({ run, scene: made(of_others, run) }));
    this.first.ghost_layer = new GhostLayer();
    this.first.ghosts_at = (t) => this.at(t);
    if (kind === 'scene') this.widen();
  }

  // Enlarges the drawn area to include the ghosts.
  widen() {
    const { box } = this.first;
    for (const { scene } of this.ghosts) {
      box.own.x = union(box.own.x, scene.box.own.x);
      box.own.y = union(box.own.y, scene.box.own.y);
      box.wide.x = union(box.wide.x, scene.box.wide.x);
    }
  }

  at(t) {
    const palette = this.first.theme.lines, exact = 1e-6;
    return this.ghosts
      .filter(({ run }) => this.shown[run] && t >= this.runs[run].first_s - exact && t <= this.runs[run].last_s + exact)
      .map(({ run, scene }) => ({ scene, color: palette[run % palette.length] }));
  }

  can_follow() {
    return this.there && Boolean(this.first.spec.track);
  }

  toggle_follow() {
    return this.can_follow() && this.first.toggle_follow();
  }

  read_theme() {
    if (!this.there) return;
    this.first.read_theme();
    for (const { scene } of this.ghosts) scene.read_theme();
  }

  draw(t) {
    if (!this.there) return;
    this.first.hidden = !this.shown[this.drawn[0]];
    this.first.draw(t);
  }

  note() {
    const ghosts = this.ghosts.map(({ run }) => letter_of(run)).join(', ');
    const missing = this.runs.length - this.drawn.length;
    return [`${letter_of(this.drawn[0])} in full`, ghosts && `${ghosts} over it as ${this.ghosts.length > 1 ? 'ghosts in their colors' : 'a ghost in its color'}`,
    this.can_follow() && ghosts && 'bodies aligned while the trolley is followed',
    missing && `${missing} without angles to draw`, this.first.note()].filter(Boolean).join('; ');
  }
}
