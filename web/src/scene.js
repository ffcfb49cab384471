// Side view of the machine. The program writes the pose of each part as a frame
// (sinew/report/page/scene.h); this file only draws them.
import { between, index_at, open_within } from './samples.js';
import { pressure_color } from './colors.js';
import * as shapes from './shapes.js';
import { page_theme } from './theme.js';

const trail_seconds = 3;
const window_seconds = 0.01;  // a valve is lit if it was open at any time within it

export class Scene {
  room = { above: 28, margin: 4 };  // space for time and button above, and around the drawing [px]

  constructor(canvas, spec, columns, units, duration) {
    Object.assign(this, { canvas, spec, columns, units, duration });
    this.follow = true;
    this.tick_step = null;  // distance of the ground's ticks, for an animation that loops [m]
    this.column = (index) => (index === null || index === undefined ? null : columns[index]);
    this.refit();
    this.read_theme();
    new ResizeObserver(() => this.draw(this.time ?? 0)).observe(canvas);
  }

  // Adapts area, pressure scale and force scale to the columns, which may have grown.
  refit() {
    this.reach = this.spec.links.reduce((total, link) => total + link.length, 0) || 0.3;
    this.box = this.bounds();
    this.pressures = this.pressure_range();
    this.force_scale = this.find_force_scale();
  }

  read_theme() {
    this.theme = page_theme();
  }

  // Returns whether the view follows the machine from now on.
  toggle_follow() {
    return (this.follow = !this.follow);
  }

  // --- extent of the drawing ---

  pose(frame, t) {
    const f = this.spec.frames[frame];
    const at = (index) => (index === null ? 0 : between(this.columns[index], t));
    return { x: at(f.x), y: at(f.y), heading: at(f.heading) };
  }

  // Returns the area that all parts cover during the run: relative to the body, and absolute.
  bounds() {
    const own = { x: [-0.3 * this.reach, 0.3 * this.reach], y: [-0.1 * this.reach, 0.15 * this.reach] };
    const wide = { x: [0, 0] };
    const widen = (range, v, room) => {
      range[0] = Math.min(range[0], v - room);
      range[1] = Math.max(range[1], v + room);
    };
    const room = 0.12 * this.reach;
    for (let i = 0; i <= 400; ++i) {
      const t = (this.duration * i) / 400, body = this.pose(0, t);
      for (const link of this.spec.links) {
        const p = this.pose(link.frame, t);
        const x = p.x + link.length * Math.cos(p.heading), y = p.y + link.length * Math.sin(p.heading);
        widen(own.x, x - body.x, room);
        widen(wide.x, x, room);
        widen(own.y, y, room);
      }
    }
    for (const m of this.spec.muscles)
      if (m.frame === 0) widen(own.y, m.anchor[1], 0.5 * room);
    const { track, surface, cylinder } = this.spec;
    if (cylinder) widen(own.y, shapes.cylinder_top(this.spec, this.reach), 0.2 * room);
    if (track) {
      widen(own.x, track.rear, room), widen(own.x, track.front, room);
      widen(own.y, track.height, room);
      widen(wide.x, track.from + track.rear, room);
      widen(wide.x, track.to + track.front, room);
    } else {
      wide.x = own.x;
    }
    if (surface !== undefined) own.y[0] = Math.min(own.y[0], surface - 0.1 * this.reach);
    return { own, wide };
  }

  pressure_range() {
    let most = this.units.atmosphere + 1e5;
    const of_cylinder = this.spec.cylinder ? [this.spec.cylinder.up, this.spec.cylinder.down] : [];
    for (const index of [...this.spec.muscles.map((m) => m.pressure), ...of_cylinder]) {
      const c = this.column(index);
      if (c) for (const v of c.values) if (v > most) most = v;
    }
    return [this.units.atmosphere, most];
  }

  has_pressure() {
    return this.spec.muscles.some((m) => m.pressure !== null);
  }

  note() {
    return `${this.spec.drawn_from}; muscles placed to fit, ${shapes.thicker} × as thick`;
  }

