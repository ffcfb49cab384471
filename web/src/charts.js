// Charts of one quantity over another. uPlot draws the axes; the curves are drawn here, since their x
// values need not increase.
import uPlot from 'uplot';
import { chart_picture } from './chart_picture.js';
import { band_opacity, band_path, mark_path, point_path, sample_of } from './chart_shapes.js';
import { pressure_color } from './colors.js';
import { Enlarged } from './enlarged.js';
import { menu_button } from './menu.js';
import { between } from './samples.js';
import { save_entries } from './saving.js';
import { number, tick_text } from './units.js';
import { element } from './page.js';

const usual_height = 270;
const paper_width = 330;  // half of A4 and of Letter, between their margins [px]
const near = 24;  // largest distance of the cursor to a point that it selects [px]

// Returns a list of numbers of the program, null as NaN, or the values of a column.
const numbers_of = (source, columns) =>
  Array.isArray(source) ? Float64Array.from(source, (v) => v ?? NaN) : columns[source].values;

// Styles of secondary curves, and the share of the main curves' span by which each may widen an axis. An
// outlier or a law that fits badly would otherwise compress the main curves.
const secondary = { band: 0.2, 'other line': 0.1, 'left out': 0.35 };

function ends_of(curves, keys) {
  let low = Infinity, high = -Infinity;
  for (const c of curves)
    for (const key of keys)
      for (const v of c[key] ?? []) {
        if (v < low) low = v;
        if (v > high) high = v;
      }
  return [low, high];
}

function range_of(curves, which) {
  const keys = which === 'y' ? ['y', 'y_high'] : ['x'];
  let [low, high] = ends_of(curves.filter((c) => !(c.style in secondary)), keys);
  if (!(low <= high)) [low, high] = ends_of(curves, keys);
  if (!(low <= high)) return [0, 1];
  const whole = high - low, inner = [low, high];
  for (const [style, share] of Object.entries(secondary)) {
    const [least, most] = ends_of(curves.filter((c) => c.style === style), keys);
    if (!(least <= most)) continue;
    low = Math.min(low, Math.max(least, inner[0] - share * whole));
    high = Math.max(high, Math.min(most, inner[1] + share * whole));
  }
  const room = high > low ? 0.05 * (high - low) : Math.max(1e-9, 0.1 * Math.abs(high));
  return [low - room, high + room];
}

class Chart {
  constructor(spec, columns, charts) {
    Object.assign(this, { spec, columns, charts });
    this.shown = new Set(spec.curves.filter((c) => !c.hidden).map((c) => c.label));
    this.time = null;
    this.most = Math.max(0, ...spec.curves.filter((c) => !(c.style in secondary)).map((c) => c.color));
    this.title = element('h3', {});
    this.value = element('span', { class: 'value', 'aria-live': 'off' });
    this.lines = element('div', { class: 'lines' });
    this.others = element('div', { class: 'lines others' });
    this.box = element('div', { class: 'box' });
    this.set_height(usual_height);
    this.root = element('article', { class: 'chart' },
      element('header', {}, this.title, this.lines, this.tools()), this.box,
      element('p', { class: 'hint' }, this.value, spec.note), this.others);
    this.value.hidden = true;
    this.keys();
  }

  set_height(pixels) {
    this.height = pixels;
    this.box.style.height = `${pixels}px`;
  }

  resize() {
    this.plot.setSize({ width: this.box.clientWidth || 480, height: this.height });
  }

  tools() {
    const { enlarged, name } = this.charts;
    const more = menu_button('⋯', 'Chart menu', () => save_entries(name, () => this.spec.title, () => chart_picture(this)));
    return element('div', { class: 'panel-tools' }, enlarged.button_of(this), more);
  }

  // Returns one curve per name for the legend; an empty list if there are fewer than two names.
  named() {
    const order = { points: 0, 'held out': 1, line: 2, band: 3, 'left out': 4, 'other line': 5 };
    const named = [...new Map(this.spec.curves.map((c) => [c.label, c])).values()].filter((c) => c.label)
      .sort((a, b) => order[a.style] - order[b.style] || (a.style === 'band' ? a.label.localeCompare(b.label) : 0));
    return named.length < 2 ? [] : named;
  }

