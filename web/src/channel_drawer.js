// List of a run's channels. A reader searches it and drags channels onto a plot or adds them from a menu.
import { button, element } from './page.js';
import { menu_button } from './menu.js';
import { dragged } from './dragging.js';

const most = 400;  // rows shown at once

export class ChannelDrawer {
  // `entries_for` returns the menu of a channel: the plots that it can be added to.
  constructor(root, channels, units, { entries_for, on_formula }) {
    Object.assign(this, { root, channels, units, entries_for });
    this.field = element('input', { type: 'search', placeholder: 'Search channels', 'aria-label': 'Search channels' });
    this.field.addEventListener('input', () => this.list());
    this.rows = element('ul', { class: 'channel-rows' });
    root.append(element('div', { class: 'search' }, this.field, button({ class: 'new-formula' }, on_formula, 'Formula…')),
      element('p', { class: 'quiet' }, 'Drag a channel onto a plot, or onto the field above the plots for a new one. A plot can also be dragged onto another plot.'), this.rows);
  }

  toggle() {
    this.root.hidden = !this.root.hidden;
    if (this.root.hidden) return;
    this.list();
    this.field.focus();
  }

  list() {
    if (this.root.hidden) return;
    const words = this.field.value.toLowerCase().split(/\s+/).filter(Boolean);
    const found = this.channels.with_samples().filter((c) => {
      const text = `${this.channels.words(c)} ${c.id}`.toLowerCase();
      return words.every((w) => text.includes(w));
    });
    this.rows.replaceChildren(...found.slice(0, most).map((c) => this.row(c)));
    if (!found.length) this.rows.append(element('li', { class: 'quiet' }, 'No channel matches.'));
  }

  row(channel) {
    const row = element('li', { draggable: 'true', title: channel.id },
      element('span', { class: 'name' }, this.channels.words(channel)),
      element('span', { class: 'unit' }, this.units.of(channel.unit).label),
      menu_button('+', `Add ${this.channels.words(channel)} to a plot`, () => this.entries_for(channel)));
    dragged.from(row, () => [channel.id]);
    return row;
  }
}
