// Tables of a comparison: numbers of the runs, parameters that differ, and differences of channels.
import { breakable, button, by_id, element } from './page.js';
import { letter_of } from './runs.js';
import { cell, heading, long_cell, searched, table } from './tables.js';
import { difference_unit, number, signed, unit_of_key, words_of_key } from './units.js';

// Returns whether the values differ; null, for a run without this number, is ignored.
export function differ(values) {
  const there = values.filter((v) => v !== null);
  return there.some((v) => v !== there[0]);
}

// Returns the largest relative change, |b - a| divided by the larger of both, as the program sorts by it.
function size_of_change([first, ...others]) {
  if (first === null) return 0;
  return Math.max(0, ...others.map((v) =>
    v === null || v === first ? 0 : Math.abs(v - first) / Math.max(Math.abs(first), Math.abs(v))));
}

// Returns whether the runs have different verdicts, each by its own experiment file; runs without a
// verdict are ignored.
export const judged_differently = ({ verdicts }) => new Set((verdicts ?? []).filter((v) => v)).size > 1;

function percent(relative, value) {
  if (relative === null) return value === null ? '' : 'from 0';
  const p = 100 * relative, size = Math.abs(p);
  if (p === 0) return '=';
  const text = size >= 9.95 ? p.toFixed(0) : size >= 0.01 ? p.toPrecision(2) : p.toExponential(0);
  return `${p > 0 ? '+' : ''}${text} %`.replace(/-/g, '−');
}

// Returns a toggle button.
const toggle_button = (words, on_change) => button({ 'aria-pressed': 'false' }, (event, own) => {
  const on = own.getAttribute('aria-pressed') !== 'true';
  own.setAttribute('aria-pressed', String(on));
  on_change(on);
}, words);

// Returns the list with a search field and buttons above it.
function with_tools(list, rows, label, buttons) {
  const found = searched(list, rows, label);
  found.prepend(element('div', { class: 'tools no-print' }, found.querySelector('.search'), ...buttons));
  return found;
}

// Puts the rows of a table into this order.
function order(list, rows) {
  list.querySelector('tbody').append(...rows.map((r) => r.row));
}

export class ComparisonTables {
  // `visit(channel, time)` shows a channel's plot at a time.
  constructor(data, units, visit) {
    Object.assign(this, { data, units, visit });
    this.others = data.runs.map((r, i) => i).slice(1);
    this.figures();
    this.parameters();
    this.channels();
    this.refresh();
  }

  refresh() {
    for (const r of this.figure_rows) this.fill_figure(r);
    for (const r of this.channel_rows) this.fill_channel(r);
  }

  // Marks a table that is wider than paper: in print each run has its own line or column.
  mark_several(list) {
    list.classList.toggle('of-several', this.others.length > 1);
    list.style.setProperty('--others', this.others.length);
  }

  // --- figures ---

  figures() {
    this.figure_rows = this.data.figures.map((figure) => this.figure_row(figure));
    const heads = ['', 'A', ...this.others.flatMap((i) => [letter_of(i), `${letter_of(i)} − A`, '']), '', ''];
    const list = table('Numbers of the runs', heads, this.figure_rows.map((r) => r.row));
    list.querySelectorAll('thead th').forEach((th, i) => i > 0 && i < heads.length - 2 && th.classList.add('number'));
    list.classList.add('only-differing');
    this.mark_several(list);
    const buttons = [
      toggle_button('Largest change first', (on) => order(list, on ? by_size(this.figure_rows) : this.figure_rows)),
      toggle_button('Show equal ones', (on) => list.classList.toggle('only-differing', !on)),
    ];
    const differing = this.data.figures.filter((f) => differ(f.values)).length;
    by_id('figures').append(heading('Numbers', `${differing} of ${this.figure_rows.length} differ`),
      with_tools(list, this.figure_rows, 'Search numbers', buttons));
  }

  figure_row(figure) {
    const cells = this.data.runs.flatMap((run, i) => i === 0 ? [cell('', 'number')]
      : [cell('', 'number'), cell('', 'number difference'), cell('', 'number difference')]);
    const unit = cell('', 'unit');
    const judged = figure.verdicts ?? [];
    const changed = judged_differently(figure);
    const alike = judged.every((v) => v === judged[0]);
    const words = alike ? judged[0] ?? '' : judged.map((v) => v ?? 'not judged').join(' → ');
    const row = element('tr', { 'data-key': figure.key, title: figure.key },
      element('th', { scope: 'row' }, words_of_key(figure.key)), ...cells, unit,
      element('td', { class: changed ? 'changed' : 'quiet' }, words));
    row.classList.toggle('equal', !differ(figure.values));
    return { figure, row, cells, unit, size: size_of_change(figure.values) };
  }

  fill_figure({ figure, cells, unit: unit_cell }) {
    const unit = /share|passiveness|duty/.test(figure.key) ? 'share' : unit_of_key(figure.key);
    const shown = this.units.of(unit), scale = this.units.of(difference_unit(unit)).scale;
    const value = (v) => v === null ? '–'
      : unit === '1' && Number.isInteger(v) ? String(v) : number(this.units.convert(v, unit));
    cells[0].textContent = value(figure.values[0]);
    for (const i of this.others) {
      const [own, difference, relative] = cells.slice(3 * i - 2, 3 * i + 1), d = figure.differences[i];
      own.textContent = value(figure.values[i]);
      difference.textContent = d === null ? '' : signed(d * scale);
      // A change relative to the absolute pressure would mislead where gauge pressure is shown.
      relative.textContent = d === null || shown.offset ? '' : percent(figure.relative[i], figure.values[i]);
    }
    unit_cell.textContent = shown.label;
  }

