// Shapes of the side view. All lengths are in meters, y up, in the frame that the caller has set;
// `view.px` is the size of a pixel [m].

const turn = 2 * Math.PI;

function stroke(ctx, view, color, pixels, dash = [], path = null) {
  ctx.strokeStyle = color;
  ctx.lineWidth = pixels * view.px;
  ctx.setLineDash(dash.map((d) => d * view.px));
  path ? ctx.stroke(path) : ctx.stroke();
  ctx.setLineDash([]);
}

// Draws upright text in any frame.
function text(ctx, view, words, x, y, color, { align = 'center', size = 11, sans = 'sans-serif', halo = null } = {}) {
  ctx.save();
  ctx.translate(x, y);
  ctx.scale(view.px, -view.px);
  ctx.font = `${size}px ${sans}`;
  ctx.textAlign = align;
  if (halo) {
    ctx.strokeStyle = halo;
    ctx.lineWidth = 4;
    ctx.lineJoin = 'round';
    ctx.strokeText(words, 0, 0);
  }
  ctx.fillStyle = color;
  ctx.fillText(words, 0, 0);
  ctx.restore();
}

// Returns 1, 2 or 5 times a power of ten, close to `size`.
export function round_step(size) {
  const power = 10 ** Math.floor(Math.log10(size));
  const rest = size / power;
  return (rest < 1.5 ? 1 : rest < 3.5 ? 2 : rest < 7.5 ? 5 : 10) * power;
}

// --- the surroundings ---

// `step`: distance of ticks without numbers [m]; null: ticks at round distances, with numbers.
export function table(ctx, view, height, units, theme, step = null) {
  ctx.fillStyle = theme.ground;
  ctx.fillRect(view.left, view.bottom, view.right - view.left, height - view.bottom);
  ctx.beginPath();
  ctx.moveTo(view.left, height);
  ctx.lineTo(view.right, height);
  stroke(ctx, view, theme['ground-edge'], 1.5);

  const { scale, label } = units.of('m');
  const apart = step ?? round_step((110 * view.px) * scale) / scale;
  ctx.beginPath();
  const ticks = [];
  for (let x = Math.ceil(view.left / apart) * apart; x <= view.right; x += apart) {
    ctx.moveTo(x, height);
    ctx.lineTo(x, height - 5 * view.px);
    ticks.push(x);
  }
  stroke(ctx, view, theme['ground-edge'], 1);
  const half = 24 * view.px;  // half a number's width, which the edge would cut
  for (const x of step ? [] : ticks.filter((x) => x > view.left + half && x < view.right - half))
    text(ctx, view, `${+(x * scale).toFixed(3)} ${label}`.replace('-', '−'), x, height - 17 * view.px, theme.quiet, theme);
}

export function track(ctx, view, t, theme, reach) {
  const from = Math.max(view.left, t.from + t.rear - 0.1 * reach);
  const to = Math.min(view.right, t.to + t.front);
  if (to <= from) return;
  const thick = 0.022 * reach;
  ctx.fillStyle = theme.ground;
  ctx.fillRect(from, t.height - thick, to - from, thick);
  ctx.beginPath();
  ctx.moveTo(from, t.height);
  ctx.lineTo(to, t.height);
  ctx.moveTo(from, t.height - thick);
  ctx.lineTo(to, t.height - thick);
  stroke(ctx, view, theme['ground-edge'], 1);
  if (t.to + t.front <= view.right) {  // the stop
    ctx.fillStyle = theme['ground-edge'];
    ctx.fillRect(t.to + t.front, t.height - 2 * thick, 0.02 * reach, 4.5 * thick);
  }
}

// Draws the trolley and the body below it, down to the first joint. `pose`: that of the body, which may be
// lifted.
export function body(ctx, view, spec, theme, reach, pose) {
  const width = 0.11 * reach;
  const top = body_top(spec, reach);
  if (spec.track) trolley(ctx, view, spec.track, theme, reach, pose);
  else mount(ctx, view, theme, reach, top);
  box(ctx, view, -width / 2, -0.04 * reach, width, top + 0.04 * reach, 0.02 * reach, theme.metal, theme['metal-edge']);
}

export function box(ctx, view, x, y, width, height, radius, fill, edge, line = 1) {
  ctx.beginPath();
  ctx.roundRect(x, y, width, height, radius);
  ctx.fillStyle = fill;
  ctx.fill();
  stroke(ctx, view, edge, line);
}

