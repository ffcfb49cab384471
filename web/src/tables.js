// Tables of the page of a run: results compared with reported values, all numbers, warnings, and all
// parameters.
import { breakable, button, by_id, element } from './page.js';
import { number, unit_of_key, words_of_key } from './units.js';

export function table(label, heads, rows) {
  return element('div', { class: 'scroll' },
    element('table', { 'aria-label': label },
      element('thead', {}, element('tr', {}, ...heads.map((h) => element('th', { scope: 'col' }, h)))),
      element('tbody', {}, ...rows)));
}

export const cell = (words, kind) => element('td', kind ? { class: kind } : {}, words);
export const heading = (words, note) =>
  element('h2', {}, words, note ? element('span', { class: 'note' }, note) : null);

const verdict_class = (is) =>
  is === 'agrees' ? 'good' : is === 'not applicable' ? 'none' : is === 'differs as known' ? 'known' : 'bad';

export const count_verdicts = (verdicts) => ({
  agree: verdicts.filter((v) => v.is === 'agrees').length,
  judged: verdicts.filter((v) => v.is !== 'not applicable').length,
  bad: verdicts.filter((v) => verdict_class(v.is) === 'bad').length,
});

// Counts of verdicts by class, the strongest class first: "agree: 0 of 1 predicted, 5 of 5 fitted".
const classes = ['predicted', 'fitted', 'put in', 'by construction', 'code against code', '-'];
export function counts_in_words(verdicts) {
  const parts = classes.map((of) => [of, count_verdicts(verdicts.filter((v) => (v.class ?? '-') === of))])
    .filter(([, n]) => n.judged).map(([of, n]) => `${n.agree} of ${n.judged} ${of === '-' ? 'without a class' : of}`);
  return parts.length ? `agree: ${parts.join(', ')}` : 'have no verdict';
}

// --- results ---

export function show_results(run) {
  const root = by_id('results');
  if (!run.verdicts.length) return root.remove();
  const rows = run.verdicts.map((v) =>
    element('tr', { 'data-key': v.key },
      element('th', { scope: 'row', title: v.key }, words_of_key(v.key)),
      cell(v.reported, 'number'), cell(v.ours || '–', 'number ours'), cell(v.accept, 'number quiet'),
      element('td', { class: 'quiet', title: v.wording }, v.class ?? ''),
      element('td', {}, element('span', { class: `verdict ${verdict_class(v.is)}` }, v.is)),
      cell(v.source, 'source')));
  root.append(heading('Results', counts_in_words(run.verdicts)),
    table('Results', ['', 'reported', 'this run', 'accepted', 'class', '', 'source'], rows));
}

// Returns a button with a span of time that moves the time to its start.
export const time_button = (from, to, seek, words = '') => button({ class: 'time' }, () => seek(from), words + span_text(from, to));
export const span_text = (from, to) => (to > from ? `${from.toFixed(2)}–${to.toFixed(2)} s` : `${from.toFixed(2)} s`);

// --- warnings ---

export function show_warnings(run, seek) {
  const root = by_id('warnings');
  if (!run.warnings.length) return root.remove();
  const items = run.warnings.map((w) => {
    const times = w.spans.slice(0, 8).map(([from, to]) => time_button(from, to, seek));
    if (w.spans.length > 8) times.push(element('span', { class: 'quiet' }, `and ${w.spans.length - 8} more`));
    return element('li', {}, element('p', {}, w.text), element('div', { class: 'times' }, ...times));
  });
  root.append(heading('Warnings', String(run.warnings.length)), element('ul', { class: 'warnings' }, ...items));
}

// --- faults ---

// Shows the list of faults that the plots shade; each is a button that moves the time to its start.
export function show_faults(run, seek) {
  const root = by_id('faults');
  root.hidden = !run.faults?.length;
  if (root.hidden) return;
  root.append(element('span', { class: 'key' }, 'injected faults'), ...run.faults.map((f) => time_button(f.from, f.to, seek, `${f.of} ${f.what}, `)));
}

