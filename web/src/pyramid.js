// Minima and maxima of a column over 16, 32, 64, … samples. With them a plot of any length shows every
// peak with two points per pixel.

const finest = 16;

// One level: minimum and maximum of each bucket, and whether the minimum came first.
function level_of(low, high, first_low, count) {
  return { low, high, first_low, count };
}

function base_level(values) {
  const count = Math.ceil(values.length / finest);
  const low = new Float32Array(count), high = new Float32Array(count);
  const first_low = new Uint8Array(count);
  for (let b = 0; b < count; ++b) {
    const end = Math.min(values.length, (b + 1) * finest);
    let least = NaN, most = NaN, at_least = 0, at_most = 0;
    for (let i = b * finest; i < end; ++i) {
      const v = values[i];
      if (v !== v) continue;
      if (!(v >= least)) { least = v; at_least = i; }
      if (!(v <= most)) { most = v; at_most = i; }
    }
    low[b] = least;
    high[b] = most;
    first_low[b] = at_least <= at_most ? 1 : 0;
  }
  return level_of(low, high, first_low, count);
}

function next_level(below) {
  const count = Math.ceil(below.count / 2);
  const low = new Float32Array(count), high = new Float32Array(count);
  const first_low = new Uint8Array(count);
  for (let b = 0; b < count; ++b) {
    const i = 2 * b, j = Math.min(i + 1, below.count - 1);
    const low_in_i = !(below.low[j] < below.low[i]), high_in_i = !(below.high[j] > below.high[i]);
    low[b] = low_in_i && below.low[i] === below.low[i] ? below.low[i] : below.low[j];
    high[b] = high_in_i && below.high[i] === below.high[i] ? below.high[i] : below.high[j];
    first_low[b] = low_in_i === high_in_i ? below.first_low[low_in_i ? i : j] : low_in_i ? 1 : 0;
  }
  return level_of(low, high, first_low, count);
}

export function pyramid(values) {
  const levels = [base_level(values)];
  while (levels.at(-1).count > 64) levels.push(next_level(levels.at(-1)));
  return levels;
}

// Returns the finest level with at most one bucket per pixel for `samples` samples; -1: use the samples.
export function level_for(samples, pixels, levels) {
  if (samples <= 3 * pixels) return -1;
  let level = 0;
  while (level + 1 < levels && samples / (finest << level) > pixels) ++level;
  return level;
}

export const bucket_size = (level) => finest << level;