  legend() {
    const of = (what) => this.spec.feet?.some((foot) => foot[what]);
    return [of('path') && ['actual', 'foot'], of('desired') && ['desired', 'foot desired'],
            of('force') && ['force', 'ground reaction']].filter(Boolean);
  }

  // Returns the scale of force arrows [m/N]: the 99.5 % percentile of the forces is drawn half as long as
// the leg.
  find_force_scale() {
    const greatest = (force) => {
      const [x, y] = force.map((i) => this.columns[i].values);
      const all = Float32Array.from(x, (v, i) => Math.hypot(v, y[i])).filter(Number.isFinite).sort();
      return all[Math.floor(0.995 * (all.length - 1))];
    };
    const forces = (this.spec.feet ?? []).map((foot) => foot.force).filter(Boolean);
    const most = Math.max(0, ...forces.map(greatest).filter(Number.isFinite));
    return most > 0 ? (0.5 * this.reach) / most : 0;
  }

  // --- drawing ---

  draw(t) {
    this.time = t;
    const { canvas } = this;
    const ratio = window.devicePixelRatio || 1;
    const width = canvas.clientWidth, height = canvas.clientHeight;
    if (!width || !height) return;
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    const ctx = canvas.getContext('2d');
    ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
    ctx.clearRect(0, 0, width, height);
    const { above, margin } = this.room;
    if (height <= above + margin || width <= 2 * margin) return;  // no room for a drawing
    const view = this.place(ctx, width, height, t);
    this.draw_world(ctx, view, t);
    this.draw_paths(ctx, view, t);
    this.draw_machine(ctx, view, t);
    this.draw_force(ctx, view, t);
    ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.draw_scale(ctx, view, width, height);
  }

  draw_scale(ctx, view, width, height) {
    if (this.spec.surface !== undefined) return;  // the ticks of the ground already show the scale
    shapes.scale_bar(ctx, view, this.units, this.theme, width, height);
  }

  // Sets the transformation from meters, y up, to pixels.
  place(ctx, width, height, t) {
    const body = this.pose(0, t);
    const x = this.follow ? this.box.own.x.map((v) => v + body.x) : this.box.wide.x;
    const y = this.box.own.y;
    const { above, margin } = this.room;
    const high = height - above - margin;
    const scale = Math.min((width - 2 * margin) / (x[1] - x[0]), high / (y[1] - y[0]));
    const left = width / 2 - (scale * (x[0] + x[1])) / 2;
    // A view of the whole track is low; the free space is left above it.
    const bottom = this.follow ? above + high / 2 + (scale * (y[0] + y[1])) / 2 : height - margin + scale * y[0];
    ctx.transform(scale, 0, 0, -scale, left, bottom);
    return { scale, left: -left / scale, right: (width - left) / scale,
             bottom: (bottom - height) / scale, top: bottom / scale, px: 1 / scale };
  }

  in_frame(ctx, frame, t, paint) {
    const p = this.pose(frame, t);
    ctx.save();
    ctx.translate(p.x, p.y);
    ctx.rotate(p.heading);
    paint();
    ctx.restore();
  }

  draw_world(ctx, view) {
    const { surface, track } = this.spec;
    if (surface !== undefined) shapes.table(ctx, view, surface, this.units, this.theme, this.tick_step);
    if (track) shapes.track(ctx, view, track, this.theme, this.reach);
  }

