// Page of an identification: measurements compared with each model, the reason why one was chosen, and
// its values.
import { Charts } from './charts.js';
import { errors, further, left_out, percent, unseen } from './fit_evidence.js';
import { Appearance } from './appearance.js';
import { by_id, chip, element, start_page } from './page.js';
import { cell, heading, show_parameters, table } from './tables.js';
import { number, Units } from './units.js';

const words = (text) => text.replace(/-/g, '−');
const rank = (x) => Math.floor(Math.log10(Math.abs(x)));

// Returns a value, rounded to two digits of half its interval, and that half.
function precise(value, half) {
  if (!(half > 0) || !Number.isFinite(half)) return [words(String(+value.toPrecision(6))), ''];
  const size = rank(Math.max(Math.abs(value), half)), digits = Math.min(6, Math.max(0, size - rank(half) + 1));
  if (size < -3 || size >= 6) return [words(value.toExponential(digits)), `± ${words(half.toExponential(1))}`];
  const decimals = Math.max(0, digits - size);
  const small = half < 0.5 * 10 ** -decimals;
  return [words(value.toFixed(decimals)), `± ${small ? words(half.toExponential(1)) : half.toFixed(decimals)}`];
}

const error_at = ({ profile }, k) => (!profile || profile[k].error === null ? '–' : profile[k].error >= 10 ? '> 10' : profile[k].error.toPrecision(3));

class Part {
  constructor(spec, page) {
    const { report } = spec;
    Object.assign(this, { report, page });
    const head = element('h2', {}, page.run.parts.length > 1 ? report.subject : 'Result');
    this.scale = element('span', { class: 'note' });
    head.append(this.scale);
    this.values = element('div', {});
    const charts = element('div', {});
    this.spec = spec;
    this.evidence = element('div', {});
    this.plan = element('div', {});
    this.root = element('section', { class: 'block fit' }, head, this.verdict(), charts, this.evidence, this.values, this.models(),
                        this.plan, this.remarks(), unseen(report));
    this.show = () => (this.charts = spec.charts.length ? new Charts(charts, spec.charts, [], page.units, report.subject) : null);
    this.refresh();
  }

  // Returns the chosen model with its errors.
  verdict() {
    const { report } = this, best = report.models.find((m) => m.model === report.chosen);
    const figure = (name, score) => score && element('div', { class: 'figure' },
      element('span', { class: 'quiet' }, name), element('b', {}, percent(score.rmse_percent)),
      element('span', { class: 'quiet' }, `at most ${percent(score.max_percent)} · ${score.points} points`));
    return element('div', { class: 'verdict-box' },
      element('div', { class: 'chosen' }, element('span', { class: 'quiet' }, 'chosen'), element('b', {}, report.chosen),
        element('code', {}, best.law), element('span', { class: 'quiet' }, best.source)),
      figure('error of the fit, rms', best.fit), figure('held out', best.held_out),
      figure('cross-validated', best.cross_validated), figure('extrapolated to the outer lengths', best.extrapolated),
      report.not_pinned.length ? element('p', { class: 'hint not-pinned' }, `Not pinned by these data: ${report.not_pinned.join(', ')}.`) : '');
  }

  models() {
    const { report } = this;
    const kinds = [['fit', 'fit, rms'], ['held_out', 'held out, rms'], ['cross_validated', 'cross-validated'], ['extrapolated', 'extrapolated']]
      .filter(([key]) => report.models.some((m) => m[key]));
    const score = (s) => [cell(percent(s?.rmse_percent), 'number'), cell(percent(s?.max_percent), 'number quiet')];
    const rows = report.models.map((m) => {
      const head = element('th', { scope: 'row', title: m.law }, m.model);
      if (m.refused)
        return element('tr', { class: 'refused' }, head, element('td', { colspan: 1 + 2 * kinds.length, class: 'quiet' }, `cannot be fitted to these data: ${m.refused}`),
          element('td', {}));
      return element('tr', { class: m.model === report.chosen ? 'is-chosen' : null }, head, cell(String(m.parameters.length), 'number'),
        ...kinds.flatMap(([key]) => score(m[key])),
        element('td', {}, m.model === report.chosen ? element('span', { class: 'tag fit' }, 'chosen') : m.not_chosen ?? ''));
    });
    const why = [report.models.length > 1 && report.rule && `Chosen: ${report.rule}.`,
                 report.held_out_is && `Held out: ${report.held_out_is}.`].filter(Boolean).join(' ');
    return element('div', {}, element('h3', {}, 'Models that were tried'),
      table('Models', ['', 'values', ...kinds.flatMap(([, name]) => [name, 'at most']), ''], rows),
      element('p', { class: 'hint' }, why));
  }

