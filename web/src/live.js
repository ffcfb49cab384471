// A run that still goes: takes in what the program sends, lets the page follow it, and asks for
// what a person wants. The page before its end has no results; then it is loaded anew.
import { LiveControls } from './live_controls.js';
import { append_stretches, GrowingColumns } from './growing.js';
import { read_samples } from './samples.js';

const plots_every = 100;   // [ms]
const refit_every = 500;   // [ms]
const again_after = 1000;  // without a connection [ms]
const window_seconds = 15; // of a long run in the plots, which turn their page

// The program's WebSocket: beside this page, behind the token of its address.
const where = () => new URL('live', location.href).href.replace(/^http/, 'ws');

export class Live {
  constructor(run) {
    this.run = run;
    this.growing = new GrowingColumns(run.samples);
    this.time = 0;        // of the last sample
    this.frames = 0;
    this.following = true;
    this.queue = Promise.resolve();  // pieces are appended in their order
  }

  // Columns with the first samples in them.
  connect() {
    return new Promise((resolve) => {
      this.first = () => resolve(this.growing.columns);
      this.open();
    });
  }

  open() {
    this.socket = new WebSocket(where());
    this.socket.addEventListener('message', (event) => {
      const message = JSON.parse(event.data);
      this.queue = this.queue.then(() => this.take(message)).then(() => message.state && this.socket.send('ready'));
    });
    this.socket.addEventListener('close', () => this.lost());
  }

  ask(what) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(what));
  }

  async take(message) {
    if (message.over) return this.over();
    if (message.error) return this.controls?.complain(message.error);
    if (message.piece) await this.append(message.piece);
    this.state = message.state;
    if (message.changes) this.take_changes(message.changes);
    ++this.frames;
    this.controls?.show(this.state);
    if (this.first && this.time >= 0) {
      this.first();
      this.first = null;
    }
  }

  async append(piece) {
    this.growing.append(await read_samples(piece.samples, piece.data));
    append_stretches(this.run.phases.stretches, piece.phases.stretches);
    this.time = this.growing.clocks.reduce((t, c) => Math.max(t, c.length ? c.room[c.length - 1] : 0), 0);
    if (this.page) this.grow();
  }

  // Marks what was set since, by a slider or the file's list.
  take_changes(changes) {
    (this.run.changes ??= []).push(...changes);
    this.page?.marks.refresh();
  }

  // --- the page ---

  attach(page) {
    this.page = page;
    this.controls = new LiveControls(this, page);
    page.player.limit = this.time;
    page.player.on_seek = () => this.follow(false);
    this.grow();
    if (this.state) this.controls.show(this.state);
    if (this.run.duration > 1.5 * window_seconds) page.plots.zoom(0, window_seconds);
    this.follow(true);
  }

  grow() {
    const { page } = this, now = performance.now();
    page.player.limit = this.time;
    page.player.clock = page.clock();
    if (now - (this.plotted ?? -Infinity) >= plots_every) {
      this.plotted = now;
      page.desk.grow();
      page.plots.refresh();
      page.draw_phases();
    }
    if (page.scene && now - (this.fitted ?? -Infinity) >= refit_every) {
      this.fitted = now;
      page.scene.duration = this.time;
      page.scene.refit();
      page.legend();
    }
  }

  // Shown is what was a moment ago, so that it moves evenly from frame to frame.
  follow(on) {
    this.following = on;
    this.controls.show_following(on);
    if (!on) return;
    this.page.player.set_playing(false);
    let before = null;
    const step = (now) => {
      if (!this.following) return;
      const passed = before === null ? 0 : Math.min(0.1, (now - before) / 1000);
      before = now;
      this.move(this.page.player.time + passed * (this.state?.pace || 1));
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  move(t) {
    const moment = 0.15 * (this.state?.pace || 1);
    const { player, plots } = this.page;
    player.place(t > this.time || t < this.time - 2 * moment ? this.time : t);
    plots.keep_in_view(player.time);
  }

  // --- the end ---

  over() {
    this.is_over = true;
    location.reload();
  }

  lost() {
    if (this.is_over) return;
    this.controls?.lost();
    setTimeout(() => {
      const probe = new WebSocket(where());
      probe.addEventListener('open', () => location.reload());
      probe.addEventListener('close', () => this.lost());
    }, again_after);
  }
}
