// Unit tests of the page of a run: shapes, samples, units, axes. Results are compared with those of simple
// algorithms.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { deflateSync } from 'node:zlib';
import { ticks, upright_ticks } from '../src/axis.js';
import { trace_point } from '../src/chart_shapes.js';
import { append_stretches, GrowingColumns } from '../src/growing.js';
import { between, held, index_at, open_within, read_samples } from '../src/samples.js';
import { bucket_size, extremes, Slices } from '../src/slices.js';
import { SvgContext } from '../src/svg_context.js';
import { number, short_number, unit_of_key, Units, words_of_key } from '../src/units.js';

// Returns a generator of repeatable random numbers in [0, 1).
function random_from(seed) {
  let state = seed;
  return () => (state = (1103515245 * state + 12345) % 2147483648) / 2147483648;
}

// --- shapes ---

test('points with a mark are triangles and others discs, larger where they are held out', () => {
  const point_path = (curve, x, y, r) => {
    const ctx = new SvgContext();
    trace_point(ctx, curve, x, y, r);
    return ctx.d;
  };
  const corners = (path) => [...path.matchAll(/[ML]([-\d.]+) ([-\d.]+)/g)].map((m) => [Number(m[1]), Number(m[2])]);
  const width = (path) => { const x = corners(path).map(([at]) => at); return Math.max(...x) - Math.min(...x); };
  const filling = point_path({ style: 'points' }, 10, 20, 4), venting = point_path({ style: 'points', mark: 1 }, 10, 20, 4);
  assert.match(filling, /^M14 20a4 4 .*Z$/);
  assert.equal(corners(venting).length, 3);
  assert.ok(venting.endsWith('Z') && !venting.includes('a'));
  const middle = corners(venting).reduce(([x, y], [u, v]) => [x + u / 3, y + v / 3], [0, 0]);
  assert.ok(Math.hypot(middle[0] - 10, middle[1] - 20) < 1);
  assert.ok(width(point_path({ style: 'held out', mark: 1 }, 10, 20, 4)) > width(venting));
});

// --- samples ---

function packed(clocks, columns) {
  const planes = (words) => {
    const bytes = new Uint8Array(4 * words.length);
    for (let rank = 0; rank < 4; ++rank)
      words.forEach((w, i) => (bytes[rank * words.length + i] = (w >>> (8 * rank)) & 255));
    return bytes;
  };
  const steps = clocks.map((ticks) => Uint32Array.from(ticks, (t, i) => (t - (i ? ticks[i - 1] : 0)) >>> 0));
  const bits = columns.map((c) => new Uint32Array(Float32Array.from(c).buffer));
  return deflateSync(Buffer.concat([...steps, ...bits].map((w) => planes([...w])))).toString('base64');
}

test('samples come back as they were packed', async () => {
  const random = random_from(1);
  const clocks = [[0, 100, 250, 100000], [-3, 7]];
  const columns = [[1.5, -2e-8, 3e30, 0], Array.from({ length: 4 }, () => random() - 0.5), [NaN, Infinity]];
  const read = await read_samples({ clocks: [4, 2], columns: [0, 0, 1] }, packed(clocks, columns));
  read.forEach((column, i) => assert.deepEqual(column.values, Float32Array.from(columns[i])));
  assert.deepEqual([...read[0].time], [0, 0.01, 0.025, 10]);
  assert.deepEqual([...read[2].time], [-0.0003, 0.0007]);
  assert.equal(read[0].time, read[1].time, 'columns of one clock share their times');
});

test('index_at is the last time that is not after', () => {
  const random = random_from(2);
  const time = Float64Array.from({ length: 100 }, random).sort();
  for (let i = 0; i < 1000; ++i) {
    const t = i % 10 ? 1.2 * random() - 0.1 : time[i % 100];
    assert.equal(index_at(time, t), time.filter((x) => x <= t).length - 1);
  }
  assert.equal(index_at(new Float64Array(), 1), -1);
});

