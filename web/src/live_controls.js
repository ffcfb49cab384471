// Controls of a run in progress: pause, speed, gains, desired angles and stiffnesses.
import { button, element, set_icon } from './page.js';
import { number } from './units.js';

const send_every = 100;  // while a slider is dragged [ms]

const paces = [['0.1', '0.1×'], ['0.25', '0.25×'], ['0.5', '0.5×'], ['1', '1×'], ['2', '2×'], ['4', '4×'], ['0', 'full speed']];

// Control of one gain, desired angle or stiffness: a slider, a field, and a button that returns to the
// value of the plan.
class Control {
  constructor(spec, index, panel) {
    Object.assign(this, { spec, index, panel, most: spec.most, held: false, sent: 0 });
    const name = `${spec.joint.replaceAll('_', ' ')} ${spec.what}`;
    this.slider = element('input', { type: 'range', min: 0, max: 1000, step: 1, 'aria-label': name });
    this.field = element('input', { type: 'number', min: 0, step: 'any', 'aria-label': `${name}, exactly` });
    this.unit = element('span', { class: 'unit' });
    this.back = button({ class: 'icon release', title: `Return to the plan's ${spec.what}`, 'aria-label': `Release ${name}` },
                       () => panel.live.request({ do: 'release', key: spec.key }), '↺');
    this.root = element('div', { class: 'control', 'data-key': spec.key },
      element('span', { class: 'what' }, spec.what), this.slider, this.field, this.unit, this.back);
    this.listen();
  }

  listen() {
    const { slider, field } = this;
    slider.addEventListener('input', () => {
      this.held = true;
      this.value = (Number(slider.value) / 1000) * this.most;
      this.show_number();
      if (performance.now() - this.sent > send_every) this.send();
    });
    slider.addEventListener('change', () => this.send());
    field.addEventListener('focus', () => (this.held = true));
    field.addEventListener('blur', () => (this.held = false));
    field.addEventListener('change', () => {
      const typed = Number(field.value) / this.in_unit()[1];
      if (field.value === '' || !(typed >= 0)) return this.panel.show_error(`found "${field.value}"; expected a number of at least 0`);
      this.value = typed;
      this.show_slider();
      this.send();
    });
  }

  send() {
    this.sent = performance.now();
    this.until = this.sent + 300;  // until then older values from the run are ignored
    if (document.activeElement !== this.field) this.held = false;
    this.panel.live.request({ do: 'set', key: this.spec.key, value: this.value });
  }

  in_unit() {
    const u = this.panel.units.of(this.spec.unit);
    return [u.label, u.scale];
  }

  show_slider() {
    if (this.value > this.most) this.most = 1.5 * this.value;
    this.slider.value = Math.round((1000 * this.value) / this.most);
  }

  show_number() {
    const [label, scale] = this.in_unit();
    this.unit.textContent = label;
    this.field.value = Number((this.value * scale).toPrecision(4));
  }

  show(value, overridden) {
    this.root.classList.toggle('by-hand', overridden);
    this.back.disabled = !overridden;
    if (this.held || performance.now() < (this.until ?? 0)) return;
    this.value = value;
    this.show_slider();
    this.show_number();
  }
}

export class LiveControls {
  constructor(live, page) {
    Object.assign(this, { live, page, units: page.units });
    this.controls = live.run.live.controls.map((spec, i) => new Control(spec, i, this));
    this.strip = this.make_strip();
    this.panel = this.make_panel();
    document.querySelector('main').prepend(this.strip);
    document.getElementById('replay').append(this.panel);
    document.documentElement.classList.add('live');
  }

