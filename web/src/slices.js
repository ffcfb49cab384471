// Data that a plot draws of its columns: every sample in view, or the minimum and maximum of every pixel
// if there are too many, in the units shown.
import uPlot from 'uplot';
import { index_at } from './samples.js';

const finest = 16;  // smallest bucket

// Returns the size of a bucket with which `samples` samples have at most one bucket per pixel; 0: draw the
// samples. Sizes are powers of two, so that buckets stay the same while the view is moved.
export function bucket_size(samples, pixels) {
  if (samples <= 3 * pixels) return 0;
  let size = finest;
  while (samples / size > pixels) size *= 2;
  return size;
}

// Returns the minimum and the maximum of values[from] to values[to - 1], the earlier one first; NaN if all
// are NaN.
export function extremes(values, from, to) {
  let low = NaN, high = NaN, at_low = 0, at_high = 0;
  for (let i = from; i < to; ++i) {
    const v = values[i];
    if (v !== v) continue;
    if (!(v >= low)) low = v, at_low = i;
    if (!(v <= high)) high = v, at_high = i;
  }
  return at_low <= at_high ? [low, high] : [high, low];
}

const block = 256;  // samples of a pair of extremes that is kept
const kept = new WeakMap();  // pairs of a column's full blocks, by the buffer of its values

// Returns the extremes of each full block, as extremes() does. A column that grows keeps its buffer and its
// samples, or moves to a larger buffer.
function pairs_of(values) {
  if (!kept.has(values.buffer)) kept.set(values.buffer, []);
  const pairs = kept.get(values.buffer);
  for (let at = (pairs.length / 2) * block; at + block <= values.length; at += block) pairs.push(...extremes(values, at, at + block));
  return pairs;
}

// Returns the extremes of a bucket. Those of a large one come from its blocks: in the view of an hour at full
// rate, millions of samples would delay each move.
function of_bucket(values, from, to) {
  if (to - from < 2 * block || to % block || values.byteOffset) return extremes(values, from, to);
  return extremes(pairs_of(values), (2 * from) / block, (2 * to) / block);
}

const in_unit = (value, { scale, offset }) => (value === value ? (value + offset) * scale : null);

export class Slices {
  // Columns may have different clocks.
  constructor(columns) {
    this.columns = columns;
    const clocks = [...new Set(columns.map((c) => c.time))];
    this.clocks = clocks.map((time) => {
      const lines = columns.map((c, i) => i).filter((i) => columns[i].time === time);
      return { time, lines };
    });
    // Position of each column in the data of all clocks, one clock after the other.
    const order = this.clocks.flatMap((c) => c.lines);
    this.places = columns.map((c, i) => order.indexOf(i));
  }

  // Returns data for uPlot: times, then a line per column. A column is undefined at times of other clocks,
  // and null, a gap, where it is NaN. `unit`: one for all columns, or a list.
  of(view, pixels, unit) {
    if (!this.clocks.length) return [[]];
    const units = Array.isArray(unit) ? unit : this.columns.map(() => unit);
    const tables = this.clocks.map((clock) => this.of_clock(clock, view, pixels, units));
    if (tables.length === 1) return tables[0];
    const [time, ...lines] = uPlot.join(tables);
    return [time, ...this.places.map((place) => lines[place])];
  }

  // Returns the samples in view and one on either side.
  of_clock({ time, lines }, [from, to], pixels, units) {
    const first = Math.max(0, index_at(time, from));
    const last = Math.min(time.length, index_at(time, to) + 2);
    const size = bucket_size(last - first, pixels);
    if (size) return this.buckets(time, lines, first, last, size, units);
    return [time.subarray(first, last), ...lines.map((i) => this.samples(i, first, last, units[i]))];
  }

  samples(i, first, last, unit) {
    const { values } = this.columns[i];
    const line = new Array(last - first);
    for (let k = first; k < last; ++k) line[k - first] = in_unit(values[k], unit);
    return line;
  }

  buckets(time, lines, first, last, size, units) {
    const from = Math.floor(first / size), to = Math.ceil(last / size);
    const x = new Float64Array(2 * (to - from));
    for (let b = from; b < to; ++b) {
      x[2 * (b - from)] = time[b * size];
      x[2 * (b - from) + 1] = time[Math.min(time.length - 1, b * size + size / 2)];
    }
    return [x, ...lines.map((i) => {
      const { values } = this.columns[i], line = [];
      for (let b = from; b < to; ++b)
        for (const v of of_bucket(values, b * size, Math.min(values.length, (b + 1) * size))) line.push(in_unit(v, units[i]));
      return line;
    })];
  }
}