test('held keeps a value, between interpolates linearly', () => {
  const column = { time: Float64Array.of(1, 2, 4), values: Float32Array.of(10, 20, 0) };
  assert.ok(Number.isNaN(held(column, 0.9)));
  assert.equal(held(column, 1.999), 10);
  assert.equal(held(column, 9), 0);
  assert.equal(between(column, 0), 10);
  assert.equal(between(column, 1.5), 15);
  assert.equal(between(column, 3), 10);
  assert.equal(between(column, 9), 0);
});

test('a valve was open within an interval if an edge or the state before shows it', () => {
  const random = random_from(3);
  const time = [], values = [];
  for (let t = 0.01, open = 1; t < 5; t += 0.002 + 0.05 * random(), open = 1 - open) {
    time.push(t);
    values.push(open);
  }
  const column = { time: Float64Array.from(time), values: Float32Array.from(values) };
  const open_at = (t) => held(column, t) > 0;
  for (let i = 0; i < 2000; ++i) {
    const from = 5 * random(), to = from + 0.03 * random();
    let any = open_at(from) || open_at(to);
    time.forEach((t, k) => (any ||= t >= from && t <= to && (values[k] > 0 || k > 0)));
    assert.equal(open_within(column, from, to), any, `${from} to ${to}`);
  }
});

// --- buckets ---

test('a bucket has the least and greatest of its samples, in their order', () => {
  const random = random_from(4);
  for (const length of [1, 15, 16, 17, 1000, 4096, 5003]) {
    const values = Float32Array.from({ length }, () => (random() < 0.05 ? NaN : random() - 0.5));
    for (let size = 16; size < 2 * length; size *= 2)
      for (let from = 0; from < length; from += size) {
        const found = extremes(values, from, Math.min(length, from + size));
        const part = [...values.subarray(from, from + size)].map((v, i) => [v, i]).filter(([v]) => v === v);
        if (!part.length) {
          assert.ok(found.every(Number.isNaN));
          continue;
        }
        const low = part.reduce((a, c) => (c[0] < a[0] ? c : a)), high = part.reduce((a, c) => (c[0] > a[0] ? c : a));
        assert.deepEqual(found, low[1] <= high[1] ? [low[0], high[0]] : [high[0], low[0]], `${from} of ${length} by ${size}`);
      }
  }
});

test('a plot gets all samples where there is room, else at most two per pixel', () => {
  for (const samples of [10, 1800, 1801, 60000, 6000000]) {
    const size = bucket_size(samples, 600);
    if (samples <= 1800) assert.equal(size, 0);
    else assert.ok(samples / size <= 600, `${samples}`);
  }
});

// --- units ---

// In the form in which the library writes them into a page; sinew/report/page/units_test.cpp checks the
// numbers.
const unit_table = {
  start: 'own',
  sets: [
    { name: 'si', units: { Pa: { label: 'kPa abs', scale: 1e-3 }, share: { label: '%', scale: 100 } } },
    { name: 'thesis', units: { m: { label: 'in', scale: 1 / 0.0254 },
                               Pa: { label: 'psi gauge', scale: 1 / 6894.757293168361, gauge: true } } },
    { name: 'own', units: { m: { label: 'cm', scale: 100 }, K: { label: 'degC', scale: 1, offset: -273.15 },
                            kg: { label: 'g', scale: 1e3, large: { label: 'kg', scale: 1 } } } },
  ],
};

test('a page shows numbers in the units of its table', () => {
  const units = new Units(95000, unit_table);
  const near = (value, expected) => assert.ok(Math.abs(value - expected) < 1e-9 * Math.max(1, Math.abs(expected)), `${value}`);
  assert.equal(units.system, 'own', 'it begins in the units of the page');
  near(units.convert(0.0254, 'm'), 2.54);
  near(units.convert(293.15, 'K'), 20);
  assert.equal(units.text(0.75, 'kg'), '750.0 g');
  assert.equal(units.text(2.5, 'kg'), '2.500 kg', 'a single number has a larger unit');
  assert.equal(units.of('kg').label, 'g', 'an axis keeps the usual one');
  units.choose('thesis');
  near(units.convert(95000 + 62 * 6894.757293168361, 'Pa'), 62);
  units.choose('si');
  near(units.convert(101325, 'Pa'), 101.325);
  near(units.convert(0.25, 'share'), 25);
  assert.equal(units.text(3, 'furlong'), '3.000 furlong', 'a unit that is not in the table is unchanged');
  assert.equal(units.text(3, '1'), '3.000');
  units.choose('parsec');
  assert.equal(units.system, 'si', 'a set that is not there changes nothing');
});

