// One plot with its heading: its lines' names, which show and hide them, and their values.
import uPlot from 'uplot';
import { element } from './page.js';
import { held } from './samples.js';
import { Slices } from './slices.js';
import { number, signed, tick_text } from './units.js';

const axis_width = 58;
const height = 132;
const paper_width = 680;  // of A4 and of Letter, between their margins [px]

export class Panel {
  constructor(spec, columns, plots) {
    this.spec = spec;
    this.plots = plots;
    this.columns = spec.lines.map((line) => columns[line.column]);
    this.slices = new Slices(this.columns);
    this.shown = spec.lines.map((line) => line.style !== 'hidden');
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
    this.height = this.spec.height ?? height;
    this.box.style.height = `${this.height}px`;
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
    this.show_line(i, !this.shown[i]);
  }

  show_line(i, on) {
    this.shown[i] = on;
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
      width: line.width ?? (line.style === 'full' ? 1.5 : 1.25),
      dash: line.dash ?? (line.style === 'dashed' ? [6, 4] : undefined),
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
      height: this.height,
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
        setScale: [() => this.head && this.place(this.plots.time)],  // which comes after a zoom
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
    if (this.plot && this.box.clientWidth) this.plot.setSize({ width: this.box.clientWidth, height: this.height });
    this.refresh();
  }

  // --- what is drawn ---

  refresh() {
    this.stale = true;
    if (!this.visible) return;
    if (!this.plot) return this.build();
    this.stale = false;
    const pixels = Math.max(200, this.box.clientWidth - axis_width);
    this.plot.setData(this.slices.of(this.plots.view, pixels, this.plots.units.of(this.spec.unit)), true);
    this.place(this.plots.time);
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
      r.value.textContent = this.shown[i] ? this.value_text(i, t) : '';
    });
  }

  // And by how much it differs from another run, where the line knows that.
  value_text(i, t) {
    const { units } = this.plots, { unit, lines } = this.spec;
    if (t > lines[i].ends) return number(NaN);  // of a run that is over
    const value = number(units.convert(held(this.columns[i], t), unit));
    const { difference } = lines[i];
    return difference && value !== number(NaN) ? `${value} (${signed(held(difference, t) * units.of(unit).scale)})` : value;
  }
}

function padded(low, high) {
  if (low === null || !Number.isFinite(low)) return [0, 1];
  const room = high > low ? 0.06 * (high - low) : Math.max(1e-6, 0.1 * Math.abs(high));
  return [low - room, high + room];
}
