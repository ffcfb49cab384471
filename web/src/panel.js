// One plot with its heading, which has the names of the lines, buttons that show and hide them, and
// their values.
import uPlot from 'uplot';
import { range_of, spoiling_start, upright_ticks } from './axis.js';
import { frame_of_plot, trace_line } from './frame.js';
import { button, element } from './page.js';
import { picture } from './picture.js';
import { held } from './samples.js';
import { Slices } from './slices.js';
import { number, signed, tick_text } from './units.js';

const axis_width = 58;
const height = 132;
const paper_width = 680;  // A4 and Letter without margins [px]
const scales = ['y', 'y2'];  // the left axis, and the right one for a second unit

export class Panel {
  // `spec`: title, unit, lines. A line has the index of its column in `columns`, or its own column `data`.
  // Its unit may differ from that of the plot, which then has a second axis.
  constructor(spec, columns, plots) {
    this.spec = spec;
    this.plots = plots;
    this.all = columns;
    this.visible = false;
    this.stale = true;
    this.build_frame();
    this.set_lines(spec.lines);
  }

  build_frame() {
    this.root = element('article', { class: 'panel', 'data-group': this.spec.group });
    this.title = element('h3', {});
    this.lines = element('div', { class: 'lines' });
    this.note = element('span', { class: 'note', hidden: '' });
    this.root.append(element('header', {}, this.title, this.lines), (this.box = element('div', { class: 'box' })));
    this.set_height(this.spec.height ?? height);
  }

  set_height(pixels) {
    this.height = pixels;
    this.box.style.height = `${pixels}px`;
  }

  // Replaces the lines; those that were there before stay shown or hidden.
  set_lines(lines) {
    const was = new Map((this.readouts ?? []).map((r, i) => [this.spec.lines[i].id, this.shown[i]]));
    this.spec = { ...this.spec, lines };
    this.units = [...new Set(lines.map((l) => l.unit ?? this.spec.unit))];
    if (!this.units.length) this.units = [this.spec.unit];
    this.shown = lines.map((line) => (line.id === undefined ? undefined : was.get(line.id)) ?? line.style !== 'hidden');
    this.readouts = lines.map((line, i) => this.readout(line, i));
    this.lines.replaceChildren(...this.readouts.map((r) => r.button));
    this.name_units();
    this.renew();
    if (this.plot) this.build();
    this.show_values(this.plots.shown_time());
  }

  // Prepares the data again after new samples or a change of a formula's column.
  renew() {
    this.columns = this.spec.lines.map((line) => line.data ?? this.all[line.column]);
    this.slices = new Slices(this.columns);
    this.starts = null;
    this.stale = true;
  }

  // Returns whether no line has a finite value; such a plot is not shown.
  is_empty() {
    return !this.columns.some((c) => c.values.some((v) => v === v));
  }

  readout(line, i) {
    const value = element('span', { class: 'value' });
    return { value, button: button({ class: `line ${line.style}${line.dash?.[0] <= 2 ? ' dotted' : ''}`, 'aria-pressed': String(this.shown[i]), title: line.topic }, () => this.toggle(i),
      element('span', { class: 'mark' }), element('span', {}, line.label), value) };
  }

  toggle(i) {
    this.show_line(i, !this.shown[i]);
    this.plots.on_toggle?.(this, i);
  }

  show_line(i, on) {
    this.shown[i] = on;
    this.readouts[i].button.setAttribute('aria-pressed', String(this.shown[i]));
    this.plot?.setSeries(i + 1, { show: this.shown[i] });
    this.refresh();
    this.show_values(this.plots.shown_time());
  }

  unit_of(i) {
    return this.spec.lines[i].unit ?? this.spec.unit;
  }

  name_units() {
    const labels = this.units.map((u) => this.plots.units.of(u).label);
    const words = labels.length > 1 ? labels.map((l, i) => `${l || '1'} ${i ? 'right' : 'left'}`).join(', ') : labels[0];
    this.title.replaceChildren(this.spec.title, element('span', { class: 'unit' }, words), this.note);
  }

  // --- the plot ---

