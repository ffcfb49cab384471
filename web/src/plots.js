// The plots under each other: one time axis and one cursor for all.
import { Panel } from './panel.js';

export class Plots {
  // `run` as the program writes it; `on_seek` is told where a person wants to go.
  constructor(root, run, columns, units, on_seek) {
    Object.assign(this, { root, run, units, seek: on_seek });
    this.view = this.whole = [run.start ?? 0, run.duration || 1];
    this.time = 0;
    this.hovered = null;
    this.read_look();
    this.columns = columns;
    this.groups_shown = new Map();
    this.panels = run.panels.map((spec) => new Panel(spec, columns, this));
    root.append(...this.panels.map((p) => p.root));
    this.watch();
  }

  // One that a person made: it comes first.
  add_panel(spec) {
    const panel = new Panel(spec, this.columns, this);
    this.panels.unshift(panel);
    this.by_root.set(panel.root, panel);
    this.root.prepend(panel.root);
    this.observer.observe(panel.root);
    return panel;
  }

  remove_panel(panel) {
    this.observer.unobserve(panel.root);
    this.by_root.delete(panel.root);
    this.panels.splice(this.panels.indexOf(panel), 1);
    panel.plot?.destroy();
    panel.root.remove();
  }

  // Puts the plots in this order.
  put_in_order(panels) {
    if (panels.every((p, i) => p === this.panels[i])) return;
    this.panels = panels;
    this.root.append(...panels.map((p) => p.root));
  }

  read_look() {
    const css = getComputedStyle(document.documentElement);
    const get = (name) => css.getPropertyValue(name).trim();
    this.palette = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => get(`--line-${i}`));
    this.look = { ink: get('--quiet'), grid: get('--grid'), stance: get('--stance'), fault: get('--fault'), edge: get('--bad'), mark: get('--mark'),
                  font: `11px ${get('--sans')}` };
  }

  // Only what can be seen is drawn.
  watch() {
    this.by_root = new Map(this.panels.map((p) => [p.root, p]));
    this.observer = new IntersectionObserver((entries) => {
      for (const entry of entries) {
        const panel = this.by_root.get(entry.target);
        if (!panel) continue;
        panel.visible = entry.isIntersecting;
        if (panel.visible && panel.stale) panel.refresh();
        if (panel.visible) panel.place(this.time), panel.show_values(this.shown_time());
      }
    }, { rootMargin: '200px' });
    for (const p of this.panels) this.observer.observe(p.root);
    new ResizeObserver(() => this.panels.forEach((p) => p.resize())).observe(this.root);
    this.root.addEventListener('mouseleave', () => this.unhover());
  }

  // Stance is shaded, and what was broken on purpose, between two edges.
  draw_phases(u) {
    const { ctx, bbox } = u, px = devicePixelRatio || 1;
    ctx.save();
    ctx.fillStyle = this.look.stance;
    for (const s of this.run.phases.stretches) if (s.stance) this.fill(u, s, 0);
    for (const f of this.run.faults ?? []) {
      ctx.fillStyle = this.look.fault;
      this.fill(u, f, px);
      ctx.fillStyle = this.look.edge;
      for (const t of [f.from, f.to])
        if (t >= this.view[0] && t <= this.view[1]) ctx.fillRect(u.valToPos(t, 'x', true) - px / 2, bbox.top, px, bbox.height);
    }
    ctx.restore();
  }

  // A stretch of time, at least so wide [px].
  fill(u, { from, to }, least) {
    const { ctx, bbox } = u;
    if (to < this.view[0] || from > this.view[1]) return;
    const left = Math.max(bbox.left, u.valToPos(from, 'x', true));
    const right = Math.min(bbox.left + bbox.width, u.valToPos(to, 'x', true));
    ctx.fillRect(left, bbox.top, Math.max(least, right - left), bbox.height);
  }

  // --- time ---

  shown_time() {
    return this.hovered ?? this.time;
  }

  set_time(t) {
    this.time = t;
    for (const p of this.panels) p.place(t);
    if (this.hovered === null) this.show_values();
  }

  hover(u) {
    if (!u.cursor.event && u.cursor.left >= 0) return;  // told by another plot
    if (u.cursor.left < 0) return;
    this.hovered = u.posToVal(u.cursor.left, 'x');
    this.show_values();
  }

  unhover() {
    this.hovered = null;
    this.show_values();
  }

  show_values() {
    const t = this.shown_time();
    this.root.classList.toggle('hovered', this.hovered !== null);
    for (const p of this.panels) p.show_values(t);
    this.on_values?.(t, this.hovered !== null);
  }

  // --- zoom ---

  zoom(from, to) {
    const least = Math.min(2e-3, this.whole[1] - this.whole[0]);
    const middle = (from + to) / 2, half = Math.max(to - from, least) / 2;
    const view = [Math.max(this.whole[0], middle - half), Math.min(this.whole[1], middle + half)];
    if (!(view[1] > view[0])) return;
    this.view = view;
    this.refresh();
    this.on_view?.(view);
  }

  zoom_by(factor) {
    const [from, to] = this.view;
    const t = this.time >= from && this.time <= to ? this.time : (from + to) / 2;
    this.zoom(t - (t - from) * factor, t + (to - t) * factor);
  }

  zoom_all() {
    this.zoom(...this.whole);
  }

  // A playing run stays in view: the view turns its page.
  keep_in_view(t) {
    const [from, to] = this.view;
    if (t >= from && t <= to) return;
    const span = to - from;
    const start = Math.min(Math.max(this.whole[0], t - 0.05 * span), this.whole[1] - span);
    this.view = [start, start + span];
    this.refresh();
    this.on_view?.(this.view);
  }

  refresh() {
    for (const p of this.panels) p.refresh();
  }

  // Other units or colors.
  rebuild() {
    this.read_look();
    for (const p of this.panels) {
      p.name_units();
      p.stale = true;
      if (p.visible) p.build();
      else if (p.plot) p.plot.destroy(), (p.plot = null);
    }
    this.show_values();
  }

  // The next rebuild() is for paper, or for the screen again.
  print(begins) {
    this.printing = begins;
    for (const p of this.panels) if (begins) p.visible = !p.root.hidden;
  }

  show_group(group, shown) {
    this.groups_shown.set(group, shown);
    this.arrange();
  }

  // Which plots are there: of a group that is shown, not put away, and with something in them.
  arrange() {
    for (const p of this.panels)
      p.root.hidden = !(this.groups_shown.get(p.spec.group) ?? true) || Boolean(p.away) || p.is_empty();
  }
}