  keys() {
    const named = this.named();
    if (!named.length) return;
    this.buttons = named.map((c) => {
      const kind = c.style in secondary || (c.style === 'points' && c.mark) ? 'drawn' : c.style === 'line' ? 'full' : c.style === 'points' ? 'dots' : 'rings';
      const pressed = String(this.shown.has(c.label));
      const mark = element('span', { class: 'mark' });
      if (kind === 'drawn') mark.innerHTML = sample_of(c);
      const button = element('button', { type: 'button', class: `line ${kind}${c.bold ? ' bold' : ''}`, 'aria-pressed': pressed },
        mark, element('span', {}, c.label));
      button.addEventListener('click', () => this.toggle(c.label, button));
      return { button, curve: c };
    });
    const is_other = (b) => b.curve.style === 'other line', others = this.buttons.filter(is_other);
    this.lines.append(...this.buttons.filter((b) => !is_other(b)).map((b) => b.button));
    if (others.length) this.others.append(element('span', { class: 'quiet' }, 'other laws'), ...others.map((b) => b.button));
  }

  // Returns whether the curves of a name have several colors.
  has_several_colors(label) {
    return new Set(this.spec.curves.filter((c) => c.label === label).map((c) => c.color)).size > 1;
  }

  // Returns the color of a curve; null if the curve has no color of its own.
  color_of(curve, palette = this.charts.palette, dark = this.charts.dark) {
    if (curve.style === 'held out') return null;
    if (curve.style in secondary) return palette[curve.color % palette.length];
    return this.color(curve.color, palette, dark);
  }

  toggle(label, button) {
    const on = !this.shown.delete(label);
    if (on) this.shown.add(label);
    button.setAttribute('aria-pressed', String(on));
    this.plot?.redraw(false);
  }

  // Returns a color of the palette, or of a continuous scale if there are more curves than palette colors.
  color(place, palette = this.charts.palette, dark = this.charts.dark) {
    if (this.most < palette.length) return palette[place];
    const share = place / this.most;
    return pressure_color(dark ? 0.4 + 0.6 * share : 0.64 * share);
  }

  // Converts all curves into the page's units.
  convert() {
    const { units } = this.charts, { x, y } = this.spec;
    const all = (values, unit) => Float64Array.from(values, (v) => units.convert(v, unit));
    this.curves = this.spec.curves.map((c) => ({
      ...c,
      x: all(numbers_of(c.x, this.columns), x.unit),
      y: all(numbers_of(c.y, this.columns), y.unit),
      ...(c.y_high && { y_high: all(numbers_of(c.y_high), y.unit) }),
    }));
    this.whole = { x: range_of(this.curves, 'x'), y: range_of(this.curves, 'y') };
    this.clamp_left_out_marks();
    this.view = this.whole;
  }

  // Moves marks of left-out points that are beyond the axes to the ends of the axes. Their true values are
  // kept for the readout.
  clamp_left_out_marks() {
    for (const c of this.curves) {
      if (c.style !== 'left out') continue;
      for (const key of ['x', 'y']) {
        const [low, high] = this.whole[key], edge = 0.02 * (high - low);
        c[`true_${key}`] = c[key];
        c[key] = c[key].map((v) => Math.min(high - edge, Math.max(low + edge, v)));
      }
    }
  }

  // "length [mm]"
  axis_name(axis) {
    const unit = this.charts.units.of(axis.unit).label;
    return unit ? `${axis.label} [${unit}]` : axis.label;
  }