function trolley(ctx, view, t, theme, reach, pose) {
  const r = 0.028 * reach;
  const y = t.height - pose.y;  // the track does not rise with the body
  box(ctx, view, t.rear - 0.05 * reach, y + 1.1 * r, t.front - t.rear + 0.1 * reach, 0.06 * reach, 0.015 * reach,
      theme.metal, theme['metal-edge']);
  for (const x of [t.rear, t.front]) {
    ctx.beginPath();
    ctx.arc(x, y + r, r, 0, turn);
    ctx.fillStyle = theme.paper;
    ctx.fill();
    stroke(ctx, view, theme['metal-edge'], 1.5);
    const angle = -pose.x / r;
    ctx.beginPath();
    ctx.moveTo(x, y + r);
    ctx.lineTo(x + r * Math.cos(angle), y + r + r * Math.sin(angle));
    stroke(ctx, view, theme['metal-edge'], 1);
  }
}

function mount(ctx, view, theme, reach, top) {
  const y = top, half = 0.25 * reach;
  ctx.beginPath();
  ctx.moveTo(-half, y);
  ctx.lineTo(half, y);
  stroke(ctx, view, theme['metal-edge'], 2);
  ctx.beginPath();
  for (let x = -half; x < half; x += 0.05 * reach) {
    ctx.moveTo(x, y);
    ctx.lineTo(x + 0.04 * reach, y + 0.05 * reach);
  }
  stroke(ctx, view, theme['ground-edge'], 1);
}

// Returns the upper end of the body, in its own frame.
const body_top = (spec, reach) =>
  Math.max(0.3 * reach, ...spec.muscles.filter((m) => m.frame === 0).map((m) => m.anchor[1])) + 0.02 * reach;

// Returns the upper end of the cylinder above the body, while the body is not lifted.
export const cylinder_top = (spec, reach) => body_top(spec, reach) + 0.05 * reach + 2.3 * spec.cylinder.stroke;

// Draws the lifting cylinder on posts above the trolley. The body hangs on its rod; `pose.y` is the height
// by which it is lifted.
export function cylinder(ctx, view, spec, chambers, theme, reach, pose) {
  const { bore, stroke: travel } = spec.cylinder;
  const wide = Math.max(bore, 0.04 * reach), post = 0.17 * reach;
  const top = cylinder_top(spec, reach) - pose.y, bottom = top - 1.25 * travel;
  const plate = (spec.track?.height ?? 0.2 * reach) + 0.06 * reach - pose.y;
  ctx.beginPath();
  for (const side of [-1, 1]) {
    ctx.moveTo(side * post, plate);
    ctx.lineTo(side * post, bottom + 0.2 * travel);
    ctx.lineTo((side * wide) / 2, bottom + 0.2 * travel);
  }
  stroke(ctx, view, theme['metal-edge'], 1.5);
  const piston = bottom + 0.12 * travel + pose.y;
  ctx.fillStyle = chambers.up.color;  // the chamber below the piston lifts the body
  ctx.fillRect(-wide / 2, bottom, wide, piston - bottom);
  ctx.fillStyle = chambers.down.color;
  ctx.fillRect(-wide / 2, piston, wide, top - piston);
  ctx.beginPath();
  ctx.rect(-wide / 2, bottom, wide, top - bottom);
  stroke(ctx, view, theme['metal-edge'], 1.25);
  for (const [chamber, y] of [[chambers.up, bottom + 0.15 * travel], [chambers.down, top - 0.15 * travel]]) {
    const at = { anchor: [wide / 2, y], direction: [-1, 0] };
    chamber.valves.forEach((open, place) => open !== null && valve(ctx, view, at, place, open, theme, reach));
  }
  ctx.beginPath();
  ctx.moveTo(-wide / 2, piston);
  ctx.lineTo(wide / 2, piston);
  stroke(ctx, view, theme.paper, 3);
  ctx.beginPath();
  ctx.moveTo(0, piston);
  ctx.lineTo(0, body_top(spec, reach));
  stroke(ctx, view, theme['metal-edge'], 2.5);
}

// --- the leg ---

export function link(ctx, view, l, theme, reach) {
  const half = 0.024 * reach;
  box(ctx, view, -half, -half, l.length + 2 * half, 2 * half, half, theme.metal, theme['metal-edge']);
}

export function pin(ctx, view, theme, reach) {
  ctx.beginPath();
  ctx.arc(0, 0, 0.014 * reach, 0, turn);
  ctx.fillStyle = theme.paper;
  ctx.fill();
  stroke(ctx, view, theme['metal-edge'], 1.25);
}

