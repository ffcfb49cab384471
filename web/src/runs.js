// Letter, color and dashes of each run of a comparison.
import { button, element } from './page.js';

// Dashes in pixels of the screen. The first run's line is full and wide, so that a line over it is visible.
const dashes = [[], [7, 4], [2, 3], [11, 3, 2, 3], [4, 2], [14, 5], [6, 2, 1, 2], [1, 2]];

export const letter_of = (run) => String.fromCharCode(65 + run);

// Returns the style of a run's line for a plot.
export function line_of(run) {
  const dash = dashes[run % dashes.length];
  return { color: run, style: run === 0 ? 'full' : 'dashed', width: run === 0 ? 2.5 : 1.8, dash: dash.length ? dash : undefined };
}

function swatch(run) {
  const { color, width, dash } = line_of(run);
  const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  svg.setAttribute('width', '34');
  svg.setAttribute('height', '8');
  svg.setAttribute('aria-hidden', 'true');
  svg.innerHTML = `<path d="M0 4h34" stroke="var(--line-${color})" stroke-width="${width}" stroke-dasharray="${dash ?? ''}"/>`;
  return svg;
}

// Legend with one button per run, which shows or hides the run everywhere.
export class RunLegend {
  constructor(root, runs, on_toggle) {
    this.buttons = runs.map((run, i) => {
      const moved = run.shift_s ? `, moved by ${(-run.shift_s).toFixed(3).replace('-', '−')} s` : '';
      return button({ class: 'run', 'aria-pressed': 'true', title: `${run.title}; show or hide (${i + 1})` }, () => on_toggle(i),
        swatch(i), element('b', {}, letter_of(i)), element('span', {}, run.label),
        element('span', { class: 'quiet' }, `${(run.last_s - run.first_s).toFixed(2)} s${moved}`));
    });
    root.append(...this.buttons);
  }

  set(run, shown) {
    this.buttons[run].setAttribute('aria-pressed', String(shown));
  }
}
