// Connection to a run in progress. It receives samples from the program, lets the page follow them, and
// sends the user's requests. Results exist only at the end of the run; the page is then loaded again.
import { LiveControls } from './live_controls.js';
import { append_stretches, GrowingColumns } from './growing.js';
import { read_samples } from './samples.js';

const plots_every = 100;   // [ms]
const refit_every = 500;   // [ms]
const again_after = 1000;  // without a connection [ms]
const window_seconds = 15; // time span of the plots, if the run is long

// Returns the address of the program's WebSocket: that of this page, with its token, and "live".
const where = () => new URL('live', location.href).href.replace(/^http/, 'ws');

export class Live {
  constructor(run) {
    this.run = run;
    this.growing = new GrowingColumns(run.samples);
    this.time = 0;        // of the latest sample [s]
    this.frames = 0;
    this.following = true;
    this.queue = Promise.resolve();  // pieces are appended in the order in which they arrive
  }

  // Connects and returns the columns as soon as they contain the first samples.
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

  request(what) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(what));
  }

  async take(message) {
    if (message.over) return this.over();
    if (message.error) return this.controls?.show_error(message.error);
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

  // Adds marks for values set since the last message, by a slider or by the experiment's list of changes.
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
      page.plot_tools.grow();
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

  // Shows a time slightly before the latest sample, so that the drawing moves evenly from frame to frame.
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
