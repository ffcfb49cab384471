// SVG picture of a plot: its lines within the view, with phases, faults and marks behind them.
import { at, Picture } from './picture.js';

class PlotPicture extends Picture {
  constructor(panel) {
    const names = panel.spec.lines.flatMap((line, i) => (panel.shown[i] ? [{ i, label: line.label }] : []));
    super(panel.spec.title, names, panel.units.length > 1);
    Object.assign(this, { panel, plots: panel.plots });
    [this.from, this.to] = this.plots.view;
    this.data = panel.slice(this.right - this.left);
    this.ranges = panel.units.slice(0, 2).map((unit, axis) => panel.range(axis, this.data));
  }

  axis_words() {
    return ['time [s]', this.panel.units.map((u) => this.plots.units.of(u).label)];
  }

  background() {
    const stretch = (from, to, color) => {
      const a = Math.max(this.left, this.x(from)), b = Math.min(this.right, this.x(to));
      if (b > a) this.add(`<rect x="${at(a)}" y="${at(this.top)}" width="${at(b - a)}" height="${at(this.bottom - this.top)}" fill="${color}"/>`);
    };
    const { run } = this.plots;
    for (const s of run.phases.stretches) if (s.stance) stretch(s.from, s.to, this.colors.stance);
    for (const f of run.faults ?? []) stretch(f.from, f.to, this.colors.fault);
  }

  marks() {
    for (const m of this.plots.marks?.in_view() ?? [])
      this.add(`<path d="M${at(this.x(m.from))} ${at(this.top)}V${at(this.bottom)}" stroke="${this.colors.mark}" stroke-dasharray="3 3"/>`);
    for (const f of this.plots.run.faults ?? [])
      for (const t of [f.from, f.to])
        if (t >= this.from && t <= this.to) this.add(`<path d="M${at(this.x(t))} ${at(this.top)}V${at(this.bottom)}" stroke="${this.colors.bad}"/>`);
  }

  stroke(i) {
    const line = this.panel.spec.lines[i], dash = line.dash ?? (line.style === 'dashed' ? [6, 4] : null);
    return `stroke="${this.colors.lines[line.color % this.colors.lines.length]}" stroke-width="${line.style === 'full' ? 1.6 : 1.3}"` +
      (dash ? ` stroke-dasharray="${dash.join(' ')}"` : '');
  }

  key({ i }, x, y) {
    this.add(`<path d="M${at(x)} ${at(y)}h24" ${this.stroke(i)} fill="none"/>`);
  }

  curves() {
    const [x, ...lines] = this.data;
    this.panel.spec.lines.forEach((line, i) => {
      if (!this.panel.shown[i]) return;
      const range = this.ranges[this.panel.units.indexOf(this.panel.unit_of(i))] ?? this.ranges[0];
      this.line(line.label, this.path(x, lines[i], range), this.stroke(i));
    });
  }
}

export const plot_picture = (panel) => new PlotPicture(panel).svg();
