// Range and ticks of an axis. The range is not narrowed to noise and not widened by an outlying first
// sample; ticks are round numbers.

// Smallest span of values that counts as a change, by SI unit; anything below is noise.
const least_span = {
  rad: 1e-4, 'rad/s': 1e-3, 'rad/s^2': 1e-2, N: 1e-2, Pa: 10, 'Pa diff': 10, 'Pa abs': 10, 'Pa gauge': 10, m: 1e-5, 'm/s': 1e-4,
  'm/s^2': 1e-3, kg: 1e-8, 'kg/s': 1e-8, share: 1e-3, 'N m': 1e-4, 'N m/rad': 1e-4, 'N/m': 1e-2, count: 0.5, s: 1e-6, V: 1e-5,
};
const share_of_size = 1e-5;  // of a large value: error of single precision and of a solver

// Returns whether the difference of two values is no more than noise. `scale`: shown unit per SI unit.
function is_at_rest(low, high, unit, scale) {
  return high - low <= Math.max((least_span[unit] ?? 1e-9) * scale, share_of_size * Math.max(Math.abs(low), Math.abs(high)));
}

// Returns the range of an axis for values from `low` to `high`; null where no value is finite.
// `unit`: SI unit of the quantity. `scale`: shown unit per SI unit.
export function range_of(low, high, unit, scale = 1) {
  if (low === null || !Number.isFinite(low) || !Number.isFinite(high)) return [0, 1];
  if (!is_at_rest(low, high, unit, scale)) {
    const room = 0.06 * (high - low);
    return [low - room, high + room];
  }
  // A constant is drawn in the middle. The axis about a zero spans a fixed amount of its unit.
  const middle = (low + high) / 2, least = 20 * (least_span[unit] ?? 1e-9) * scale;
  const size = Math.abs(middle) < least ? least : 0.1 * Math.abs(middle);
  const about = Math.abs(middle) < least / 10 ? 0 : middle;
  return [about - size, about + size];
}

const most_of_start = 0.02;  // of all samples
const jump = 0.5;            // of the span of all other samples

// Returns the number of equal samples at the start to ignore when an axis is scaled: a value from before
// the first reading, or the first step of an estimate. They are far from all later values.
export function spoiling_start({ values }, unit) {
  const most = Math.max(1, Math.floor(most_of_start * values.length));
  const first = values[0];
  if (first !== first || values.length < 20) return 0;
  let count = 1;
  while (count <= most && values[count] === first) ++count;
  if (count > most) return 0;
  let low = Infinity, high = -Infinity;
  for (let i = count; i < values.length; ++i) {
    if (values[i] < low) low = values[i];
    if (values[i] > high) high = values[i];
  }
  if (!(low <= high) || is_at_rest(low, high, unit, 1)) return 0;
  const outside = Math.max(low - first, first - high), step = Math.abs(values[count] - first);
  return outside > jump * (high - low) && step > jump * (high - low) ? count : 0;
}

// Returns round values within a range, `about` that many, where uPlot does not choose them.
export function ticks(low, high, about) {
  if (!(high > low)) return [low];
  const raw = (high - low) / Math.max(1, about), size = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((k) => k * size).find((k) => k >= raw * (1 - 1e-9));
  return ticks_by(low, high, step);
}

const fewest = 3;       // numbers on an axis
const closest = 13;     // distance of two numbers on a vertical axis [px]
const round = [1, 2, 5], less_round = [1, 1.5, 2, 2.5, 3, 4, 5, 6, 8];

function ticks_by(low, high, step) {
  const out = [];
  for (let k = Math.ceil(low / step - 1e-9); k <= high / step + 1e-9; ++k) out.push(+(k * step).toPrecision(12) || 0);
  return out;
}

// Returns the largest step with one of these mantissas that gives enough numbers without crowding them.
function step_for(low, high, pixels, mantissas) {
  const size = 10 ** Math.floor(Math.log10(high - low));
  const steps = [size, size / 10].flatMap((s) => mantissas.map((m) => m * s)).sort((a, b) => b - a);
  return steps.find((s) => ticks_by(low, high, s).length >= fewest && (s / (high - low)) * pixels >= closest);
}

// Returns the numbers of a vertical axis of `pixels`: at the usual step, or at a smaller one where the
// usual step leaves fewer than three numbers, as on a low plot. Less round steps are tried last.
export function upright_ticks(low, high, usual_step, pixels) {
  const usual = ticks_by(low, high, usual_step);
  if (usual.length >= fewest || !(high > low)) return usual;
  const step = step_for(low, high, pixels, round) ?? step_for(low, high, pixels, less_round);
  return step ? ticks_by(low, high, step) : usual;
}
