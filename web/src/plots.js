// Plots below each other, with a common time axis and cursor.
import { Panel } from './panel.js';
import { page_theme } from './theme.js';

export class Plots {
  // `run` as the program writes it; `on_seek(t)` is called when the reader clicks at a time.
  constructor(root, run, columns, units, on_seek) {
    Object.assign(this, { root, run, units, seek: on_seek });
    this.view = this.whole = [run.start ?? 0, run.duration || 1];
    this.time = 0;
    this.hovered = null;
    this.theme = page_theme();
    this.columns = columns;
    this.groups_shown = new Map();
    this.panels = run.panels.map((spec) => new Panel(spec, columns, this));
    root.append(...this.panels.map((p) => p.root));
    this.watch();
  }

  // Adds a plot of the reader before all others.
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

  // Puts the plots into this order.
  put_in_order(panels) {
    if (panels.every((p, i) => p === this.panels[i])) return;
    this.panels = panels;
    this.root.append(...panels.map((p) => p.root));
  }

  // Draws only plots that are in the window or near it.
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

  // Shades stance phases, and injected faults between two edges. `px`: size of a pixel.
  draw_behind(ctx, frame, theme, px) {
    // Fills a stretch of time, at least `least` wide.
    const fill = ({ from, to }, least) => {
      if (to < this.view[0] || from > this.view[1]) return;
      const left = Math.max(frame.left, frame.x(from)), right = Math.min(frame.right, frame.x(to));
      ctx.fillRect(left, frame.top, Math.max(least, right - left), frame.bottom - frame.top);
    };
    ctx.fillStyle = theme.stance;
    for (const s of this.run.phases.stretches) if (s.stance) fill(s, 0);
    for (const f of this.run.faults ?? []) {
      ctx.fillStyle = theme.fault;
      fill(f, px);
      ctx.fillStyle = theme.bad;
      for (const t of [f.from, f.to])
        if (t >= this.view[0] && t <= this.view[1]) ctx.fillRect(frame.x(t) - px / 2, frame.top, px, frame.bottom - frame.top);
    }
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
    if (!u.cursor.event && u.cursor.left >= 0) return;  // synchronised by another plot
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

  // Moves the view by a page when the time of the replay leaves it.
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

  // Draws all plots again, after units or colors have changed.
  rebuild() {
    this.theme = page_theme();
    for (const p of this.panels) {
      p.name_units();
      p.stale = true;
      if (p.visible) p.build();
      else if (p.plot) p.plot.destroy(), (p.plot = null);
    }
    this.show_values();
  }

  // Prepares the next rebuild() for printing (true) or for the screen (false).
  print(begins) {
    this.printing = begins;
    for (const p of this.panels) if (begins) p.visible = !p.root.hidden;
  }

  show_group(group, shown) {
    this.groups_shown.set(group, shown);
    this.arrange();
  }

  // Shows the plots whose group is shown and that are neither hidden by the reader nor empty.
  arrange() {
    for (const p of this.panels)
      p.root.hidden = !(this.groups_shown.get(p.spec.group) ?? true) || Boolean(p.away) || p.is_empty();
  }
}
