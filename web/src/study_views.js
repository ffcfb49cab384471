// Views of a study: history, scatter and surface. Each is a canvas with its choices above it.
import { ticks } from './axis.js';
import { trace_disc } from './chart_shapes.js';
import { button, element } from './page.js';
import { axis_of, Chart, coloring, color_steps, picture_menu, value_text } from './study_chart.js';
import { best_so_far, level_lines, pareto_front, surface } from './study_math.js';
import { number, tick_text } from './units.js';

const surface_size = 40;  // nodes across

// Returns a field to choose a column; the entries `more`, [value, words], come first.
export function chooser(label, columns, chosen, on_change, more = []) {
  const field = element('select', { 'aria-label': label, title: label },
    ...more.map(([value, words]) => element('option', { value }, words)),
    ...columns.map((c) => element('option', { value: c.heading }, c.heading)));
  field.value = typeof chosen === 'string' ? chosen : chosen?.heading ?? '';
  field.addEventListener('change', () => on_change(columns.find((c) => c.heading === field.value) ?? field.value));
  return element('label', { class: 'choice' }, element('span', {}, label), field);
}

// Returns a button that selects, for all views, whether less or more of a column is better.
export function direction(page, column) {
  const turn = () => {
    column.less = !column.less;
    page.redraw();
    page.arrange_choices();
  };
  return button({ class: 'direction', title: `of ${column.heading}` }, turn, column.less ? '↓ less is better' : '↑ more is better');
}

// View with heading, choices, canvas and a sentence of explanation.
export class View {
  constructor(page, id, title, label, height) {
    Object.assign(this, { page, title });
    this.choices = element('div', { class: 'choices no-print' });
    this.canvas = element('canvas', { id: `${id}-canvas`, role: 'img', 'aria-label': label });
    this.hint = element('p', { class: 'hint' });
    this.root = element('section', { class: 'study-view', id },
      element('header', {}, element('h2', {}, title), this.choices, picture_menu(page, this)), this.canvas, this.hint);
    this.chart = new Chart(this.canvas, { on_pick: (row) => page.choose(row), on_over: (row) => page.over(row), height });
    this.canvas.addEventListener('keydown', (e) => this.key(e));
  }

  // Moves through the marks from left to right with the arrow keys.
  key(event) {
    const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!by || !this.chart.rows.length) return;
    event.preventDefault();
    event.stopPropagation();
    const { rows, px } = this.chart;
    const order = rows.map((_, i) => i).sort((a, b) => px[a] - px[b] || rows[a] - rows[b]);
    const at = order.findIndex((i) => rows[i] === this.page.chosen);
    const next = at < 0 ? (by > 0 ? 0 : order.length - 1) : Math.min(order.length - 1, Math.max(0, at + by));
    this.page.choose(rows[order[next]]);
  }

  show(over, chosen) {
    this.chart.show(over, chosen, (row) => this.words(row));
  }

  words(row) {
    const { data } = this.page;
    return [`row ${data.name_of(row)}`, ...this.columns().map((c) => value_text(c, c.values[row]))].join(' · ');
  }
}

export class History extends View {
  constructor(page) {
    super(page, 'history', 'History', 'A number of every row in the order of rows, and the best so far');
    this.y = page.first_figures[0] ?? page.columns[0];
    this.by = page.data.generation.some((g) => g >= 0) ? 'generation' : 'row';
  }

  columns() { return [this.y]; }

  arrange() {
    const { page } = this, generations = page.data.generation.some((g) => g >= 0);
    const change = (y) => { this.y = y; this.arrange(); page.redraw(); };
    this.choices.replaceChildren(chooser('number', page.columns, this.y, change), direction(page, this.y),
      ...(generations ? [chooser('by', [], this.by, (by) => { this.by = by; page.redraw(); }, [['row', 'row'], ['generation', 'generation']])] : []));
  }

