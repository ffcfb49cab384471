// Shapes of charts, added to the path of a canvas or of an SvgContext: marks of points, and bands.
import { SvgContext } from './svg_context.js';

const turn = 2 * Math.PI;

// Corners of the marks: a cross, which is open, triangle, square, diamond. The second half of a cross
// begins a new line.
const marks = [
  [[-1, -1], [1, 1], null, [-1, 1], [1, -1]],
  [[0, -1.2], [1.15, 0.85], [-1.15, 0.85]],
  [[-1, -1], [1, -1], [1, 1], [-1, 1]],
  [[0, -1.3], [1.3, 0], [0, 1.3], [-1.3, 0]],
];
export const triangle = 1;

// Adds a mark about (x, y) of size `r`.
export function trace_mark(ctx, mark, x, y, r) {
  const corners = marks[mark % marks.length];
  corners.forEach((corner, i) => corner && ctx[i && corners[i - 1] ? 'lineTo' : 'moveTo'](x + r * corner[0], y + r * corner[1]));
  if (!corners.includes(null)) ctx.closePath();
}

export function trace_disc(ctx, x, y, r) {
  ctx.moveTo(x + r, y);
  ctx.arc(x, y, r, 0, turn);
}

// Adds a measured point: a disc, or the curve's mark. Held-out points are larger.
export function trace_point(ctx, curve, x, y, r) {
  const size = curve.style === 'points' ? r : 1.25 * r;
  if (curve.mark) trace_mark(ctx, curve.mark, x, y, 1.15 * size);
  else trace_disc(ctx, x, y, size);
}

// Adds the area between the curve's lower and upper line: one part for each stretch where both are finite.
// All parts have the same direction, so that overlapping parts are filled once.
export function trace_band(ctx, curve, at_x, at_y) {
  const known = (i) => i < curve.x.length && Number.isFinite(curve.y[i]) && Number.isFinite(curve.y_high[i]);
  for (let from = 0, to; from < curve.x.length; from = to + 1) {
    for (to = from; known(to);) ++to;
    if (to - from < 2) continue;
    for (let i = from; i < to; ++i) ctx[i > from ? 'lineTo' : 'moveTo'](at_x(curve.x[i]), at_y(curve.y[i]));
    for (let i = to - 1; i >= from; --i) ctx.lineTo(at_x(curve.x[i]), at_y(curve.y_high[i]));
    ctx.closePath();
  }
}

// Opacity of a band. The 68 % band is drawn over the 95 % band and is darker.
export const band_opacity = (label) => (label.startsWith('68') ? 0.3 : 0.17);

// Draws a curve's sample of a legend, `width` pixels wide from x on, about the height y.
export function draw_sample(ctx, curve, x, y, width, color, paper) {
  ctx.strokeStyle = ctx.fillStyle = color;
  ctx.beginPath();
  if (curve.style === 'band') {
    ctx.globalAlpha = band_opacity(curve.label) + 0.1;
    ctx.fillRect(x, y - 5, width, 10);
    ctx.globalAlpha = 1;
  } else if (curve.style === 'points' || curve.style === 'held out') {
    trace_point(ctx, curve, x + width / 2, y, 3.6);
    draw_point(ctx, curve, paper);
  } else if (curve.style === 'left out') {
    ctx.lineWidth = 1.4;
    trace_mark(ctx, curve.mark ?? 0, x + width / 2, y, 3.4);
    ctx.stroke();
  } else {
    ctx.lineWidth = curve.bold ? 3 : 2;
    ctx.setLineDash(curve.dash ?? []);
    ctx.moveTo(x, y);
    ctx.lineTo(x + width, y);
    ctx.stroke();
    ctx.setLineDash([]);
  }
}

// Paints the path of a point in the current color: filled, or hollow if it was held out.
export function draw_point(ctx, curve, paper, ratio = 1) {
  if (curve.style === 'points') return ctx.fill();
  const color = ctx.fillStyle;
  ctx.lineWidth = 1.3 * ratio;
  ctx.fillStyle = paper;
  ctx.fill();
  ctx.fillStyle = color;
  ctx.stroke();
}

// Returns the sample of a curve for a legend of the page, as SVG, 26 pixels wide.
export function sample_of(curve) {
  const ctx = new SvgContext();
  draw_sample(ctx, curve, 0, 5, 26, 'var(--line)', 'var(--paper)');
  return `<svg viewBox="0 0 26 10" width="26" height="10" aria-hidden="true">${ctx.parts.join('')}</svg>`;
}
