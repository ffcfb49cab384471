// The picture of a chart: its points and lines in the view that is zoomed to, with those names that
// are shown.
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
    return this.chart.color(curve.color, this.colors.lines, false);
  }

  // The mark of a legend has no color where it stands for curves of several.
  key(curve, x, y) {
    const several = curve.style === 'held out', color = several ? '#444' : this.color(curve);
    if (curve.style === 'line') this.add(`<path d="M${at(x)} ${at(y)}h24" fill="none" ${this.stroke(curve)}/>`);
    else this.dot(curve.style, x + 12, y, 3.2, color);
  }

  stroke(curve) {
    return `stroke="${this.color(curve)}" stroke-width="1.6"${curve.dash ? ` stroke-dasharray="${curve.dash.join(' ')}"` : ''}`;
  }

  dot(style, x, y, r, color) {
    const paint = style === 'points' ? `fill="${color}"` : `fill="#fff" stroke="${color}" stroke-width="1.3"`;
    this.add(`<circle cx="${at(x)}" cy="${at(y)}" r="${at(style === 'points' ? r : 1.25 * r)}" ${paint}/>`);
  }

  curves() {
    const [range] = this.ranges;
    for (const kind of ['line', 'points', 'held out'])
      for (const c of this.shown) {
        if (c.style !== kind) continue;
        if (kind === 'line') this.line(c.label, this.path(c.x, c.y, range), this.stroke(c));
        else this.points(c, range);
      }
  }

  points(c, range) {
    const r = c.x.length > 400 ? 1.7 : 2.9;
    for (let i = 0; i < c.x.length; ++i)
      if (Number.isFinite(c.x[i]) && Number.isFinite(c.y[i])) this.dot(c.style, this.x(c.x[i]), this.y(c.y[i], range), r, this.color(c));
  }
}

export const chart_picture = (chart) => new ChartPicture(chart).svg();