  make_strip() {
    this.pause = button({ id: 'run-pause', title: 'Pause or resume the run itself' }, () => this.live.request({ do: this.paused ? 'resume' : 'pause' }), '');
    this.pace = element('select', { id: 'run-pace', 'aria-label': 'Speed of the run' },
      ...paces.map(([value, words]) => element('option', { value }, words)));
    this.pace.addEventListener('change', () => this.live.request({ do: 'pace', value: Number(this.pace.value) }));
    this.tail = button({ id: 'follow-run', title: 'Show the current time of the run' }, () => this.live.follow(true), 'Follow the run');
    this.release = button({ id: 'release-all', title: 'Return to all values of the plan' }, () => this.live.request({ do: 'release all' }), 'Release all');
    this.lamp = element('span', { class: 'lamp' });
    this.word = element('strong', {});
    this.clock = element('span', { class: 'run-clock' });
    this.note = element('span', { class: 'run-note', role: 'status' });
    this.stop = button({ id: 'stop-machine', title: 'Close the valves and vent the air immediately (space)' }, () => this.stop_machine(), 'Stop the machine');
    this.stop.hidden = true;
    this.speed = element('label', {}, element('span', { class: 'quiet' }, 'Speed of the run '), this.pace);
    return element('section', { class: 'live-strip no-print', id: 'live', 'aria-label': 'The run' },
      this.lamp, this.word, this.clock, this.stop, this.pause, this.speed, this.tail, this.release, this.note);
  }

  stop_machine() {
    this.stop.disabled = true;
    this.live.request({ do: 'stop' });
  }

  // A machine cannot be paused, only stopped. The space bar then stops it instead of playing the replay.
  make_stoppable() {
    if (!this.stop.hidden) return;
    this.stop.hidden = false;
    this.pause.hidden = this.speed.hidden = true;
    addEventListener('keydown', (event) => {
      if (event.key !== ' ' || !this.stop.isConnected) return;
      event.preventDefault();
      event.stopImmediatePropagation();
      this.stop_machine();
    }, { capture: true });
  }

  make_panel() {
    const joints = [...new Set(this.controls.map((c) => c.spec.joint))];
    return element('section', { class: 'live-controls no-print', 'aria-label': 'Gains, desired angles and stiffnesses' },
      ...joints.map((joint) => element('fieldset', {},
        element('legend', {}, joint.replaceAll('_', ' ')),
        ...this.controls.filter((c) => c.spec.joint === joint).map((c) => c.root))));
  }

  show(state) {
    this.paused = state.paused;
    if (state.machine) this.make_stoppable();
    this.stop.disabled = state.stopping;
    this.lamp.className = `lamp ${state.paused ? 'paused' : 'on'}`;
    this.word.textContent = state.stopping ? 'Stopping' : state.paused ? 'Paused' : 'Live';
    this.clock.textContent = `${state.time.toFixed(1)} s of ${this.live.run.duration.toFixed(1)} s at most`;
    if (this.pause.dataset.shows !== String(state.paused)) {
      this.pause.dataset.shows = String(state.paused);
      set_icon(this.pause, state.paused ? 'play' : 'pause');
      this.pause.append(state.paused ? ' Resume the run' : ' Pause the run');
    }
    this.show_pace(String(state.pace));
    this.controls.forEach((c, i) => c.show(state.values[i], state.overridden[i]));
    const by_hand = state.overridden.filter(Boolean).length;
    this.release.disabled = !by_hand;
    if (state.left_out) this.show_error('some samples arrived too fast to be shown; the log contains them');
    if (state.refused) this.show_error(`${state.refused} changes were ignored: the run has reached its limit of recorded changes`);
  }

  show_pace(pace) {
    if (document.activeElement === this.pace && this.pace.matches(':active')) return;
    if (![...this.pace.options].some((o) => o.value === pace))
      this.pace.append(element('option', { value: pace }, `${number(Number(pace))}×`));
    this.pace.value = pace;
  }

  show_following(on) {
    this.tail.disabled = on;
  }

  show_error(words) {
    this.note.textContent = words;
    clearTimeout(this.forget);
    this.forget = setTimeout(() => (this.note.textContent = ''), 6000);
  }

  lost() {
    this.lamp.className = 'lamp';
    this.word.textContent = 'No connection';
    this.note.textContent = 'the run continues without this page, or the program has ended';
  }
}
