// Page of one study or of two compared studies: history, all columns, two columns, influence of the
// parameters, a number over two parameters, and every row with the command that runs it again.
import { pressure_gradient } from './colors.js';
import { Appearance } from './appearance.js';
import { button, by_id, element, on_click, start_page } from './page.js';
import { value_text, view_colors } from './study_chart.js';
import { Filter, StudyData } from './study_data.js';
import { Parallel } from './study_parallel.js';
import { Growing } from './study_growing.js';
import { ChosenRow, Importance, RowTable } from './study_tables.js';
import { chooser, History, Scatter, Surface } from './study_views.js';
import { page_theme } from './theme.js';
import { Units } from './units.js';

class StudyPage {
  constructor(run) {
    this.run = run;
    this.data = new StudyData(run.studies);
    this.filter = new Filter(this.data);
    this.chosen = -1;
    this.under = -1;
    this.is_dragging = false;  // while a range is dragged, slow views are not drawn
    this.sort_columns();
    this.color_column = this.data.studies.length > 1 ? null : this.first_figures[1] ?? this.first_figures[0] ?? null;
    document.querySelector('.switch').hidden = true;  // each heading has its own unit
    this.views = [new History(this), new Scatter(this), new Importance(this), new Surface(this)];
    this.parallel = new Parallel(this);
    this.table = new RowTable(this);
    this.side = new ChosenRow(this);
    by_id('overview').append(this.parallel.root);
    by_id('views').append(...this.views.map((v) => v.root));
    by_id('side').append(this.side.root);
    by_id('table').append(this.table.root);
    this.head();
    this.appearance = new Appearance(new Units(101325), { on_units: () => {}, on_colors: () => this.draw(), on_print() {} });
    this.controls();
    this.arrange_choices();
    this.draw();
    this.side.draw();
    new ResizeObserver(() => this.redraw()).observe(by_id('views'));
    if (run.served) this.growing = new Growing(this);
  }

  // Sorts columns: parameters, objectives, constraints, numbers; within each, columns of both studies before
  // those of one. The views first show objectives, then other numbers that vary.
  sort_columns() {
    const rank = (c) => (['parameter', 'objective', 'constraint', 'figure'].indexOf(c.role) + 1 || 9) + (this.data.is_common(c) ? 0 : 0.5);
    this.columns = this.data.columns.map((c, i) => [rank(c), i, c]).sort((a, b) => a[0] - b[0] || a[1] - b[1]).map((c) => c[2]);
    this.parameters = this.columns.filter((c) => c.role === 'parameter');
    const figures = this.columns.filter((c) => c.number && ['objective', 'figure', 'constraint'].includes(c.role));
    this.first_figures = figures.some((c) => c.varies) ? figures.filter((c) => c.varies) : figures;
  }

  // --- head of the page ---

  head() {
    const { studies } = this.data;
    by_id('title').textContent = studies.map((s) => s.title).join(' · ');
    by_id('about').textContent = [...new Set(studies.map((s) => s.experiment))].join(' · ');
    this.facts();
    by_id('asked-text').append(...studies.map((s) => element('div', {},
      studies.length > 1 ? element('h3', {}, `${s.letter}: ${s.file}`) : '', element('pre', {}, s.asked))));
    if (studies.length > 1) by_id('studies').append(...studies.map((s) => this.study_button(s)));
    this.studies_shown = by_id('studies').children;
  }

  facts() {
    const { studies } = this.data;
    const words = studies.map((s) => `${studies.length > 1 ? `${s.letter} ` : ''}${s.file}: ${s.count} of ${s.expected} ` +
      `${s.kind === 'tune' ? 'candidates' : 'points'}`);
    by_id('facts').textContent = [...words, ...new Set(studies.map((s) => `Sinew ${s.version}`))].join(' · ');
  }

  study_button(s) {
    const mark = element('span', { class: `study-mark ${s.study ? 'triangle' : 'disc'}` });
    return button({ class: 'run', 'aria-pressed': 'true', title: `show or hide (${s.study + 1})` }, () => this.toggle_study(s.study),
      mark, element('b', {}, s.letter), element('span', {}, s.file));
  }

  toggle_study(study) {
    if (study >= this.data.studies.length) return;
    this.filter.studies[study] = !this.filter.studies[study];
    this.filtered();
  }

