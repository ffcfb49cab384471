// A plot as large as the window, until Escape or its button: the same plot, with the same zoom.
import { element } from './page.js';

export class Enlarged {
  // `before` and `after` are told when one goes and comes back.
  constructor(plots, changed) {
    Object.assign(this, { plots, changed, panel: null });
    this.dialog = element('dialog', { class: 'enlarged', 'aria-label': 'Enlarged plot' });
    document.body.append(this.dialog);
    this.dialog.addEventListener('close', () => this.back());
    this.dialog.addEventListener('click', (event) => event.target === this.dialog && this.dialog.close());
    addEventListener('resize', () => this.fit());
    addEventListener('beforeprint', () => this.panel && this.dialog.close());
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
    this.changed(panel, true);
    this.fit();
    panel.root.querySelector('.enlarge')?.focus();
  }

  fit() {
    const { panel, dialog } = this;
    if (!panel) return;
    const head = panel.root.querySelector('header').offsetHeight, style = getComputedStyle(dialog);
    panel.visible = true;
    panel.set_height(Math.max(160, dialog.clientHeight - head - parseFloat(style.paddingTop) - parseFloat(style.paddingBottom) - 14));
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
    this.changed(panel, false);
    panel.root.querySelector('.enlarge')?.focus({ preventScroll: true });
  }
}