  // --- parameters ---

  parameters() {
    const rows = this.data.parameters.map(({ key, values }) => ({
      row: element('tr', { 'data-key': key }, element('th', { scope: 'row', class: 'key' }, ...breakable(key)),
        ...values.map((v) => (v === null ? cell('–', 'quiet') : long_cell(v)))),
    }));
    const root = by_id('parameters');
    root.append(heading('Parameters', rows.length ? `${rows.length} differ, resolved.toml` : 'all equal'));
    if (!rows.length) return;
    const list = table('Parameters that differ', ['key', ...this.data.runs.map((r, i) => letter_of(i))], rows.map((r) => r.row));
    root.append(rows.length > 12 ? searched(list, rows, 'Search keys and values') : list);
  }

  // --- channels ---

  channels() {
    this.channel_rows = this.data.channels.map((channel) => this.channel_row(channel));
    const most = Math.max(...this.channel_rows.map((r) => r.size), 1e-300);
    for (const r of this.channel_rows) r.bar.style.width = `${(100 * r.size) / most}%`;
    const heads = ['channel', '', ...this.others.flatMap((i) =>
      [element('span', {}, 'rms', element('span', { class: 'of-run' }, `, ${letter_of(i)} − A`)), 'of range', 'bias', 'at most', 'at', 'correlation', '']), 'unit'];
    const sorted = by_size(this.channel_rows);
    const list = table('Differences of channels', heads, sorted.map((r) => r.row));
    list.classList.add('only-differing');
    this.mark_several(list);
    const with_numbers = [0, 1, 2, 3, 5];  // of the columns of a run
    list.querySelectorAll('thead th').forEach((th, i) => i > 1 && i < heads.length - 1 && with_numbers.includes((i - 2) % 7) && th.classList.add('number'));
    const same = this.data.channels.filter((c) => c.differences.every((d) => !d || d.same)).length;
    by_id('channels').append(
      heading('Channels', `${this.channel_rows.length} compared, ${same} with equal samples; the bar is rms divided by the range of values`),
      with_tools(list, this.channel_rows, 'Search channels', [
        toggle_button("In the log's order", (on) => order(list, on ? this.channel_rows : sorted)),
        toggle_button('Show equal ones', (on) => list.classList.toggle('only-differing', !on)),
      ]));
  }

  channel_row(channel) {
    const bar = element('i', {});
    const name = channel.field === 'value' ? channel.topic : `${channel.topic}.${channel.field}`;
    const cells = this.others.map((i) => this.channel_cells(channel, channel.differences[i], `${letter_of(i)} − A`));
    const unit = cell('', 'unit');
    const row = element('tr', { 'data-key': name }, element('th', { scope: 'row', class: 'key' }, ...breakable(name)),
      element('td', { class: 'bar-cell' }, bar), ...cells.flatMap((c) => c.all), unit);
    row.classList.toggle('equal', channel.differences.every((d) => !d || d.same || (d.samples > 0 && d.largest === 0)));
    const share = (d) => (d && d.span > 0 && d.rms !== null ? d.rms / d.span : 0);
    return { channel, row, bar, cells, unit, size: Math.max(...channel.differences.map(share)) };
  }

  channel_cells(channel, d, pair) {
    const rms = element('td', { class: 'number', 'data-pair': pair }), bias = cell('', 'number'), largest = cell('', 'number'), at = cell('', ''), note = cell(note_of(d), 'quiet');
    const share = cell(d && d.span > 0 && d.rms > 0 && d.meet !== 'held' ? `${number((100 * d.rms) / d.span)} %` : '', 'number');
    const r = cell(d && typeof d.correlation === 'number' && !d.same ? d.correlation.toFixed(4).replace('-', '−') : '', 'number');
    if (d && !d.same && d.at_s !== null && d.largest !== 0)
      at.append(button({ class: 'time' }, () => this.visit(`${channel.topic} ${channel.field}`, d.at_s), `${d.at_s.toFixed(3)} s`));
    return { d, rms, bias, largest, all: [rms, share, bias, largest, at, r, note] };
  }

  fill_channel({ channel, cells, unit }) {
    const { scale, label } = this.units.of(difference_unit(channel.unit));
    for (const { d, rms, bias, largest } of cells) {
      const drawn = d && !d.same && d.rms !== null && d.largest !== 0 && d.meet !== 'held';
      rms.textContent = drawn ? number(d.rms * scale) : '';
      bias.textContent = drawn && typeof d.bias === 'number' ? signed(d.bias * scale) : '';
      largest.textContent = drawn ? signed(d.largest * scale) : '';
    }
    unit.textContent = label;
  }
}

const by_size = (rows) => [...rows].sort((a, b) => b.size - a.size);

// Returns how the samples were matched, where this is not obvious.
function note_of(d) {
  if (!d) return 'missing';
  if (d.same) return 'same samples';
  if (d.samples === 0) return 'no common time';
  const out = [];
  if (d.largest === 0) out.push('equal at common times');
  if (d.meet === 'between') out.push('interpolated');
  if (d.meet === 'held' && d.largest !== 0) out.push(`different ${number(100 * d.rms ** 2)} % of the time`);
  if (d.gaps > 0) out.push(`${d.gaps} gaps`);
  return out.join(', ');
}
