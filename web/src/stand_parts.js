// Shapes of the test stand, in pixels. `v` transforms meters to pixels (stand.js).

import { box as box_in, round_step } from './shapes.js';

const turn = 2 * Math.PI, pixels = { px: 1 };

const box = (ctx, x, y, width, height, radius, fill, edge, line = 1.25) =>
  box_in(ctx, pixels, x, y, width, height, radius, fill, edge, line);

function lines(ctx, color, width, ...points) {
  ctx.beginPath();
  points.forEach(([x, y], i) => (i ? ctx.lineTo(x, y) : ctx.moveTo(x, y)));
  ctx.strokeStyle = color;
  ctx.lineWidth = width;
  ctx.lineJoin = 'round';
  ctx.stroke();
}

function words(ctx, text, x, y, color, theme, { align = 'left', size = 12, weight = 400 } = {}) {
  ctx.font = `${weight} ${size}px ${theme.sans}`;
  ctx.textAlign = align;
  ctx.lineJoin = 'round';
  ctx.lineWidth = 4;
  ctx.strokeStyle = theme.paper;
  ctx.strokeText(text, x, y);
  ctx.fillStyle = color;
  ctx.fillText(text, x, y);
}

// Returns the width of a pointer's text.
export function width(ctx, text, theme) {
  ctx.font = `600 12px ${theme.sans}`;
  return ctx.measureText(text).width;
}

function hatch(ctx, x, y, width, tall, color) {
  ctx.save();
  ctx.beginPath();
  ctx.rect(x, y, width, tall);
  ctx.clip();
  ctx.beginPath();
  for (let at = x - tall; at < x + width; at += 8) {
    ctx.moveTo(at, y + tall);
    ctx.lineTo(at + tall, y);
  }
  ctx.strokeStyle = color;
  ctx.lineWidth = 1;
  ctx.stroke();
  ctx.restore();
}

// --- fixed parts ---

const frame = 0.36;  // distance of the columns from the axis, as a share of the reach

export function beam(ctx, v, alone, theme) {
  const half = v.px((alone ? frame - 0.06 : frame + 0.06) * v.reach), tall = v.px(0.045 * v.reach), y = v.y(-0.03 * v.reach) - tall;
  hatch(ctx, v.x(0) - half, y - 9, 2 * half, 9, theme['ground-edge']);
  box(ctx, v.x(0) - half, y, 2 * half, tall, 2, theme.metal, theme['metal-edge']);
}

// Draws the columns of the machine that prescribes the length.
export function columns(ctx, v, most, theme) {
  const from = v.y(-0.03 * v.reach), to = v.y(v.zero + most + 0.3 * v.reach), wide = v.px(0.035 * v.reach);
  for (const side of [-1, 1])
    box(ctx, v.x(side * frame * v.reach) - wide / 2, from, wide, to - from, 2, theme.ground, theme['ground-edge'], 1);
  const half = v.px((frame + 0.06) * v.reach);
  box(ctx, v.x(0) - half, to, 2 * half, v.px(0.045 * v.reach), 2, theme.metal, theme['metal-edge']);
}

// Draws a ruler from zero length down to `to`; it is thicker between the shortest and the longest length.
export function ruler(ctx, v, x, { to, shortest, longest, unit, label }, theme) {
  const y = (m) => v.y(v.zero + m);
  if (longest > 0) {
    ctx.fillStyle = theme.edge;
    ctx.fillRect(x - 3, y(shortest), 6, y(longest) - y(shortest));
  }
  lines(ctx, theme['ground-edge'], 1.25, [x, y(0)], [x, y(to)]);
  const step = round_step((46 / v.px(1)) / unit);
  for (let i = 0; i * step * unit <= to * 1.0001; ++i) {
    const at = y(i * step * unit);
    lines(ctx, theme['ground-edge'], 1, [x - 6, at], [x, at]);
    words(ctx, String(+(i * step).toPrecision(6)), x - 10, at + 4, theme.quiet, theme, { align: 'right', size: 11 });
  }
  words(ctx, label, x - 10, y(0) - 12, theme.quiet, theme, { align: 'right', size: 11 });
}

