// Unit tests of plots: axes, formulas of channels, stored layouts, marks of values that were set. Results
// are compared with those of simple algorithms.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { range_of, spoiling_start, ticks } from '../src/axis.js';
import { dims_of, name_of } from '../src/dimension.js';
import { FormulaError, parse_formula } from '../src/formula.js';
import { column_of_formula } from '../src/formula_values.js';
import { is_nothing, nothing, read_layout } from '../src/layout.js';
import { moves_of, setting_in_words } from '../src/marks.js';

// --- axes ---

const constant = (value, count = 1000) => Float32Array.from({ length: count }, () => value);

test('an axis of a moving quantity has a little room about it', () => {
  const [low, high] = range_of(-0.5, 1.5, 'rad');
  assert.ok(low < -0.5 && low > -0.7 && high > 1.5 && high < 1.7);
});

test('noise of 1e-6 is at rest: the axis is that of a constant', () => {
  for (const [value, unit, scale] of [[2, 'N m/rad', 1], [790828, 'Pa', 1e-3], [2.5e-4, 'kg', 1e3], [30, 'm', 1 / 0.0254]]) {
    const middle = value * scale, noise = 1e-6 * middle;
    const [low, high] = range_of(middle - noise, middle + noise, unit, scale);
    assert.ok(high - low > 0.1 * middle, `${unit}: ${low} … ${high}`);
    assert.ok(low < middle && middle < high);
  }
  // The axis of a zero with noise is symmetric and needs no powers of ten.
  const [low, high] = range_of(-1e-6, 2e-6, 'rad');
  assert.equal(low, -high);
  assert.ok(high >= 1e-3, `${high}`);
  assert.deepEqual(range_of(-0.1, 0.1, 'rad').map((v) => Math.abs(v) > 0.1), [true, true], 'but a tenth of a radian moves');
});

test('a milligram of air is a change, and missing values have an axis', () => {
  const [low, high] = range_of(0, 1e-6, 'kg');
  assert.ok(high - low < 2e-6);
  for (const none of [[null, null], [Infinity, -Infinity], [NaN, NaN]]) assert.deepEqual(range_of(...none, 'm'), [0, 1]);
});

test('a first sample that the second one leaves at once does not count for the axis', () => {
  const swing = Float32Array.from({ length: 1000 }, (_, i) => Math.sin(0.02 * i));
  assert.equal(spoiling_start({ values: swing }, 'rad'), 0, 'a swing has none');
  for (const count of [1, 7]) {
    const spoiled = Float32Array.from(swing, (v, i) => (i < count ? 300 : v));
    assert.equal(spoiling_start({ values: spoiled }, 'rad'), count);
  }
  const late = Float32Array.from(swing, (v, i) => (i < 100 ? 300 : v));
  assert.equal(spoiling_start({ values: late }, 'rad'), 0, 'a tenth of the run is no start');
  const step = Float32Array.from(constant(1), (v, i) => (i ? v : 0));
  assert.equal(spoiling_start({ values: step }, 'm'), 0, 'a step to what stays is all there is to see');
  const grown = Float32Array.from({ length: 1000 }, (_, i) => 300 * Math.exp(-i / 5));
  assert.equal(spoiling_start({ values: grown }, 'N'), 0, 'what dies away does not jump');
  assert.equal(spoiling_start({ values: new Float32Array(0) }, 'N'), 0);
  assert.equal(spoiling_start({ values: constant(NaN) }, 'N'), 0);
});

test('ticks are round, within the axis, and of about the requested number', () => {
  assert.deepEqual(ticks(0, 1, 5), [0, 0.2, 0.4, 0.6, 0.8, 1]);
  assert.deepEqual(ticks(-0.31, 0.31, 4), [-0.2, 0, 0.2]);
  for (const [low, high] of [[1.234, 1.2345], [-7e5, 9e6], [3e-7, 4e-7]]) {
    const all = ticks(low, high, 6);
    assert.ok(all.length >= 2 && all.length <= 8, String(all));
    assert.ok(all.every((v) => v >= low - 1e-12 && v <= high + 1e-12));
  }
});

// --- formulas ---

const channels = new Map([['/joint/hip/angle', 'rad'], ['/joint/hip/angle2', 'rad'], ['/p', 'Pa'], ['/q', 'Pa'], ['/g', 'Pa gauge'],
  ['/f', 'N'], ['/l', 'm'], ['/duty', 'share'], ['/foot/position.x', 'm'], ['/odd', 'furlong']]);
const unit_of = (text) => parse_formula(text, channels).unit;
const error_of = (text) => {
  try {
    parse_formula(text, channels);
  } catch (error) {
    assert.ok(error instanceof FormulaError, `${text}: ${error}`);
    return error.message;
  }
  return assert.fail(`${text}: taken`);
};

