// Data that a plot draws of its columns: every sample in view, or the minimum and maximum of every pixel
// if there are too many, in the units shown.
import uPlot from 'uplot';
import { bucket_size, level_for, pyramid } from './pyramid.js';
import { index_at } from './samples.js';

const in_unit = (value, { scale, offset }) => (value === value ? (value + offset) * scale : null);

export class Slices {
  // Columns may have different clocks.
  constructor(columns) {
    this.columns = columns;
    this.pyramids = columns.map(() => null);  // computed when first needed
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
    const level = level_for(last - first, pixels, this.pyramid_of(lines[0]).length);
    if (level >= 0) return this.buckets(time, lines, first, last, level, units);
    return [time.subarray(first, last), ...lines.map((i) => this.samples(i, first, last, units[i]))];
  }

  pyramid_of(i) {
    return (this.pyramids[i] ??= pyramid(this.columns[i].values));
  }

  samples(i, first, last, unit) {
    const { values } = this.columns[i];
    const line = new Array(last - first);
    for (let k = first; k < last; ++k) line[k - first] = in_unit(values[k], unit);
    return line;
  }

  buckets(time, lines, first, last, level, units) {
    const size = bucket_size(level);
    const from = Math.floor(first / size), to = Math.ceil(last / size);
    const x = new Float64Array(2 * (to - from));
    for (let b = from; b < to; ++b) {
      x[2 * (b - from)] = time[b * size];
      x[2 * (b - from) + 1] = time[Math.min(time.length - 1, b * size + size / 2)];
    }
    return [x, ...lines.map((i) => {
      const { low, high, first_low } = this.pyramid_of(i)[level];
      const line = new Array(x.length);
      for (let b = from; b < to; ++b) {
        line[2 * (b - from)] = in_unit(first_low[b] ? low[b] : high[b], units[i]);
        line[2 * (b - from) + 1] = in_unit(first_low[b] ? high[b] : low[b], units[i]);
      }
      return line;
    })];
  }
}
