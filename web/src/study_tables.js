// Influence of the parameters as bars, the chosen row with its command, and the table of rows.
import { breakable, button, element } from './page.js';
import { value_text } from './study_chart.js';
import { variance_share } from './study_math.js';
import { chooser } from './study_views.js';
import { number } from './units.js';

const page_of_rows = 50;

const percent = (share) => `${(100 * share).toFixed(share < 0.1 ? 1 : 0)} %`;

// --- importance ---

export class Importance {
  constructor(page) {
    this.page = page;
    this.of = page.first_figures[0] ?? page.columns[0];
    this.choices = element('div', { class: 'choices no-print' });
    this.list = element('ol', { class: 'shares' });
    this.hint = element('p', { class: 'hint' });
    this.root = element('section', { class: 'study-view', id: 'importance' },
      element('header', {}, element('h2', {}, 'Influence of parameters'), this.choices), this.list, this.hint);
  }

  arrange() {
    const { page } = this;
    this.choices.replaceChildren(chooser('number', page.columns.filter((c) => c.role !== 'parameter'), this.of, (c) => {
      this.of = c;
      page.redraw();
    }));
  }

  draw() {
    const { page } = this, { data, filter } = page;
    const rows = filter.rows.filter((r) => data.ok[r]);
    this.shares = page.parameters.map((c) => ({ column: c, ...variance_share(rows, c.values, this.of.values) }))
      .filter((s) => s.share !== undefined).sort((a, b) => b.share - a.share);
    this.list.replaceChildren(...this.shares.map((s) => this.bar(s)));
    this.hint.textContent = this.shares.length ? this.words() : 'Too few rows, or nothing varies.';
  }

  bar({ column, share, chance, bins, rows }) {
    const fill = element('i', { class: 'share' }), tick = element('i', { class: 'chance', title: `exceeded by chance with a probability of 5 %: ${percent(chance)}` });
    fill.style.width = `${100 * share}%`;
    tick.style.left = `${100 * chance}%`;
    const none = share <= chance;
    return element('li', { 'data-heading': column.heading, 'data-share': share, class: none ? 'none' : null, title: `${rows} rows in ${bins} bins` },
      element('span', { class: 'key' }, ...breakable(column.heading)), element('span', { class: 'track' }, fill, tick),
      element('b', {}, none ? `${percent(share)}, not significant` : percent(share)));
  }

  words() {
    const sum = this.shares.reduce((all, s) => all + s.share, 0);
    const drawn = this.page.data.studies.every((s) => s.kind === 'sweep') && !this.page.filter.is_on;
    return 'Share of the number’s variance that one parameter alone explains: the variation of its mean over bins of that parameter, corrected for chance. ' +
      'The mark is the share that is exceeded by chance with a probability of 5 %. Shares depend on the ranges that were varied and do not include interactions. ' +
      (drawn ? `The rest, ${percent(Math.max(0, 1 - sum))}, is due to interactions, seeds, and variation within bins.`
        : 'These rows were chosen by a tuner or a filter: their parameters are correlated, and the shares overlap.');
  }
}

// --- the chosen row ---

export class ChosenRow {
  constructor(page) {
    this.page = page;
    this.root = element('aside', { class: 'chosen-row', id: 'chosen', 'aria-label': 'The chosen row', 'aria-live': 'polite' });
  }

  draw() {
    const { page } = this, { data, chosen } = page;
    this.root.classList.toggle('is-empty', chosen < 0);
    if (chosen < 0) return this.root.replaceChildren(element('h2', {}, 'No row is chosen'),
      element('p', { class: 'quiet' }, 'Click a mark, a line or a row of the table; ← → move from row to row, Esc clears the choice.'));
    const study = data.studies[data.study[chosen]], command = data.command_of(chosen);
    const kind = study.kind === 'tune' ? 'Candidate' : 'Row';
    this.root.replaceChildren(
      element('header', {}, element('h2', {}, `${kind} ${data.name_of(chosen)}`), this.steps()),
      this.state(chosen),
      this.values('parameter', 'Parameters'), this.values('', 'Numbers'),
      element('h3', {}, 'Run it again'), element('pre', { class: 'command', tabindex: '0' }, command),
      ...(study.cases ?? []).flatMap((one) => [element('h4', {}, `In the case “${one.name}”`),
        element('pre', { class: 'command', 'data-case': one.name, tabindex: '0' }, data.command_of(chosen, one))]),
      study.kind === 'tune' ? element('p', { class: 'quiet' }, 'One run, with the experiment’s own seed; a candidate’s numbers are over all of its runs.') : '',
      this.buttons(study, command));
  }

  steps() {
    const step = (words, label, by) => button({ class: 'icon', 'aria-label': label, title: label }, () => this.page.step(by), words);
    return element('div', { class: 'steps no-print' }, step('←', 'Previous row (←)', -1), step('→', 'Next row (→)', 1));
  }

  state(row) {
    const { data, filter } = this.page, words = [];
    if (data.generation[row] >= 0) words.push(`generation ${data.generation[row]}`);
    if (!data.ok[row]) words.push('without numbers');
    if (data.violation[row] > 0) words.push(`beyond its limits by ${number(data.violation[row])}`);
    if (!filter.shown[row]) words.push('hidden by the filter');
    if (data.studies.length > 1) words.push(data.studies[data.study[row]].file);
    for (const c of data.studies[data.study[row]].own)
      if (c.role === 'other' && c.texts[row]) words.push(`${c.key}: ${c.texts[row]}`);
    return element('p', { class: 'quiet' }, words.join(' · '));
  }

