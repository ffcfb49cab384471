// The plots under each other: one uPlot per panel, one time axis and one cursor for all.
import uPlot from 'uplot';
import { bucket_size, level_for, pyramid } from './pyramid.js';
import { held, index_at } from './samples.js';
import { number } from './units.js';
import { element } from './page.js';

const axis_width = 58;
const height = 132;
const paper_width = 680;  // of A4 and of Letter, between their margins [px]

// The lines' columns on one clock: their own, or where they have several, all times of all.
function on_one_clock(columns) {
  const time = columns[0].time;
  if (columns.every((c) => c.time === time)) return { time, values: columns.map((c) => c.values) };
  const all = Float64Array.from(new Set(columns.flatMap((c) => [...c.time]))).sort();
  return { time: all, values: columns.map((c) => Float32Array.from(all, (t) => held(c, t))) };
}

class Panel {
  constructor(spec, columns, plots) {
    this.spec = spec;
    this.plots = plots;
    this.columns = spec.lines.map((line) => columns[line.column]);
    this.data = on_one_clock(this.columns);
    this.shown = spec.lines.map((line) => line.style !== 'hidden');
    this.levels = spec.lines.map(() => null);  // made when they are first needed
    this.visible = false;
    this.stale = true;
    this.build_frame();
  }

  build_frame() {
    this.root = element('article', { class: 'panel', 'data-group': this.spec.group });
    this.title = element('h3', {});
    this.readouts = this.spec.lines.map((line, i) => this.readout(line, i));
    this.root.append(
      element('header', {}, this.title, element('div', { class: 'lines' }, ...this.readouts.map((r) => r.button))),
      (this.box = element('div', { class: 'box' })),
    );
    this.box.style.height = `${height}px`;
    this.name_units();
  }

  readout(line, i) {
    const value = element('span', { class: 'value' });
    const button = element(
      'button',
      { type: 'button', class: `line ${line.style}`, 'aria-pressed': String(this.shown[i]), title: line.topic },
      element('span', { class: 'mark' }), element('span', {}, line.label), value,
    );
    button.addEventListener('click', () => this.toggle(i));
    return { button, value };
  }

  toggle(i) {
    this.shown[i] = !this.shown[i];
    this.readouts[i].button.setAttribute('aria-pressed', String(this.shown[i]));
    this.plot?.setSeries(i + 1, { show: this.shown[i] });
    this.refresh();
    this.show_values(this.plots.shown_time());
  }

  name_units() {
    const label = this.plots.units.of(this.spec.unit).label;
    this.title.replaceChildren(this.spec.title, element('span', { class: 'unit' }, label));
  }

  // --- the plot ---

  build() {
    this.plot?.destroy();
    const color = (i) => this.plots.palette[this.spec.lines[i].color % this.plots.palette.length];
    this.readouts.forEach((r, i) => r.button.style.setProperty('--line', color(i)));
    const series = this.spec.lines.map((line, i) => ({
      label: line.label,
      stroke: color(i),
      width: line.style === 'full' ? 1.5 : 1.25,
      dash: line.style === 'dashed' ? [6, 4] : undefined,
      show: this.shown[i],
      points: { show: false },
    }));
    this.plot = new uPlot(this.options(series), null, this.box);
    this.head = element('div', { class: 'playhead' });
    this.plot.over.append(this.head);
    this.listen();
    this.refresh();
  }

  options(series) {
    const { ink, grid, font } = this.plots.look;
    const axis = { stroke: ink, grid: { stroke: grid, width: 1 }, ticks: { show: false }, font, gap: 4 };
    return {
      width: this.plots.printing ? paper_width : this.box.clientWidth || 600,
      height,
      legend: { show: false },
      padding: [6, 14, 0, 0],
      cursor: {
        sync: { key: 'run', setSeries: false, scales: ['x', null] },
        drag: { x: true, y: false, setScale: false, dist: 5 },
        points: { size: 6 },
        y: false,
      },
      scales: {
        x: { time: false, range: () => this.plots.view },
        y: { range: (u, low, high) => padded(low, high) },
      },
      axes: [
        { ...axis, size: 22, values: (u, ticks) => ticks.map((t) => `${+t.toFixed(6)} s`) },
        { ...axis, size: axis_width, space: 26, values: (u, ticks) => ticks.map(tick_text) },
      ],
      series: [{}, ...series],
      hooks: {
        drawClear: [(u) => this.plots.draw_phases(u)],
        setSelect: [(u) => this.zoom_to(u)],
        setCursor: [(u) => this.plots.hover(u)],
      },
    };
  }

  zoom_to(u) {
    const { left, width } = u.select;
    if (width > 0) this.plots.zoom(u.posToVal(left, 'x'), u.posToVal(left + width, 'x'));
    u.setSelect({ left: 0, width: 0, top: 0, height: 0 }, false);
  }

  // A click goes there; what ends a drag is none.
  listen() {
    const over = this.plot.over;
    let from = null;
    over.addEventListener('mousedown', (e) => (from = e.clientX));
    over.addEventListener('click', (e) => {
      if (from === null || Math.abs(e.clientX - from) > 4) return;
      this.plots.seek(this.plot.posToVal(e.clientX - over.getBoundingClientRect().left, 'x'));
    });
    over.addEventListener('dblclick', () => this.plots.zoom_all());
  }

  resize() {
    if (this.plot && this.box.clientWidth) this.plot.setSize({ width: this.box.clientWidth, height });
    this.refresh();
  }

  // --- what is drawn ---

