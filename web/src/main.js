// Page of a run. It reads the data that the program has put into it and builds replay, plots and tables.
import { pressure_gradient } from './colors.js';
import { Charts } from './charts.js';
import { Live } from './live.js';
import './film.js';
import { Marks } from './marks.js';
import { by_id, chip, element, start_page } from './page.js';
import { Player } from './player.js';
import { PlotTools } from './plot_tools.js';
import { Plots } from './plots.js';
import { finest_clock, ReplayPage } from './replay_page.js';
import { held, index_at, open_within, read_samples } from './samples.js';
import { Scene } from './scene.js';
import { as_scene, StandScene } from './stand.js';
import {
  count_verdicts, counts_in_words, faults_at, mark_faults, Numbers, show_faults, show_parameters, show_results, show_warnings,
} from './tables.js';
import { page_theme } from './theme.js';
import { short_number, Units } from './units.js';

class Page extends ReplayPage {
  constructor(run, columns) {
    super();
    Object.assign(this, { run, columns, whole: [0, run.duration] });
    this.units = new Units(run.atmosphere);
    this.head();
    this.plots = new Plots(by_id('panels'), run, columns, this.units, (t) => this.seek(t));
    this.plots.on_view = () => this.draw_phases();
    this.plot_tools = new PlotTools(run, this.plots, columns);
    this.marks = new Marks(by_id('changes'), run, this.plots, this.units, (t) => this.seek(t));
    this.charts = run.charts?.length ? new Charts(by_id('charts'), run.charts, columns, this.units, run.name || run.title) : null;
    this.replay();
    this.player = new Player(this.whole, this.clock(), (t) => this.show(t));
    this.tables();
    this.controls({});
    new ResizeObserver(() => this.draw_phases()).observe(by_id('phases'));
    this.seek(run.phases.stretches[0]?.from ?? 0);
  }

  // Returns the times of the channel with the most samples; the player steps through them.
  clock() {
    return finest_clock(this.run.panels.flatMap((p) => p.lines.map((l) => this.columns[l.column])));
  }

  head() {
    const { run } = this;
    by_id('title').textContent = run.title || run.name || 'A run';
    by_id('about').textContent = run.reproduces;
    const facts = [run.name, run.robot && `robot ${run.robot}`, `${run.duration.toFixed(2)} s`,
                   run.seed && `seed ${run.seed}`, run.version && `Sinew ${run.version}`];
    by_id('facts').textContent = facts.filter((f) => f && f !== run.title).join(' · ');
  }

  chips() {
    const { run } = this;
    const out = [];
    if (run.verdicts.length) {
      const n = count_verdicts(run.verdicts);
      out.push(chip('results', `Results that ${counts_in_words(run.verdicts)}`, n.bad ? 'bad' : 'good'));
    }
    if (run.warnings.length)
      out.push(chip('warnings', `${run.warnings.length} warning${run.warnings.length > 1 ? 's' : ''}`, 'warn'));
    const faults = run.faults?.length ?? 0;
    if (faults) out.push(chip('faults', `${faults} fault${faults > 1 ? 's' : ''}`, 'bad'));
    out.push(chip('numbers', 'Numbers'), chip('parameters', 'Parameters'));
    by_id('chips').append(...out);
  }

  tables() {
    this.chips();
    show_results(this.run);
    const seek = (t) => {
      this.seek(t);
      by_id('replay').scrollIntoView({ block: 'nearest' });
    };
    show_warnings(this.run, seek);
    show_faults(this.run, seek);
    this.numbers = new Numbers(this.run, this.units);
    show_parameters(this.run);
  }

  // --- the replay ---

  replay() {
    const { run } = this;
    document.querySelector('.stage').hidden = !run.panels.length;  // a sweep has no time axis
    if (run.stand) run.scene = as_scene(run.stand);
    if (!run.scene) {  // without a drawing the plots use its space; the player stays
      document.querySelector('.stage').classList.add('without-scene');
      return;
    }
    this.drawing = this.scene = run.stand ? new StandScene(by_id('scene'), run.stand, this.columns, this.units)
      : new Scene(by_id('scene'), run.scene, this.columns, this.units, run.duration);
    by_id('follow').hidden = !run.scene.track;
    this.muscles = run.scene.muscles.map((m) => this.muscle_card(m));
    // A log of hardware may have neither pressures nor valves.
    this.muscles = this.muscles.filter((m) => m.spec.pressure !== null || m.lights.some((l) => l));
    by_id('muscles').append(...this.muscles.map((m) => m.root));
    this.legend();
  }

  muscle_card(m) {
    const bar = element('span', { class: 'bar' });
    const pressure = element('span', { class: 'value' });
    const lights = ['inlet', 'exhaust'].map((which) =>
      m[which] === null ? null : element('span', { class: `light ${which}`, title: which }));
    const root = element('div', { class: 'muscle' },
      element('span', { class: 'name' }, m.name.replaceAll('_', ' ')),
      element('span', { class: 'lights' }, ...lights),
      m.pressure === null ? null : element('span', { class: 'track' }, bar), pressure);
    return { spec: m, root, bar, pressure, lights };
  }

