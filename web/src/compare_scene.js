// The machines of all runs in one drawing: the first one as it is, the others as ghosts over it, each
// in its run's color. What a recording lacks is not drawn: of angles alone a ghost has links and
// muscles, without pressures or valves.
import { between } from './samples.js';
import { letter_of, palette_of_runs } from './runs.js';
import { Scene } from './scene.js';
import * as shapes from './shapes.js';
import { StandScene } from './stand.js';
import * as parts from './stand_parts.js';

const solid = 0.45;  // of a ghost

// A ghost is drawn on this before it is laid over the picture, so that its parts do not shine
// through each other.
class Veil {
  constructor() {
    this.canvas = document.createElement('canvas');
  }

  // `paint(ctx)` draws in the coordinates of `onto`.
  lay(onto, paint) {
    const { width, height } = onto.canvas;
    Object.assign(this.canvas, { width, height });
    const ctx = this.canvas.getContext('2d');
    ctx.setTransform(onto.getTransform());
    paint(ctx);
    onto.save();
    onto.setTransform(1, 0, 0, 1, 0, 0);
    onto.globalAlpha = solid;
    onto.drawImage(this.canvas, 0, 0);
    onto.restore();
  }
}

// The look of a machine in one color; edges and cords are of it, too.
const in_color = (look, color) => ({ ...look, ink: color, metal: color, 'metal-edge': color, cord: color,
                                     actual: color, ground: color, 'ground-edge': color });

class Ghost extends Scene {
  draw() {}  // the first machine's drawing calls paint()

  draw_muscle(ctx, view, m, t) {
    const length = between(this.column(m.length), t), diameter = between(this.column(m.diameter), t);
    if (Number.isFinite(length)) shapes.muscle(ctx, view, m, { length, diameter, color: this.color }, this.look);
  }

  color_of() {
    return this.color;
  }

  is_open() {
    return false;
  }

  // `base`: where the first machine's body is, with which this one's is aligned; null: where it is itself.
  paint(ctx, view, t, base, color) {
    this.color = color;
    this.read_look();
    this.look = in_color(this.look, color);
    const own = this.pose(0, t);
    ctx.save();
    if (base) ctx.translate(base.x - own.x, base.y - own.y);
    this.draw_trails(ctx, view, t);
    this.draw_machine(ctx, view, t);
    ctx.restore();
  }

  // Where its foot was; where it was to be says the first machine's drawing.
  draw_trails(ctx, view, t) {
    for (const foot of this.spec.feet ?? []) this.draw_path(ctx, view, t, { ...foot, desired: null });
  }
}

class GhostStand extends StandScene {
  draw() {}

  // It stands in the first stand's place.
  paint(ctx, v, t, color) {
    const state = { ...this.state(t), color, inlet: false, exhaust: false };
    if (!Number.isFinite(state.length)) return;
    const look = in_color(this.look, color);
    if (this.spec.bore > 0) parts.cylinder(ctx, v, this.spec, state, look);
    else parts.actuators(ctx, v, this.spec, state, look);
    parts.load_cell(ctx, v, state.length, '', look);
  }
}

// A drawing with ghosts over it. `ghosts_at(t)`: those that there is something of then.
class Machine extends Scene {
  draw_machine(ctx, view, t) {
    if (!this.hidden) super.draw_machine(ctx, view, t);
    const base = this.follow ? this.pose(0, t) : null;
    for (const { scene, color } of this.ghosts_at?.(t) ?? [])
      this.veil.lay(ctx, (on) => scene.paint(on, view, t, base, color));
  }

  draw_force(ctx, view, t) {
    if (!this.hidden) super.draw_force(ctx, view, t);
  }
}

class Stand extends StandScene {
  draw(t) {
    super.draw(t);
    const { canvas } = this;
    if (!canvas.clientWidth || !canvas.clientHeight) return;
    const ctx = canvas.getContext('2d'), v = this.place(canvas.clientWidth, canvas.clientHeight);
    for (const { scene, color } of this.ghosts_at?.(t) ?? [])
      this.veil.lay(ctx, (on) => scene.paint(on, v, t, color));
  }
}

const union = (a, b) => [Math.min(a[0], b[0]), Math.max(a[1], b[1])];

export class Machines {
  // `shown`: which runs are, as the page has it. Nothing is drawn where no run says how it stood.
  constructor(canvas, runs, columns, units, shown) {
    Object.assign(this, { runs, shown });
    const kind = runs.find((r) => r.scene || r.stand)?.scene ? 'scene' : 'stand';
    this.drawn = runs.flatMap((run, i) => (run[kind] ? [i] : []));
    this.there = this.drawn.length > 0;
    if (!this.there) return;
    const made = (Of, run) => new Of(canvas, runs[run][kind], columns, units, runs[run].last_s);
    const [of_first, of_others] = kind === 'scene' ? [Machine, Ghost] : [Stand, GhostStand];
    this.first = made(of_first, this.drawn[0]);
    this.ghosts = this.drawn.slice(1).map((run) => ({ run, scene: made(of_others, run) }));
    this.first.veil = new Veil();
    this.first.ghosts_at = (t) => this.at(t);
    if (kind === 'scene') this.widen();
  }

  // To hold the ghosts as well.
  widen() {
    const { box } = this.first;
    for (const { scene } of this.ghosts) {
      box.own.x = union(box.own.x, scene.box.own.x);
      box.own.y = union(box.own.y, scene.box.own.y);
      box.wide.x = union(box.wide.x, scene.box.wide.x);
    }
  }

  at(t) {
    const palette = palette_of_runs(), exact = 1e-6;
    return this.ghosts
      .filter(({ run }) => this.shown[run] && t >= this.runs[run].first_s - exact && t <= this.runs[run].last_s + exact)
      .map(({ run, scene }) => ({ scene, color: palette[run % palette.length] }));
  }

  can_follow() {
    return this.there && Boolean(this.first.spec.track);
  }

  toggle_follow() {
    this.first.follow = !this.first.follow;
    this.first.draw(this.first.time ?? 0);
    return this.first.follow;
  }

  read_look() {
    if (!this.there) return;
    this.first.read_look();
    for (const { scene } of this.ghosts) scene.read_look();
  }

  draw(t) {
    if (!this.there) return;
    this.first.hidden = !this.shown[this.drawn[0]];
    this.first.draw(t);
  }

  note() {
    const ghosts = this.ghosts.map(({ run }) => letter_of(run)).join(', ');
    const beside = this.runs.length - this.drawn.length;
    return [`${letter_of(this.drawn[0])} as it is`, ghosts && `${ghosts} over it as ${this.ghosts.length > 1 ? 'ghosts in their colors' : 'a ghost in its color'}`,
            this.can_follow() && ghosts && 'bodies aligned while the trolley is followed',
            beside && `${beside} without angles to draw`, this.first.note()].filter(Boolean).join('; ');
  }
}