  draw(colors) {
    const { page: { data, filter }, y, chart } = this;
    const xs = this.by === 'generation' ? data.generation : data.number;
    const last = filter.rows.reduce((most, r) => Math.max(most, xs[r]), 1);
    const ctx = chart.begin({ span: [-0.02 * last, 1.02 * last], name: this.by }, axis_of(y), colors);
    if (!ctx) return;
    chart.place(filter.rows, xs, y.values);
    chart.marks(ctx, data, coloring(data, null, colors));
    const bests = data.studies.map((s) => this.best(ctx, s, xs, colors));
    const words = bests.filter(Boolean).map(({ row }) => `${data.name_of(row)} with ${value_text(y, y.values[row])}`);
    this.hint.textContent = `Line: the best so far${words.length ? `, now row ${words.join(', row ')}` : ''}. Hollow: without numbers, or beyond a limit.`;
  }

  // Draws the staircase of the best value so far of one study; returns its best row.
  best(ctx, { study }, xs, colors) {
    const { page: { data, filter }, y, chart } = this, { values } = y;
    const rows = filter.rows.filter((r) => data.study[r] === study && data.feasible[r] && values[r] === values[r]);
    if (!rows.length) return null;
    rows.sort((a, b) => xs[a] - xs[b] || data.number[a] - data.number[b]);
    const bests = best_so_far(rows.map((r) => values[r]), y.less);
    ctx.strokeStyle = colors.lines[study];
    ctx.lineWidth = 2.5;
    ctx.setLineDash(study ? [7, 4] : []);
    ctx.beginPath();
    rows.forEach((r, i) => {
      if (i) ctx.lineTo(chart.x(xs[r]), chart.y(bests[i - 1]));
      ctx[i ? 'lineTo' : 'moveTo'](chart.x(xs[r]), chart.y(bests[i]));
    });
    ctx.stroke();
    ctx.setLineDash([]);
    return { row: rows[bests.indexOf(bests.at(-1))] };
  }
}

export class Scatter extends View {
  constructor(page) {
    super(page, 'scatter', 'Two columns', 'One column over another, with the Pareto front');
    [this.x, this.y] = [page.first_figures[0] ?? page.columns[0], page.first_figures[1] ?? page.columns[1] ?? page.columns[0]];
    this.front = [];
  }

  columns() { return [this.x, this.y, ...(this.page.color_column ? [this.page.color_column] : [])]; }

  arrange() {
    const { page } = this, set = (name) => (c) => { this[name] = c; this.arrange(); page.redraw(); };
    this.choices.replaceChildren(
      chooser('x', page.columns, this.x, set('x')), direction(page, this.x),
      chooser('y', page.columns, this.y, set('y')), direction(page, this.y));
  }

  draw(colors) {
    const { page: { data, filter, color_column }, x, y, chart } = this;
    const ctx = chart.begin(axis_of(x), axis_of(y), colors);
    if (!ctx) return;
    chart.place(filter.rows, x.values, y.values);
    chart.marks(ctx, data, coloring(data, color_column, colors));
    this.front = pareto_front(filter.rows.filter((r) => data.feasible[r]), x.values, y.values, x.less, y.less);
    this.draw_front(ctx, colors);
    const better = (c) => (c.less ? 'less' : 'more');
    this.hint.textContent = `${this.front.length} ringed ${this.front.length === 1 ? 'row' : 'rows'} (Pareto front): no other row has ${better(x)} ${x.key} and ${better(y)} ${y.key}.`;
  }

  // Draws the Pareto front as a staircase between its rows.
  draw_front(ctx, colors) {
    const { x, y, chart, front } = this;
    ctx.strokeStyle = colors.ink;
    ctx.lineWidth = 1.3;
    ctx.beginPath();
    front.forEach((r, i) => {
      const px = chart.x(x.values[r]), py = chart.y(y.values[r]);
      if (i) {
        const qx = chart.x(x.values[front[i - 1]]), qy = chart.y(y.values[front[i - 1]]);
        ctx.lineTo(x.less ? px : qx, x.less ? qy : py);
      }
      ctx[i ? 'lineTo' : 'moveTo'](px, py);
    });
    ctx.stroke();
    ctx.beginPath();
    for (const r of front) trace_disc(ctx, chart.x(x.values[r]), chart.y(y.values[r]), 6);
    ctx.stroke();
  }
}

