// Foot path of each run: height over forward position, both to the same scale.
import { between, index_at } from './samples.js';
import { palette_of_runs, set_line } from './runs.js';
import { tick_text } from './units.js';

const margin = { left: 46, right: 12, top: 10, bottom: 34 };  // [px]
const most_points = 20000;

function bounds_of(columns) {
  let low = Infinity, high = -Infinity;
  for (const column of columns) {
    for (const v of column?.values ?? []) {
      if (v < low) low = v;
      if (v > high) high = v;
    }
  }
  return [low, high];
}

// Returns a round step that divides `span` into about `count` parts.
function step_of(span, count) {
  const rough = span / count, power = 10 ** Math.floor(Math.log10(rough));
  return power * ([1, 2, 5, 10].find((m) => m * power >= rough) ?? 10);
}

export class FootPaths {
  // `xs`, `ys`: the columns of each run; null if missing.
  constructor(canvas, xs, ys, units, shown) {
    Object.assign(this, { canvas, xs, ys, units, shown });
    this.x_span = bounds_of(xs);
    this.y_span = bounds_of(ys);
    this.still = document.createElement('canvas');  // everything that does not move
  }

  runs() {
    return this.xs.map((x, run) => run).filter((run) => this.shown[run] && this.xs[run] && this.ys[run]);
  }

  // Draws the paths within the time `view`.
  draw(view) {
    const ratio = window.devicePixelRatio || 1, width = this.canvas.clientWidth;
    if (!width) return;
    const height = this.height_for(width);
    this.canvas.style.height = `${height}px`;
    for (const canvas of [this.canvas, this.still]) {
      canvas.width = width * ratio;
      canvas.height = height * ratio;
    }
    const ctx = this.still.getContext('2d');
    ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.fit(width, height);
    this.axes(ctx, width, height);
    const palette = palette_of_runs();
    ctx.lineJoin = 'round';
    for (const run of this.runs()) {
      set_line(ctx, run, palette);
      this.path(ctx, run, view);
    }
    ctx.setLineDash([]);
    this.palette = palette;
  }

  // Returns the height at which the paths fill the width.
  height_for(width) {
    const [x0, x1] = this.x_span, [y0, y1] = this.y_span;
    const wanted = ((width - margin.left - margin.right) * (y1 - y0)) / (x1 - x0 || 1);
    return Math.round(Math.min(460, Math.max(190, 1.2 * wanted + margin.top + margin.bottom)));
  }

  fit(width, height) {
    const [x0, x1] = this.x_span, [y0, y1] = this.y_span;
    const w = width - margin.left - margin.right, h = height - margin.top - margin.bottom;
    this.scale = Math.min(w / (1.06 * (x1 - x0) || 1), h / (1.06 * (y1 - y0) || 1));
    const left = margin.left + w / 2 - (this.scale * (x0 + x1)) / 2;
    const top = margin.top + h / 2 + (this.scale * (y0 + y1)) / 2;
    this.at = (x, y) => [left + this.scale * x, top - this.scale * y];
  }

  axes(ctx, width, height) {
    const css = getComputedStyle(document.documentElement);
    const unit = this.units.of('m');
    const right = width - margin.right, bottom = height - margin.bottom;
    const of_screen = unit.scale / this.scale;  // a pixel, in that unit
    const x_step = step_of((right - margin.left) * of_screen, 6), y_step = step_of((bottom - margin.top) * of_screen, 4);
    const [x0, y0] = this.at(0, 0);
    ctx.font = `11px ${css.getPropertyValue('--sans')}`;
    ctx.strokeStyle = css.getPropertyValue('--grid');
    ctx.fillStyle = css.getPropertyValue('--quiet');
    ctx.lineWidth = 1;
    ctx.beginPath();
    ctx.textAlign = 'center';
    ctx.textBaseline = 'top';
    const across = x_step / of_screen, down = y_step / of_screen;
    for (let i = Math.ceil((margin.left - x0) / across); x0 + i * across <= right; ++i) {
      const x = Math.round(x0 + i * across) + 0.5;
      ctx.moveTo(x, margin.top);
      ctx.lineTo(x, bottom);
      ctx.fillText(tick_text(+(i * x_step).toPrecision(9)), x, bottom + 5);
    }
    ctx.textAlign = 'right';
    ctx.textBaseline = 'middle';
    for (let i = Math.ceil((y0 - bottom) / down); y0 - i * down >= margin.top; ++i) {
      const y = Math.round(y0 - i * down) + 0.5;
      ctx.moveTo(margin.left, y);
      ctx.lineTo(right, y);
      ctx.fillText(tick_text(+(i * y_step).toPrecision(9)), margin.left - 6, y);
    }
    ctx.stroke();
    ctx.textAlign = 'center';
    ctx.textBaseline = 'alphabetic';
    ctx.fillText(`forward → ${unit.label}, up ↑ ${unit.label}`, (margin.left + right) / 2, height - 3);
  }

  path(ctx, run, [from, to]) {
    const x = this.xs[run], y = this.ys[run];
    const first = Math.max(0, index_at(x.time, from)), last = index_at(x.time, to);
    const step = Math.max(1, Math.ceil((last - first) / most_points));
    let drawing = false;
    ctx.beginPath();
    for (let i = first; i <= last; i += step) {
      const vx = x.values[i], vy = y.values[i];
      const there = vx === vx && vy === vy;
      if (there) drawing ? ctx.lineTo(...this.at(vx, vy)) : ctx.moveTo(...this.at(vx, vy));
      drawing = there;
    }
    ctx.stroke();
  }

  // Draws a dot at each foot's position at t.
  show(t) {
    if (!this.palette) return;
    const ctx = this.canvas.getContext('2d'), ratio = window.devicePixelRatio || 1;
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.clearRect(0, 0, this.canvas.width, this.canvas.height);
    ctx.drawImage(this.still, 0, 0);
    ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
    for (const run of this.runs()) {
      const x = this.xs[run];
      if (!x.time.length || t < x.time[0] || t > x.time[x.time.length - 1]) continue;
      ctx.fillStyle = this.palette[run % this.palette.length];
      ctx.beginPath();
      ctx.arc(...this.at(between(x, t), between(this.ys[run], t)), 5, 0, 2 * Math.PI);
      ctx.fill();
    }
  }
}
