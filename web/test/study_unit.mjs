// Unit tests of the page of a study: Pareto fronts, shares of variance, surfaces, filters.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { ticks } from '../src/axis.js';
import { Filter, heading_parts, StudyData } from '../src/study_data.js';
import { best_so_far, bins_of, level_lines, pareto_front, surface, variance_share } from '../src/study_math.js';

// Returns a generator of repeatable random numbers in [0, 1).
function random_from(seed) {
  let state = seed;
  return () => (state = (1103515245 * state + 12345) % 2147483648) / 2147483648;
}
const range = (n) => Array.from({ length: n }, (_, i) => i);
const near = (value, expected, exact, what = '') => assert.ok(Math.abs(value - expected) <= exact, `${what} ${value} for ${expected}`);

// --- the front ---

test('a front equals that of a direct comparison of all rows, for all directions and with ties', () => {
  const random = random_from(1);
  for (const size of [1, 2, 5, 40, 200]) {
    for (const steps of [4, 1000]) {
      const x = range(size).map(() => Math.floor(steps * random())), y = range(size).map(() => (random() < 0.05 ? NaN : Math.floor(steps * random())));
      for (const [less_x, less_y] of [[true, true], [true, false], [false, true], [false, false]]) {
        const front = pareto_front(range(size), x, y, less_x, less_y);
        const as_good = (a, b, less) => (less ? a <= b : a >= b);
        const beats = (a, b) => as_good(x[a], x[b], less_x) && as_good(y[a], y[b], less_y) && (x[a] !== x[b] || y[a] !== y[b]);
        const there = range(size).filter((r) => y[r] === y[r]);
        assert.deepEqual([...front].sort((a, b) => a - b), there.filter((r) => !there.some((o) => beats(o, r))));
        front.forEach((r, i) => assert.ok(!i || x[front[i - 1]] <= x[r], 'in order of x'));
      }
    }
  }
});

test('the best so far is the best of the values so far', () => {
  const random = random_from(2), values = range(300).map(() => (random() < 0.1 ? NaN : random()));
  for (const less of [true, false])
    best_so_far(values, less).forEach((best, i) => {
      const there = values.slice(0, i + 1).filter((v) => v === v);
      assert.equal(best, there.length ? Math[less ? 'min' : 'max'](...there) : NaN);
    });
});

// --- importance ---

test("Ishigami's function: the shares that are known in closed form", () => {
  const random = random_from(3), n = 20000, a = 7, b = 0.1, pi = Math.PI;
  const [x, y, z] = range(3).map(() => range(n).map(() => pi * (2 * random() - 1)));
  const f = range(n).map((i) => Math.sin(x[i]) + a * Math.sin(y[i]) ** 2 + b * z[i] ** 4 * Math.sin(x[i]));
  const all = 0.5 + a ** 2 / 8 + (b * pi ** 4) / 5 + (b ** 2 * pi ** 8) / 18;
  const shares = [x, y, z].map((p) => variance_share(range(n), p, f));
  near(shares[0].share, (0.5 * (1 + (b * pi ** 4) / 5) ** 2) / all, 0.02, 'x');
  near(shares[1].share, a ** 2 / 8 / all, 0.02, 'y');
  near(shares[2].share, 0, 0.01, 'z, which acts only together with x');
  assert.ok(shares[0].share > shares[0].chance && shares[1].share > shares[1].chance);
});

test('a parameter without effect has a mean share of zero, and exceeds the mark with a probability of 5 %', () => {
  const random = random_from(4), n = 120;
  let sum = 0, above = 0;
  for (let i = 0; i < 600; ++i) {
    const x = range(n).map(random), f = range(n).map(random), s = variance_share(range(n), x, f);
    sum += s.share;
    above += s.share > s.chance;
  }
  assert.ok(sum / 600 < 0.03, `${sum / 600}`);
  near(above / 600, 0.05, 0.03);
});

test('text values are bins; one parameter may explain the whole variance; without variation the share is null', () => {
  const word = range(40).map((i) => i % 2), f = word.map((w) => 3 + w);
  near(variance_share(range(40), word, f).share, 1, 1e-12);
  assert.deepEqual(bins_of(word).count, 2);
  assert.equal(variance_share(range(40), word, range(40).map(() => 2)), null, 'a figure that does not vary');
  assert.equal(variance_share(range(40), range(40).map(() => 1), f), null, 'a parameter that does not');
  assert.equal(variance_share(range(3), word, f), null, 'too few rows');
  assert.equal(variance_share(range(40), word.map(() => NaN), f), null);
});

// --- surfaces ---

test('a surface over points of a plane is that plane, and blank where no point is near', () => {
  const random = random_from(5), n = 400, size = 40;
  const x = range(n).map(() => 2 + 3 * random()), y = range(n).map(() => -random()), z = range(n).map((i) => 4 * x[i] - 7 * y[i]);
  const some = range(n).filter((i) => x[i] < 4 || y[i] < -0.5);  // a corner is empty
  const nodes = surface(some, x, y, z, [2, 5], [-1, 0], size);
  let there = 0;
  nodes.forEach((v, k) => {
    const at = [2 + (3 * (k % size)) / (size - 1), -1 + Math.floor(k / size) / (size - 1)];
    const inside = at[0] > 2.3 && at[0] < 3.7 && at[1] > -0.9 && at[1] < -0.1;
    if (at[0] > 4.4 && at[1] > -0.3) assert.ok(Number.isNaN(v), `not blank at ${at}`);
    else if (inside) {
      near(v, 4 * at[0] - 7 * at[1], 0.6, `at ${at}`);
      ++there;
    }
  });
  assert.ok(there > 300, `${there} nodes`);
});

