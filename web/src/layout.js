// Layout of the plots, as a reader has arranged them for a robot in an experiment. The browser stores it
// under the names of both, so that the next run is shown in the same way. Only differences from the page's
// own layout are stored.
//
//   { format, own: [{ id, title, lines }], added: { plot: [line] }, away: [plot], order: [plot],
//     shown: { plot: { line: true } }, groups: { group: true } }
//
// A line is the id of a channel, or { formula, name }. Lines whose channels a run lacks are not drawn, but
// stay in the layout.
import { recall, remember } from './memory.js';

const format = 'sinew.layout/1';
const most = 200000;  // characters; a longer text is ignored

const is_object = (v) => v !== null && typeof v === 'object' && !Array.isArray(v);
const is_text = (v) => typeof v === 'string' && v.length <= 500;

export const nothing = () => ({ format, own: [], added: {}, away: [], order: [], shown: {}, groups: {} });

const line_of = (line) => (is_text(line) ? line : is_object(line) && is_text(line.formula)
  ? { formula: line.formula, name: is_text(line.name) ? line.name : '' } : null);
const lines_of = (lines) => (Array.isArray(lines) ? lines.map(line_of).filter((l) => l !== null) : []);
const texts_of = (list) => (Array.isArray(list) ? list.filter(is_text) : []);
const flags_of = (object) => Object.fromEntries(Object.entries(is_object(object) ? object : {}).filter(([, v]) => typeof v === 'boolean'));
const each = (object, does) => Object.fromEntries(Object.entries(is_object(object) ? object : {}).map(([k, v]) => [k, does(v)]));

// Reads a layout from the text that the browser has stored. Invalid parts are ignored.
export function read_layout(text) {
  const out = nothing();
  if (!text || text.length > most) return out;
  let read;
  try {
    read = JSON.parse(text);
  } catch {
    return out;
  }
  if (!is_object(read) || read.format !== format) return out;
  out.own = (Array.isArray(read.own) ? read.own : []).filter((p) => is_object(p) && is_text(p.id) && p.id.startsWith('own/'))
    .map((p) => ({ id: p.id, title: is_text(p.title) ? p.title : '', lines: lines_of(p.lines) }));
  out.added = each(read.added, lines_of);
  out.away = texts_of(read.away);
  out.order = texts_of(read.order);
  out.shown = each(read.shown, flags_of);
  out.groups = flags_of(read.groups);
  return out;
}

export const is_nothing = (layout) => JSON.stringify(layout) === JSON.stringify(nothing());

export class StoredLayout {
  constructor(run) {
    this.key = `plots of ${[run.robot, run.name].filter(Boolean).join(', ') || 'a run'}`;
    this.layout = read_layout(recall(this.key));
  }

  save() {
    remember(this.key, is_nothing(this.layout) ? '' : JSON.stringify(this.layout));
  }

  reset() {
    this.layout = nothing();
    this.save();
  }
}
