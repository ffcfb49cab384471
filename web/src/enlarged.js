// Dialog that shows a plot or a chart as large as the window, with its zoom, until Escape or its button.
import { button, element, set_icon } from './page.js';

export class Enlarged {
  constructor() {
    this.panel = null;
    this.dialog = element('dialog', { class: 'enlarged', 'aria-label': 'Enlarged plot' });
    document.body.append(this.dialog);
    this.dialog.addEventListener('close', () => this.back());
    this.dialog.addEventListener('click', (event) => event.target === this.dialog && this.dialog.close());
    addEventListener('resize', () => this.fit());
    addEventListener('beforeprint', () => this.panel && this.dialog.close());
  }

  // Returns a button for the heading of a plot, which has root, box, height, plot, build(), set_height()
  // and resize().
  button_of(panel) {
    const own = button({ class: 'icon small enlarge no-print' }, () => this.toggle(panel));
    this.show(own, false);
    return own;
  }

  show(own, large) {
    own.setAttribute('aria-label', large ? 'Back into the page' : 'Enlarge');
    own.title = large ? 'Back into the page (Escape)' : 'Enlarge to the window (Escape to return)';
    set_icon(own, large ? 'shrink' : 'enlarge');
  }

  toggle(panel) {
    if (this.panel === panel) return this.dialog.close();
    if (this.panel) this.dialog.close();
    this.panel = panel;
    this.place = document.createComment('');
    this.usual = panel.height;
    panel.root.replaceWith(this.place);
    this.dialog.append(panel.root);
    this.dialog.showModal();
    this.show(panel.root.querySelector('.enlarge'), true);
    this.fit();
    panel.root.querySelector('.enlarge').focus();
  }

  fit() {
    const { panel, dialog } = this;
    if (!panel) return;
    const style = getComputedStyle(dialog), around = panel.root.offsetHeight - panel.box.offsetHeight;
    panel.visible = true;
    panel.set_height(Math.max(160, dialog.clientHeight - around - parseFloat(style.paddingTop) - parseFloat(style.paddingBottom)));
    if (!panel.plot) panel.build();
    panel.resize();
  }

  back() {
    const { panel } = this;
    if (!panel) return;
    this.panel = null;
    this.place.replaceWith(panel.root);
    panel.set_height(this.usual);
    panel.resize();
    const own = panel.root.querySelector('.enlarge');
    this.show(own, false);
    own.focus({ preventScroll: true });
  }
}
