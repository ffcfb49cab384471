// Computations of the page of a study: Pareto fronts, shares of variance, surfaces. They are pure
// functions; NaN is a missing value.

// --- the Pareto front ---

// Returns the rows that no other row dominates, that is, is at least as good in both and better in one,
// in order of x. `less_x`, `less_y`: less is better.
export function pareto_front(rows, x, y, less_x, less_y) {
  const sign_x = less_x ? 1 : -1, sign_y = less_y ? 1 : -1;
  const of = (row) => ({ row, x: sign_x * x[row], y: sign_y * y[row] });
  const sorted = rows.map(of).filter((p) => p.x === p.x && p.y === p.y).sort((a, b) => a.x - b.x || a.y - b.y);
  const front = [];
  let best = Infinity, last_x = NaN;
  for (const p of sorted) {
    if (!(p.y < best || (p.y === best && p.x === last_x))) continue;
    front.push(p.row);
    if (p.y < best) last_x = p.x;
    best = p.y;
  }
  return less_x ? front : front.reverse();
}

// Returns the best value up to and including each of `values`; NaN before the first.
export function best_so_far(values, less) {
  let best = NaN;
  return values.map((v) => {
    if (v === v && !(less ? v >= best : v <= best)) best = v;
    return best;
  });
}

// --- importance ---

const most_bins = 24;

// Divides values into bins of about equal count; equal values share a bin, and a few distinct values get
// a bin each. Returns the bin of each value and the number of bins.
export function bins_of(values) {
  const sorted = [...values].sort((a, b) => a - b);
  const wanted = Math.max(2, Math.min(most_bins, Math.floor(Math.sqrt(values.length) / 2)));
  let distinct = sorted.length ? 1 : 0;
  for (let i = 1; i < sorted.length; ++i) distinct += sorted[i] !== sorted[i - 1];
  const few = distinct <= Math.max(12, wanted) && 2 * distinct <= values.length;
  const starts = [];
  for (let i = 0; i < sorted.length; ++i) {
    if (i && sorted[i] === sorted[i - 1]) continue;
    if (few || i >= (starts.length * sorted.length) / wanted) starts.push(sorted[i]);
  }
  return { of: values.map((v) => last_at_most(starts, v)), count: starts.length };
}

function last_at_most(starts, value) {
  let low = 0, high = starts.length;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (starts[middle] <= value) low = middle;
    else high = middle;
  }
  return low;
}

// Returns the share of the variance of `figure` that `parameter` alone explains: the correlation ratio over
// bins of the parameter, corrected for the share that as many bins explain by chance (Kelley's epsilon
// squared), at least 0. `chance` is the share that is exceeded with a probability of 5 % if the parameter
// has no effect. Returns null if there are too few rows or nothing varies.
export function variance_share(rows, parameter, figure) {
  const used = rows.filter((r) => parameter[r] === parameter[r] && figure[r] === figure[r]);
  const n = used.length;
  if (n < 6) return null;
  const { of, count: k } = bins_of(used.map((r) => parameter[r]));
  if (k < 2 || n <= k + 1) return null;
  const mean = used.reduce((sum, r) => sum + figure[r], 0) / n;
  const sum = new Float64Array(k), size = new Float64Array(k);
  let total = 0;
  used.forEach((r, i) => {
    const d = figure[r] - mean;
    sum[of[i]] += d;
    size[of[i]] += 1;
    total += d * d;
  });
  if (!(total > 1e-24 * n * mean * mean)) return null;
  let between = 0;
  for (let b = 0; b < k; ++b) between += size[b] ? (sum[b] * sum[b]) / size[b] : 0;
  const corrected = (ratio) => Math.min(1, Math.max(0, 1 - ((1 - ratio) * (n - 1)) / (n - k)));
  return { share: corrected(between / total), chance: corrected(chance_ratio(k, n)), bins: k, rows: n };
}

// Returns the correlation ratio of k bins and n rows that is exceeded by chance with a probability of 5 %:
// chi-squared of k - 1 degrees of freedom after Wilson and Hilferty, divided by n - 1.
function chance_ratio(k, n) {
  const f = k - 1, a = 2 / (9 * f);
  return Math.min(1, (f * (1 - a + 1.6449 * Math.sqrt(a)) ** 3) / (n - 1));
}

// --- a surface over two quantities ---

const nearest_used = 9;
const reach = 1.2;         // distance to the nearest point beyond which the surface is blank, in mean spacings
const least_reach = 0.06;  // the same at least, as a share of the axis

