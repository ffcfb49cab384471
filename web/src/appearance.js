// Appearance of a page: units, light or dark colors, print. Every page has the same buttons.
import { button, by_id, on_click, set_icon } from './page.js';

export class Appearance {
  // `on_units` and `on_colors` redraw the page; `on_print(begins)` prepares it for printing (true) or for
  // the screen again (false).
  constructor(units, { on_units, on_colors, on_print }) {
    Object.assign(this, { units, on_units, on_colors, on_print });
    this.offer_units();
    on_click('theme', () => this.set_theme(this.is_dark() ? 'light' : 'dark'));
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.recolor());
    addEventListener('beforeprint', () => this.print(true));
    addEventListener('afterprint', () => this.print(false));
    this.set_icon();
  }

  // Adds a button for each set of units.
  offer_units() {
    this.buttons = this.units.table.sets.map(({ name, title, about }) =>
      button({ id: `units-${name}`, title: about }, () => this.set_units(name), title));
    by_id('units').replaceChildren(...this.buttons);
    this.show_units();
  }

  show_units() {
    for (const b of this.buttons) b.setAttribute('aria-pressed', String(b.id === `units-${this.units.system}`));
  }

  set_units(name) {
    this.units.choose_and_store(name);
    this.show_units();
    this.on_units();
  }

  is_dark() {
    const chosen = document.documentElement.dataset.theme;
    return chosen ? chosen === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches;
  }

  set_theme(theme) {
    if (theme) document.documentElement.dataset.theme = theme;
    else delete document.documentElement.dataset.theme;
    this.recolor();
  }

  set_icon() {
    set_icon(by_id('theme'), this.is_dark() ? 'light' : 'dark');
  }

  recolor() {
    this.set_icon();
    this.on_colors();
  }

  // Prints always use the light colors.
  print(begins) {
    if (begins) this.theme_before = document.documentElement.dataset.theme;
    this.on_print(begins);
    this.set_theme(begins ? 'light' : this.theme_before);
  }
}
