// Plots as a reader arranges them: combined channels and formulas, hidden plots, another order. Every
// action changes the layout, which is then applied to the page's plots.
import { column_of_formula } from './formula_values.js';
import { parse_formula } from './formula.js';
import { is_nothing, StoredLayout } from './layout.js';

export const own_group = 'Own';
const most_units = 2;  // a plot has an axis at each side

// Returns a title for a plot without one: the plots of its channels, or the names of its formulas.
const title_of = (lines) =>
  [...new Set(lines.map((l) => l.title ?? l.label))].slice(0, 3).join(', ') || 'Own plot';

const same_line = (a, b) => JSON.stringify(a) === JSON.stringify(b);
const id_of_stored = (line) => (typeof line === 'string' ? line : `=${line.formula}`);

export class OwnPlots {
  // `channels`: a ChannelList; `on_change` is called after each change.
  constructor(run, plots, channels, on_change) {
    Object.assign(this, { run, plots, channels, on_change });
    this.stored = new StoredLayout(run);
    this.by_id = new Map();
    for (const panel of plots.panels) {
      panel.id = `${panel.spec.group}/${panel.spec.title}`;
      panel.built_in = panel.spec.lines;
      this.by_id.set(panel.id, panel);
    }
    this.usual_order = [...plots.panels];
    plots.on_toggle = (panel, i) => this.store_shown(panel, i);
    this.apply();
  }

  get layout() {
    return this.stored.layout;
  }

  is_changed() {
    return !is_nothing(this.layout);
  }

  // --- from the layout to the plots ---

  apply() {
    const { layout, plots } = this;
    for (const panel of [...plots.panels])
      if (panel.own && !layout.own.some((o) => o.id === panel.id)) this.forget(panel);
    for (const own of layout.own) this.show_own(own);
    for (const panel of this.usual_order) {
      const lines = [...panel.built_in, ...this.lines_of(layout.added[panel.id] ?? [], panel, 1 + Math.max(-1, ...panel.built_in.map((l) => l.color)))];
      if (lines.length !== panel.spec.lines.length || lines.some((l, i) => l.id !== panel.spec.lines[i].id)) panel.set_lines(lines);
    }
    for (const panel of plots.panels) {
      panel.away = layout.away.includes(panel.id);
      const shown = layout.shown[panel.id] ?? {};
      panel.spec.lines.forEach((line, i) => {
        const on = shown[line.id] ?? line.style !== 'hidden';
        if (panel.shown[i] !== on) panel.show_line(i, on);
      });
    }
    plots.put_in_order(this.in_order());
    for (const [group, on] of Object.entries(layout.groups)) plots.groups_shown.set(group, on);
    plots.arrange();
    this.on_change?.();
  }

  // Returns the plots in order: own plots first, then the page's. After the reader has moved a plot, the
// stored order is used, with newer plots first.
  in_order() {
    const own = this.layout.own.map((o) => this.by_id.get(o.id)).reverse();
    const all = [...own, ...this.usual_order], { order } = this.layout;
    const known = order.map((id) => this.by_id.get(id)).filter((p) => p && all.includes(p));
    return known.length ? [...all.filter((p) => !known.includes(p)), ...known] : all;
  }

  show_own(own) {
    const panel = this.by_id.get(own.id);
    const lines = this.lines_of(own.lines, null, 0);
    const title = own.title || title_of(lines);
    if (!panel) {
      const made = this.plots.add_panel({ group: own_group, title, unit: lines[0]?.unit ?? '1', lines });
      Object.assign(made, { id: own.id, own: true, built_in: [] });
      this.by_id.set(own.id, made);
      return;
    }
    const same = panel.spec.lines.map((l) => l.id).join() === lines.map((l) => l.id).join();
    if (same && panel.spec.title === title) return;
    panel.spec.title = title;
    panel.spec.unit = lines[0]?.unit ?? '1';
    panel.set_lines(lines);
  }

  forget(panel) {
    this.by_id.delete(panel.id);
    this.plots.remove_panel(panel);
  }

  // Returns stored lines in the form that a panel takes. Lines whose channels this run lacks, and lines
// that would need a third unit, are skipped.
  lines_of(stored, panel, color) {
    const units = new Set((panel?.built_in ?? []).map((l) => l.unit ?? panel.spec.unit));
    const has = new Set((panel?.built_in ?? []).map((l) => l.id));
    const from = new Set(panel ? [panel.spec.title] : []);
    for (const line of stored) if (typeof line === 'string') from.add(this.channels.by_id.get(line)?.title);
    return stored.flatMap((line) => {
      const id = id_of_stored(line);
      const made = has.has(id) ? null : typeof line === 'string' ? this.channel_line(line, from.size > 1) : this.formula_line(line);
      if (!made || (units.size >= most_units && !units.has(made.unit))) return [];
      units.add(made.unit);
      has.add(id);
      return [{ ...made, id, color: color++, style: 'full', stored: line }];
    });
  }

