// Values of a formula, at the times of its channel with the most samples. Channels with other times
// contribute their last value before each time.

const apply = {
  '+': (a, b) => a + b,
  '-': (a, b) => a - b,
  '*': (a, b) => a * b,
  '/': (a, b) => a / b,
  min: (a, b) => (a !== a || b !== b ? NaN : Math.min(a, b)),
  max: (a, b) => (a !== a || b !== b ? NaN : Math.max(a, b)),
  abs: Math.abs, sqrt: Math.sqrt, sin: Math.sin, cos: Math.cos,
};

function resampled(column, time) {
  const out = new Float64Array(time.length).fill(NaN);
  for (let i = 0, k = -1; i < time.length; ++i) {
    while (k + 1 < column.time.length && column.time[k + 1] <= time[i]) ++k;
    if (k >= 0) out[i] = column.values[k];
  }
  return out;
}

// Returns central differences; at the ends and next to a gap, one-sided ones.
function derivative(time, v) {
  const out = new Float64Array(v.length).fill(NaN);
  for (let i = 0; i < v.length; ++i) {
    if (v[i] !== v[i]) continue;
    const from = i > 0 && v[i - 1] === v[i - 1] ? i - 1 : i, to = i + 1 < v.length && v[i + 1] === v[i + 1] ? i + 1 : i;
    if (time[to] > time[from]) out[i] = (v[to] - v[from]) / (time[to] - time[from]);
  }
  return out;
}

// Integrates by trapezoids; a gap adds nothing.
function integral(time, v) {
  const out = new Float64Array(v.length);
  for (let i = 0, sum = 0; i < v.length; ++i) {
    const part = i > 0 ? 0.5 * (v[i] + v[i - 1]) * (time[i] - time[i - 1]) : 0;
    if (part === part) sum += part;
    out[i] = v[i] === v[i] ? sum : NaN;
  }
  return out;
}

// Returns the mean over a window about each time. At the ends the window is shortened on both sides, so
// that a straight line keeps its slope.
function moving_mean(time, v, window) {
  const sums = new Float64Array(v.length + 1), counts = new Uint32Array(v.length + 1);
  for (let i = 0; i < v.length; ++i) {
    const there = v[i] === v[i];
    sums[i + 1] = sums[i] + (there ? v[i] : 0);
    counts[i + 1] = counts[i] + (there ? 1 : 0);
  }
  const out = new Float64Array(v.length).fill(NaN), slack = 1e-9, end = v.length - 1;
  for (let i = 0, from = 0, to = 0; i < v.length; ++i) {
    const half = Math.min(window / 2, time[i] - time[0], time[end] - time[i]) + slack;
    // Near the start the window grows as fast as it advances, so its beginning never moves back.
    while (time[from] < time[i] - half) ++from;
    to = Math.max(to, i);
    while (to < end && time[to + 1] <= time[i] + half) ++to;
    while (to > i && time[to] > time[i] + half) --to;
    const n = counts[to + 1] - counts[from];
    if (n && v[i] === v[i]) out[i] = (sums[to + 1] - sums[from]) / n;
  }
  return out;
}

function each(does, time, args) {
  if (args.every((a) => typeof a === 'number')) return does(...args);
  const [a, b] = args.map((v) => (typeof v === 'number' ? () => v : (i) => v[i]));
  return Float64Array.from(time, b ? (t, i) => does(a(i), b(i)) : (t, i) => does(a(i)));
}

function evaluate(node, time, column_of) {
  switch (node.kind) {
    case 'number':
      return node.value;
    case 'channel': {
      const column = column_of(node.id);
      return column.time === time ? column.values : resampled(column, time);
    }
    case 'minus':
      return each((a) => -a, time, [evaluate(node.a, time, column_of)]);
    case 'op':
      return each(apply[node.op], time, [evaluate(node.a, time, column_of), evaluate(node.b, time, column_of)]);
  }
  const args = node.args.map((arg) => evaluate(arg, time, column_of));
  const line = (v) => (typeof v === 'number' ? new Float64Array(time.length).fill(v) : v);
  switch (node.name) {
    case 'deriv':
      return derivative(time, line(args[0]));
    case 'integral':
      return integral(time, line(args[0]));
    case 'mean':
      return moving_mean(time, line(args[0]), args[1]);
  }
  return each(apply[node.name], time, args);
}

// `formula`: result of parse_formula(); `column_of` returns a channel's { time, values }.
export function column_of_formula(formula, column_of) {
  const clocks = formula.ids.map((id) => column_of(id).time);
  const time = clocks.reduce((most, c) => (c.length > most.length ? c : most));
  return { time, values: evaluate(formula.tree, time, column_of) };
}