  build(width = this.box.clientWidth || 480) {
    this.plot?.destroy();
    const { theme } = this.charts, { x, y } = this.spec;
    this.convert();
    const axis = { stroke: theme.ink, grid: { stroke: theme.grid, width: 1 }, ticks: { show: false },
                   font: theme.font, labelFont: theme.font, labelSize: 18, gap: 4,
                   values: (u, ticks) => ticks.map(tick_text) };
    this.title.textContent = this.spec.title;
    this.buttons?.forEach((b) => b.button.style.setProperty('--line', b.curve.bold && this.has_several_colors(b.curve.label) ? theme.strong : this.color_of(b.curve) ?? theme.ink));
    this.plot = new uPlot({
      width, height: this.height,
      legend: { show: false },
      padding: [8, 14, 0, 0],
      cursor: { y: false, x: false, points: { show: false }, drag: { x: true, y: true, setScale: false, dist: 5 } },
      scales: { x: { time: false, range: () => this.view.x }, y: { range: () => this.view.y } },
      axes: [{ ...axis, label: this.axis_name(x), size: 26 }, { ...axis, label: this.axis_name(y), size: 52, space: 32 }],
      series: [{}, { show: true, stroke: 'transparent', points: { show: false } }],
      hooks: {
        draw: [(u) => this.draw(u)],
        setSelect: [(u) => this.zoom(u)],
        setCursor: [(u) => this.hover(u)],
      },
    }, [this.whole.x, this.whole.y], this.box);
    this.plot.over.addEventListener('dblclick', () => this.set_view(this.whole));
    this.plot.over.addEventListener('mouseleave', () => this.point_out(null));
    this.mark = element('div', { class: 'found', hidden: '' });
    this.plot.over.append(this.mark);
  }

  zoom(u) {
    const { left, top, width, height: tall } = u.select;
    u.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
    if (width < 4 || tall < 4) return;
    this.set_view({ x: [u.posToVal(left, 'x'), u.posToVal(left + width, 'x')],
                    y: [u.posToVal(top + tall, 'y'), u.posToVal(top, 'y')] });
  }

  set_view(view) {
    this.view = view;
    this.plot.setData([view.x, view.y]);
  }

  // --- curves ---

  draw(u) {
    const { ctx, bbox } = u, ratio = devicePixelRatio || 1;
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    const at = { x: (v) => u.valToPos(v, 'x', true), y: (v) => u.valToPos(v, 'y', true) };
    this.draw_bands(ctx, at);
    for (const kind of ['left out', 'line', 'other line', 'points', 'held out'])
      for (const c of this.curves)
        if (c.style === kind && this.shown.has(c.label)) this.draw_curve(ctx, c, at, ratio);
    this.draw_now(ctx, at, ratio);
    ctx.restore();
  }

  // Fills the bands of one name as one area, so that overlaps are not darker.
  draw_bands(ctx, at) {
    for (const [label, path] of this.bands(at.x, at.y)) {
      ctx.save();
      ctx.fillStyle = this.color_of(this.curves.find((c) => c.label === label));
      ctx.globalAlpha = band_opacity(label);
      ctx.fill(new Path2D(path));
      ctx.restore();
    }
  }

  // Returns the paths of the bands by name.
  bands(at_x, at_y) {
    const out = new Map();
    for (const c of this.curves)
      if (c.style === 'band' && this.shown.has(c.label)) out.set(c.label, (out.get(c.label) ?? '') + band_path(c, at_x, at_y));
    return out;
  }

  draw_curve(ctx, c, at, ratio) {
    const { theme } = this.charts;
    ctx.strokeStyle = ctx.fillStyle = this.color_of(c) ?? this.color(c.color);
    ctx.lineWidth = (c.bold ? 2.2 : 1.5) * ratio;
    ctx.lineJoin = 'round';
    if (c.style === 'line' || c.style === 'other line') return stroke_line(ctx, c, at);
    if (c.style === 'left out') return stroke_marks(ctx, c, at, ratio);
    const many = c.x.length > 400, r = (many ? 1.7 : 2.9) * ratio;
    ctx.lineWidth = 1.3 * ratio;
    for (let i = 0; i < c.x.length; ++i) {
      if (!Number.isFinite(c.y[i])) continue;
      const point = new Path2D(point_path(c, at.x(c.x[i]), at.y(c.y[i]), r));
      if (c.style === 'points') ctx.fill(point);
      else {
        ctx.save();
        ctx.fillStyle = theme.paper;
        ctx.fill(point);
        ctx.restore();
        ctx.stroke(point);
      }
    }
  }

  // Draws a dot at the current time of the replay; with several runs, in each run's color.
  draw_now(ctx, at, ratio) {
    if (this.time === null) return;
    const { units } = this.charts, { x, y, curves } = this.spec;
    for (const c of curves) {
      if (Array.isArray(c.x) || !this.shown.has(c.label)) continue;
      const px = at.x(units.convert(between(this.columns[c.x], this.time), x.unit));
      const py = at.y(units.convert(between(this.columns[c.y], this.time), y.unit));
      ctx.beginPath();
      ctx.arc(px, py, 5 * ratio, 0, 2 * Math.PI);
      ctx.fillStyle = c.run === undefined ? this.charts.theme.strong : this.color(c.color);
      ctx.fill();
    }
  }

