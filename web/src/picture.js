// Plot or chart as an SVG picture for print: title, legend, axes and curves, on white.
import { draw_axes, frame_of } from './frame.js';
import { SvgContext } from './svg_context.js';
import { paper_theme } from './theme.js';

const width = 720, tall = 320;  // of the picture and of its curves [px]
const room = { left: 66, right: 18, axis: 62, bottom: 44, legend: 20, names: 26 };

// Draws a picture. `x` and `ys`: axes of frame.js. `keys`: entries of the legend, each with its `label` and
// draw(ctx, x, y, theme), which draws a sample 24 pixels wide. draw(ctx, frame, theme) draws the curves,
// behind(…) what is under the grid.
export function picture({ title, x, ys, keys, draw, behind = null }) {
  const ctx = new SvgContext(), theme = paper_theme(), rows = in_rows(keys);
  const top = room.legend * rows.length + room.names;
  const frame = frame_of({ left: room.left, right: width - (ys.length > 1 ? room.axis : room.right), top, bottom: top + tall }, x, ys);
  ctx.font = theme.font;
  rows.forEach((row, k) => row.forEach(({ at, key }) => {
    const y = room.legend * k + 8;
    key.draw(ctx, room.left + at, y - 4, theme);
    ctx.fillStyle = theme.ink;
    ctx.fillText(key.label, room.left + at + 30, y);
  }));
  if (behind) ctx.within(frame, () => behind(ctx, frame, theme));
  draw_axes(ctx, frame, theme);
  ctx.within(frame, () => draw(ctx, frame, theme));
  ctx.strokeStyle = theme.quiet;
  ctx.lineWidth = 1;
  ctx.beginPath();
  ctx.rect(frame.left, top, frame.right - frame.left, tall);
  ctx.stroke();
  return ctx.svg(title, width, frame.bottom + room.bottom);
}

// Distributes the entries of a legend over rows that fit.
function in_rows(keys) {
  const rows = keys.length ? [[]] : [];
  let at = 0;
  for (const key of keys) {
    const long = 44 + 6.4 * key.label.length;
    if (at + long > width - room.left - room.right && rows.at(-1).length) rows.push([]), (at = 0);
    rows.at(-1).push({ at, key });
    at += long;
  }
  return rows;
}