  // Returns color, width and dashes of a line.
  style(i, { lines } = this.plots.theme) {
    const line = this.spec.lines[i];
    return { color: lines[line.color % lines.length], width: line.width ?? (line.style === 'full' ? 1.5 : 1.25),
             dash: line.dash ?? (line.style === 'dashed' ? [6, 4] : undefined) };
  }

  build() {
    this.plot?.destroy();
    const series = this.spec.lines.map((line, i) => {
      const { color, width, dash } = this.style(i);
      this.readouts[i].button.style.setProperty('--line', color);
      return { label: line.label, scale: scales[this.units.indexOf(this.unit_of(i))] ?? 'y', stroke: color, width, dash,
               show: this.shown[i], points: { show: false } };
    });
    this.plot = new uPlot(this.options(series), null, this.box);
    this.head = element('div', { class: 'playhead' });
    this.plot.over.append(this.head);
    this.listen();
    this.refresh();
  }

  options(series) {
    return {
      width: this.plots.printing ? paper_width : this.box.clientWidth || 600,
      height: this.height,
      legend: { show: false },
      padding: [6, this.units.length > 1 ? 4 : 14, 0, 0],
      cursor: {
        sync: { key: 'run', setSeries: false, scales: ['x', null] },
        drag: { x: true, y: false, setScale: false, dist: 5 },
        points: { size: 6 },
        y: false,
      },
      scales: {
        x: { time: false, range: () => this.plots.view },
        ...Object.fromEntries(this.units.slice(0, 2).map((unit, k) => [scales[k], { range: () => this.range(k) }])),
      },
      axes: this.axes(),
      series: [{}, ...series],
      hooks: {
        drawClear: [(u) => this.plots.draw_behind(u.ctx, frame_of_plot(u), this.plots.theme, devicePixelRatio || 1)],
        // Over the grid, under the curves.
        drawAxes: [(u) => this.plots.marks?.draw(u.ctx, frame_of_plot(u), this.plots.theme, devicePixelRatio || 1)],
        setSelect: [(u) => this.zoom_to(u)],
        setCursor: [(u) => this.plots.hover(u)],
        setScale: [() => this.head && this.place(this.plots.time)],  // called after a zoom
      },
    };
  }

  // Returns the time axis and one vertical axis per unit.
  axes() {
    const { quiet, grid, font } = this.plots.theme;
    const axis = { stroke: quiet, grid: { stroke: grid, width: 1 }, ticks: { show: false }, font, gap: 4 };
    const splits = (u, i, low, high, step) => upright_ticks(low, high, step, u.bbox.height / (devicePixelRatio || 1));
    const upright = { ...axis, size: axis_width, space: 26, splits, values: (u, ticks) => ticks.map(tick_text) };
    const right = { ...upright, scale: 'y2', side: 1, grid: { show: false } };
    return [{ ...axis, size: 22, values: (u, ticks) => ticks.map((t) => `${+t.toFixed(6)} s`) }, { ...upright, scale: 'y' },
            ...(this.units.length > 1 ? [right] : [])];
  }

  zoom_to(u) {
    const { left, width } = u.select;
    if (width > 0) this.plots.zoom(u.posToVal(left, 'x'), u.posToVal(left + width, 'x'));
    u.setSelect({ left: 0, width: 0, top: 0, height: 0 }, false);
  }

