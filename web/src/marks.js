// Marks of values that were set during the run, by the experiment's list of changes or by a slider: one
// on the time axis of every plot. A slider that is dragged sends many values; those that follow each other
// within a moment are one move.
import { element } from './page.js';
import { span_text, time_button } from './tables.js';

const moment = 1;      // between values of one move [s]
const most_shown = 60; // handles of one plot
const reach = 5;       // half the width of a handle [px]

// Returns a key such as "control.gains.hip.angle" in the words of the sliders, "hip angle gain".
export function setting_in_words(key) {
  const [, what, joint, of] = key.match(/^control\.(?:(gains)\.)?(.*)\.([^.]+)$/) ?? [];
  if (!joint) return key;
  const words = what ? `${joint} ${of} gain` : `${of} desired ${joint}`;
  return words.replaceAll('_', ' ');
}

// Returns changes as moves in order of time: { key, leg, from, to (times), before, value; null: released }.
export function moves_of(changes) {
  const last = new Map(), out = [];
  for (const c of [...changes].sort((a, b) => a.time - b.time)) {
    const of = `${c.leg ?? ''} ${c.key}`, before = last.get(of);
    if (before && c.value !== null && before.value !== null && c.time - before.to <= moment) {
      Object.assign(before, { to: c.time, value: c.value, count: before.count + 1 });
      continue;
    }
    const move = { key: c.key, leg: c.leg ?? '', unit: c.unit, from: c.time, to: c.time,
                   before: before?.value ?? null, value: c.value, count: 1 };
    last.set(of, move);
    out.push(move);
  }
  return out;
}

export class Marks {
  // `run.changes`: changes as the program writes them; on a live page more are appended.
  constructor(root, run, plots, units, seek) {
    Object.assign(this, { root, run, plots, units, seek });
    plots.marks = this;
    plots.on_place = (panel) => this.place(panel);
    this.refresh();
  }

  // Updates the list after new changes or a change of units.
  refresh() {
    this.moves = moves_of(this.run.changes ?? []);
    this.root.hidden = !this.moves.length;
    const most = 12, shown = this.moves.slice(0, most).map((move) =>
      time_button(move.from, move.to, this.seek, `${this.words(move)}, `));
    this.root.replaceChildren(element('span', { class: 'key' }, 'set during the run'), ...shown,
      this.moves.length > most ? element('span', {}, `and ${this.moves.length - most} more`) : '');
    for (const panel of this.plots.panels) panel.marked = null;
  }

  text(value, unit) {
    return value === null ? "the plan's value" : this.units.text(value, unit);
  }

  words(move) {
    const of = `${move.leg ? `${move.leg} ` : ''}${setting_in_words(move.key)}`;
    return move.value === null ? `${of}: back to the plan's value`
      : `${of}: ${move.before === null ? '' : `${this.text(move.before, move.unit)} → `}${this.text(move.value, move.unit)}`;
  }

  in_view() {
    const [from, to] = this.plots.view;
    return this.moves.filter((m) => m.from >= from && m.from <= to);
  }

  // Draws a dashed line at each move, under the curves of a plot. `px`: size of a pixel.
  draw(ctx, frame, theme, px) {
    ctx.strokeStyle = theme.mark;
    ctx.lineWidth = px;
    ctx.setLineDash([3 * px, 3 * px]);
    for (const move of this.in_view()) {
      const x = Math.round(frame.x(move.from)) + px / 2;
      ctx.beginPath();
      ctx.moveTo(x, frame.top);
      ctx.lineTo(x, frame.bottom);
      ctx.stroke();
    }
    ctx.setLineDash([]);
  }

  // Puts a handle with a description at the top of each line. Handles are created again when the view changes.
  place(panel) {
    // The positions of the view's ends are compared as well: a new plot gets its scale only later.
    const [begin, end] = this.plots.view.map((t) => panel.plot.valToPos(t, 'x'));
    if (!(end > begin)) return;
    const of = `${this.plots.view} ${begin} ${end} ${this.moves.length} ${this.units.system}`;
    if (panel.marked === of && panel.plot.over.querySelector('.mark-handle, .no-marks')) return;
    panel.marked = of;
    panel.plot.over.querySelectorAll('.mark-handle, .no-marks').forEach((m) => m.remove());
    const moves = this.in_view().slice(0, most_shown);
    const handles = moves.map((move) => {
      const handle = element('div', { class: 'mark-handle' }, element('i', {}), element('span', {}, `${this.words(move)} at ${span_text(move.from, move.to)}`));
      const x = panel.plot.valToPos(move.from, 'x');
      handle.style.left = `${(x - reach).toFixed(1)}px`;
      handle.classList.toggle('to-left', x > panel.plot.over.clientWidth / 2);
      return handle;
    });
    panel.plot.over.append(...(handles.length ? handles : [element('i', { class: 'no-marks' })]));
  }
}
