// Samples of a run: base64 of zlib of columns, in the format described in sinew/report/page/content.h.

const ticks_per_second = 10000;

function from_base64(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const bytes = atob(text);
  const out = new Uint8Array(bytes.length);
  for (let i = 0; i < bytes.length; ++i) out[i] = bytes.charCodeAt(i);
  return out;
}

async function inflate(packed) {
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Reads numbers whose bytes are grouped by significance, the lowest bytes first.
function words(bytes, at, count) {
  const out = new Uint32Array(count);
  const b = at + count, c = b + count, d = c + count;
  for (let i = 0; i < count; ++i)
    out[i] = bytes[at + i] | (bytes[b + i] << 8) | (bytes[c + i] << 16) | (bytes[d + i] << 24);
  return out;
}

function times(bytes, at, count) {
  const steps = new Int32Array(words(bytes, at, count).buffer);
  const out = new Float64Array(count);
  for (let i = 0, tick = 0; i < count; ++i) out[i] = (tick += steps[i]) / ticks_per_second;
  return out;
}

// Returns columns as { time, values }; columns of one clock share their times.
export async function read_samples(layout, base64) {
  const bytes = await inflate(from_base64(base64));
  let at = 0;
  const clocks = layout.clocks.map((count) => {
    const time = times(bytes, at, count);
    at += 4 * count;
    return time;
  });
  return layout.columns.map((clock) => {
    const time = clocks[clock];
    const values = new Float32Array(words(bytes, at, time.length).buffer);
    at += 4 * time.length;
    return { time, values };
  });
}

// Returns the index of the last time that is not after t; -1 before the first.
export function index_at(time, t) {
  let low = 0, high = time.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (time[middle] <= t) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

// Returns the last value not after t; NaN before the first.
export function held(column, t) {
  const i = index_at(column.time, t);
  return i < 0 ? NaN : column.values[i];
}

// Interpolates linearly between two samples. Before the first and after the last, returns that one.
export function between(column, t) {
  const { time, values } = column;
  const i = index_at(time, t);
  if (i < 0) return values[0];
  if (i + 1 >= time.length) return values[i];
  const share = (t - time[i]) / (time[i + 1] - time[i]);
  const a = values[i], b = values[i + 1];
  return share > 0 ? a + share * (b - a) : a;
}

// Returns whether a valve with these edges (1 opens, 0 closes) was open at any time in [from, to].
export function open_within(column, from, to) {
  const i = index_at(column.time, to);
  if (i < 0) return false;
  if (column.values[i] > 0) return true;
  return column.time[i] >= from;  // it closed within the interval, so it was open before
}