// Draws a line from the ruler to the element's end, with text above (-1) or below it (1).
export function pointer(ctx, v, x, length, color, dash, text, theme, side) {
  if (!Number.isFinite(length)) return;
  const y = v.y(v.zero + length);
  ctx.setLineDash(dash);
  lines(ctx, color, dash.length ? 1.5 : 1.25, [x, y], [v.x(-0.02 * v.reach), y]);
  ctx.setLineDash([]);
  if (!text) return;
  ctx.beginPath();
  ctx.moveTo(x, y);
  ctx.lineTo(x + 9, y - 5);
  ctx.lineTo(x + 9, y + 5);
  ctx.closePath();
  ctx.fillStyle = color;
  ctx.fill();
  words(ctx, text, x + 14, side < 0 ? y - 6 : y + 15, color, theme, { weight: 600 });
}

// --- air supply ---

// Draws a valve as two triangles that meet; filled while it is open.
function valve(ctx, x, y, size, open, color, theme) {
  ctx.beginPath();
  ctx.moveTo(x - size, y - 0.6 * size);
  ctx.lineTo(x + size, y + 0.6 * size);
  ctx.lineTo(x + size, y - 0.6 * size);
  ctx.lineTo(x - size, y + 0.6 * size);
  ctx.closePath();
  ctx.save();
  if (open) {
    ctx.shadowColor = color;
    ctx.shadowBlur = 14;
  }
  ctx.fillStyle = open ? color : theme.paper;
  ctx.fill();
  ctx.restore();
  ctx.strokeStyle = open ? color : theme.unlit;
  ctx.lineWidth = 1.5;
  ctx.stroke();
}

export function feed(ctx, v, spec, state, theme) {
  const y = v.y(0), from = v.x(0), s = Math.max(6, 0.028 * v.unit);
  const to = v.x((frame + 0.16) * v.reach);
  const pipe = (...points) => lines(ctx, theme.tendon, 2, ...points);
  if (spec.air === 'sealed') {
    const end = v.x(0.17 * v.reach);
    pipe([from, y], [end, y]);
    lines(ctx, theme.ink, 4, [end, y - 7], [end, y + 7]);
    return words(ctx, 'sealed', end + 9, y + 4, theme.quiet, theme);
  }
  if (spec.air === 'regulated') {
    pipe([from, y], [to, y]);
    ctx.beginPath();
    ctx.arc(to + 1.4 * s, y, 1.4 * s, 0, turn);
    ctx.fillStyle = state.color;
    ctx.fill();
    ctx.strokeStyle = theme['metal-edge'];
    ctx.lineWidth = 1.5;
    ctx.stroke();
    return words(ctx, 'regulator', to + 3.4 * s, y + 4, theme.quiet, theme);
  }
  // One branch leads up to the supply, one down to the room.
  const fork = v.x((frame + 0.11) * v.reach), apart = Math.max(15, 0.07 * v.unit), end = to + 4 * s;
  pipe([from, y], [fork, y]);
  const both = spec.air === '3-way';
  const branches = [['inlet', -1, 'supply']];
  if (both || spec.exhaust !== null) branches.push(['exhaust', 1, 'room']);
  for (const [which, side, name] of branches) {
    const at = y + side * apart;
    pipe([fork, y], [fork, at], [end, at]);
    valve(ctx, to + 1.5 * s, at, s, state[which], theme[which], theme);
    words(ctx, name, end + 5, at + 4, state[which] ? theme[which] : theme.quiet, theme, { weight: state[which] ? 600 : 400 });
  }
  if (!both) return;
  ctx.setLineDash([3, 3]);
  ctx.beginPath();
  ctx.roundRect(fork - 5, y - apart - 1.2 * s, to + 3 * s - fork + 5, 2 * apart + 2.4 * s, 4);
  ctx.strokeStyle = theme.quiet;
  ctx.lineWidth = 1;
  ctx.stroke();
  ctx.setLineDash([]);
}

// --- elements ---