test('a surface stays within the range of its points, and rows at one point are averaged', () => {
  const random = random_from(6), n = 900, x = range(n).map(() => Math.floor(5 * random())), y = range(n).map(() => Math.floor(5 * random()));
  const z = range(n).map((i) => x[i] * y[i] + (random() - 0.5));
  const nodes = surface(range(n), x, y, z, [0, 4], [0, 4], 41);
  for (let j = 0; j < 5; ++j) for (let i = 0; i < 5; ++i) near(nodes[10 * j * 41 + 10 * i], i * j, 1.7, `at ${i}, ${j}`);
  assert.ok(nodes.every((v) => v >= Math.min(...z) && v <= Math.max(...z)), 'all of a whole grid is there');
});

test('lines of equal value are where the surface has the value', () => {
  const size = 21, nodes = Float64Array.from(range(size * size), (k) => Math.hypot((k % size) / 20 - 0.5, Math.floor(k / size) / 20 - 0.5));
  const pieces = level_lines(nodes, size, 0.3);
  assert.ok(pieces.length > 30);
  for (const [u0, v0, u1, v1] of pieces) for (const [u, v] of [[u0, v0], [u1, v1]]) near(Math.hypot(u - 0.5, v - 0.5), 0.3, 2e-3);
  nodes[210] = NaN;
  assert.ok(level_lines(nodes, size, 0.3).length <= pieces.length);
  assert.deepEqual(ticks(0.13, 0.87, 5), [0.2, 0.4, 0.6, 0.8]);
  assert.deepEqual(ticks(3, 3, 5), [3]);
});

// --- rows ---

const column = (heading, role, number = true) => ({ heading, number, role, maximize: false, set: role === 'parameter' });
const some = (file, rows) => ({ file, experiment: 'experiments/a b.toml', kind: 'sweep', version: '1', expected: 4, sets: ['seed=3'], asked: '',
  columns: [column('gain [%/count]', 'parameter'), column('rounding', 'parameter', false), column('speed [m/s]', 'figure'), column('status', 'other', false)], rows });
const row = (number, cells, ok = 1, violation = 0) => [number, ok, -1, violation, cells];

test('a heading is a key and a unit; a row is repeated by its command', () => {
  assert.deepEqual(heading_parts('a.b [%/count]'), { key: 'a.b', unit: '%/count' });
  assert.deepEqual(heading_parts('seed'), { key: 'seed', unit: '' });
  const data = new StudyData([some('a.db', [row(0, ['0.02', 'truncate sum', '1', 'ok'])])]);
  assert.equal(data.command_of(0), 'sinew run "experiments/a b.toml" --set seed=3 --set "gain=0.02 %/count" --set "rounding=truncate sum"');
});

test('rows that come later take their place by their number', () => {
  const data = new StudyData([some('a.db', [row(0, ['1', 'none', '5', 'ok']), row(2, ['3', 'none', '7', 'ok'])])]);
  assert.equal(data.add(data.studies[0], [row(1, ['2', 'none', '6', 'ok']), row(2, ['3', 'none', '9', 'ok'])]), 1);
  assert.deepEqual(data.number, [0, 2, 1]);
  assert.deepEqual(data.by_heading.get('speed [m/s]').values, [5, 9, 6]);
});

test('two studies share columns by heading; ranges, words and whole rows filter', () => {
  const other = some('b.db', [row(0, ['4', 'none', '', 'refused'], 0), row(1, ['5', 'none', '8', 'ok'], 1, 0.5)]);
  other.columns.push(column('drag [N]', 'parameter'));
  other.rows.forEach((r, i) => r[4].push(String(i)));
  const data = new StudyData([some('a.db', [row(0, ['1', 'truncate sum', '5', 'ok']), row(1, ['2', 'none', '6', 'ok'])]), other]);
  assert.equal(data.columns.length, 5);
  const gain = data.by_heading.get('gain [%/count]'), drag = data.by_heading.get('drag [N]');
  assert.ok(Number.isNaN(drag.values[0]) && drag.values[3] === 1);
  assert.ok(data.is_common(gain) && !data.is_common(drag));
  const filter = new Filter(data);
  const shown = () => filter.rows.map((r) => data.name_of(r)).join(' ');
  filter.set_range(gain, [2, 4]);
  assert.equal(shown(), 'A1 B0');
  filter.set_range(gain, null);
  filter.words = ['truncate'];
  filter.update();
  assert.equal(shown(), 'A0');
  filter.clear();
  filter.only_feasible = true;
  filter.update();
  assert.equal(shown(), 'A0 A1', 'without figures, and beyond a limit, are none');
  filter.clear();
  filter.set_range(drag, [0, 9]);
  assert.equal(shown(), 'B0 B1');
});
