// Parallel coordinates: an axis for each column, a line for each row. A range drawn on an axis filters
// every view.
import { breakable, button, element } from './page.js';
import { axis_of, coloring, outlined, picture_menu, Sheet, value_text } from './study_chart.js';
import { number } from './units.js';

const pad = { top: 12, bottom: 12 };  // [px]
const height = 300;
const narrowest = 84;  // smallest distance of two axes; more axes scroll [px]
const near_enough = 14;
const lines_at_once = 250;  // per path; one long path is slower than several short ones

const name_of = (column) => column.key.split('.').slice(-2).join('.');
const thin = (rows, most) => rows.filter((_, i) => i % Math.ceil(rows.length / most) === 0);

export class Parallel {
  constructor(page) {
    Object.assign(this, { page, title: 'All columns', below: 10 });
    this.choose_first();
    this.canvas = element('canvas', { id: 'parallel-canvas', role: 'img', 'aria-label': 'A line for each row across the axes of its columns' });
    this.chart = new Sheet(this.canvas, { row_at: (e) => this.row_at(e), on_pick: (row) => page.choose(row), on_over: (row) => page.over(row), height });
    this.handles = element('div', { class: 'handles' });
    this.names = element('div', { class: 'axis-names' });
    this.inner = element('div', { class: 'parallel-inner' }, this.names, this.canvas, this.handles);
    this.toggles = element('div', { class: 'groups no-print', role: 'group', 'aria-label': 'Axes' });
    this.root = element('section', { class: 'study-view', id: 'parallel' },
      element('header', {}, element('h2', {}, this.title), this.toggles, picture_menu(page, this)),
      element('div', { class: 'parallel-scroll' }, this.inner),
      element('p', { class: 'hint no-print' }, 'Drag along an axis to select a range, click the axis to remove it. With the keyboard, ↑ ↓ move the lower end, Shift ↑ ↓ the upper end, Delete removes it. ',
        'Click a line to choose its row.'));
  }

  // Chooses the axes, unless the reader has chosen them.
  choose_first() {
    if (this.chosen_by_hand) return;
    const { columns, data } = this.page, there = columns.filter((c) => c.varies && c.role !== 'other');
    const common = there.filter((c) => data.is_common(c));
    this.shown = new Set((common.length > 1 ? common : there).slice(0, 12));
  }

  arrange() {
    const { page } = this;
    this.toggles.replaceChildren(...page.columns.filter((c) => c.varies).map((c) => {
      const toggle = () => {
        this.chosen_by_hand = true;
        if (!this.shown.delete(c)) this.shown.add(c);
        else if (this.page.filter.ranges.has(c)) this.page.set_range(c, null);
        this.arrange();
        page.redraw();
      };
      return button({ 'aria-pressed': String(this.shown.has(c)), title: c.heading }, toggle, name_of(c));
    }));
    this.columns = page.columns.filter((c) => this.shown.has(c));
    this.inner.style.minWidth = `${narrowest * this.columns.length}px`;
    this.names.replaceChildren(...this.columns.map((c) => element('div', { class: 'axis-name', title: c.heading },
      element('b', {}, ...breakable(name_of(c))), c.unit ? ` ${c.unit}` : '')));
    this.handles.replaceChildren(...this.columns.map((c, i) => this.handle(c, i)));
  }

  // Returns the element over an axis along which ranges are dragged.
  handle(column, i) {
    const band = element('i', { class: 'band' });
    const root = element('div', { class: 'axis-handle', tabindex: '0', role: 'group', 'data-heading': column.heading,
                                  'aria-label': `${column.heading}: drag to select a range` }, band);
    root.style.left = `${(100 * (i + 0.5)) / this.columns.length}%`;
    root.addEventListener('pointerdown', (e) => this.drag(e, column, root));
    root.addEventListener('keydown', (e) => this.key(e, column));
    return root;
  }