  // `long`: adds the plot's title to the label, for plots with channels of several plots.
  channel_line(id, long) {
    const channel = this.channels.by_id.get(id);
    if (!channel) return null;
    return { label: long ? this.channels.words(channel) : channel.label, title: channel.title, topic: channel.id, unit: channel.unit, column: channel.column };
  }

  formula_line({ formula, name }) {
    try {
      const read = parse_formula(formula, this.channels.units);
      const data = column_of_formula(read, (id) => this.channels.column(id));
      return { label: name || formula, topic: formula, unit: read.unit, data, read };
    } catch {
      return null;  // the formula has channels that this run lacks
    }
  }

  // Updates the formulas after new samples.
  recompute() {
    for (const panel of this.plots.panels)
      for (const line of panel.spec.lines)
        if (line.read) Object.assign(line.data, column_of_formula(line.read, (id) => this.channels.column(id)));
  }

  // --- actions of the reader ---

  changed() {
    this.stored.save();
    this.apply();
  }

  stored_lines(panel) {
    const own = this.layout.own.find((o) => o.id === panel.id);
    return own ? own.lines : (this.layout.added[panel.id] ??= []);
  }

  // Returns why these lines cannot be added to a plot; '' if they can.
  refusal(panel, lines) {
    const units = new Set(panel.spec.lines.map((l) => l.unit ?? panel.spec.unit));
    for (const made of this.lines_of(lines, null, 0)) units.add(made.unit);
    if (units.size <= most_units) return '';
    const labels = [...units].map((u) => this.plots.units.of(u).label || '1').join(', ');
    return `A plot can have two units; these would be ${labels}. Use a new plot.`;
  }

  // Adds channels or formulas to a plot, or to a new one if `panel` is null. Returns that plot.
  add(panel, lines, title = '') {
    if (!panel) {
      const next = 1 + Math.max(0, ...this.layout.own.map((o) => Number(o.id.slice(4)) || 0));
      this.layout.own.push({ id: `own/${next}`, title, lines });
      this.layout.groups[own_group] = true;
      this.changed();
      return this.by_id.get(`own/${next}`);
    }
    const stored = this.stored_lines(panel);
    for (const line of lines) {
      const there = panel.spec.lines.find((l) => l.id === id_of_stored(line));
      if (there) (this.layout.shown[panel.id] ??= {})[there.id] = true;
      else if (!stored.some((k) => same_line(k, line))) stored.push(line);
    }
    this.tidy();
    this.changed();
    return panel;
  }

  take_out(panel, line) {
    const stored = this.stored_lines(panel);
    stored.splice(stored.findIndex((k) => same_line(k, line.stored)), 1);
    delete this.layout.shown[panel.id]?.[line.id];
    if (panel.own && !stored.length) return this.put_away(panel);
    this.tidy();
    this.changed();
  }

  tidy() {
    for (const list of ['added', 'shown'])
      for (const [id, of] of Object.entries(this.layout[list]))
        if (!Object.keys(of).length) delete this.layout[list][id];
  }

  put_away(panel) {
    const { layout } = this;
    if (panel.own) {
      layout.own = layout.own.filter((o) => o.id !== panel.id);
      layout.order = layout.order.filter((id) => id !== panel.id);
      delete layout.shown[panel.id];
      if (!layout.own.length) delete layout.groups[own_group];
    } else {
      layout.away.push(panel.id);
    }
    this.changed();
  }

  rename(panel, title) {
    const own = this.layout.own.find((o) => o.id === panel.id);
    if (own) own.title = title;
    this.changed();
  }

  // Moves a plot past the next visible one.
  move(panel, by) {
    const all = [...this.plots.panels], from = all.indexOf(panel);
    let to = from + by;
    while (all[to]?.root.hidden) to += by;
    if (!all[to]) return;
    all.splice(from, 1);
    all.splice(to, 0, panel);
    this.layout.order = all.map((p) => p.id);
    this.changed();
  }

  store_shown(panel, i) {
    const line = panel.spec.lines[i], usual = line.style !== 'hidden';
    const shown = (this.layout.shown[panel.id] ??= {});
    if (panel.shown[i] === usual) delete shown[line.id];
    else shown[line.id] = panel.shown[i];
    this.tidy();
    this.stored.save();
    this.on_change?.();
  }

  store_group(name, on, usual) {
    if (on === usual) delete this.layout.groups[name];
    else this.layout.groups[name] = on;
    this.stored.save();
    this.on_change?.();
  }

  reset() {
    this.stored.reset();
    this.plots.groups_shown.clear();
    this.apply();
  }
}
