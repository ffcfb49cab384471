// Player of the replay: play, pause, seek, step and speed, by buttons, slider and keyboard.
import { by_id, set_icon } from './page.js';
import { index_at } from './samples.js';

export class Player {
  // `clock`: times through which it steps; `show(t)` draws a time.
  constructor(duration, clock, show) {
    Object.assign(this, { duration, clock, show, time: 0, playing: false, speed: 1 });
    this.limit = duration;  // latest time with data; it increases during a run in progress
    this.slider = by_id('seek');
    this.slider.max = duration;
    this.slider.addEventListener('input', () => this.seek(Number(this.slider.value)));
    by_id('play').addEventListener('click', () => this.toggle());
    by_id('back').addEventListener('click', () => this.step(-1));
    by_id('forth').addEventListener('click', () => this.step(1));
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
    this.time = Math.min(this.limit, Math.max(0, t));
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
    if (!this.playing && this.time >= this.limit) this.seek(0);
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