function fitting(ctx, x, y, width, theme) {
  box(ctx, x - width / 2, y - 0.35 * width, width, 0.7 * width, 2, theme.ink, theme.ink);
}

export function element(ctx, v, spec, state, theme) {
  if (spec.bore > 0) cylinder(ctx, v, spec, state, theme);
  else actuators(ctx, v, spec, state, theme);
}

// Draws `spec.count` actuators side by side between two fittings.
function actuators(ctx, v, spec, state, theme) {
  const length = Math.max(0.02 * v.reach, Math.min(state.length, 1.3 * v.reach));
  const diameter = Number.isFinite(state.diameter) ? state.diameter : 0.02 * v.reach;
  const top = v.y(0), bottom = v.y(length), half = v.px(diameter) / 2, n = spec.count;
  const apart = 2.2 * half;
  lines(ctx, theme['metal-edge'], 3, [v.x(0), v.y(-0.03 * v.reach)], [v.x(0), top]);
  for (let k = 0; k < n; ++k) {
    const x = v.x(0) + (k - (n - 1) / 2) * apart;
    tube(ctx, x, top, bottom, half, spec.turns, state.color, theme);
  }
  const wide = Math.max(0.9 * half, 6) + (n - 1) * apart;
  for (const y of [top, bottom]) {
    if (n > 1) box(ctx, v.x(0) - wide / 2, y - 4, wide, 8, 2, theme.ink, theme.ink);
    else fitting(ctx, v.x(0), y, wide, theme);
  }
}

// Returns half the width of a tube at a share of its length; its ends taper to the fittings.
function half_at(share, half, taper) {
  const end = Math.min(share, 1 - share) / taper;
  return half * (end >= 1 ? 1 : 0.4 + 0.6 * Math.sin((0.5 * Math.PI * end)));
}

function tube(ctx, x, top, bottom, half, turns, color, theme) {
  const tall = bottom - top, taper = Math.min(0.3, (1.3 * half) / tall), steps = 60;
  const outline = new Path2D();
  for (const side of [1, -1])
    for (let i = 0; i <= steps; ++i) {
      const share = side > 0 ? i / steps : 1 - i / steps;
      const px = x + side * half_at(share, half, taper), py = top + share * tall;
      i || side < 0 ? outline.lineTo(px, py) : outline.moveTo(px, py);
    }
  outline.closePath();
  ctx.fillStyle = color;
  ctx.fill(outline);
  ctx.save();
  ctx.clip(outline);
  // Shading makes the tube theme round.
  const shade = ctx.createLinearGradient(x - half, 0, x + half, 0);
  shade.addColorStop(0, 'rgb(0 0 0 / .34)');
  shade.addColorStop(0.35, 'rgb(255 255 255 / .10)');
  shade.addColorStop(1, 'rgb(0 0 0 / .38)');
  ctx.fillStyle = shade;
  ctx.fillRect(x - half, top, 2 * half, tall);
  threads(ctx, x, top, tall, half, taper, turns);
  ctx.restore();
  ctx.strokeStyle = theme.ink;
  ctx.lineWidth = 1.25;
  ctx.stroke(outline);
}

// Draws the front halves of some threads of both directions, with their true number of turns.
function threads(ctx, x, top, tall, half, taper, turns) {
  const count = 10, steps = 140;
  ctx.lineWidth = 1;
  ctx.strokeStyle = 'rgb(255 255 255 / .55)';
  for (const hand of [1, -1])
    for (let k = 0; k < count; ++k) {
      ctx.beginPath();
      let drawing = false;
      for (let i = 0; i <= steps; ++i) {
        const share = i / steps, angle = turn * (hand * (turns || 2) * share + k / count);
        if (Math.cos(angle) < -0.02) { drawing = false; continue; }
        const px = x + half_at(share, half, taper) * Math.sin(angle), py = top + share * tall;
        drawing ? ctx.lineTo(px, py) : ctx.moveTo(px, py);
        drawing = true;
      }
      ctx.stroke();
    }
}