export function cam(ctx, view, c, theme) {
  ctx.beginPath();
  c.outline.forEach(([x, y], i) => (i ? ctx.lineTo(x, y) : ctx.moveTo(x, y)));
  ctx.closePath();
  ctx.save();
  ctx.globalAlpha *= 0.75;
  ctx.fillStyle = theme.paper;
  ctx.fill();
  ctx.restore();
  stroke(ctx, view, theme['metal-edge'], 1.25);
  ctx.beginPath();  // spokes show the rotation
  for (let k = 0; k < 3; ++k) {
    const [x, y] = c.outline[Math.round((k * c.outline.length) / 3)];
    ctx.moveTo(0.35 * x, 0.35 * y);
    ctx.lineTo(0.8 * x, 0.8 * y);
  }
  stroke(ctx, view, theme['metal-edge'], 1);
}

// Draws the part that holds discs next to the link, from the link's joint to each of them.
export function sole(ctx, view, discs, theme) {
  if (discs.length < 2) return;
  ctx.beginPath();
  ctx.moveTo(0, 0);
  for (const d of discs) ctx.lineTo(...d.center);
  ctx.closePath();
  ctx.lineJoin = 'round';
  ctx.fillStyle = theme.metal;
  ctx.fill();
  stroke(ctx, view, theme['metal-edge'], 1.25);
}

export function disc(ctx, view, d, theme) {
  ctx.beginPath();
  ctx.arc(d.center[0], d.center[1], d.radius, 0, turn);
  ctx.fillStyle = theme.metal;
  ctx.fill();
  stroke(ctx, view, theme['metal-edge'], 1.25);
}

export function tendon(ctx, view, from, to, theme) {
  ctx.beginPath();
  ctx.moveTo(...from);
  ctx.lineTo(...to);
  stroke(ctx, view, theme.tendon, 1.25);
}

// --- a muscle ---

// Factor by which muscles are drawn thicker than they are, so that their swelling is visible.
export const thicker = 1.5;

// Draws a muscle with the diameter of its braid and crimped ends, and the tendon from it to the cam.
export function muscle(ctx, view, m, { length, diameter, color }, theme) {
  const end = [m.anchor[0] + m.direction[0] * length, m.anchor[1] + m.direction[1] * length];
  tendon(ctx, view, end, m.touch, theme);
  ctx.save();
  ctx.translate(...m.anchor);
  ctx.rotate(Math.atan2(m.direction[1], m.direction[0]));
  const half = (thicker * diameter) / 2, outline = tube(length, half);
  ctx.fillStyle = color;
  ctx.fill(outline);
  braid(ctx, view, length, half, outline);
  stroke(ctx, view, theme.ink, 1.1, [], outline);
  ctx.fillStyle = theme.ink;
  for (const x of [0, length]) ctx.fillRect(x - 0.02 * length, -0.45 * half, 0.04 * length, 0.9 * half);
  ctx.restore();
}

// Returns the outline of a muscle along x, from 0 to its length.
function tube(length, half) {
  const crimp = 0.08 * length, path = new Path2D();
  path.moveTo(0, 0.35 * half);
  path.bezierCurveTo(crimp, half, crimp, half, 2 * crimp, half);
  path.lineTo(length - 2 * crimp, half);
  path.bezierCurveTo(length - crimp, half, length - crimp, half, length, 0.35 * half);
  path.lineTo(length, -0.35 * half);
  path.bezierCurveTo(length - crimp, -half, length - crimp, -half, length - 2 * crimp, -half);
  path.lineTo(2 * crimp, -half);
  path.bezierCurveTo(crimp, -half, crimp, -half, 0, -0.35 * half);
  path.closePath();
  return path;
}

// Draws a few threads of the braid; their angle grows as the muscle shortens.
function braid(ctx, view, length, half, outline) {
  const threads = 9, step = length / threads;
  ctx.save();
  ctx.clip(outline);
  ctx.beginPath();
  for (let k = -1; k <= threads; ++k)
    for (const side of [1, -1]) {
      ctx.moveTo(k * step, side * half);
      ctx.lineTo((k + 1.6) * step, -side * half);
    }
  stroke(ctx, view, 'rgb(255 255 255 / .3)', 0.8);
  ctx.restore();
}