  drag(event, column, root) {
    event.preventDefault();
    root.focus();
    root.setPointerCapture(event.pointerId);
    this.page.is_dragging = true;
    const from = event.clientY, value = (e) => this.value_at(column, e.clientY - root.getBoundingClientRect().top);
    const first = value(event);
    const move = (e) => {
      if (Math.abs(e.clientY - from) < 4) return;
      const last = value(e);
      this.page.set_range(column, [Math.min(first, last), Math.max(first, last)]);
    };
    const end = (e) => {
      root.removeEventListener('pointermove', move);
      this.page.is_dragging = false;
      this.page.redraw();
      if (e.type === 'pointerup' && Math.abs(e.clientY - from) < 4) this.page.set_range(column, null);
    };
    root.addEventListener('pointermove', move);
    root.addEventListener('pointerup', end, { once: true });
    root.addEventListener('pointercancel', end, { once: true });
  }

  key(event, column) {
    const { span: [low, high] } = axis_of(column), step = 0.05 * (high - low);
    const by = { ArrowUp: step, ArrowDown: -step }[event.key];
    if (['Delete', 'Backspace'].includes(event.key)) this.page.set_range(column, null);
    else if (by) {
      const [from, to] = this.page.filter.ranges.get(column) ?? [low, high];
      const range = event.shiftKey ? [from, to + by] : [from + by, to];
      this.page.set_range(column, [Math.max(low, Math.min(...range)), Math.min(high, Math.max(...range))]);
    } else return;
    event.preventDefault();
    event.stopPropagation();
  }

  value_at(column, y) {
    const { span: [low, high] } = axis_of(column);
    const share = (height - pad.bottom - y) / (height - pad.top - pad.bottom);
    return low + Math.min(1, Math.max(0, share)) * (high - low);
  }

  draw(colors) {
    const width = this.canvas.clientWidth;
    if (!width || !this.columns.length) return;
    const ctx = this.chart.fresh();
    this.at_x = this.columns.map((_, i) => (width * (i + 0.5)) / this.columns.length);
    this.at_y = this.columns.map((c) => {
      const { span: [low, high] } = axis_of(c), scale = (height - pad.top - pad.bottom) / (high - low);
      return (v) => height - pad.bottom - (v - low) * scale;
    });
    this.colors = colors;
    this.lines(ctx, colors);
    this.axes(ctx, colors);
    if (this.chart.instead) this.write_names(ctx, colors);
    this.bands();
  }

  // Draws hidden rows faintly, then visible rows by color over them.
  lines(ctx, colors) {
    const { data, filter, color_column } = this.page, color = coloring(data, color_column, colors);
    const groups = new Map();
    for (const row of this.page.is_dragging ? thin(filter.rows, 1500) : filter.rows) {
      const key = 2 * (color.step_of(row) + 1) + (data.study[row] ? 1 : 0);
      if (!groups.has(key)) groups.set(key, []);
      groups.get(key).push(row);
    }
    const count = filter.rows.length;
    ctx.lineWidth = 1;
    if (filter.is_on) this.stroke(ctx, thin(filter.hidden, 1500), colors.grid, 0.7);
    const alpha = count > 3000 ? 0.25 : count > 300 ? 0.45 : 0.8;
    for (const [key, rows] of groups) {
      const step = (key >> 1) - 1;
      ctx.setLineDash(key & 1 && count < 1000 ? [6, 4] : []);
      this.stroke(ctx, rows, step < 0 ? colors.unlit : color.list[step], alpha);
    }
    ctx.setLineDash([]);
    ctx.globalAlpha = 1;
  }

  stroke(ctx, rows, paint, alpha) {
    ctx.strokeStyle = paint;
    ctx.globalAlpha = alpha;
    for (let from = 0; from < rows.length; from += lines_at_once) {
      ctx.beginPath();
      for (const row of rows.slice(from, from + lines_at_once)) this.trace(ctx, row);
      ctx.stroke();
    }
  }