// Draws a cylinder whose rod is extended by `length` below it. The air on the rod's side retracts it.
function cylinder(ctx, v, spec, state, theme) {
  const wide = v.px(spec.bore), rod = Math.max(2, v.px(spec.rod)), x = v.x(0);
  const top = v.y(0), bottom = v.y(v.barrel), wall = v.px(0.1 * spec.stroke);
  const piston = bottom - wall - v.px(spec.stroke - state.length), thick = Math.max(5, v.px(0.06 * spec.stroke));
  lines(ctx, theme['metal-edge'], 3, [x, v.y(-0.03 * v.reach)], [x, top]);
  ctx.fillStyle = theme.paper;
  ctx.fillRect(x - wide / 2, top, wide, bottom - top);
  ctx.fillStyle = state.color;
  ctx.fillRect(x - wide / 2, piston, wide, bottom - wall - piston);
  box(ctx, x - rod / 2, piston, rod, v.y(v.zero + state.length) - piston, 0, theme.metal, theme['metal-edge'], 1);
  box(ctx, x - wide / 2, piston - thick, wide, thick, 1, theme.metal, theme['metal-edge']);
  box(ctx, x - wide / 2, bottom - wall, wide, wall, 1, theme.metal, theme['metal-edge']);
  ctx.beginPath();
  ctx.roundRect(x - wide / 2, top, wide, bottom - top, 3);
  ctx.strokeStyle = theme['metal-edge'];
  ctx.lineWidth = 1.75;
  ctx.stroke();
}

// --- load ---

const below = 0.07;  // distance from the element's end to the load, as a share of the reach

export function load_cell(ctx, v, length, text, theme) {
  const y = v.y(v.zero + length), x = v.x(0), s = v.px(0.03 * v.reach);
  lines(ctx, theme['metal-edge'], 2.5, [x, y], [x, y + v.px(below * v.reach) + 2]);
  box(ctx, x - s, y + 0.6 * s, 2 * s, 1.3 * s, 2, theme.paper, theme.force, 1.75);
  words(ctx, text, x + s + 8, y + 1.25 * s + 4, theme.force, theme, { weight: 600 });
}

// Draws the hanging load as plates of one step of load each; the topmost may be partly applied.
export function weights(ctx, v, spec, state, text, theme) {
  const top = v.y(v.zero + state.length + below * v.reach), x = v.x(0);
  const whole = v.px(0.3 * v.reach), wide = v.px(0.36 * v.reach);
  const tall = spec.heaviest > 0 ? (whole * Math.max(0, state.weight)) / spec.heaviest : 0;
  lines(ctx, theme['metal-edge'], 2.5, [x, top], [x, top + whole]);
  const bottom = top + whole + 3;
  box(ctx, x - wide / 2, bottom - tall, wide, tall, 2, theme.metal, theme['metal-edge'], 1.5);
  const step = spec.weight_step > 0 ? (whole * spec.weight_step) / spec.heaviest : 0;
  if (step > 4)
    for (let y = bottom - step; y > bottom - tall + 1; y -= step)
      lines(ctx, theme['metal-edge'], 1, [x - wide / 2, y], [x + wide / 2, y]);
  box(ctx, x - 0.6 * wide, bottom, 1.2 * wide, 4, 2, theme.ink, theme.ink);
  words(ctx, text, x + 0.6 * wide + 10, bottom - 4, theme.ink, theme, { weight: 600 });
}

// Draws the crosshead between the columns: driven, or clamped if the length is fixed.
export function crosshead(ctx, v, spec, length, theme) {
  const y = v.y(v.zero + length + below * v.reach), half = v.px((frame + 0.05) * v.reach), tall = Math.max(19, v.px(0.06 * v.reach));
  box(ctx, v.x(0) - half, y, 2 * half, tall, 2, theme.metal, theme['metal-edge'], 1.5);
  const text = spec.load === 'clamped' ? 'clamped' : 'driven';
  words(ctx, text, v.x(0), y + tall / 2 + 4, theme.quiet, { ...theme, paper: theme.metal }, { align: 'center' });
}
