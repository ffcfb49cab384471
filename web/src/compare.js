// Page that compares several runs: each channel of all runs in one plot, differences, and tables.
import { Charts } from './charts.js';
import { Machines } from './compare_scene.js';
import './film.js';
import { ComparisonTables, differ, judged_differently } from './compare_tables.js';
import { button, by_id, chip, on_click, start_page } from './page.js';
import { Plan } from './plan.js';
import { Player } from './player.js';
import { Plots } from './plots.js';
import { finest_clock, ReplayPage } from './replay_page.js';
import { read_samples } from './samples.js';
import { line_of, letter_of, RunLegend } from './runs.js';
import { difference_unit, signed, Units } from './units.js';

// Returns a column that the program left out because it is the sum of the first run's and the difference.
function sum(first, difference) {
  return { time: first.time, values: first.values.map((v, i) => v + difference.values[i]) };
}

// Returns the columns of a panel: each run's values and differences to the first run; null if missing.
function columns_of(panel, columns) {
  const of = (i) => (i === null ? null : columns[i]);
  const differences = panel.differences.map(of);
  const values = panel.columns.map((i, run) =>
    of(i) ?? (differences[run] ? sum(columns[panel.columns[0]], differences[run]) : null));
  return { values, differences };
}

// Returns "+2.500 s ± 0.003 s", with two digits of the uncertainty.
function with_uncertainty(value, uncertainty, unit) {
  if (uncertainty === null) return `${signed(value)} ${unit}`;
  const digits = uncertainty > 0 ? Math.min(9, Math.max(0, 1 - Math.floor(Math.log10(uncertainty)))) : 4;
  const text = `${value >= 0 ? '+' : '−'}${Math.abs(value).toFixed(digits)}`;
  return `${text} ${unit} ± ${uncertainty.toFixed(digits)} ${unit}`;
}

// Returns "0.29 % ± 0.11 % faster", or "slower".
const pace = (rate, uncertainty) =>
  `${with_uncertainty(100 * Math.abs(rate), uncertainty && 100 * uncertainty, '%').slice(1)} ${rate < 0 ? 'slower' : 'faster'}`;

// Returns how a run was aligned with the first one.
function alignment_words(run, i, fitted) {
  const a = run.alignment;
  if (!a) return '';
  if (a.same) return `${letter_of(i)} has the same samples and is not shifted`;
  const by = [a.event && `event: ${a.event}`, a.channels.length && `correlation of ${a.channels.join(', ')}`].filter(Boolean).join('; ');
  return `${letter_of(i)}'s clock shows ${with_uncertainty(a.shift_s, a.shift_uncertainty_s, 's')} at A's 0` +
    (fitted ? ` and runs ${pace(a.rate, a.rate_uncertainty)}` : '') +
    (a.correlation === null ? '' : `, r ${a.correlation.toFixed(4)}`) + ` (${by})` +
    (a.rate_seen ? `; it seems to run ${pace(a.rate_seen, a.rate_seen_uncertainty)}, which is not corrected` : '');
}

class ComparePage extends ReplayPage {
  constructor(data, samples) {
    super();
    this.data = data;
    this.units = new Units(data.runs[0].atmosphere);
    this.shown = data.runs.map(() => true);
    this.whole = [Math.min(...data.runs.map((r) => r.first_s)), Math.max(...data.runs.map((r) => r.last_s))];
    this.head();
    this.legend = new RunLegend(by_id('runs'), data.runs, (run) => this.toggle_run(run));
    this.make_plots(samples);
    this.make_machines(samples);
    this.tables = new ComparisonTables(data, this.units, (channel, t) => this.visit(channel, t));
    on_click('all-channels', () => this.switch_all());
    on_click('show-differences', () => this.switch_differences());
    this.controls({ d: () => this.switch_differences(),
                    ...Object.fromEntries(data.runs.map((r, run) => [run + 1, () => this.toggle_run(run)])) });
    this.seek(this.whole[0]);
  }