test('without a table numbers stay in SI', () => {
  const units = new Units(101325);
  assert.equal(units.text(0.0254, 'm'), '0.025 m');
  assert.deepEqual(units.table.sets.map((s) => s.name), ['si']);
});

test('short numbers of bar have a decimal, those of kilopascals do not', () => {
  for (const [value, text] of [[4.2137, '4.2'], [421.37, '421'], [0, '0.0'], [-0.01, '0.0'], [-0.6, '−0.6']])
    assert.equal(short_number(value), text);
});

test('numbers keep about four digits', () => {
  for (const [value, text] of [[0, '0.000'], [1.23456, '1.235'], [-12.3456, '−12.35'], [123.456, '123.5'],
                               [12345.6, '12346'], [-0.0004, '−4.00e−4'], [NaN, '–'], [-0, '0.000']])
    assert.equal(number(value), text);
});

test('units and labels are derived from keys', () => {
  assert.equal(unit_of_key('trolley.mean_speed_m_per_s'), 'm/s');
  assert.equal(unit_of_key('joints.hip.stiffness_mean_Nm_per_rad'), 'N m/rad');
  assert.equal(unit_of_key('steps'), '1');
  assert.equal(words_of_key('joints.hip.min_angle_rad'), 'hip · min angle');
  assert.equal(words_of_key('muscles.hip_extensor.peak_tension_N'), 'hip extensor · peak tension');
});

// --- slices ---

const plain = { scale: 1, offset: 0 };

test('a slice is every sample in view and one on either side, from afar every peak', () => {
  const random = random_from(7);
  const time = Float64Array.from({ length: 5000 }, (_, i) => 0.01 * i);
  const values = Float32Array.from(time, random);
  const slices = new Slices([{ time, values }]);
  const [x, y] = slices.of([10, 12], 600, { scale: 2, offset: 1 });
  assert.deepEqual([...x], [...time.filter((t) => t >= 10 && t <= 12.015)]);
  assert.deepEqual(y, [...values.subarray(1000, 1000 + x.length)].map((v) => 2 * (v + 1)));

  const [far, drawn] = slices.of([0, 50], 600, plain);
  assert.ok(far.length <= 1200 && far.length > 300, `${far.length} points`);
  assert.equal(Math.min(...drawn), Math.min(...values));
  assert.equal(Math.max(...drawn), Math.max(...values));
});

test('an hour at full rate is moved without delay, and its slices are those of every sample', () => {
  const random = random_from(9), time = Float64Array.from({ length: 7200000 }, (_, i) => i / 2000);
  const values = Float32Array.from(time, () => (random() < 0.001 ? NaN : random()));
  const short = new Slices([{ time, values: values.subarray(0, 5000000) }]), slices = new Slices([{ time, values }]);
  short.of([0, 3600], 1200, plain);  // the column grows afterwards
  const [, drawn] = slices.of([0, 3600], 1200, plain), size = bucket_size(values.length, 1200);
  const all = [];
  for (let at = 0; at < values.length; at += size) all.push(...extremes(values, at, Math.min(values.length, at + size)));
  assert.deepEqual(drawn, all);
  const start = performance.now();
  for (let i = 0; i < 10; ++i) slices.of([i, 3500 + i], 1200, plain);
  const took = (performance.now() - start) / 10;
  assert.ok(took < 10, `${took} ms for a column; a page draws some ten at a time`);
});