  legend() {
    const { scene, run } = this;
    const item = (kind, words) => element('span', { class: 'key' }, element('i', { class: kind }), words);
    const out = [];
    if (scene.has_pressure()) {
      const ramp = element('span', { class: 'ramp' });
      ramp.style.background = pressure_gradient;
      const [low, high] = scene.pressures.map((p) => short_number(this.units.convert(p, 'Pa')));
      out.push(element('span', { class: 'key' }, `pressure ${low}`, ramp, `${high} ${this.units.of('Pa').label}`));
    }
    if (run.scene.muscles.some((m) => m.inlet !== null)) out.push(item('inlet', 'inlet open'));
    if (run.scene.muscles.some((m) => m.exhaust !== null)) out.push(item('exhaust', 'exhaust open'));
    out.push(...scene.legend().map(([kind, words]) => item(kind, words)));
    out.push(element('span', { class: 'key quiet' }, scene.note()));
    by_id('legend').replaceChildren(...out);
  }

  // Draws the phases under the slider, warnings below and faults above them, and a frame around the time
// that the plots show.
  draw_phases() {
    const canvas = by_id('phases'), ratio = window.devicePixelRatio || 1;
    const width = canvas.clientWidth, height = canvas.clientHeight;
    canvas.width = width * ratio;
    canvas.height = height * ratio;
    const ctx = canvas.getContext('2d');
    ctx.scale(ratio, ratio);
    const theme = page_theme();
    const x = (t) => (t / this.run.duration) * width;
    ctx.fillStyle = theme.rail;
    ctx.beginPath();
    ctx.roundRect(0, height / 2 - 5, width, 10, 3);
    ctx.fill();
    for (const s of this.run.phases.stretches) {
      ctx.fillStyle = theme[s.stance ? 'rail-stance' : 'rail-swing'];
      ctx.fillRect(x(s.from), height / 2 - 5, Math.max(0.5, x(s.to) - x(s.from) - 0.5), 10);
    }
    ctx.fillStyle = theme.warn;
    for (const w of this.run.warnings)
      for (const [from, to] of w.spans) ctx.fillRect(x(from), height / 2 + 7, Math.max(1.5, x(to) - x(from)), 2.5);
    ctx.fillStyle = theme.bad;
    for (const f of this.run.faults ?? []) ctx.fillRect(x(f.from), height / 2 - 9.5, Math.max(1.5, x(f.to) - x(f.from)), 2.5);
    ctx.fillStyle = theme.mark;
    for (const m of this.marks?.moves ?? []) ctx.fillRect(x(m.from) - 0.75, height / 2 - 9.5, 1.5, 8);
    const [from, to] = this.plots.view;
    if (to - from < this.run.duration) {
      ctx.strokeStyle = theme.accent;
      ctx.lineWidth = 1.5;
      ctx.strokeRect(x(from), height / 2 - 8, Math.max(2, x(to) - x(from)), 16);
    }
  }

  phase_at(t) {
    const found = this.run.phases.stretches.find((s) => t >= s.from && t < s.to);
    if (!found) return '';
    const name = this.run.phases.names[found.phase] ?? '';
    return `step ${found.step + 1}, ${name.replaceAll('_', ' ')}`;
  }

  show(t) {
    this.scene?.draw(t);
    this.plots.set_time(t);
    this.charts?.set_time(t);
    if (this.player?.playing) this.plots.keep_in_view(t);
    const phase = this.phase_at(t);
    const broken = faults_at(this.run, t).map((f) => `${f.of} ${f.what}`);
    by_id('clock').replaceChildren([`${t.toFixed(2)} s`, phase].filter(Boolean).join('  ·  '),
      ...broken.map((text) => element('b', { class: 'broken' }, `  ·  ${text}`)));
    mark_faults(this.run, t);
    this.show_muscles(t);
  }

  show_muscles(t) {
    if (!this.muscles) return;
    const [low, high] = this.scene.pressures;
    for (const m of this.muscles) {
      if (m.spec.pressure !== null) {
        const p = held(this.columns[m.spec.pressure], t);
        m.bar.style.width = `${(100 * Math.max(0, p - low)) / (high - low)}%`;
        m.pressure.textContent = `${short_number(this.units.convert(p, 'Pa'))} ${this.units.of('Pa').label.split(' ')[0]}`;
      }
      ['inlet', 'exhaust'].forEach((which, i) =>
        m.lights[i]?.classList.toggle('open', open_within(this.columns[m.spec[which]], t - 0.01, t)));
    }
  }

  rebuild() {
    this.marks.refresh();
    this.numbers.refresh();
    if (this.scene) this.legend();
    super.rebuild();
    this.draw_phases();
  }
}

start_page(async (run) => {
  const samples = by_id('run-samples'), live = run.live ? new Live(run) : null;
  const columns = live ? await live.connect() : await read_samples(run.samples, samples.textContent);
  samples.remove();
  const page = new Page(run, columns);
  live?.attach(page);
  return { run, columns, page, index_at, live };
});
