// Page with plots over time, a drawing and a player: base of the pages of one run and of several runs.
import { Appearance } from './appearance.js';
import { by_id, on_click } from './page.js';

// Size of the drawing in print, independent of the screen.
const paper_scene = 'width: 600px; height: 325px;';

// A derived class sets `units`, `whole` (first and last time), `plots`, `player` and, if it has them,
// `charts` and a `drawing` with draw(t), read_theme() and toggle_follow(); show() shows everything at a
// time.
export class ReplayPage {
  // `keys`: what further keys do.
  controls(keys) {
    this.keys = keys;
    this.appearance = new Appearance(this.units, { on_units: () => this.rebuild(), on_colors: () => this.recolor(),
                                                   on_print: (begins) => this.print(begins) });
    on_click('follow', () => this.toggle_follow());
    on_click('zoom-in', () => this.plots.zoom_by(0.5));
    on_click('zoom-out', () => this.plots.zoom_by(2));
    on_click('zoom-all', () => this.plots.zoom_all());
    document.addEventListener('keydown', (event) => this.key(event));
  }

  key(event) {
    const { target } = event;
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (['search', 'text', 'number', 'checkbox'].includes(target.type) || ['SELECT', 'TEXTAREA'].includes(target.tagName)) return;
    if (target.closest?.('.control, .panel-tools, .channels') && !this.keys[event.key]) return;
    const big = event.shiftKey ? 10 : 1;
    const does = {
      ' ': () => this.player.toggle(),
      ArrowLeft: () => this.step(-1, big),
      ArrowRight: () => this.step(1, big),
      Home: () => this.seek(this.whole[0]),
      End: () => this.seek(this.whole[1]),
      f: () => this.toggle_follow(),
      '+': () => this.plots.zoom_by(0.5),
      '-': () => this.plots.zoom_by(2),
      0: () => this.plots.zoom_all(),
      '[': () => this.player.faster(-1),
      ']': () => this.player.faster(1),
      ...this.keys,
    }[event.key];
    if (!does) return;
    event.preventDefault();
    does();
  }

  seek(t) {
    this.player.seek(t);
    this.plots.keep_in_view(this.player.time);
  }

  step(by, times = 1) {
    for (let i = 0; i < times; ++i) this.player.step(by);
    this.plots.keep_in_view(this.player.time);
  }

  toggle_follow() {
    if (!this.drawing) return;
    by_id('follow').setAttribute('aria-pressed', String(this.drawing.toggle_follow()));
    this.drawing.draw(this.player.time);
  }

  // Draws everything again, in other units.
  rebuild() {
    this.plots.rebuild();
    this.charts?.rebuild();
    this.show(this.player.time);
  }

  // Draws everything again, in other colors.
  recolor() {
    this.drawing?.read_theme();
    this.rebuild();
  }

  // Prepares the page for printing (true) or for the screen (false).
  print(begins) {
    this.player.set_playing(false);
    this.plots.print(begins);
    this.charts?.print(begins);
    if (this.drawing) by_id('scene').style.cssText = begins ? paper_scene : '';
  }
}

// Returns the times of the column with the most samples.
export const finest_clock = (columns) =>
  columns.map((c) => c.time).reduce((most, c) => (c.length > most.length ? c : most), new Float64Array());
