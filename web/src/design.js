// Page of a design: its numbers with their intervals, plots, tables of all candidates, and remarks.
import { Appearance } from './appearance.js';
import { Charts } from './charts.js';
import { by_id, chip, element, start_page, with_code } from './page.js';
import { cell, heading, table } from './tables.js';
import { Units } from './units.js';

const label_of = (name, unit, units) => {
  const { label } = units.of(unit);
  return label ? `${name} [${label}]` : name;
};
// Returns a number with four digits.
const digits = (value) => String(+value.toPrecision(4)).replace('-', '−');
const list = (title, texts, kind) => texts.length
  ? element('div', {}, element('h3', {}, title), element('ul', { class: 'warnings' }, ...texts.map((text) => element('li', { class: kind }, element('p', {}, ...with_code(text))))))
  : '';

class DesignPage {
  constructor(run) {
    this.run = run;
    this.units = new Units(run.atmosphere);
    by_id('title').replaceChildren(...with_code(run.title.charAt(0).toUpperCase() + run.title.slice(1)));
    by_id('about').textContent = '';
    by_id('facts').textContent = `Sinew ${run.version}`;
    this.values = element('div', { class: 'values' });
    const charts = element('div', {});
    by_id('result').append(heading('Result'),
      run.refused ? element('p', { class: 'hint not-pinned' }, ...with_code(run.refused)) : '',
      this.values, charts, list('Warnings', run.warnings, ''), list('Remarks', run.notes, 'remark'),
      list('What this does not show', run.unseen, 'remark'));
    this.refresh();
    this.charts = run.charts.length ? new Charts(charts, run.charts, [], this.units, run.title) : null;
    if (run.warnings.length) by_id('chips').append(chip('result', `${run.warnings.length} warning${run.warnings.length > 1 ? 's' : ''}`, 'warn'));
    this.appearance = new Appearance(this.units, {
      on_units: () => (this.refresh(), this.charts?.rebuild()),
      on_colors: () => this.charts?.rebuild(),
      on_print: (begins) => this.charts?.print(begins),
    });
  }

  // Updates all numbers in the current units.
  refresh() {
    const { run, units } = this;
    const shown = (value, unit) => (value === null ? '–' : digits(units.convert(value, unit)));
    const has_bounds = run.values.some((v) => v.low !== null || v.high !== null);
    const bounds = (v) => (has_bounds ? [v.low, v.high].map((x) => cell(x === null ? '' : shown(x, v.unit), 'number')) : []);
    const rows = run.values.map((v) => element('tr', { 'data-key': v.key, 'data-value': v.value },
      element('th', { scope: 'row', class: 'key' }, v.name), cell(shown(v.value, v.unit), 'number ours'),
      cell(units.of(v.unit).label, 'unit'),
      ...bounds(v), cell(v.note, 'source')));
    this.values.replaceChildren(rows.length ? table('Values', ['', 'value', '', ...(has_bounds ? ['from', 'to'] : []), ''], rows) : '');
    const cells = (row, columns) => columns.map((c, i) =>
      typeof row[i] === 'string' ? cell(row[i], '') : cell(shown(row[i], c.unit), 'number'));
    by_id('tables').replaceChildren(...run.tables.filter((t) => t.rows.length).flatMap((t) => [heading(t.title, String(t.rows.length)),
      table(t.title, t.columns.map((c) => label_of(c.name, c.unit, units)), t.rows.map((row) => element('tr', {}, ...cells(row, t.columns))))]));
    by_id('tables').hidden = !run.tables.some((t) => t.rows.length);
  }
}

start_page((run) => ({ run, page: new DesignPage(run) }));