  draw_machine(ctx, view, t) {
    const { spec, theme, reach } = this;
    const pose = this.pose(0, t);
    this.in_frame(ctx, 0, t, () => {
      if (spec.cylinder) shapes.cylinder(ctx, view, spec, this.chambers(t), theme, reach, pose);
      shapes.body(ctx, view, spec, theme, reach, pose);
    });
    for (const tendon of spec.tendons)
      this.in_frame(ctx, tendon.frame, t, () => shapes.tendon(ctx, view, tendon.from, tendon.to, theme));
    for (const link of spec.links)
      this.in_frame(ctx, link.frame, t, () => shapes.link(ctx, view, link, theme, reach));
    if (spec.discs.length)
      this.in_frame(ctx, spec.discs[0].frame, t, () => shapes.sole(ctx, view, spec.discs, theme));
    for (const disc of spec.discs)
      this.in_frame(ctx, disc.frame, t, () => shapes.disc(ctx, view, disc, theme));
    for (const cam of spec.cams)
      this.in_frame(ctx, cam.frame, t, () => shapes.cam(ctx, view, cam, theme));
    for (const link of spec.links)
      this.in_frame(ctx, link.frame, t, () => shapes.pin(ctx, view, theme, reach));
    for (const m of spec.muscles) this.in_frame(ctx, m.frame, t, () => this.draw_muscle(ctx, view, m, t));
  }

  // Returns the color of air at a column's pressure; the color of metal if the pressure is unknown.
  color_of(index, t) {
    const pressure = index === null ? NaN : between(this.column(index), t);
    const [low, high] = this.pressures;
    return Number.isFinite(pressure) ? pressure_color((pressure - low) / (high - low)) : this.theme.metal;
  }

  // Returns the color of each chamber of the cylinder, and which of its valves are open.
  chambers(t) {
    const c = this.spec.cylinder;
    const chamber = (pressure, valves) => ({
      color: this.color_of(pressure, t),
      valves: valves.map((v) => (v === null ? null : this.is_open(v, t))),
    });
    return { up: chamber(c.up, c.valves_up), down: chamber(c.down, c.valves_down) };
  }

  draw_muscle(ctx, view, m, t) {
    const length = between(this.column(m.length), t), diameter = between(this.column(m.diameter), t);
    const color = this.color_of(m.pressure, t);
    shapes.muscle(ctx, view, m, { length, diameter, color }, this.theme);
    for (const [which, at] of [['inlet', 0], ['exhaust', 1]])
      if (m[which] !== null) shapes.valve(ctx, view, m, at, this.is_open(m[which], t), this.theme, this.reach);
  }

  is_open(index, t) {
    return open_within(this.column(index), t - window_seconds, t);
  }

  // Draws the actual and the desired path of the feet; relative to the body while the trolley is followed.
  draw_paths(ctx, view, t) {
    for (const foot of this.spec.feet ?? []) this.draw_path(ctx, view, t, foot);
  }

  draw_path(ctx, view, t, foot) {
    const base = this.pose(0, t);
    for (const [path, color, dash] of [[foot.desired, this.theme.desired, [5, 4]], [foot.path, this.theme.actual, []]]) {
      if (!path) continue;
      const [x, y] = path.map((i) => this.columns[i]);
      const first = Math.max(0, index_at(x.time, t - trail_seconds)), last = index_at(x.time, t);
      const points = [];
      for (let i = first; i <= last; ++i) {
        const at = this.follow ? base : this.pose(0, x.time[i]);
        points.push([at.x + foot.at + x.values[i], at.y + y.values[i]]);
      }
      shapes.trail(ctx, view, points, color, dash);
    }
  }

  force_text(newtons) {
    const value = this.units.convert(newtons, 'N');
    return `${value.toPrecision(value < 10 ? 2 : 3).replace(/\.0$/, '')} ${this.units.of('N').label}`;
  }

  draw_force(ctx, view, t) {
    for (const foot of this.spec.feet ?? []) this.draw_force_on(ctx, view, t, foot);
  }

  draw_force_on(ctx, view, t, foot) {
    if (!foot.force || !this.force_scale || foot.contact === null) return;
    const [x, y] = foot.force.map((i) => between(this.columns[i], t));
    if (!(Math.hypot(x, y) * this.force_scale > 6 * view.px)) return;
    const from = [between(this.columns[foot.contact], t), this.spec.surface ?? 0];
    shapes.arrow(ctx, view, from, [x * this.force_scale, y * this.force_scale],
                 this.force_text(Math.hypot(x, y)), this.theme);
  }
}