test('the unit of a formula follows from its channels', () => {
  for (const [text, unit] of [
    ['/joint/hip/angle - joint/hip/angle2', 'rad'], ['/joint/hip/angle/2', 'rad'], ['/joint/hip/angle + 2 deg', 'rad'],
    ['deriv(/joint/hip/angle)', 'rad/s'], ['deriv(deriv(/l))', 'm/s^2'], ['/f*/l', 'N m'], ['/f * deriv(/l)', 'W'],
    ['/f / (pi * (10 mm) * (10 mm))', 'Pa diff'], ['mean(/duty, 100 ms)', 'share'], ['abs(/duty)', 'share'], ['/l/(0.1 m)', '1'],
    ['sqrt(/l*/l)', 'm'], ['sin(/joint/hip/angle) * 3 N m', 'N m'], ['integral(deriv(/f))', 'N'], ['max(/f, 2 lbf)', 'N'],
    ['foot/position.x', 'm'], ['-(+/f)', 'N'], ['/odd*2', '1'], ['/f/-2', 'N'],
  ]) assert.equal(unit_of(text), unit, text);
});

test('the difference of two absolute pressures is not absolute, their mean is', () => {
  for (const [text, unit] of [['/p', 'Pa'], ['/p - /q', 'Pa diff'], ['(/p + /q)/2', 'Pa'], ['0.5*/p + 0.5*/q', 'Pa'], ['/p - 1 bar', 'Pa'],
                              ['mean(/p, 0.1)', 'Pa'], ['/g', 'Pa gauge'], ['abs(/p - /q)', 'Pa diff'], ['min(/p, /q)', 'Pa']])
    assert.equal(unit_of(text), unit, text);
});

test('dimensions have the names of the log, and others are composed', () => {
  for (const unit of ['1', 'm', 'm/s', 'N', 'Pa', 'N m', 'N m/rad', 'count', 'kg/s', 'm/s^2']) assert.equal(name_of(dims_of(unit)), unit);
  assert.equal(name_of(dims_of('N').map((p, i) => p + dims_of('rad/s')[i])), 'N rad/s');
  for (const unknown of ['furlong', 'N m/s/s', 'm^', '']) if (unknown) assert.equal(dims_of(unknown), null, unknown);
});

test('errors of a formula are reported with their column', () => {
  for (const [text, words] of [
    ['', /column 1: found the end; expected a channel/], ['/joint/hip/angel', /found "\/joint\/hip\/angel".*did you mean \/joint\/hip\/angle/],
    ['/f + 2', /column 4: found N \+ a plain number; expected the same unit on both sides; write the unit after/],
    ['/f + /l', /found N \+ m/], ['/f /l x', /found "x"; expected \+ - \* \/ or the end/], ['(/f', /found the end; expected \)/], ['/f)', /found "\)"/],
    ['root(/f)', /column 1: found "root"; expected one of abs, deriv/], ['mean(/f)', /expected a comma: mean takes 2 values/],
    ['mean(/f, /l)', /expected a time above zero/], ['mean(/f, 0 s)', /expected a time above zero/], ['sin(/f)', /found sin of N; expected an angle/],
    ['3 + 4', /at least one channel/], [`${'('.repeat(60)}/f`, /at most 40 nested/], [`/f${' + /f'.repeat(200)}`, /at most 500 characters/],
    ['constructor(/f)', /found "constructor"/], ['__proto__', /found "__proto__"/], ['alert(1)', /found "alert"/], ['/f; /f', /found ";"/],
  ]) assert.match(error_of(text), words, text);
});

const time = Float64Array.from({ length: 401 }, (_, i) => 0.01 * i);
const columns = {
  '/f': { time, values: Float32Array.from(time, (t) => 3 * t + 1) },
  '/l': { time, values: Float32Array.from(time, (t) => Math.sin(2 * t)) },
  '/p': { time: Float64Array.of(0.5, 2), values: Float32Array.of(10, 20) },
};
const values_of = (text) => column_of_formula(parse_formula(text, channels), (id) => columns[id]);
const near = (a, b, slack, words) => assert.ok(Math.abs(a - b) <= slack, `${words}: ${a} for ${b}`);

test('a formula is evaluated at every time of its channels', () => {
  const both = values_of('2*(/f) - /f*(0.5 + 1)');
  assert.equal(both.time, time);
  both.values.forEach((v, i) => near(v, 0.5 * (3 * time[i] + 1), 1e-5, `at ${time[i]}`));
  const signed = values_of('-abs(/l) / (2 m)');
  signed.values.forEach((v, i) => near(v, -Math.abs(Math.sin(2 * time[i])) / 2, 1e-6, 'abs'));
});