// Returns the faults that are active at t.
export function faults_at(run, t) {
  return (run.faults ?? []).filter((f) => t >= f.from && t < f.to);
}

export function mark_faults(run, t) {
  const now = new Set(faults_at(run, t));
  by_id('faults').querySelectorAll('button').forEach((button, i) => button.classList.toggle('now', now.has(run.faults[i])));
}

// --- all numbers of the summary ---

function* leaves(object, path = '') {
  for (const [key, value] of Object.entries(object)) {
    const at = path ? `${path}.${key}` : key;
    if (typeof value === 'number') yield [at, value];
    else if (value && typeof value === 'object' && !Array.isArray(value)) yield* leaves(value, at);
  }
}

export class Numbers {
  constructor(run, units) {
    this.units = units;
    this.root = by_id('numbers');
    this.rows = [...leaves(run.summary)].map(([key, value]) => {
      const shown = element('td', { class: 'number' });
      const row = element('tr', { 'data-key': key, 'data-value': value, title: `${key}: ${value}` },
        element('th', { scope: 'row' }, words_of_key(key)), shown, element('td', { class: 'unit' }));
      return { key, value, shown, row, unit: row.lastChild };
    });
    const list = table('Numbers of the run', ['', '', ''], this.rows.map((r) => r.row));
    this.root.append(heading('Numbers', 'summary.json'), searched(list, this.rows, 'Search numbers'));
    this.refresh();
  }

  refresh() {
    for (const r of this.rows) {
      const unit = /share|passiveness|duty/.test(r.key) ? 'share' : unit_of_key(r.key);
      const { value, label } = this.units.words(r.value, unit);
      r.shown.textContent = unit === '1' && Number.isInteger(value) ? String(value) : number(value);
      r.unit.textContent = label;
    }
  }
}

// --- every value ---

// Returns a table cell; a long list is shortened, with the whole text in its title.
export function long_cell(words) {
  const most = 120;
  if (words.length <= most) return cell(words, 'long');
  return element('td', { class: 'long', title: words }, `${words.slice(0, most)} …`);
}

export function show_parameters(run, file = 'resolved.toml') {
  const rows = run.parameters.map(([key, value, mark, range, uncertainty, source]) => ({
    row: element('tr', { 'data-key': key },
      element('th', { scope: 'row', class: 'key' }, ...breakable(key)), long_cell(value),
      element('td', {}, mark ? element('span', { class: `tag ${mark}` }, mark) : ''),
      cell([range, uncertainty && `± ${uncertainty}`].filter(Boolean).join(', '), 'quiet'),
      cell(source, 'source')),
  }));
  const list = table('Parameters', ['key', 'value', '', 'range', 'source'], rows.map((r) => r.row));
  by_id('parameters').append(heading('Parameters', `${rows.length} values, ${file}`),
    searched(list, rows, 'Search keys, values and sources'));
}

// Returns a table with a search field above it, which hides rows that lack any of its words.
export function searched(list, rows, label) {
  const field = element('input', { type: 'search', placeholder: label, 'aria-label': label, class: 'no-print' });
  const texts = rows.map((r) => `${r.row.dataset.key} ${r.row.textContent}`.toLowerCase());
  const count = element('span', { class: 'quiet', 'aria-live': 'polite' });
  field.addEventListener('input', () => {
    const words = field.value.toLowerCase().split(/\s+/).filter(Boolean);
    let found = 0;
    rows.forEach((r, i) => {
      const wanted = words.every((w) => texts[i].includes(w));
      r.row.hidden = !wanted;
      found += wanted;
    });
    count.textContent = words.length ? `${found} of ${rows.length}` : '';
  });
  return element('div', {}, element('div', { class: 'search no-print' }, field, count), list);
}