  head() {
    const { runs, align, figures, parameters, channels } = this.data;
    const titles = [...new Set(runs.map((r) => r.title || r.label))];
    by_id('title').textContent = titles.length > 2 ? `${titles[0]} and ${titles.length - 1} others` : titles.join(' · ');
    const aligned = { start: 'times from the start of each run', sequence: 'aligned at the start of the sequence, in the time of the first run',
    event: 'aligned by an event', correlation: 'aligned by the greatest correlation' };
    by_id('facts').textContent = `${runs.length} runs, each compared with the first; ${aligned[align]}` +
      runs.map((run, i) => alignment_words(run, i, this.data.clock === 'fit')).filter(Boolean).map((w) => `. ${w}`).join('');
    const differing = figures.filter((f) => differ(f.values)).length;
    const changed = figures.filter((f) => judged_differently(f)).length;
    const several = (count, word) => `${count} ${word}${count === 1 ? ' differs' : 's differ'}`;
    const same = channels.filter((c) => c.differences.every((d) => !d || d.same)).length;
    by_id('chips').append(
      chip('figures', `${differing} of ${figures.length} numbers differ`),
      ...(changed ? [chip('figures', `${changed} with another verdict`, 'warn')] : []),
      chip('parameters', parameters.length ? several(parameters.length, 'parameter') : 'same parameters'),
      chip('channels', same === channels.length ? 'same samples in every channel'
        : `${channels.length} channels, ${same} with equal samples`));
  }

  // --- plots ---

  make_plots(samples) {
    const { data } = this;
    const columns = [], specs = [];
    this.of_channel = new Map();
    for (const panel of data.panels) {
      const found = columns_of(panel, samples);
      const { values, differences } = specs_of(panel, found, columns, data.runs);
      this.of_channel.set(`${panel.topic} ${panel.field}`, { panel, ...found, at: specs.length });
      specs.push(values);
      if (differences.lines.length) specs.push(differences);
    }
    const run = { start: this.whole[0], duration: this.whole[1], phases: data.runs[0].phases, panels: specs };
    this.plots = new Plots(by_id('panels'), run, columns, this.units, (t) => this.seek(t));
    for (const p of this.plots.panels) if (p.spec.difference) p.root.classList.add('difference');
    this.plan = new Plan(by_id('plan'), data.runs, this.plots, this.shown);
    by_id('plan').hidden = !data.runs.some((r) => r.phases.stretches.some((s) => s.stance));
    this.make_charts(samples);
    this.plots.on_view = () => this.draw_view();
    this.plots.on_values = (t) => this.show_values(t);
    document.querySelector('.stage').classList.toggle('without-plots', !specs.length);
    // Runs that were aligned with each other are usually compared by their remaining differences.
    this.shows_differences = data.align === 'event' || data.align === 'correlation';
    by_id('show-differences').setAttribute('aria-pressed', String(this.shows_differences));
    this.all = false;
    this.groups_shown = new Map();
    this.groups();
    this.arrange();
    new ResizeObserver(() => this.draw_view()).observe(by_id('plots'));
  }

  // Creates the drawing of the machines over each other, and its player.
  make_machines(columns) {
    const clock = finest_clock(this.plots.panels.flatMap((p) => p.columns));
    this.player = new Player(this.whole, clock, (t) => this.show(t));
    this.machines = new Machines(by_id('scene'), this.data.runs, columns, this.units, this.shown);
    document.querySelector('.stage').classList.toggle('without-machines', !this.machines.there);
    by_id('follow').hidden = !this.machines.can_follow();
    if (!this.machines.there) return;
    this.drawing = this.machines;
    by_id('machine-note').textContent = this.machines.note();
  }

  // Creates the chart of the foot paths, or the charts of a test stand.
  make_charts(samples) {
    const { charts, runs } = this.data, foot = this.foot_chart();
    this.follows_view = foot !== null;
    if (!foot && !charts.length) {
      document.querySelector('.stage').classList.add('without-foot');
      by_id('foot').hidden = true;
      return;
    }
    const columns = [...samples], of_run = (c) => ({ ...c, ...line_of(c.run), style: c.style });
    const specs = foot ? [{ ...foot, curves: foot.curves.map((c) => ({ ...of_run(c), x: columns.push(c.x) - 1, y: columns.push(c.y) - 1 })) }]
      : charts.map((chart) => {
        const names = new Set(chart.curves.map((c) => c.label).filter(Boolean));
        const name = (c) => (names.size > 1 && c.label ? `${letter_of(c.run)} ${c.label}` : letter_of(c.run));
        return { ...chart, note: runs.length > 2 ? '' : chart.note, curves: chart.curves.map((c) => ({ ...of_run(c), label: name(c) })) };
      });
    if (!foot) by_id('foot').setAttribute('aria-label', 'Charts');
    this.charts = new Charts(by_id('foot'), specs, columns, this.units, runs.map((r) => r.label).join('-'));
  }