// Draws a valve behind the muscle's anchor: a triangle towards it for the inlet, away from it for the
// exhaust.
export function valve(ctx, view, m, place, open, theme, reach) {
  const s = 0.025 * reach;
  const color = place === 0 ? theme.inlet : theme.exhaust;
  ctx.save();
  ctx.translate(...m.anchor);
  ctx.rotate(Math.atan2(m.direction[1], m.direction[0]));
  ctx.translate(-1.35 * s, (place === 0 ? 1 : -1) * 0.75 * s);
  if (place === 1) ctx.rotate(Math.PI);
  ctx.beginPath();
  ctx.moveTo(0.55 * s, 0);
  ctx.lineTo(-0.55 * s, 0.6 * s);
  ctx.lineTo(-0.55 * s, -0.6 * s);
  ctx.closePath();
  if (open) {
    ctx.save();
    ctx.shadowColor = color;
    ctx.shadowBlur = 12;
    ctx.fillStyle = color;
    ctx.fill();
    ctx.restore();
  } else {
    ctx.fillStyle = theme.paper;
    ctx.fill();
  }
  stroke(ctx, view, open ? color : theme.unlit, 1.25);
  ctx.restore();
}

// --- overlays ---

export function trail(ctx, view, points, color, dash) {
  if (points.length < 2) return;
  const parts = dash.length ? 1 : 12;  // parts of increasing opacity; dashes would restart at each part
  ctx.save();
  ctx.lineCap = 'round';
  ctx.lineJoin = 'round';
  for (let k = 0; k < parts; ++k) {
    const from = Math.floor((k * (points.length - 1)) / parts);
    const to = Math.floor(((k + 1) * (points.length - 1)) / parts);
    ctx.globalAlpha = parts === 1 ? 0.9 : 0.15 + (0.85 * (k + 1)) / parts;
    ctx.beginPath();
    let drawing = false;
    for (let i = from; i <= to; ++i) {
      const [x, y] = points[i];
      if (!Number.isFinite(x) || !Number.isFinite(y)) { drawing = false; continue; }
      drawing ? ctx.lineTo(x, y) : ctx.moveTo(x, y);
      drawing = true;
    }
    stroke(ctx, view, color, 2, dash);
  }
  const [x, y] = points.at(-1);
  if (Number.isFinite(x) && dash.length) {  // the desired position
    ctx.globalAlpha = 1;
    ctx.beginPath();
    ctx.arc(x, y, 4 * view.px, 0, turn);
    stroke(ctx, view, color, 2);
  }
  ctx.restore();
}

export function arrow(ctx, view, from, along, words, theme) {
  const length = Math.hypot(...along), u = [along[0] / length, along[1] / length];
  const head = Math.min(11 * view.px, 0.5 * length);
  const to = [from[0] + along[0], from[1] + along[1]];
  const neck = [to[0] - head * u[0], to[1] - head * u[1]];
  ctx.beginPath();
  ctx.moveTo(...from);
  ctx.lineTo(...neck);
  stroke(ctx, view, theme.force, 3);
  ctx.beginPath();
  ctx.moveTo(...to);
  ctx.lineTo(neck[0] - 0.45 * head * u[1], neck[1] + 0.45 * head * u[0]);
  ctx.lineTo(neck[0] + 0.45 * head * u[1], neck[1] - 0.45 * head * u[0]);
  ctx.closePath();
  ctx.fillStyle = theme.force;
  ctx.fill();
  text(ctx, view, words, to[0] + 8 * view.px, to[1] + 2 * view.px, theme.force, { align: 'left', size: 12, sans: theme.sans, halo: theme.paper });
}

// Draws a scale bar at the lower right, in pixels.
export function scale_bar(ctx, view, units, theme, width, height) {
  const { scale, label } = units.of('m');
  const meters = round_step((90 * view.px) * scale) / scale;
  const length = meters / view.px, x = width - 16 - length, y = height - 14;
  ctx.strokeStyle = theme.quiet;
  ctx.lineWidth = 1.5;
  ctx.beginPath();
  ctx.moveTo(x, y - 3);
  ctx.lineTo(x, y);
  ctx.lineTo(x + length, y);
  ctx.lineTo(x + length, y - 3);
  ctx.stroke();
  ctx.fillStyle = theme.quiet;
  ctx.font = `11px ${theme.sans}`;
  ctx.textAlign = 'center';
  ctx.fillText(`${+(meters * scale).toPrecision(3)} ${label}`, x + length / 2, y - 6);
}
