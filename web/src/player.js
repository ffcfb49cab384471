// Player of the replay: play, pause, seek, step and speed, by buttons, slider and keyboard.
import { by_id, on_click, set_icon } from './page.js';
import { index_at } from './samples.js';

export class Player {
  // `from`, `to`: first and last time. `clock`: times through which it steps; `show(t)` draws a time.
  constructor([from, to], clock, show) {
    Object.assign(this, { from, clock, show, time: from, playing: false, speed: 1 });
    this.limit = to;  // latest time with data; it increases during a run in progress
    this.slider = by_id('seek');
    Object.assign(this.slider, { min: from, max: to });
    this.slider.addEventListener('input', () => this.seek(Number(this.slider.value)));
    on_click('play', () => this.toggle());
    on_click('back', () => this.step(-1));
    on_click('forth', () => this.step(1));
    this.speeds = by_id('speed');
    this.speeds.addEventListener('change', () => (this.speed = Number(this.speeds.value)));
    set_icon(by_id('back'), 'back');
    set_icon(by_id('forth'), 'forth');
    this.set_playing(false);
  }

  seek(t) {
    this.on_seek?.();
    this.place(t);
  }

  place(t) {
    this.time = Math.min(this.limit, Math.max(this.from, t));
    this.slider.value = this.time;
    this.slider.setAttribute('aria-valuetext', `${this.time.toFixed(3)} s`);
    this.show(this.time);
  }

  // Moves to the next sample (1) or the previous one (-1).
  step(by) {
    this.set_playing(false);
    if (!this.clock.length) return this.seek(this.time + 0.01 * by);
    const exact = 1e-9;
    const i = by > 0 ? index_at(this.clock, this.time + exact) + by : index_at(this.clock, this.time - exact);
    this.seek(this.clock[Math.min(this.clock.length - 1, Math.max(0, i))]);
  }

  toggle() {
    if (!this.playing && this.time >= this.limit) this.seek(this.from);
    this.set_playing(!this.playing);
  }

  set_playing(playing) {
    this.playing = playing;
    const button = by_id('play');
    set_icon(button, playing ? 'pause' : 'play');
    button.setAttribute('aria-label', playing ? 'Pause' : 'Play');
    if (playing) {
      this.before = null;
      requestAnimationFrame((now) => this.frame(now));
    }
  }

  frame(now) {
    if (!this.playing) return;
    // A page that was hidden for a while continues where it stopped.
    const passed = this.before === null ? 0 : Math.min(0.1, (now - this.before) / 1000);
    this.before = now;
    this.seek(this.time + passed * this.speed);
    if (this.time >= this.limit) return this.set_playing(false);
    requestAnimationFrame((next) => this.frame(next));
  }

  faster(by) {
    const last = this.speeds.options.length - 1;
    this.speeds.selectedIndex = Math.min(last, Math.max(0, this.speeds.selectedIndex + by));
    this.speed = Number(this.speeds.value);
  }
}
