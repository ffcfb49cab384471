// Charts of one quantity over another. uPlot draws the axes; the curves are drawn here, since their x
// values need not increase.
import uPlot from 'uplot';
import { band_opacity, draw_point, draw_sample, sample_of, trace_band, trace_mark, trace_point } from './chart_shapes.js';
import { pressure_color } from './colors.js';
import { Enlarged } from './enlarged.js';
import { frame_of_plot, trace_line } from './frame.js';
import { menu_button } from './menu.js';
import { button, element } from './page.js';
import { picture } from './picture.js';
import { between, index_at } from './samples.js';
import { save_entries } from './saving.js';
import { page_theme } from './theme.js';
import { number, tick_text } from './units.js';

const usual_height = 270, least_height = 190, most_height = 460;
const around = { across: 84, along: 52 };  // axes and space next to the curves [px]
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
    this.dots = spec.curves.map(() => element('i', { class: 'now', hidden: '' }));
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
    this.place_dots();
  }

  tools() {
    const { enlarged, name } = this.charts;
    const more = menu_button('⋯', 'Chart menu', () => save_entries(name, () => this.spec.title, () => this.picture()));
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
      const kind = c.style in secondary || c.dash || (c.style === 'points' && c.mark) ? 'drawn' : c.style === 'line' ? 'full' : c.style === 'points' ? 'dots' : 'rings';
      const pressed = String(this.shown.has(c.label));
      const mark = element('span', { class: 'mark' });
      if (kind === 'drawn') mark.innerHTML = sample_of(c);
      return { curve: c, button: button({ class: `line ${kind}${c.bold ? ' bold' : ''}`, 'aria-pressed': pressed },
        (event, own) => this.toggle(c.label, own), mark, element('span', {}, c.label)) };
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
  color_of(curve, theme = this.charts.theme) {
    if (curve.style === 'held out') return null;
    if (curve.style in secondary) return theme.lines[curve.color % theme.lines.length];
    return this.color(curve.color, theme);
  }

  toggle(label, own) {
    const on = !this.shown.delete(label);
    if (on) this.shown.add(label);
    own.setAttribute('aria-pressed', String(on));
    this.plot?.redraw(false);
    this.place_dots();
  }

  // Returns a color of the lines, or of a continuous scale if there are more curves than colors of lines.
  color(place, theme) {
    if (this.most < theme.lines.length) return theme.lines[place];
    const share = place / this.most;
    return pressure_color(theme.dark ? 0.4 + 0.6 * share : 0.64 * share);
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
      time: Array.isArray(c.x) ? null : this.columns[c.x].time,
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

  // Returns the ranges of the axes in a space of this size: with `equal` the view, extended so that both axes
  // have the same scale.
  ranges(width = (this.box.clientWidth || 480) - around.across, height = this.height - around.along) {
    const { x, y } = this.view;
    if (!this.spec.equal) return { x, y };
    const pixel = Math.max((x[1] - x[0]) / width, (y[1] - y[0]) / height);
    const about = ([low, high], half) => [(low + high) / 2 - half, (low + high) / 2 + half];
    return { x: about(x, 0.5 * pixel * width), y: about(y, 0.5 * pixel * height) };
  }

  build(width = this.box.clientWidth || 480) {
    this.plot?.destroy();
    const { theme } = this.charts, { x, y } = this.spec;
    this.convert();
    if (this.spec.equal) {
      const filled = ((width - around.across) * (this.whole.y[1] - this.whole.y[0])) / (this.whole.x[1] - this.whole.x[0]);
      this.set_height(Math.round(Math.min(most_height, Math.max(least_height, filled + around.along))));
    }
    const axis = { stroke: theme.quiet, grid: { stroke: theme.grid, width: 1 }, ticks: { show: false },
                   font: theme.font, labelFont: theme.font, labelSize: 18, gap: 4,
                   values: (u, ticks) => ticks.map(tick_text) };
    this.title.textContent = this.spec.title;
    this.buttons?.forEach((b) => b.button.style.setProperty('--line', b.curve.bold && this.has_several_colors(b.curve.label) ? theme.ink : this.color_of(b.curve) ?? theme.quiet));
    this.plot = new uPlot({
      width, height: this.height,
      legend: { show: false },
      padding: [8, 14, 0, 0],
      cursor: { y: false, x: false, points: { show: false }, drag: { x: true, y: true, setScale: false, dist: 5 } },
      scales: { x: { time: false, range: () => this.ranges().x }, y: { range: () => this.ranges().y } },
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
    this.plot.over.append(...this.dots, this.mark);
    this.place_dots();
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
    this.place_dots();
  }

  // --- curves ---

  draw(u) {
    const { ctx, bbox } = u;
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    this.draw_curves(ctx, frame_of_plot(u), this.charts.theme, devicePixelRatio || 1);
    ctx.restore();
  }

  draw_curves(ctx, frame, theme, ratio) {
    ctx.lineJoin = 'round';
    this.draw_bands(ctx, frame, theme);
    for (const kind of ['left out', 'line', 'other line', 'points', 'held out'])
      for (const c of this.curves) {
        if (c.style !== kind || !this.shown.has(c.label)) continue;
        ctx.strokeStyle = ctx.fillStyle = this.color_of(c, theme) ?? this.color(c.color, theme);
        if (kind === 'line' || kind === 'other line') this.draw_line(ctx, c, frame, ratio);
        else this.draw_points(ctx, c, frame, theme, ratio);
      }
  }

  // Fills the bands of one name as one area, so that overlaps are not darker.
  draw_bands(ctx, frame, theme) {
    const bands = this.curves.filter((c) => c.style === 'band' && this.shown.has(c.label));
    for (const label of new Set(bands.map((c) => c.label))) {
      const own = bands.filter((c) => c.label === label);
      ctx.fillStyle = this.color_of(own[0], theme);
      ctx.globalAlpha = band_opacity(label);
      ctx.beginPath();
      for (const c of own) trace_band(ctx, c, frame.x, frame.y);
      ctx.fill();
      ctx.globalAlpha = 1;
    }
  }

  draw_line(ctx, c, frame, ratio) {
    const [first, last] = this.shown_part(c);
    ctx.lineWidth = (c.width ?? (c.bold ? 2.2 : 1.5)) * ratio;
    ctx.setLineDash((c.dash ?? []).map((d) => d * ratio));
    ctx.beginPath();
    trace_line(ctx, c.x, c.y, frame.x, frame.y, first, last);
    ctx.name = c.label;
    ctx.stroke();
    ctx.setLineDash([]);
  }

  // Returns the indices between which a curve is drawn: all, or those within a span of time.
  shown_part(c) {
    if (!this.within || !c.time) return [0, c.x.length];
    return [Math.max(0, index_at(c.time, this.within[0])), index_at(c.time, this.within[1]) + 1];
  }

  draw_points(ctx, c, frame, theme, ratio) {
    const hollow = c.style === 'left out', many = c.x.length > (hollow ? 60 : 400);
    const r = (hollow ? (many ? 2.4 : 4) : many ? 1.7 : 2.9) * ratio;
    ctx.lineWidth = (many ? 0.9 : 1.6) * ratio;
    for (let i = 0; i < c.x.length; ++i) {
      if (!Number.isFinite(c.x[i]) || !Number.isFinite(c.y[i])) continue;
      ctx.beginPath();
      if (hollow) {
        trace_mark(ctx, c.mark ?? 0, frame.x(c.x[i]), frame.y(c.y[i]), r);
        ctx.stroke();
      } else {
        trace_point(ctx, c, frame.x(c.x[i]), frame.y(c.y[i]), r);
        draw_point(ctx, c, theme.paper, ratio);
      }
    }
  }

  // Returns the picture for print of the current zoom, with the curves that are shown.
  picture() {
    const { x, y } = this.spec, axis = (span, of) => ({ span, name: this.axis_name(of) });
    const spans = this.ranges(636, 320);
    const key = (c) => ({ label: c.label, draw: (ctx, at_x, at_y, theme) => draw_sample(ctx, c, at_x, at_y, 24,
      c.style === 'held out' || (c.bold && this.has_several_colors(c.label)) ? theme.quiet : this.color_of(c, theme), theme.paper) });
    return picture({ title: this.spec.title, x: axis(spans.x, x), ys: [axis(spans.y, y)],
                     keys: this.named().filter((c) => this.shown.has(c.label)).map(key),
                     draw: (ctx, frame, theme) => this.draw_curves(ctx, frame, theme, 1) });
  }

  // --- time ---

  set_time(t) {
    this.time = t;
    this.place_dots();
  }

  // Draws only the samples within a span of time.
  set_within(view) {
    this.within = view;
    this.plot.redraw(false);
  }

  // Puts a dot at the current time of the replay on each curve of two channels; with several runs, in each
  // run's color.
  place_dots() {
    const { units, theme } = this.charts, { x, y, curves } = this.spec;
    curves.forEach((c, i) => {
      const dot = this.dots[i];
      if (Array.isArray(c.x) || this.time === null || !this.plot) return;
      const { time } = this.columns[c.x], { width, height } = this.plot.over.getBoundingClientRect();
      const at = [this.plot.valToPos(units.convert(between(this.columns[c.x], this.time), x.unit), 'x'),
                  this.plot.valToPos(units.convert(between(this.columns[c.y], this.time), y.unit), 'y')];
      const has_ended = this.within && (this.time < time[0] || this.time > time.at(-1));
      dot.hidden = !this.shown.has(c.label) || has_ended || !(at[0] >= 0 && at[0] <= width && at[1] >= 0 && at[1] <= height);
      dot.style.background = c.run === undefined ? theme.ink : this.color(c.color, theme);
      dot.style.transform = `translate(${at[0]}px, ${at[1]}px)`;
    });
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

// All charts of a page in a grid.
export class Charts {
  // `name`: first part of the file names of saved pictures.
  constructor(root, specs, columns, units, name) {
    Object.assign(this, { root, units, name });
    this.enlarged = new Enlarged();
    this.theme = page_theme();
    this.list = specs.map((spec) => new Chart(spec, columns, this));
    root.append(element('div', { class: 'charts' }, ...this.list.map((c) => c.root)));
    for (const c of this.list) c.build();
    new ResizeObserver(() => this.resize()).observe(root);
  }

  resize() {
    for (const c of this.list) c.resize();
  }

  // Draws all charts again, after units or colors have changed.
  rebuild() {
    this.theme = page_theme();
    for (const c of this.list) c.build(this.printing ? paper_width : undefined);
  }

  // Selects the width of the next rebuild(): paper (true) or screen (false).
  print(begins) {
    this.printing = begins;
  }

  set_time(t) {
    for (const c of this.list) c.set_time(t);
  }

  set_within(view) {
    for (const c of this.list) c.set_within(view);
  }
}
