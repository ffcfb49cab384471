// Further sections of a fit: errors by part of the data, what was left out and why, and by how much
// further measurements would reduce the error.
import { sample_of } from './chart_shapes.js';
import { element } from './page.js';
import { cell, table } from './tables.js';
import { number } from './units.js';

export const percent = (x) => (x === undefined ? '–' : x < 0.005 ? '< 0.01 %' : `${x.toFixed(2)} %`);

const capital = (words) => words.charAt(0).toUpperCase() + words.slice(1);
const section = (title, ...inner) => element('div', { class: 'evidence-part' }, element('h3', {}, title), ...inner);

// Returns one table of `report.errors`; the bars of all tables have the same scale.
function errors_by({ by, unit, parts }, units, most) {
  const rows = parts.map((p) => {
    const bar = element('span', { class: 'bar' });
    bar.style.width = `${((100 * p.rmse_percent) / most).toFixed(1)}%`;
    return element('tr', { 'data-by': by, 'data-points': p.points, 'data-rms': p.rmse_percent },
      element('th', { scope: 'row' }, p.name ?? number(units.convert(p.value, unit))),
      cell(percent(p.rmse_percent), 'number'), element('td', { class: 'bar-cell' }, bar), cell(percent(p.max_percent), 'number quiet'),
      cell(String(p.points), 'number'));
  });
  const label = unit && units.of(unit).label, head = label ? `${by === 'muscle' ? 'rest length' : by} [${label}]` : by;
  return element('div', {}, element('h4', {}, `By ${by}`), table(`Error by ${by}`, [head, 'rms', '', 'at most', 'points'], rows));
}

export function errors(report, units) {
  if (!report.errors) return '';
  const most = Math.max(1e-9, ...report.errors.flatMap((e) => e.parts.map((p) => p.rmse_percent)));
  return section(`Errors of ${report.chosen} by part`,
    element('div', { class: 'evidence' }, ...report.errors.map((e) => errors_by(e, units, most))),
    element('p', { class: 'hint' }, `Of all points, fitted and held out, in % of ${report.full_scale_is}.`));
}

// Returns what was left out, with the marks of the chart, in the same order.
export function left_out(report, chart, units) {
  if (!report.left_out) return '';
  const curves = (chart?.curves ?? []).filter((c) => c.style === 'left out');
  const mark = (k) => {
    const out = element('span', { class: 'left-out-mark' });
    if (curves[k]) out.innerHTML = sample_of(curves[k]);
    return out;
  };
  const rows = report.left_out.map((o, k) => element('tr', { 'data-reason': o.reason, 'data-count': o.count, 'data-shown': o.shown },
    element('th', { scope: 'row' }, mark(k), ` ${o.reason}`), cell(String(o.count), 'number'),
    cell(o.shown < o.count ? String(o.shown) : 'all', 'number quiet'), cell(o.told_by, 'quiet')));
  const why = report.left_out.flatMap((o) => (o.rows ?? []).map((r) => {
    const { x } = chart;
    return element('tr', { class: 'explained' }, element('th', { scope: 'row' }, r.group), cell(units.text(r[x.label], x.unit), 'number'),
      cell(r.why));
  }));
  return section('What was left out', table('Left out', ['reason', 'count', 'shown', 'criterion'], rows),
    why.length ? table('Explained', ['point', chart.x.label, 'explanation'], why) : '');
}

function mounts_of(further, units) {
  const error = (e, what) => (e[what] > 100 ? '> 100 %' : percent(e[what]));
  const errors_of = (e) => [cell(error(e, 'rms_percent'), 'number'), cell(error(e, 'half_width_95_percent'), 'number')];
  const kind = units.of('Pa gauge').label;
  const before = element('tr', {}, element('th', { scope: 'row' }, 'these data'), cell(''), cell(String(further.readings), 'number'),
    cell(''), ...errors_of(further.before));
  const rows = further.mounts.map((m) => element('tr', { 'data-length': m.length_m }, element('th', { scope: 'row' }, `and one at ${units.text(m.length_m, 'm')}`),
    cell(m.gauge_pressures_Pa.map((p) => String(+units.convert(p, 'Pa gauge').toPrecision(3))).join(' ')), cell(`+ ${m.readings}`, 'number'),
    cell(`${Math.round(m.time_s / 60)} min`, 'number'), ...errors_of(m.after)));
  return element('div', { class: 'further' }, further.of ? element('h4', {}, capital(further.of)) : '',
    table('Further measurements', ['mount', `up and down over [${kind}]`, 'readings', 'time', 'error, rms', '95 %, worst'], [before, ...rows]),
    element('p', { class: 'hint' }, further.note));
}

export function further(report, units) {
  if (!report.further) return '';
  return section('What further measurements would improve', ...report.further.map((f) => mounts_of(f, units)));
}

export function unseen(report) {
  return section('What this does not show', element('ul', { class: 'unseen' }, ...report.does_not_show.map((text) => element('li', {}, text))));
}