// Returns z on size × size nodes over the box of `x_span` and `y_span`, row by row from the lowest y. Each
// value is that of a plane fitted to the nearest points, weighted by distance and limited to their range;
// NaN where no point is near.
export function surface(rows, x, y, z, x_span, y_span, size = 40) {
  const points = gathered(rows, x, y, z, x_span, y_span, size);
  const nodes = new Float64Array(size * size).fill(NaN);
  if (points.length < 3) return nodes;
  const far = Math.max(least_reach, reach / Math.max(1, Math.sqrt(points.length) - 1));
  for (let j = 0; j < size; ++j)
    for (let i = 0; i < size; ++i)
      nodes[j * size + i] = value_at(points, i / (size - 1), j / (size - 1), far);
  return nodes;
}

// Returns rows as points of the unit square; rows in one cell are averaged.
function gathered(rows, x, y, z, [x0, x1], [y0, y1], size) {
  const cells = new Map();
  for (const r of rows) {
    const u = x1 > x0 ? (x[r] - x0) / (x1 - x0) : 0.5, v = y1 > y0 ? (y[r] - y0) / (y1 - y0) : 0.5;
    if (!(u >= 0 && u <= 1 && v >= 0 && v <= 1) || z[r] !== z[r]) continue;
    const key = Math.floor(u * size) * (size + 1) + Math.floor(v * size);
    const cell = cells.get(key) ?? { u: 0, v: 0, z: 0, n: 0 };
    cell.u += u; cell.v += v; cell.z += z[r]; cell.n += 1;
    cells.set(key, cell);
  }
  return [...cells.values()].map(({ u, v, z: sum, n }) => ({ u: u / n, v: v / n, z: sum / n, n }));
}

// Nearest points in order of distance; allocated once and used for all nodes.
const near = { at: new Int32Array(nearest_used), d: new Float64Array(nearest_used), count: 0 };

function find_nearest(points, u, v) {
  const { at, d } = near, most = Math.min(nearest_used, points.length);
  let count = 0;
  for (let i = 0; i < points.length; ++i) {
    const du = points[i].u - u, dv = points[i].v - v, distance = du * du + dv * dv;
    if (count === most && distance >= d[most - 1]) continue;
    let k = count < most ? count++ : most - 1;
    for (; k > 0 && d[k - 1] > distance; --k) {
      d[k] = d[k - 1];
      at[k] = at[k - 1];
    }
    d[k] = distance;
    at[k] = i;
  }
  near.count = count;
}

function value_at(points, u, v, far) {
  find_nearest(points, u, v);
  if (near.d[0] > far * far) return NaN;
  const wide = 1.69 * near.d[near.count - 1] || 1;
  const s = [0, 0, 0, 0, 0, 0], t = [0, 0, 0];
  let low = Infinity, high = -Infinity;
  for (let k = 0; k < near.count; ++k) {
    const p = points[near.at[k]], w = p.n * (1 - near.d[k] / wide) ** 2, du = p.u - u, dv = p.v - v;
    s[0] += w; s[1] += w * du; s[2] += w * dv; s[3] += w * du * du; s[4] += w * du * dv; s[5] += w * dv * dv;
    t[0] += w * p.z; t[1] += w * du * p.z; t[2] += w * dv * p.z;
    low = Math.min(low, p.z);
    high = Math.max(high, p.z);
  }
  return Math.min(high, Math.max(low, plane_at_origin(s, t)));
}

// Returns the constant of the weighted plane, by Cramer's rule; the mean if the points are on one line.
function plane_at_origin([s0, s1, s2, s3, s4, s5], [t0, t1, t2]) {
  const c0 = s3 * s5 - s4 * s4, c1 = s2 * s4 - s1 * s5, c2 = s1 * s4 - s2 * s3;
  const det = s0 * c0 + s1 * c1 + s2 * c2;
  if (!(det > 1e-9 * s0 * (s3 + s5) ** 2)) return t0 / s0;
  return (t0 * c0 + t1 * c1 + t2 * c2) / det;
}

// --- lines of equal value ---

// Returns line pieces [u0, v0, u1, v1] in the unit square on which the surface has this value; none where
// it is blank.
export function level_lines(nodes, size, level) {
  const pieces = [], at = (i, j) => nodes[j * size + i];
  for (let j = 0; j + 1 < size; ++j)
    for (let i = 0; i + 1 < size; ++i) {
      const corners = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(([a, b]) => [a, b, at(a, b)]);
      if (corners.some((c) => c[2] !== c[2])) continue;
      const cuts = [];
      corners.forEach((a, k) => {
        const b = corners[(k + 1) % 4];
        if ((a[2] < level) === (b[2] < level)) return;
        const f = (level - a[2]) / (b[2] - a[2]);
        cuts.push([(a[0] + f * (b[0] - a[0])) / (size - 1), (a[1] + f * (b[1] - a[1])) / (size - 1)]);
      });
      for (let c = 0; c + 1 < cuts.length; c += 2) pieces.push([...cuts[c], ...cuts[c + 1]]);
    }
  return pieces;
}