test('deriv and integral undo each other, mean keeps a straight line', () => {
  values_of('deriv(/f)').values.forEach((v) => near(v, 3, 1e-3, 'slope'));
  values_of('deriv(/l)').values.forEach((v, i) => i && i < 400 && near(v, 2 * Math.cos(2 * time[i]), 1e-3, 'cosine'));
  values_of('integral(deriv(/l))').values.forEach((v, i) => near(v, Math.sin(2 * time[i]), 2e-3, 'back again'));
  values_of('mean(/f, 0.5 s)').values.forEach((v, i) => near(v, 3 * time[i] + 1, 1e-4, 'straight, also at the ends'));
  // The mean over half a period of a sine is 2/pi of its amplitude.
  const mean = values_of('mean(/l, 1.5707963 s)').values, middle = 200;
  near(mean[middle], (2 / Math.PI) * Math.sin(2 * time[middle]), 5e-3, 'mean');
  // Compared with a direct sum.
  const w = 21;
  let sum = 0;
  for (let k = -10; k <= 10; ++k) sum += columns['/l'].values[150 + k];
  near(values_of('mean(/l, 0.2 s)').values[150], sum / w, 1e-6, 'window');
});

test('a channel of another clock contributes its last value', () => {
  const held = values_of('/p + 0 Pa * (/l / (1 m))');
  assert.equal(held.time, time);
  assert.ok(Number.isNaN(held.values[49]));
  assert.equal(held.values[50], 10);
  assert.equal(held.values[199], 10);
  assert.equal(held.values[200], 20);
});

test('a gap stays a gap', () => {
  const gap = { time, values: Float32Array.from(time, (t, i) => (i > 100 && i < 110 ? NaN : t)) };
  const of = (text) => column_of_formula(parse_formula(text, channels), () => gap).values;
  for (const text of ['/f + /f', 'deriv(/f)', 'mean(/f, 0.1 s)', 'max(/f, 1 N)', 'integral(/f)'])
    of(text).forEach((v, i) => assert.equal(Number.isNaN(v), i > 100 && i < 110, `${text} at ${i}`));
});

// --- layouts ---

test('a layout is read back, and invalid text is ignored', () => {
  const layout = { ...nothing(), own: [{ id: 'own/1', title: 'Mine', lines: ['/f', { formula: '/f*2', name: '' }] }],
                   added: { 'Joints/Joint angles': ['/l'] }, away: ['Foot/Slip velocity'], order: ['own/1'],
                   shown: { 'Joints/Joint angles': { '/l': false } }, groups: { Foot: false } };
  assert.deepEqual(read_layout(JSON.stringify(layout)), layout);
  assert.ok(!is_nothing(layout) && is_nothing(nothing()));
  for (const text of [null, '', '{', '[]', '7', 'null', '{"format":"sinew.layout/2","away":["x"]}', `"${'x'.repeat(300000)}"`])
    assert.deepEqual(read_layout(text), nothing(), String(text).slice(0, 40));
  const hostile = read_layout(JSON.stringify({ format: 'sinew.layout/1', own: [{ id: 3 }, null, { id: 'else/1', lines: [] }, { id: 'own/2', lines: [1, {}, '/f'] }],
                                              added: [1], away: 'x', order: [1, 'a'], shown: { a: { b: 'yes' } }, groups: { A: 1 } }));
  assert.deepEqual(hostile, { ...nothing(), own: [{ id: 'own/2', title: '', lines: ['/f'] }], order: ['a'], shown: { a: {} } });
});

// --- marks ---

test('the values that a slider sends while it is dragged are one move', () => {
  const key = 'control.gains.hip.angle', at = (time, value) => ({ time, key, value, unit: '1/count' });
  const moves = moves_of([at(1, 0.1), at(1.1, 0.2), at(1.9, 0.3), { time: 1.5, key: 'control.stiffness.knee', value: 2, unit: 'N m/rad' },
                          at(5, 0.4), { time: 5.2, key, value: null }, at(5.3, 0.1)]);
  assert.deepEqual(moves.map((m) => [m.key, m.from, m.to, m.before, m.value, m.count]), [
    [key, 1, 1.9, null, 0.3, 3], ['control.stiffness.knee', 1.5, 1.5, null, 2, 1], [key, 5, 5, 0.3, 0.4, 1], [key, 5.2, 5.2, 0.4, null, 1],
    [key, 5.3, 5.3, null, 0.1, 1]]);
});

test('settings have the names of their sliders', () => {
  assert.equal(setting_in_words('control.gains.hip.angle'), 'hip angle gain');
  assert.equal(setting_in_words('control.stiffness.left_knee'), 'left knee desired stiffness');
  assert.equal(setting_in_words('control.angle.hip'), 'hip desired angle');
  assert.equal(setting_in_words('seed'), 'seed');
});
