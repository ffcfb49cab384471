// Tools of the plots of a run: groups, enlarging, saving, arranging, formulas.
import { ChannelDrawer } from './channel_drawer.js';
import { ChannelList } from './channels.js';
import { dragged } from './dragging.js';
import { Enlarged } from './enlarged.js';
import { open_formula_dialog } from './formula_dialog.js';
import { menu_button } from './menu.js';
import { own_group, OwnPlots } from './own_plots.js';
import { button, by_id, element, on_click } from './page.js';
import { save_entries } from './saving.js';
import { open_dialog, show_message } from './dialog.js';

const in_layout = (line) => line.stored ?? line.id;

export class PlotTools {
  constructor(run, plots, columns) {
    Object.assign(this, { run, plots });
    this.channels = new ChannelList(run, columns);
    this.enlarged = new Enlarged();
    this.drawer = new ChannelDrawer(by_id('channels'), this.channels, plots.units, {
      entries_for: (channel) => this.places_for([channel.id]),
      on_formula: () => this.write_formula(null),
    });
    this.tools();
    this.usual_groups = new Map();
    for (const p of run.panels) this.usual_groups.set(p.group, p.group !== 'Other' || run.panels.every((o) => o.group === 'Other'));
    for (const [group, on] of this.usual_groups) plots.groups_shown.set(group, on);
    this.own = new OwnPlots(run, plots, this.channels, () => this.refresh());
    this.refresh();
  }

  tools() {
    on_click('show-channels', () => {
      this.drawer.toggle();
      by_id('show-channels').setAttribute('aria-pressed', String(!by_id('channels').hidden));
    });
    on_click('reset-layout', () => {
      this.own.reset();
      for (const [group, on] of this.usual_groups) this.plots.show_group(group, on);
      this.refresh();
    });
    this.new_plot = element('div', { class: 'new-plot no-print' }, 'Drop here for a new plot');
    by_id('panels').before(this.new_plot);
    dragged.onto(this.new_plot, (lines) => this.add(null, lines));
  }

  // Updates the tools after any change of the layout or of the samples.
  refresh() {
    if (!this.own) return;  // called during construction
    for (const panel of this.plots.panels) {
      if (!panel.tools) this.equip(panel);
      panel.spec.lines.forEach((line, i) => this.make_draggable(panel, i));
    }
    by_id('reset-layout').hidden = !this.own.is_changed();
    this.groups();
  }

  // --- groups ---

  groups() {
    const { plots, own } = this;
    const names = [...(own.layout.own.length ? [own_group] : []), ...this.usual_groups.keys()]
      .filter((name) => plots.panels.some((p) => p.spec.group === name && !p.away && !p.is_empty()));
    const of = names.map((name) => `${name} ${plots.groups_shown.get(name) ?? true}`).join();
    if (this.grouped === of) return;
    this.grouped = of;
    by_id('groups').replaceChildren(...names.map((name) => {
      const on = plots.groups_shown.get(name) ?? true;
      return button({ 'aria-pressed': String(on) }, (event, group) => {
        const next = group.getAttribute('aria-pressed') !== 'true';
        plots.show_group(name, next);
        group.setAttribute('aria-pressed', String(next));
        this.grouped = null;
        own.store_group(name, next, name === own_group ? undefined : this.usual_groups.get(name));
      }, name);
    }));
  }

  // --- a plot's tools ---

  equip(panel) {
    const more = menu_button('⋯', 'Plot menu', () => this.entries(panel));
    panel.tools = element('div', { class: 'panel-tools' }, this.enlarged.button_of(panel), more);
    panel.root.querySelector('header').append(panel.tools);
    panel.title.draggable = true;
    dragged.from(panel.title, () => panel.spec.lines.filter((l, i) => panel.shown[i]).map(in_layout));
    dragged.onto(panel.root, (lines) => this.add(panel, lines));
  }

  make_draggable(panel, i) {
    const { button } = panel.readouts[i];
    if (button.draggable) return;
    button.draggable = true;
    dragged.from(button, () => [in_layout(panel.spec.lines[i])]);
  }

  entries(panel) {
    const { own } = this, shown = panel.spec.lines.filter((l, i) => panel.shown[i]);
    const large = this.enlarged.panel === panel;
    return [
      ...save_entries(this.run.name || this.run.title, () => panel.spec.title, () => panel.picture()),
      ['Add a formula…', () => this.write_formula(panel)],
      !large && shown.length && ['Add its lines to…', () => this.choose_place(panel, shown.map(in_layout))],
      panel.own && ['Rename…', () => this.rename(panel)],
      ...panel.spec.lines.filter((l) => l.stored).map((l) => [`Remove ${l.label}`, () => own.take_out(panel, l)]),
      !large && ['Move up', () => own.move(panel, -1)],
      !large && ['Move down', () => own.move(panel, 1)],
      !large && [panel.own ? 'Remove this plot' : 'Hide this plot', () => this.put_away(panel)],
    ];
  }

  put_away(panel) {
    const { title } = panel.spec, { own } = panel;
    this.own.put_away(panel);
    if (!own) show_message(`${title} is hidden; "Default plots" shows it again.`);
  }

  rename(panel) {
    const field = element('input', { type: 'text', maxlength: 80, 'aria-label': 'Title of the plot' });
    field.value = panel.spec.title;
    open_dialog('Title of the plot', [field], 'Rename', () => {
      this.own.rename(panel, field.value.trim());
      return '';
    });
    field.select();
  }

  // --- lines ---

  add(panel, lines) {
    const why = panel && this.own.refusal(panel, lines);
    if (why) return show_message(why), panel;
    const made = this.own.add(panel, lines);
    if (!panel) made.root.scrollIntoView({ block: 'nearest' });
    return made;
  }

  // Returns entries of a menu: every visible plot except `but`, and a new one.
  places_for(lines, but = null) {
    return ['Add to', ['a new plot', () => this.add(null, lines)],
      ...this.plots.panels.filter((p) => p !== but && !p.root.hidden).map((p) => [p.spec.title, () => this.add(p, lines)])];
  }

  choose_place(panel, lines) {
    const places = this.places_for(lines, panel).slice(1);
    const select = element('select', { 'aria-label': 'Plot' }, ...places.map(([words], i) => element('option', { value: i }, words)));
    open_dialog('Add its lines to', [select], 'Add', () => {
      places[Number(select.value)][1]();
      return '';
    });
  }

  write_formula(panel) {
    open_formula_dialog(this.channels, this.plots.units, (line) => {
      const why = panel ? this.own.refusal(panel, [line]) : '';
      if (!why) this.add(panel, [line]);
      return why;
    });
  }

  // Updates plots and formulas after new samples of a run in progress.
  grow() {
    this.own.recompute();
    for (const panel of this.plots.panels) panel.renew();
    this.plots.arrange();
    this.groups();
  }
}
