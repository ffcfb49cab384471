// SVG picture of a chart: its points and lines within the current zoom, and a legend of the curves
// that are shown.
import { band_opacity, mark_path, point_path } from './chart_shapes.js';
import { at, Picture } from './picture.js';

class ChartPicture extends Picture {
  constructor(chart) {
    super(chart.spec.title, chart.named().filter((c) => chart.shown.has(c.label)));
    this.chart = chart;
    [this.from, this.to] = chart.view.x;
    this.ranges = [chart.view.y];
    this.shown = chart.curves.filter((c) => chart.shown.has(c.label));
  }

  axis_words() {
    const { x, y } = this.chart.spec;
    return [this.chart.axis_name(x), [this.chart.axis_name(y)]];
  }

  color(curve) {
    return this.chart.color_of(curve, this.colors.lines, false) ?? this.chart.color(curve.color, this.colors.lines, false);
  }

  // Legend entries for curves of several colors are grey.
  key(curve, x, y) {
    const several = curve.style === 'held out' || (curve.bold && this.chart.has_several_colors(curve.label));
    const color = several ? '#444' : this.color(curve);
    if (curve.style === 'band') this.add(`<rect x="${at(x)}" y="${at(y - 5)}" width="24" height="10" ${this.area(curve.label)}/>`);
    else if (curve.style === 'left out') this.mark(curve, x + 12, y, 4);
    else if (curve.style === 'line' || curve.style === 'other line') this.add(`<path d="M${at(x)} ${at(y)}h24" fill="none" ${this.stroke(curve, color)}/>`);
    else this.dot(curve, x + 12, y, 3.2, color);
  }

  stroke(curve, color = this.color(curve)) {
    return `stroke="${color}" stroke-width="${curve.bold ? 2.4 : 1.6}"${curve.dash ? ` stroke-dasharray="${curve.dash.join(' ')}"` : ''}`;
  }

  dot(curve, x, y, r, color) {
    const paint = curve.style === 'points' ? `fill="${color}"` : `fill="#fff" stroke="${color}" stroke-width="1.3"`;
    if (curve.mark) this.add(`<path d="${point_path(curve, +at(x), +at(y), r)}" ${paint}/>`);
    else this.add(`<circle cx="${at(x)}" cy="${at(y)}" r="${at(curve.style === 'points' ? r : 1.25 * r)}" ${paint}/>`);
  }

  area(label) {
    const curve = this.chart.curves.find((c) => c.label === label);
    return `fill="${this.color(curve)}" fill-opacity="${band_opacity(label)}"`;
  }

  mark(curve, x, y, r) {
    this.add(`<path d="${mark_path(curve.mark ?? 0, +at(x), +at(y), r)}" fill="none" stroke="${this.color(curve)}" stroke-width="1.3"/>`);
  }

  curves() {
    const [range] = this.ranges;
    for (const [label, path] of this.chart.bands((v) => this.x(v), (v) => this.y(v, range)))
      this.add(`<path d="${path}" ${this.area(label)}/>`);
    for (const kind of ['left out', 'line', 'other line', 'points', 'held out'])
      for (const c of this.shown) {
        if (c.style !== kind) continue;
        if (kind === 'left out') {
          for (let i = 0; i < c.x.length; ++i)
            if (Number.isFinite(c.y[i])) this.mark(c, this.x(c.x[i]), this.y(c.y[i], range), c.x.length > 60 ? 2.4 : 4);
        } else if (kind === 'line' || kind === 'other line') this.line(c.label, this.path(c.x, c.y, range), this.stroke(c));
        else this.points(c, range);
      }
  }

  points(c, range) {
    const r = c.x.length > 400 ? 1.7 : 2.9;
    for (let i = 0; i < c.x.length; ++i)
      if (Number.isFinite(c.x[i]) && Number.isFinite(c.y[i])) this.dot(c, this.x(c.x[i]), this.y(c.y[i], range), r, this.color(c));
  }
}

export const chart_picture = (chart) => new ChartPicture(chart).svg();
