// Canvas with two axes and marks for rows, used by history, scatter and surface. Everything is drawn once
// on a second canvas; the row under the pointer and the chosen row are drawn over it.
import { trace_disc, trace_mark, triangle } from './chart_shapes.js';
import { pressure_color } from './colors.js';
import { draw_axes, frame_of } from './frame.js';
import { menu_button } from './menu.js';
import { element } from './page.js';
import { save_entries } from './saving.js';
import { SvgContext } from './svg_context.js';
import { page_theme, paper_theme } from './theme.js';
import { number } from './units.js';

export const color_steps = 16;
const margin = { left: 58, right: 14, top: 28, bottom: 40 };  // [px]
const near_enough = 18;  // largest distance of the pointer to a mark [px]

// Returns the colors of the views, of the page or for print.
export const view_colors = (theme) => ({ ...theme, ramp: ramp_on(theme) });

// Returns the part of the color scale that contrasts with the background, in steps.
function ramp_on({ dark }) {
  const [from, to] = dark ? [0.28, 1] : [0, 0.88];
  return Array.from({ length: color_steps }, (_, i) => pressure_color(from + ((to - from) * i) / (color_steps - 1)));
}

// Returns how rows are colored: by a column, or by study. `step_of(row)`: index of a color, -1 if the
// value is missing.
export function coloring(data, column, colors) {
  if (!column || !column.varies)
    return { list: colors.lines, column: null, step_of: (row) => data.study[row] };
  const { values, low, high } = column, scale = color_steps / (high - low);
  return { list: colors.ramp, column,
           step_of: (row) => (values[row] === values[row] ? Math.min(color_steps - 1, Math.floor((values[row] - low) * scale)) : -1) };
}

// Returns the axis of a column, slightly wider than its values.
export function axis_of(column, room = 0.04) {
  const { low, high, heading: name } = column;
  const ticks = column.number ? undefined : column.words.map((w, i) => [i, w.length > 18 ? `${w.slice(0, 17)}…` : w]);
  if (!(high >= low)) return { span: [0, 1], name, ticks };
  const wide = high > low ? room * (high - low) : Math.abs(low) * 0.1 || 1;
  return { span: [low - wide, high + wide], name, ticks };
}

export const value_text = (column, value) =>
  (value !== value || value === undefined ? '–' : column.number ? number(value) : column.words[value]);

// Canvas on which everything is drawn once, on a second canvas; marks of rows are drawn over it.
export class Sheet {
  // Calls `on_pick(row)` on a click and `on_over(row)` on a move with the row at the pointer, -1 if none.
  constructor(canvas, { row_at, on_pick, on_over, height }) {
    Object.assign(this, { canvas, height, instead: null });  // `instead`: context while a picture is saved
    this.still = document.createElement('canvas');
    canvas.addEventListener('pointermove', (e) => on_over(row_at(e)));
    canvas.addEventListener('pointerleave', () => on_over(-1));
    canvas.addEventListener('click', (e) => on_pick(row_at(e)));
  }

  // Clears the drawing. Returns its context.
  fresh() {
    if (this.instead) return this.instead;
    const ratio = window.devicePixelRatio || 1, width = this.canvas.clientWidth;
    this.canvas.style.height = `${this.height}px`;
    for (const c of [this.canvas, this.still]) {
      c.width = Math.round(width * ratio);
      c.height = Math.round(this.height * ratio);
    }
    const ctx = this.still.getContext('2d');
    ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
    return ctx;
  }

  // Shows the drawing. Returns the context for marks over it.
  over() {
    const { canvas } = this, ctx = canvas.getContext('2d'), ratio = window.devicePixelRatio || 1;
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.clearRect(0, 0, canvas.width, canvas.height);
    ctx.drawImage(this.still, 0, 0);
    ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
    return ctx;
  }
}

// Returns the menu of a view. To save a picture, the view is drawn into an SvgContext in light colors, and
// then again on the page. `view` has `title`, `canvas`, draw(colors), a `chart`, which is a
// Sheet, and `below`, the height of what only a picture has below it.
export function picture_menu(page, view) {
  const drawn = () => {
    const ctx = new SvgContext(), { chart } = view;
    chart.instead = ctx;
    try {
      view.draw(view_colors(paper_theme()));
      return ctx.svg(view.title, view.canvas.clientWidth, chart.height + (view.below ?? 0));
    } finally {
      chart.instead = null;
      view.draw(view_colors(page_theme()));
      page.mark();
    }
  };
  const of = page.data.studies.map((s) => s.title).join('-');
  return element('div', { class: 'panel-tools' },
    menu_button('⋯', 'Chart menu', () => save_entries(of, () => view.title, drawn)));
}

export class Chart extends Sheet {
  constructor(canvas, { on_pick, on_over, height = 320 }) {
    super(canvas, { row_at: (e) => this.row_at(e), on_pick, on_over, height });
    this.rows = [];
    canvas.tabIndex = 0;
  }