  arrange_choices() {
    for (const view of [...this.views, this.parallel, this.table]) view.arrange();
    const own = this.data.studies.length > 1 ? 'by study' : 'one color';
    by_id('color').replaceChildren(chooser('color', this.columns, this.color_column ?? '', (c) => {
      this.color_column = c || null;
      this.redraw();
    }, [['', own]]));
  }

  // --- the filter ---

  set_range(column, range) {
    this.filter.set_range(column, range);
    this.filtered();
  }

  // Updates the buttons at once and the drawings in the next frame.
  filtered() {
    this.filter.update();
    this.show_filter();
    this.redraw();
  }

  show_filter() {
    const { filter, data } = this;
    by_id('count').textContent = filter.is_on ? `${filter.rows.length} of ${data.count} rows` : `${data.count} rows`;
    by_id('clear').hidden = !filter.is_on;
    by_id('feasible').setAttribute('aria-pressed', String(filter.only_feasible));
    [...this.studies_shown].forEach((b, i) => b.setAttribute('aria-pressed', String(filter.studies[i])));
    by_id('ranges').replaceChildren(...[...filter.ranges].map(([column, [from, to]]) => {
      const words = column.number ? `${value_text(column, from)} – ${value_text(column, to)}`
        : column.words.filter((_, i) => i >= from && i <= to).join(', ') || 'none';
      return button({ class: 'chip', title: `${column.heading}; remove this range` }, () => this.set_range(column, null), `${column.key}: ${words} ✕`);
    }));
    const ramp = this.color_column?.varies ? this.color_column : null;
    by_id('ramp').hidden = !ramp;
    if (!ramp) return;
    by_id('ramp-low').textContent = value_text(ramp, ramp.low);
    by_id('ramp-high').textContent = value_text(ramp, ramp.high);
    by_id('ramp-colors').style.background = pressure_gradient;
  }

  clear() {
    by_id('words').value = '';
    this.filter.clear();
    this.filtered();
  }

  // --- rows ---

  choose(row) {
    if (row === this.chosen) return;
    this.chosen = row;
    this.side.draw();
    this.table.show(row);
    this.mark();
  }

  over(row) {
    if (row === this.under) return;
    this.under = row;
    this.mark();
  }

  // Chooses the next (1) or previous (-1) row in the order of the table.
  step(by) {
    const { sorted } = this.table, at = sorted.indexOf(this.chosen);
    if (sorted.length) this.choose(sorted[Math.min(sorted.length - 1, Math.max(0, at + by))]);
  }

  mark() {
    for (const view of [...this.views, this.parallel]) view.show?.(this.under, this.chosen);
  }

  // --- drawing ---

  // Draws once in the next frame, even after several calls.
  redraw() {
    this.waiting ??= requestAnimationFrame(() => this.draw());
  }

  draw() {
    this.waiting = undefined;
    const began = performance.now(), colors = view_colors(page_theme());
    this.show_filter();
    for (const view of [this.parallel, ...this.views]) if (!this.is_dragging || !view.takes_long) view.draw(colors);
    this.table.draw();
    this.mark();
    this.took = performance.now() - began;
  }

  // Updates the page after new rows; axes and texts of columns may have changed.
  grown(columns_changed) {
    this.filter.update();
    this.facts();
    if (columns_changed) this.arrange_choices();
    this.redraw();
  }

  controls() {
    by_id('words').addEventListener('input', () => {
      this.filter.words = by_id('words').value.toLowerCase().split(/\s+/).filter(Boolean);
      this.filtered();
    });
    on_click('feasible', () => {
      this.filter.only_feasible = !this.filter.only_feasible;
      this.filtered();
    });
    on_click('clear', () => this.clear());
    addEventListener('keydown', (e) => this.key(e));
  }

  key(e) {
    if (e.ctrlKey || e.metaKey || e.altKey || /^(INPUT|SELECT|TEXTAREA)$/.test(e.target.tagName)) return;
    if (e.key === 'Escape') this.choose(-1);
    else if (e.key === 'ArrowRight') this.step(1);
    else if (e.key === 'ArrowLeft') this.step(-1);
    else if (e.key === '0') this.clear();
    else if (/^[12]$/.test(e.key) && this.data.studies.length > 1) this.toggle_study(Number(e.key) - 1);
    else return;
    e.preventDefault();
  }
}

start_page((run) => ({ run, page: new StudyPage(run) }));