  // Adds a row's line to the path, with a gap where a value is missing.
  trace(ctx, row) {
    let drawing = false;
    this.columns.forEach((c, i) => {
      const v = c.values[row];
      if (v === v) ctx[drawing ? 'lineTo' : 'moveTo'](this.at_x[i], this.at_y[i](v));
      drawing = v === v;
    });
  }

  axes(ctx, colors) {
    ctx.font = `11px ${colors.sans}`;
    ctx.textAlign = 'left';
    ctx.textBaseline = 'middle';
    this.columns.forEach((c, i) => {
      ctx.strokeStyle = colors.quiet;
      ctx.lineWidth = 1;
      ctx.beginPath();
      ctx.moveTo(this.at_x[i], pad.top);
      ctx.lineTo(this.at_x[i], height - pad.bottom);
      ctx.stroke();
      const marks = c.number ? [[c.low, number(c.low)], [c.high, number(c.high)]] : c.words.map((w, k) => [k, w.slice(0, 14)]);
      for (const [v, words] of marks) {
        const y = this.at_y[i](v), wide = ctx.measureText(words).width;
        ctx.globalAlpha = 0.8;
        ctx.fillStyle = colors.paper;
        ctx.fillRect(this.at_x[i] + 4, y - 7, wide + 4, 14);
        ctx.globalAlpha = 1;
        ctx.fillStyle = colors.ink;
        ctx.fillText(words, this.at_x[i] + 6, y);
      }
    });
  }

  // Draws the names of the axes into a picture; on the page they are text above the canvas.
  write_names(ctx, colors) {
    ctx.textAlign = 'center';
    ctx.fillStyle = colors.ink;
    this.columns.forEach((c, i) => ctx.fillText(`${name_of(c)} ${c.unit ?? ''}`.trim(), this.at_x[i], i % 2 ? height + 1 : 3));
  }

  bands() {
    [...this.handles.children].forEach((handle, i) => {
      const range = this.page.filter.ranges.get(this.columns[i]), band = handle.firstChild;
      band.hidden = !range;
      if (!range) return;
      const [bottom, top] = range.map(this.at_y[i]);
      band.style.top = `${top}px`;
      band.style.height = `${Math.max(2, bottom - top)}px`;
    });
  }

  show(over, chosen) {
    if (!this.at_x) return;
    const ctx = this.chart.over();
    for (const row of [chosen, over]) {
      if (row < 0) continue;
      ctx.beginPath();
      this.trace(ctx, row);
      outlined(ctx, this.colors, row === chosen);
      if (row === over) this.values(ctx, row);
    }
  }

  values(ctx, row) {
    ctx.font = `600 11px ${this.colors.sans}`;
    ctx.textAlign = 'right';
    this.columns.forEach((c, i) => {
      if (c.values[row] !== c.values[row]) return;
      const words = value_text(c, c.values[row]), y = this.at_y[i](c.values[row]), wide = ctx.measureText(words).width;
      ctx.fillStyle = this.colors.paper;
      ctx.fillRect(this.at_x[i] - 8 - wide, y - 8, wide + 4, 16);
      ctx.fillStyle = this.colors.ink;
      ctx.fillText(words, this.at_x[i] - 6, y);
    });
  }

  row_at(event) {
    if (!this.at_x) return -1;
    const box = this.canvas.getBoundingClientRect(), x = event.clientX - box.left, y = event.clientY - box.top;
    const right = this.at_x.findIndex((at) => at > x), left = right - 1;
    if (right < 1) return -1;
    const share = (x - this.at_x[left]) / (this.at_x[right] - this.at_x[left]);
    let best = near_enough, found = -1;
    for (const row of this.page.filter.rows) {
      const a = this.at_y[left](this.columns[left].values[row]), b = this.at_y[right](this.columns[right].values[row]);
      const d = Math.abs(a + share * (b - a) - y);
      if (d < best) best = d, found = row;
    }
    return found;
  }
}