  // Begins a drawing with these axes. Returns the context; null if the canvas has no width.
  begin(x_axis, y_axis, colors) {
    const width = this.canvas.clientWidth;
    if (!width) return null;
    const ctx = this.fresh();
    const box = { left: margin.left, right: width - margin.right, top: margin.top, bottom: this.height - margin.bottom };
    this.frame = frame_of(box, x_axis, [{ ...y_axis, name: `↑ ${y_axis.name}` }]);
    this.colors = colors;
    draw_axes(ctx, this.frame, colors);
    return ctx;
  }

  x(v) { return this.frame.x(v); }
  y(v) { return this.frame.y(v); }

  // Computes the positions of the rows' marks. `xs`, `ys`: values by row.
  place(rows, xs, ys) {
    this.rows = rows.filter((r) => xs[r] === xs[r] && ys[r] === ys[r]);
    this.px = Float32Array.from(this.rows, (r) => this.x(xs[r]));
    this.py = Float32Array.from(this.rows, (r) => this.y(ys[r]));
    this.index = new Map(this.rows.map((r, i) => [r, i]));
  }

  // Draws the marks: filled if the row is feasible, else hollow and faint; triangles for the second study.
  // Marks with a higher value of the color column are larger.
  marks(ctx, data, color) {
    const groups = new Map(), sized = color.column !== null;
    this.rows.forEach((row, i) => {
      const step = color.step_of(row), key = 4 * (step + 1) + 2 * data.study[row] + (data.feasible[row] ? 0 : 1);
      if (!groups.has(key)) groups.set(key, []);
      groups.get(key).push(i);
    });
    const many = this.rows.length > 3000 ? 0.7 : 1;
    for (const [key, members] of [...groups].sort((a, b) => (b[0] & 1) - (a[0] & 1) || a[0] - b[0])) {
      const step = (key >> 2) - 1, hollow = key & 1, second = key & 2;
      const size = many * (sized ? 2.2 + (2.6 * Math.max(0, step)) / color_steps : 3.4);
      ctx.beginPath();
      for (const i of members)
        if (second) trace_mark(ctx, triangle, this.px[i], this.py[i], 1.1 * size);
        else trace_disc(ctx, this.px[i], this.py[i], size);
      const paint = step < 0 ? this.colors.unlit : color.list[step];
      ctx.globalAlpha = hollow ? 0.45 : 0.85;
      ctx.lineWidth = 1.2;
      if (hollow) ctx.strokeStyle = paint, ctx.stroke();
      else ctx.fillStyle = paint, ctx.fill();
    }
    ctx.globalAlpha = 1;
  }

  // Shows the drawing with the row at the pointer and the chosen row over it.
  show(over, chosen, words) {
    if (!this.frame) return;
    const ctx = this.over();
    for (const [row, size] of [[chosen, 8], [over, 6]]) {
      const i = this.index?.get(row);
      if (i === undefined) continue;
      ctx.beginPath();
      trace_disc(ctx, this.px[i], this.py[i], size);
      outlined(ctx, this.colors, row === chosen);
      if (row === over && words) this.label(ctx, this.px[i], this.py[i], words(row));
    }
  }

  label(ctx, x, y, text) {
    ctx.font = `12px ${this.colors.sans}`;
    const width = ctx.measureText(text).width + 12, right = x + 12 + width > this.frame.right;
    const left = Math.max(2, right ? x - 12 - width : x + 12), top = Math.max(2, y - 26);
    ctx.fillStyle = this.colors.paper;
    ctx.strokeStyle = this.colors.edge;
    ctx.lineWidth = 1;
    ctx.beginPath();
    ctx.rect(left, top, width, 20);
    ctx.fill();
    ctx.stroke();
    ctx.fillStyle = this.colors.ink;
    ctx.textAlign = 'left';
    ctx.textBaseline = 'middle';
    ctx.fillText(text, left + 6, top + 10);
  }

  row_at(event) {
    if (!this.px) return -1;
    const box = this.canvas.getBoundingClientRect(), x = event.clientX - box.left, y = event.clientY - box.top;
    let best = near_enough ** 2, found = -1;
    for (let i = 0; i < this.rows.length; ++i) {
      const d = (this.px[i] - x) ** 2 + (this.py[i] - y) ** 2;
      if (d <= best) best = d, found = i;
    }
    return found < 0 ? -1 : this.rows[found];
  }
}

// Strokes a path with an outline that makes it visible on every color.
export function outlined(ctx, colors, is_chosen) {
  for (const [color, width] of [[colors.paper, is_chosen ? 7 : 4], [colors.ink, is_chosen ? 3 : 1.6]]) {
    ctx.strokeStyle = color;
    ctx.lineWidth = width;
    ctx.stroke();
  }
}