export class Surface extends View {
  constructor(page) {
    super(page, 'surface', 'A number over two parameters', 'Lines of equal value of a number over two parameters, with the rows');
    const over = page.parameters.filter((c) => c.varies && c.number);
    [this.x, this.y] = [over[0] ?? page.columns[0], over[1] ?? page.columns[1] ?? page.columns[0]];
    this.z = page.first_figures[0] ?? page.columns[0];
    this.takes_long = true;
  }

  columns() { return [this.x, this.y, this.z]; }

  arrange() {
    const { page } = this, set = (name) => (c) => { this[name] = c; page.redraw(); };
    this.choices.replaceChildren(chooser('number', page.columns, this.z, set('z')),
      chooser('over x', page.columns, this.x, set('x')), chooser('and y', page.columns, this.y, set('y')));
  }

  draw(colors) {
    const { page: { data, filter }, x, y, z, chart } = this;
    const ctx = chart.begin(axis_of(x), axis_of(y), colors);
    if (!ctx) return;
    chart.place(filter.rows, x.values, y.values);
    const rows = chart.rows.filter((r) => data.feasible[r]);
    this.nodes = surface(rows, x.values, y.values, z.values, [x.low, x.high], [y.low, y.high], surface_size);
    const there = [...this.nodes].filter((v) => v === v);
    const span = there.length ? [Math.min(...there), Math.max(...there)] : [0, 1];
    this.fill(ctx, span, colors);
    this.lines(ctx, span, colors);
    ctx.fillStyle = colors.ink;
    ctx.globalAlpha = rows.length > 1000 ? 0.3 : 0.6;
    for (let i = 0; i < chart.rows.length; ++i) ctx.fillRect(chart.px[i] - 1, chart.py[i] - 1, 2, 2);
    ctx.globalAlpha = 1;
    this.hint.textContent = there.length
      ? `${z.heading}: ${number(span[0])} to ${number(span[1])}, a plane fitted to the nearest rows at each point, blank if no row is near. Effects of other parameters are averaged; rows beyond a limit are shown as dots only.`
      : 'Too few rows for a surface.';
  }

  // Draws the surface as an image with a pixel per node, enlarged to the box.
  fill(ctx, [low, high], colors) {
    const { chart, x, y, nodes } = this, size = surface_size;
    const cells = document.createElement('canvas'), paint = cells.getContext('2d');
    cells.width = cells.height = size;
    nodes.forEach((v, k) => {
      if (v !== v) return;
      paint.fillStyle = colors.ramp[high > low ? Math.min(color_steps - 1, Math.floor(((v - low) / (high - low)) * color_steps)) : 0];
      paint.fillRect(k % size, size - 1 - Math.floor(k / size), 1, 1);
    });
    const left = chart.x(x.low), top = chart.y(y.high), right = chart.x(x.high), bottom = chart.y(y.low);
    const w = (right - left) / (size - 1), h = (bottom - top) / (size - 1);
    ctx.globalAlpha = 0.75;
    ctx.imageSmoothingEnabled = false;
    ctx.drawImage(cells, left - w / 2, top - h / 2, w * size, h * size);
    ctx.globalAlpha = 1;
  }

  // Draws lines at round values, each with one number.
  lines(ctx, span, colors) {
    const { chart, x, y, nodes } = this;
    const at = (u, v) => [chart.x(x.low + u * (x.high - x.low)), chart.y(y.low + v * (y.high - y.low))];
    ctx.font = `11px ${colors.sans}`;
    ctx.textAlign = 'center';
    ctx.textBaseline = 'middle';
    for (const level of ticks(...span, 7)) {
      const pieces = level_lines(nodes, surface_size, level);
      if (pieces.length < 3) continue;
      ctx.strokeStyle = colors.ink;
      ctx.lineWidth = 1;
      ctx.beginPath();
      for (const [u0, v0, u1, v1] of pieces) {
        ctx.moveTo(...at(u0, v0));
        ctx.lineTo(...at(u1, v1));
      }
      ctx.stroke();
      const [u, v] = pieces[pieces.length >> 1], [px, py] = at(u, v), words = tick_text(level);
      ctx.lineWidth = 4;
      ctx.strokeStyle = colors.paper;
      ctx.strokeText(words, px, py);
      ctx.fillStyle = colors.ink;
      ctx.fillText(words, px, py);
    }
  }
}