  // Moves the time to a click; the end of a drag is not a click.
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
    if (this.plot && this.box.clientWidth) this.plot.setSize({ width: this.box.clientWidth, height: this.height });
    this.refresh();
  }

  // --- the axes ---

  // Returns the range of an axis for the drawn values, in the unit shown.
  range(axis, drawn = this.drawn ?? [[]]) {
    const unit = this.units[axis], { scale } = this.plots.units.of(unit), [x, ...lines] = drawn;
    const [from, to] = this.plots.view;
    let low = Infinity, high = -Infinity;
    lines.forEach((line, i) => {
      if (!this.shown[i] || this.unit_of(i) !== unit) return;
      const start = this.start_of(i);  // earlier samples are outliers (axis.js)
      for (let k = 0; k < line.length; ++k) {
        const v = line[k];
        if (v === null || v === undefined || x[k] < from || x[k] > to || x[k] < start) continue;
        if (v < low) low = v;
        if (v > high) high = v;
      }
    });
    return range_of(low, high, unit, scale);
  }

  // Returns the time from which a line's samples are used to scale its axis.
  start_of(i) {
    this.starts ??= [];
    if (this.starts[i] === undefined) {
      const count = spoiling_start(this.columns[i], this.unit_of(i));
      this.starts[i] = count ? this.columns[i].time[count] : -Infinity;
    }
    return this.starts[i];
  }

  // Notes lines whose first samples are beyond the axis.
  note_start() {
    const [from] = this.plots.view;
    const off = this.columns.flatMap((c, i) => (this.shown[i] && this.start_of(i) > from
      ? [`${this.spec.lines[i].label} begins at ${this.plots.units.text(c.values[0], this.unit_of(i))}`] : []));
    this.note.textContent = off.length ? `off the axis: ${off.join(', ')}` : '';
    this.note.hidden = !off.length;
  }

  // --- what is drawn ---

  refresh() {
    this.stale = true;
    if (!this.visible) return;
    if (!this.plot) return this.build();
    this.stale = false;
    const pixels = Math.max(200, this.box.clientWidth - axis_width);
    this.drawn = this.slice(pixels);
    this.note_start();
    this.plot.setData(this.drawn, true);
    this.place(this.plots.time);
  }

  // Returns times and values within the view, in the units shown.
  slice(pixels) {
    return this.slices.of(this.plots.view, pixels, this.columns.map((c, i) => this.plots.units.of(this.unit_of(i))));
  }

  // Returns the picture for print of the lines that are shown, within the view.
  picture() {
    const { plots, spec, units } = this, data = this.slice(636), [x, ...lines] = data;
    const stroke = (ctx, i, theme) => {
      const { color, width, dash } = this.style(i, theme);
      ctx.strokeStyle = color;
      ctx.lineWidth = width;
      ctx.setLineDash(dash ?? []);
      ctx.stroke();
      ctx.setLineDash([]);
    };
    const shown = spec.lines.map((line, i) => i).filter((i) => this.shown[i]);
    const key = (i) => ({ label: spec.lines[i].label, draw: (ctx, at_x, at_y, theme) => {
      ctx.beginPath();
      ctx.moveTo(at_x, at_y);
      ctx.lineTo(at_x + 24, at_y);
      stroke(ctx, i, theme);
    } });
    return picture({
      title: spec.title, keys: shown.map(key), x: { span: plots.view, name: 'time [s]' },
      ys: units.slice(0, 2).map((unit, axis) => ({ span: this.range(axis, data), name: plots.units.of(unit).label })),
      behind: (ctx, frame, theme) => plots.draw_behind(ctx, frame, theme, 1),
      draw: (ctx, frame, theme) => {
        plots.marks?.draw(ctx, frame, theme, 1);
        for (const i of shown) {
          const axis = Math.max(0, units.indexOf(this.unit_of(i)));
          ctx.beginPath();
          trace_line(ctx, x, lines[i], frame.x, (v) => frame.y(v, axis));
          ctx.name = spec.lines[i].label;
          stroke(ctx, i, theme);
        }
      },
    });
  }

  place(t) {
    if (!this.plot || !this.visible) return;
    const x = this.plot.valToPos(t, 'x');
    const inside = x >= 0 && x <= this.plot.over.clientWidth;
    this.head.style.display = inside ? '' : 'none';
    if (inside) this.head.style.transform = `translateX(${x.toFixed(2)}px)`;
    this.plots.on_place?.(this);
  }

  show_values(t) {
    if (!this.visible) return;
    this.readouts.forEach((r, i) => {
      r.value.textContent = this.shown[i] ? this.value_text(i, t) : '';
    });
  }

  // Returns a line's value at t, and its difference to another run if the line has one.
  value_text(i, t) {
    const { units } = this.plots, { lines } = this.spec, unit = this.unit_of(i);
    if (t > lines[i].ends) return number(NaN);  // that run has ended
    const value = number(units.convert(held(this.columns[i], t), unit));
    const { difference } = lines[i];
    return difference && value !== number(NaN) ? `${value} (${signed(held(difference, t) * units.of(unit).scale)})` : value;
  }
}
