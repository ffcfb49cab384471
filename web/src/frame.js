// Axes of a drawing: positions of values, grid, numbers and names. `ctx` is a canvas or an SvgContext.
import { ticks } from './axis.js';
import { tick_text } from './units.js';

// Returns the frame of a box { left, right, top, bottom } [px]. Axes are { span: [from, to], name }, those
// of `ys` at the left and at the right; an axis of words has its `ticks`, [value, text].
export function frame_of(box, x, ys) {
  const { left, right, top, bottom } = box;
  const share = (v, [from, to]) => (v - from) / (to - from);
  return { ...box, axes: { x, ys }, x: (v) => left + share(v, x.span) * (right - left),
           y: (v, axis = 0) => bottom - share(v, ys[axis].span) * (bottom - top) };
}

// Returns the frame of a plot of uPlot, in pixels of its canvas.
export const frame_of_plot = ({ bbox, valToPos }) => ({
  left: bbox.left, right: bbox.left + bbox.width, top: bbox.top, bottom: bbox.top + bbox.height,
  x: (v) => valToPos(v, 'x', true), y: (v) => valToPos(v, 'y', true),
});

const ticks_of = ({ span, ticks: own }, about) => own ?? ticks(...span, Math.max(2, about)).map((v) => [v, tick_text(v)]);

// Draws grid and numbers, the name of the horizontal axis below, and those of the vertical axes above.
export function draw_axes(ctx, frame, theme) {
  const { left, right, top, bottom, axes: { x, ys } } = frame;
  ctx.font = theme.font;
  ctx.strokeStyle = theme.grid;
  ctx.fillStyle = theme.quiet;
  ctx.lineWidth = 1;
  ctx.beginPath();
  ctx.textAlign = 'center';
  ctx.textBaseline = 'top';
  for (const [v, words] of ticks_of(x, (right - left) / 80)) {
    const at = Math.round(frame.x(v)) + 0.5;
    ctx.moveTo(at, top);
    ctx.lineTo(at, bottom);
    ctx.fillText(words, Math.min(right - ctx.measureText(words).width / 2, at), bottom + 5);
  }
  ctx.textBaseline = 'middle';
  ys.forEach((y, axis) => {
    ctx.textAlign = axis ? 'left' : 'right';
    for (const [v, words] of ticks_of(y, (bottom - top) / 50)) {
      const at = Math.round(frame.y(v, axis)) + 0.5;
      if (!axis) ctx.moveTo(left, at), ctx.lineTo(right, at);
      ctx.fillText(words, axis ? right + 6 : left - 6, at);
    }
  });
  ctx.stroke();
  ctx.textBaseline = 'alphabetic';
  ctx.textAlign = 'center';
  ctx.fillText(fitting(ctx, x.name, right - left), (left + right) / 2, bottom + 36);
  ys.forEach((y, axis) => {
    ctx.textAlign = axis ? 'right' : 'left';
    ctx.fillText(fitting(ctx, y.name, right - 8), axis ? right + 30 : 8, top - 14);
  });
}

// Returns the text, shortened to this width.
function fitting(ctx, text, width) {
  if (ctx.measureText(text).width <= width) return text;
  let most = text.length;
  while (most > 4 && ctx.measureText(`${text.slice(0, most)}…`).width > width) --most;
  return `${text.slice(0, most)}…`;
}

// Adds a line through the points (xs[i], ys[i]) to the path. A value that is not finite interrupts it;
// undefined is skipped.
export function trace_line(ctx, xs, ys, at_x, at_y, first = 0, last = xs.length) {
  let drawing = false;
  for (let i = first; i < last; ++i) {
    if (ys[i] === undefined) continue;
    const there = ys[i] !== null && Number.isFinite(ys[i]) && Number.isFinite(xs[i]);
    if (there) ctx[drawing ? 'lineTo' : 'moveTo'](at_x(xs[i]), at_y(ys[i]));
    drawing = there;
  }
}