  refresh() {
    this.stale = true;
    if (!this.visible) return;
    if (!this.plot) return this.build();
    this.stale = false;
    this.plot.setData(this.slice(), true);
    this.place(this.plots.time);
  }

  // Samples in view and one on either side: all of them, or the least and greatest per pixel.
  slice() {
    const { time, values } = this.data;
    const [from, to] = this.plots.view;
    const first = Math.max(0, index_at(time, from));
    const last = Math.min(time.length, index_at(time, to) + 2);
    const pixels = Math.max(200, this.box.clientWidth - axis_width);
    const level = level_for(last - first, pixels, this.pyramid_of(0).length);
    return level < 0 ? this.all(time, values, first, last) : this.buckets(time, first, last, level);
  }

  pyramid_of(i) {
    return (this.levels[i] ??= pyramid(this.data.values[i]));
  }

  all(time, values, first, last) {
    const out = [time.subarray(first, last)];
    const { scale, offset } = this.plots.units.of(this.spec.unit);
    for (const column of values) {
      const line = new Array(last - first);
      for (let i = first; i < last; ++i) {
        const v = column[i];
        line[i - first] = v === v ? (v + offset) * scale : null;
      }
      out.push(line);
    }
    return out;
  }

  buckets(time, first, last, level) {
    const size = bucket_size(level);
    const from = Math.floor(first / size), to = Math.ceil(last / size);
    const x = new Float64Array(2 * (to - from));
    for (let b = from; b < to; ++b) {
      x[2 * (b - from)] = time[b * size];
      x[2 * (b - from) + 1] = time[Math.min(time.length - 1, b * size + size / 2)];
    }
    const { scale, offset } = this.plots.units.of(this.spec.unit);
    const out = [x];
    for (let i = 0; i < this.columns.length; ++i) {
      const { low, high, first_low } = this.pyramid_of(i)[level];
      const line = new Array(x.length);
      for (let b = from; b < to; ++b) {
        const a = first_low[b] ? low[b] : high[b], c = first_low[b] ? high[b] : low[b];
        line[2 * (b - from)] = a === a ? (a + offset) * scale : null;
        line[2 * (b - from) + 1] = c === c ? (c + offset) * scale : null;
      }
      out.push(line);
    }
    return out;
  }

  place(t) {
    if (!this.plot || !this.visible) return;
    const x = this.plot.valToPos(t, 'x');
    const inside = x >= 0 && x <= this.plot.over.clientWidth;
    this.head.style.display = inside ? '' : 'none';
    if (inside) this.head.style.transform = `translateX(${x.toFixed(2)}px)`;
  }

  show_values(t) {
    if (!this.visible) return;
    this.readouts.forEach((r, i) => {
      r.value.textContent = this.shown[i]
        ? number(this.plots.units.convert(held(this.columns[i], t), this.spec.unit)) : '';
    });
  }
}

function padded(low, high) {
  if (low === null || !Number.isFinite(low)) return [0, 1];
  const room = high > low ? 0.06 * (high - low) : Math.max(1e-6, 0.1 * Math.abs(high));
  return [low - room, high + room];
}

function tick_text(v) {
  const size = Math.abs(v);
  if (size !== 0 && (size < 1e-3 || size >= 1e5)) return v.toExponential(1).replace('-', '−');
  return String(+v.toPrecision(6)).replace('-', '−');
}

export class Plots {
  // `run` as the program writes it; `on_seek` is told where a person wants to go.
  constructor(root, run, columns, units, on_seek) {
    Object.assign(this, { root, run, units, seek: on_seek });
    this.view = this.whole = [0, run.duration || 1];
    this.time = 0;
    this.hovered = null;
    this.read_look();
    this.panels = run.panels.map((spec) => new Panel(spec, columns, this));
    root.append(...this.panels.map((p) => p.root));
    this.watch();
  }

  read_look() {
    const css = getComputedStyle(document.documentElement);
    const get = (name) => css.getPropertyValue(name).trim();
    this.palette = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => get(`--line-${i}`));
    this.look = { ink: get('--quiet'), grid: get('--grid'), stance: get('--stance'),
                  font: `11px ${get('--sans')}` };
  }

  // Only what can be seen is drawn.
  watch() {
    const by_root = new Map(this.panels.map((p) => [p.root, p]));
    this.observer = new IntersectionObserver((entries) => {
      for (const entry of entries) {
        const panel = by_root.get(entry.target);
        panel.visible = entry.isIntersecting;
        if (panel.visible && panel.stale) panel.refresh();
        if (panel.visible) panel.place(this.time), panel.show_values(this.shown_time());
      }
    }, { rootMargin: '200px' });
    for (const p of this.panels) this.observer.observe(p.root);
    new ResizeObserver(() => this.panels.forEach((p) => p.resize())).observe(this.root);
    this.root.addEventListener('mouseleave', () => this.unhover());
  }

  // Stance is shaded.
  draw_phases(u) {
    const { ctx, bbox } = u;
    ctx.save();
    ctx.fillStyle = this.look.stance;
    for (const s of this.run.phases.stretches) {
      if (!s.stance || s.to < this.view[0] || s.from > this.view[1]) continue;
      const from = Math.max(bbox.left, u.valToPos(s.from, 'x', true));
      const to = Math.min(bbox.left + bbox.width, u.valToPos(s.to, 'x', true));
      ctx.fillRect(from, bbox.top, to - from, bbox.height);
    }
    ctx.restore();
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
    const least = Math.min(2e-3, this.whole[1]);
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
    for (const p of this.panels) if (p.spec.group === group) p.root.hidden = !shown;
  }
}