  values(role, title) {
    const { page } = this, own = page.data.studies[page.data.study[page.chosen]].own;
    const columns = own.filter((c) => c.role !== 'other' && (c.role === 'parameter') === (role === 'parameter'));
    if (!columns.length) return '';
    return element('div', {}, element('h3', {}, title), element('table', { 'aria-label': title }, element('tbody', {},
      ...columns.map((c) => element('tr', { 'data-heading': c.heading },
        element('th', { scope: 'row', class: 'key', title: c.heading }, c.key),
        element('td', { class: c.number ? 'number ours' : 'ours', title: c.texts[page.chosen] }, c.number ? value_text(c, c.values[page.chosen]) : c.texts[page.chosen] || '–'),
        element('td', { class: 'unit' }, c.number ? c.unit : ''))))));
  }

  buttons(study, command) {
    const { page } = this;
    const copy = button({ id: 'copy' }, async () => {
      copy.textContent = (await copied(command, this.root.querySelector('.command'))) ? 'Copied' : 'Selected: press Ctrl-C';
    }, 'Copy');
    const run = page.run.served && page.data.ok[page.chosen] !== undefined
      ? element('a', { id: 'run-it', class: 'button', href: `${study.path}run/${page.data.number[page.chosen]}`, target: '_blank', rel: 'noopener' }, 'Run and show')
      : null;
    return element('div', { class: 'buttons no-print' }, copy, run);
  }
}

// Some browsers give a page from a file no clipboard; the text is then selected and copied.
async function copied(text, place) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    getSelection().selectAllChildren(place);
    return document.execCommand('copy');
  }
}

// --- the table ---

export class RowTable {
  constructor(page) {
    this.page = page;
    this.from = 0;
    this.by = null;  // sort by this column; null: in order of rows
    this.down = false;
    this.head = element('thead', {});
    this.body = element('tbody', {});
    this.count = element('span', { class: 'quiet', 'aria-live': 'polite' });
    const turn = (words, label, by) => button({ 'aria-label': label }, () => this.turn(by), words);
    this.turns = element('div', { class: 'turns no-print' }, turn('‹', 'Previous rows', -1), this.count, turn('›', 'Next rows', 1));
    this.root = element('section', { class: 'block', id: 'rows' },
      element('header', {}, element('h2', {}, 'Rows'), this.turns),
      element('div', { class: 'scroll' }, element('table', { 'aria-label': 'Rows' }, this.head, this.body)));
  }

  arrange() {
    const heading = (words, column, title) => {
      const sorted = this.by === column;
      return element('th', { scope: 'col', 'aria-sort': sorted ? (this.down ? 'descending' : 'ascending') : null, class: !column || column.number ? 'number' : null },
        button({ title }, () => this.sort(column), ...breakable(words), sorted ? (this.down ? ' ↓' : ' ↑') : ''));
    };
    this.head.replaceChildren(element('tr', {}, heading('row', null, 'The order of rows'), ...this.page.columns.map((c) => heading(c.heading, c, `Sort by ${c.heading}`))));
  }

  sort(column) {
    this.down = this.by === column && !this.down;
    this.by = column;
    this.from = 0;
    this.arrange();
    this.draw();
  }

  // Returns rows in the order of the table; those without a value are last.
  order() {
    const { filter: { rows }, data } = this.page, { by } = this, sign = this.down ? -1 : 1;
    const plain = (a, b) => data.study[a] - data.study[b] || data.number[a] - data.number[b];
    if (!by) return [...rows].sort((a, b) => sign * plain(a, b));
    const v = by.values, key = by.number ? (r) => v[r] : (r) => by.texts[r] ?? '';
    const there = rows.filter((r) => (by.number ? v[r] === v[r] : by.texts[r])), missing = rows.filter((r) => !(by.number ? v[r] === v[r] : by.texts[r]));
    const less = (a, b) => (key(a) < key(b) ? -1 : key(a) > key(b) ? 1 : 0);
    return [...there.sort((a, b) => sign * less(a, b) || plain(a, b)), ...missing];
  }

  turn(by) {
    this.from = Math.max(0, Math.min(this.from + by * page_of_rows, page_of_rows * Math.floor(Math.max(0, this.sorted.length - 1) / page_of_rows)));
    this.draw();
  }

  draw() {
    this.sorted = this.order();
    if (this.from >= this.sorted.length) this.from = 0;
    const to = Math.min(this.sorted.length, this.from + page_of_rows);
    this.count.textContent = this.sorted.length ? `${this.from + 1}–${to} of ${this.sorted.length}` : 'none';
    this.body.replaceChildren(...this.sorted.slice(this.from, to).map((row) => this.line(row)));
  }

  line(row) {
    const { page } = this, { data } = page;
    const name = element('button', { type: 'button', 'aria-label': `Choose row ${data.name_of(row)}` }, data.name_of(row));
    const line = element('tr', { 'data-row': row, class: data.feasible[row] ? null : 'refused', 'aria-selected': String(row === page.chosen) },
      element('th', { scope: 'row', class: 'number' }, name),
      ...page.columns.map((c) => element('td', { class: c.number ? 'number' : 'long', title: c.texts[row] },
        c.number ? value_text(c, c.values[row]) : c.texts[row] || '–')));
    line.addEventListener('click', () => page.choose(row));
    line.addEventListener('pointerenter', () => page.over(row));
    return line;
  }

  // Turns the table to the page of the chosen row, without scrolling to it.
  show(chosen) {
    const at = chosen < 0 ? -1 : this.sorted.indexOf(chosen);
    if (at >= 0 && (at < this.from || at >= this.from + page_of_rows)) {
      this.from = page_of_rows * Math.floor(at / page_of_rows);
      this.draw();
    }
    for (const line of this.body.children) line.setAttribute('aria-selected', String(Number(line.dataset.row) === chosen));
  }
}