  // Updates the values of the chosen model, with 95 % intervals, in the current units.
  refresh() {
    const { report } = this, { units } = this.page;
    const { band } = report;
    this.scale.textContent = `errors of the ${report.quantity} in % of ${report.full_scale_is}, ${units.text(report.full_scale, report.unit)}` +
      (band ? `; 68 and 95 % of held-out values are within ± ${units.text(band.half_68, report.unit)} and ± ${units.text(band.half_95, report.unit)}${band.where ? `, ${band.where}` : ''}` : '');
    const profiled = report.parameters.some((p) => p.profile);
    const rows = report.parameters.map((p) => {
      const u = units.of(p.unit), half = p.high === null || p.high === p.low ? NaN : 0.5 * (p.high - p.low) * u.scale;
      const value = units.convert(p.value, p.unit);
      const note = p.known?.startsWith('frozen') ? p.known : p.at_bound ? 'at the bound of its range' : !p.identifiable ? 'not determined by these data'
        : p.known?.replace('+-', '±') || (!Number.isFinite(half) ? 'no interval' : '');
      const [shown, interval] = precise(value, half);
      return element('tr', { 'data-name': p.name, 'data-value': p.value }, element('th', { scope: 'row', class: 'key' }, p.name),
        cell(shown, 'number ours'), cell(interval, 'number'), cell(u.label, 'unit'),
        ...(profiled ? [cell(error_at(p, 0), 'number'), cell(error_at(p, 4), 'number'),
                        cell(p.pinned === undefined ? '' : p.pinned ? 'pinned' : 'not pinned', p.pinned ? 'quiet' : '')] : []),
        element('td', {}, note ? element('span', { class: 'tag guess' }, note) : ''));
    });
    this.evidence.replaceChildren(left_out(report, this.spec.charts[0], units), errors(report, units));
    this.plan.replaceChildren(further(report, units));
    if (rows.length) this.values.replaceChildren(element('h3', {}, `Values of ${report.chosen}`),
      table('Values', ['', 'value', '95 %', '', ...(profiled ? ['error at half', 'at twice', ''] : []), ''], rows),
      profiled ? element('p', { class: 'hint' },
        'Error at half, at twice: ratio of the error to that of the fit when the value is fixed at half or twice its size and all others are fitted again. A value near zero is moved by its scale.') : '');
  }

  remarks() {
    const { report } = this, best = report.models.find((m) => m.model === report.chosen);
    const item = (kind) => (text) => element('li', { class: kind }, element('p', {}, text));
    const all = [...report.warnings.map(item('')), ...[...(best.notes ?? []), ...report.notes].map(item('remark'))];
    return all.length ? element('div', {}, element('h3', {}, 'Remarks'), element('ul', { class: 'warnings' }, ...all)) : '';
  }
}

class FitPage {
  constructor(run) {
    this.run = run;
    this.units = new Units(run.atmosphere);
    by_id('title').textContent = run.title.charAt(0).toUpperCase() + run.title.slice(1);
    by_id('about').textContent = run.data.join(' · ');
    by_id('facts').textContent = `Sinew ${run.version}`;
    this.parts = run.parts.map((part) => new Part(part, this));
    by_id('parts').append(...this.parts.map((p) => p.root));
    this.parts.forEach((p) => p.show());
    if (run.parameters.length) show_parameters(run, 'as in the parameter file');
    else by_id('parameters').remove();
    this.chips();
    this.appearance = new Appearance(this.units, {
      on_units: () => this.parts.forEach((p) => (p.refresh(), p.charts?.rebuild())),
      on_colors: () => this.parts.forEach((p) => p.charts?.rebuild()),
      on_print: (begins) => this.parts.forEach((p) => p.charts?.print(begins)),
    });
  }

  chips() {
    if (this.parts.length > 1)
      this.parts.forEach((p, i) => {
        p.root.id = `part-${i}`;
        by_id('chips').append(chip(p.root.id, p.report.subject));
      });
    const warnings = this.parts.reduce((n, p) => n + p.report.warnings.length, 0);
    if (warnings) by_id('chips').append(chip('parts', `${warnings} warning${warnings > 1 ? 's' : ''}`, 'warn'));
    if (this.run.parameters.length) by_id('chips').append(chip('parameters', 'Parameters'));
  }
}

start_page((run) => ({ run, page: new FitPage(run), number }));