test('columns of different clocks meet without a sample that is not theirs', () => {
  const slow = { time: Float64Array.of(0, 0.2, 0.4), values: Float32Array.of(1, NaN, 3) };
  const fast = { time: Float64Array.of(0.1, 0.2, 0.3), values: Float32Array.of(4, 5, 6) };
  const also = { time: slow.time, values: Float32Array.of(7, 8, 9) };
  const [x, a, b, c] = new Slices([slow, fast, also]).of([0, 1], 600, plain);
  assert.deepEqual([...x], [0, 0.1, 0.2, 0.3, 0.4]);
  assert.deepEqual([...a], [1, undefined, null, undefined, 3], 'NaN is null, a missing sample is undefined');
  assert.deepEqual([...b], [undefined, 4, 5, 6, undefined]);
  assert.deepEqual([...c], [7, undefined, 8, undefined, 9]);
});

// --- growing columns ---

test('pieces that are appended are the whole, and columns of one clock share its times', () => {
  const random = random_from(3);
  const rows = Float64Array.from({ length: 20000 }, (_, i) => 0.01 * i);
  const edges = Float64Array.of(0.5, 1.5, 90);
  const whole = [rows, rows, edges].map((time) => ({ time, values: Float32Array.from(time, random) }));
  const growing = new GrowingColumns({ clocks: [0, 0], columns: [0, 0, 1] });
  for (let from = 0; from < 200;) {
    const to = from + 5 * random();
    growing.append(whole.map(({ time, values }) => {
      const inside = [...time.keys()].filter((i) => time[i] >= from && time[i] < to);
      return { time: Float64Array.from(inside, (i) => time[i]), values: Float32Array.from(inside, (i) => values[i]) };
    }));
    assert.equal(growing.columns[0].time, growing.columns[1].time);
    from = to;
  }
  growing.columns.forEach((c, i) => {
    assert.deepEqual([...c.time], [...whole[i].time]);
    assert.deepEqual([...c.values], [...whole[i].values]);
  });
});

test('a phase that continues in the next piece stays one phase', () => {
  const all = [];
  append_stretches(all, [{ phase: 0, step: 0, from: 0, to: 0.1 }]);
  append_stretches(all, [{ phase: 0, step: 0, from: 0.1, to: 0.2 }, { phase: 1, step: 0, from: 0.2, to: 0.3 }]);
  append_stretches(all, [{ phase: 1, step: 1, from: 0.3, to: 0.4 }]);
  assert.deepEqual(all.map((s) => [s.phase, s.step, s.from, s.to]), [[0, 0, 0, 0.2], [1, 0, 0.2, 0.3], [1, 1, 0.3, 0.4]]);
});

// --- axes ---

test('an upright axis has three numbers or more, which do not touch', () => {
  const random = random_from(7);
  for (let i = 0; i < 5000; ++i) {
    const low = (random() - 0.5) * 10 ** (8 * random() - 4), high = low + 10 ** (6 * random() - 3), pixels = 62 + 300 * random();
    // The usual step: the smallest of 1, 2 or 5 that leaves 26 px, with which an axis may have a single number.
    const least = (26 / pixels) * (high - low), size = 10 ** Math.floor(Math.log10(least));
    const usual = [1, 2, 5, 10].map((k) => k * size).find((k) => k >= least);
    const at = upright_ticks(low, high, usual, pixels), y = at.map((v) => ((v - low) / (high - low)) * pixels);
    assert.ok(at.length >= 3, `${low} … ${high}, ${pixels} px: ${at}`);
    y.slice(1).forEach((v, k) => assert.ok(v - y[k] >= 12.9, `${at}: ${v - y[k]} px`));
    assert.ok(y[0] > -1e-6 && y.at(-1) < pixels + 1e-6);
    if (ticks(low, high, (high - low) / usual).length >= 3) assert.equal(Math.round((at[1] - at[0]) / usual), 1, 'the usual step where it does');
  }
  assert.deepEqual(upright_ticks(-0.35, 0.35, 0.5, 70), [-0.2, 0, 0.2]);
});