  // Returns the foot path of each run, both axes to the same scale; null if the first run has no foot.
  foot_chart() {
    const of = (field) => this.of_channel.get(`${this.data.foot} ${field}`)?.values;
    const [xs, ys] = [of('x'), of('y')];
    if (!xs || !ys) return null;
    const curves = xs.flatMap((x, run) => (x && ys[run] ? [{ run, label: letter_of(run), style: 'line', x, y: ys[run] }] : []));
    return { title: 'Foot path', equal: true, x: { label: 'forward →', unit: 'm' }, y: { label: 'up ↑', unit: 'm' }, curves,
             note: this.data.foot.startsWith('/true') ? 'Relative to the first joint, within the time shown in the plots.'
               : 'From measured angles, relative to the first joint, within the time shown in the plots.' };
  }

  groups() {
    const names = [...new Set(this.data.panels.map((p) => p.group))];
    by_id('groups').append(...names.map((name) => {
      const shown = name !== 'Other' || names.length === 1;
      this.groups_shown.set(name, shown);
      return button({ 'aria-pressed': String(shown) }, (event, own) => {
        this.groups_shown.set(name, !this.groups_shown.get(name));
        own.setAttribute('aria-pressed', String(this.groups_shown.get(name)));
        this.arrange();
      }, name);
    }));
  }

  // Shows or hides the plots.
  arrange() {
    for (const p of this.plots.panels)
      p.root.hidden = !this.groups_shown.get(p.spec.group) || !(p.spec.main || this.all) ||
                      (Boolean(p.spec.difference) && !this.shows_differences);
  }

  switch_all() {
    this.all = !this.all;
    by_id('all-channels').setAttribute('aria-pressed', String(this.all));
    this.arrange();
  }

  switch_differences() {
    this.shows_differences = !this.shows_differences;
    by_id('show-differences').setAttribute('aria-pressed', String(this.shows_differences));
    this.arrange();
  }

  toggle_run(run) {
    this.shown[run] = !this.shown[run];
    this.legend.set(run, this.shown[run]);
    for (const p of this.plots.panels)
      p.spec.lines.forEach((line, i) => line.run === run && p.show_line(i, this.shown[run]));
    for (const chart of this.charts?.list ?? [])
      for (const label of new Set(chart.spec.curves.filter((c) => c.run === run).map((c) => c.label)))
        if (chart.shown.has(label) !== this.shown[run])
          chart.buttons?.find((b) => b.button.textContent === label)?.button.click();
    this.machines.draw(this.player.time);
    this.draw_view();
  }

  // Shows a channel's plot at a time.
  visit(channel, t) {
    this.seek(t);
    const found = this.of_channel.get(channel);
    if (!found) return;
    this.groups_shown.set(found.panel.group, true);
    for (const b of by_id('groups').children)
      if (b.textContent === found.panel.group) b.setAttribute('aria-pressed', 'true');
    if (!found.panel.main && !this.all) this.switch_all();
    this.arrange();
    this.plots.panels[found.at].root.scrollIntoView({ block: 'center' });
  }

  // --- time ---

  // Shows the player's time everywhere.
  show(time) {
    this.plots.set_time(time);
    this.plots.keep_in_view(time);
    this.machines?.draw(time);
    by_id('machine-clock').textContent = `${time.toFixed(2)} s`;
    this.show_values(this.plots.shown_time());
  }

  show_values(t) {
    this.charts?.set_time(t);
    by_id('clock').textContent = `${t.toFixed(2)} s`;
  }

  draw_view() {
    this.plan.draw();
    if (this.follows_view) this.charts.set_within(this.plots.view);
    this.show_values(this.plots.shown_time());
  }

  rebuild() {
    this.tables.refresh();
    super.rebuild();
    this.draw_view();
  }
}

// Returns the specs of a plot of a channel's values and of one of its differences to the first run.
// Appends their columns to `columns`.
function specs_of(panel, { values, differences }, columns, runs) {
  const title = panel.label === panel.title ? panel.title : `${panel.title} · ${panel.label}`;
  const common = { group: panel.group, main: panel.main };
  const lines = (of, more) => of.flatMap((column, run) => (column ? [{
    ...line_of(run), run, ends: runs[run].last_s, label: letter_of(run), topic: `${panel.topic} ${panel.field}`,
    column: columns.push(column) - 1, ...more(run),
  }] : []));
  // A run with equal samples has no line of differences; its readout shows "=".
  const none = { time: values[0].time, values: new Float32Array(values[0].time.length) };
  return {
    values: { ...common, title, unit: panel.unit,
              lines: lines(values, (run) => ({ difference: run ? differences[run] ?? none : null })) },
    differences: { ...common, title: 'minus the first run', unit: difference_unit(panel.unit), height: 96, difference: true,
                   lines: lines(differences, () => ({})) },
  };
}

start_page(async (data) => {
  const samples = by_id('run-samples'), columns = await read_samples(data.samples, samples.textContent);
  samples.remove();
  return { data, columns, page: new ComparePage(data, columns) };
});
