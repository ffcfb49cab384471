// List of the runs in a folder, served by `sinew view`: search runs, open one, compare several.
import { Appearance } from './appearance.js';
import { icons_of } from './icon.js';
import { by_id, element, on_click, start_page } from './page.js';
import { Units } from './units.js';

class RunList {
  constructor({ folder, most, runs }) {
    this.most = most;
    this.ticked = [];  // numbers of runs, in the order in which they were ticked
    // The newest first; within the same minute, the one with the greater number first.
    this.runs = [...runs].sort((a, b) => (a.date === b.date ? b.run - a.run : a.date < b.date ? 1 : -1));
    by_id('title').textContent = 'Runs';
    by_id('facts').textContent = [folder && `below ${folder}`, `${runs.length} run${runs.length === 1 ? '' : 's'}`, 'newest first'].filter(Boolean).join(' · ');
    this.items = this.runs.map((run) => this.item(run));
    by_id('list').append(...this.items.map((i) => i.root));
    by_id('search').addEventListener('input', () => this.search());
    on_click('compare', () => (location.href = `compare/${this.ticked.join(',')}`));
    on_click('clear', () => this.clear());
    new Appearance(new Units(0), { on_units() {}, on_colors() {}, on_print() {} });
    this.show_ticked();
    this.load_pictures();
  }

  item(run) {
    const title = run.title || run.folder;
    const box = element('input', { type: 'checkbox', 'aria-label': `Compare ${title}, ${run.folder}` });
    const facts = [run.date, run.duration_s === undefined ? 'not finished' : `${run.duration_s.toFixed(2)} s`,
                   run.robot && `robot ${run.robot}`, run.seed && `seed ${run.seed}`].filter(Boolean).join(' · ');
    const root = element('li', { 'data-run': run.run },
      box, ...this.images(run),
      element('div', {}, element('h2', {}, element('a', { href: `run/${run.run}` }, title)),
        run.about ? element('p', {}, run.about) : null,
        element('p', { class: 'quiet' }, facts), element('p', { class: 'quiet' }, run.folder)));
    box.addEventListener('change', () => this.tick(run.run, box.checked));
    return { run, root, box, text: `${title} ${run.about} ${facts} ${run.folder}`.toLowerCase() };
  }

  // Returns the picture of a run on light and on dark, of which the page shows one. Both are loaded once,
  // when the run comes into the window or load_pictures() reaches it.
  images(run) {
    const images = ['light', 'dark'].map((name) => element('img', { class: `on-${name}`, alt: '', width: 96, height: 96 }));
    const load = async () => {
      const reply = await fetch(`picture/${run.run}`);
      const icons = await icons_of(reply.ok ? await reply.json() : {}, by_id('sheet'));
      images.forEach((image, i) => (image.src = icons[i]));
    };
    run.load = () => (run.loading ??= load().catch(() => {}));  // without a picture where the program has ended
    run.seen = new IntersectionObserver((entries) => entries.some((e) => e.isIntersecting) && run.load());
    images.forEach((image) => run.seen.observe(image));
    return images;
  }

  // Loads the pictures that were not in the window, one after the other: a print shows all.
  async load_pictures() {
    for (const run of this.runs) {
      await run.load();
      run.seen.disconnect();
    }
  }

  search() {
    const words = by_id('search').value.toLowerCase().split(/\s+/).filter(Boolean);
    let found = 0;
    for (const i of this.items) {
      const wanted = words.every((w) => i.text.includes(w));
      i.root.hidden = !wanted;
      found += wanted;
    }
    by_id('found').textContent = words.length ? `${found} of ${this.items.length}` : '';
  }

  tick(run, on) {
    this.ticked = this.ticked.filter((r) => r !== run);
    if (on) this.ticked.push(run);
    this.show_ticked();
  }

  clear() {
    this.ticked = [];
    this.show_ticked();
  }

  show_ticked() {
    const count = this.ticked.length, full = count >= this.most;
    for (const i of this.items) {
      const on = this.ticked.includes(i.run.run);
      i.box.checked = on;
      i.box.disabled = full && !on;
      i.root.classList.toggle('ticked', on);
    }
    by_id('compare').disabled = count < 2;
    by_id('clear').hidden = !count;
    const first = this.items.find((i) => i.run.run === this.ticked[0]);
    by_id('chosen').textContent = !count ? 'Select two or more runs to compare them.'
      : `${count} selected, compared with ${first.run.folder}${full ? '; no more can be selected' : ''}`;
  }
}

start_page((runs) => ({ list: new RunList(runs) }));
