// Planned stance phases of each run: one bar per run over the time of the plots.
import { letter_of } from './runs.js';
import { page_theme } from './theme.js';

const row = 13, bar = 7, left = 58, right = 14;  // margins as in the plots [px]

export class Plan {
  constructor(canvas, runs, plots, shown) {
    Object.assign(this, { canvas, runs, plots, shown });
    canvas.hidden = runs.every((r) => !r.phases.stretches.length);
  }

  draw() {
    const { canvas } = this;
    if (canvas.hidden) return;
    const rows = this.runs.map((run, i) => i).filter((i) => this.shown[i]);
    const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth, height = row * rows.length + 2;
    canvas.style.height = `${height}px`;
    canvas.width = width * ratio;
    canvas.height = height * ratio;
    const ctx = canvas.getContext('2d');
    ctx.scale(ratio, ratio);
    const theme = page_theme();
    const [from, to] = this.plots.view;
    const x = (t) => left + ((t - from) / (to - from)) * (width - left - right);
    ctx.font = theme.font;
    ctx.textBaseline = 'middle';
    rows.forEach((run, k) => {
      const middle = row * (k + 0.5) + 1;
      ctx.fillStyle = theme.quiet;
      ctx.fillText(k === 0 ? `stance ${letter_of(run)}` : letter_of(run), k === 0 ? 2 : 2 + ctx.measureText('stance ').width, middle);
      ctx.fillStyle = theme.rail;
      const { first_s, last_s, phases } = this.runs[run];
      const span = (a, b) => [Math.max(left, x(a)), Math.min(width - right, x(b))];
      const fill = ([a, b]) => b > a && ctx.fillRect(a, middle - bar / 2, b - a, bar);
      fill(span(first_s, last_s));
      ctx.fillStyle = theme.lines[run % theme.lines.length];
      for (const s of phases.stretches) if (s.stance) fill(span(s.from, s.to));
    });
  }
}