  set_time(t) {
    if (!this.spec.curves.some((c) => !Array.isArray(c.x))) return;
    this.time = t;
    if (this.plot && this.visible !== false) this.plot.redraw(false);
  }

  // --- values ---

  hover(u) {
    const { left, top } = u.cursor;
    if (left < 0) return this.point_out(null);
    let best = null, least = near * near;
    for (const c of this.curves) {
      if (!this.shown.has(c.label) || c.style === 'band') continue;
      for (let i = 0; i < c.x.length; ++i) {
        const dx = u.valToPos(c.x[i], 'x') - left, dy = u.valToPos(c.y[i], 'y') - top;
        const away = dx * dx + dy * dy;
        if (away < least) least = away, best = { c, i };
      }
    }
    this.point_out(best);
  }

  point_out(found) {
    this.mark.hidden = this.value.hidden = !found;
    if (!found) return;
    const { c, i } = found, { units } = this.charts, { x, y } = this.spec;
    const words = (v, unit) => `${number(v)} ${units.of(unit).label}`.trim();
    this.value.textContent = `${c.label ? c.label + ': ' : ''}${words((c.true_y ?? c.y)[i], y.unit)} at ${words((c.true_x ?? c.x)[i], x.unit)}`;
    this.mark.style.transform =
      `translate(${this.plot.valToPos(c.x[i], 'x')}px, ${this.plot.valToPos(c.y[i], 'y')}px)`;
  }
}

function stroke_line(ctx, c, at) {
  ctx.setLineDash((c.dash ?? []).map((d) => d * (devicePixelRatio || 1)));
  ctx.beginPath();
  let drawing = false;
  for (let i = 0; i < c.x.length; ++i) {
    const x = at.x(c.x[i]), y = at.y(c.y[i]);
    if (!Number.isFinite(y)) { drawing = false; continue; }
    drawing ? ctx.lineTo(x, y) : ctx.moveTo(x, y);
    drawing = true;
  }
  ctx.stroke();
  ctx.setLineDash([]);
}

function stroke_marks(ctx, c, at, ratio) {
  const many = c.x.length > 60;
  ctx.lineWidth = (many ? 0.9 : 1.6) * ratio;
  for (let i = 0; i < c.x.length; ++i)
    if (Number.isFinite(c.y[i])) ctx.stroke(new Path2D(mark_path(c.mark ?? 0, at.x(c.x[i]), at.y(c.y[i]), (many ? 2.4 : 4) * ratio)));
}

// All charts of a page in a grid.
export class Charts {
  // `name`: first part of the file names of saved pictures.
  constructor(root, specs, columns, units, name) {
    Object.assign(this, { root, units, name });
    this.enlarged = new Enlarged();
    this.read_theme();
    this.list = specs.map((spec) => new Chart(spec, columns, this));
    root.append(element('div', { class: 'charts' }, ...this.list.map((c) => c.root)));
    for (const c of this.list) c.build();
    new ResizeObserver(() => this.resize()).observe(root);
  }

  read_theme() {
    const css = getComputedStyle(document.documentElement);
    const get = (name) => css.getPropertyValue(`--${name}`).trim();
    this.palette = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => get(`line-${i}`));
    this.dark = css.colorScheme === 'dark';
    this.theme = { ink: get('quiet'), strong: get('ink'), grid: get('grid'), paper: get('paper'),
                  font: `11px ${get('sans')}` };
  }

  resize() {
    for (const c of this.list) c.resize();
  }

  // Draws all charts again, after units or colors have changed.
  rebuild() {
    this.read_theme();
    for (const c of this.list) c.build(this.printing ? paper_width : undefined);
  }

  // Selects the width of the next rebuild(): paper (true) or screen (false).
  print(begins) {
    this.printing = begins;
  }

  set_time(t) {
    for (const c of this.list) c.set_time(t);
  }
}
