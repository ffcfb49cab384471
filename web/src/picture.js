// Plot or chart as an SVG picture: paths drawn from its data, axes with units, and a legend, on white.
import { ticks } from './axis.js';
import { tick_text } from './units.js';

const width = 720, height = 400;
const room = { top: 16, right: 18, left: 66, bottom: 44, axis: 62, legend: 20 };
const font = "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif";

export const escaped = (text) => String(text).replace(/[&<>"']/g, (c) => `&#${c.charCodeAt(0)};`);
export const at = (v) => (Math.round(100 * v) / 100).toString();

// Returns the result of `does`, called while the page has its light colors.
export function on_paper(does) {
  const root = document.documentElement, before = root.dataset.theme;
  root.dataset.theme = 'light';
  try {
    return does();
  } finally {
    if (before) root.dataset.theme = before;
    else delete root.dataset.theme;
  }
}

function paper_colors() {
  const css = getComputedStyle(document.documentElement), get = (name) => css.getPropertyValue(name).trim();
  return { lines: [0, 1, 2, 3, 4, 5, 6, 7].map((i) => get(`--line-${i}`)), stance: get('--stance'), fault: get('--fault'),
           bad: get('--bad'), mark: get('--mark') };
}

export class Picture {
  // `names`: entries of the legend, each with its `label`; `two`: there is a second axis at the right.
  // A derived class sets `from`, `to` and `ranges` (one per vertical axis), and draws in background(),
  // marks(), curves() and key(), which draws the sample of a legend entry.
  constructor(title, names, two = false) {
    this.title = title;
    this.colors = on_paper(paper_colors);
    this.parts = [];
    this.keys = in_rows(names);
    this.left = room.left;
    this.right = width - (two ? room.axis : room.right);
    this.top = room.top + 20 + room.legend * this.keys.length;
    this.bottom = this.top + height - room.top - room.bottom - 20;
    this.height = this.bottom + room.bottom;
  }

  add(text) {
    this.parts.push(text);
  }

  x = (t) => this.left + ((t - this.from) / (this.to - this.from)) * (this.right - this.left);
  y = (v, [low, high]) => this.bottom - ((v - low) / (high - low)) * (this.bottom - this.top);

  text(x, y, words, more = '') {
    this.add(`<text x="${at(x)}" y="${at(y)}" ${more}>${escaped(words)}</text>`);
  }

  // Returns a path through the data; NaN and null interrupt it, undefined is skipped.
  path(xs, ys, range) {
    let d = '', drawing = false;
    for (let k = 0; k < xs.length; ++k) {
      if (ys[k] === undefined) continue;
      if (ys[k] === null || !Number.isFinite(ys[k]) || !Number.isFinite(xs[k])) { drawing = false; continue; }
      d += `${drawing ? 'L' : 'M'}${at(this.x(xs[k]))} ${at(this.y(ys[k], range))}`;
      drawing = true;
    }
    return d;
  }

  line(label, d, stroke) {
    this.add(`<path class="line" d="${d}" ${stroke}><title>${escaped(label)}</title></path>`);
  }

  // --- parts ---

  background() {}
  marks() {}

  // `across`: label of the horizontal axis, `upright`: labels of the vertical axes.
  axes(across, upright) {
    for (const t of ticks(this.from, this.to, 8)) {
      this.add(`<path class="g" d="M${at(this.x(t))} ${at(this.top)}V${at(this.bottom)}"/>`);
      this.text(this.x(t), this.bottom + 16, tick_text(t), 'text-anchor="middle"');
    }
    this.ranges.forEach((range, axis) => {
      const x = axis ? this.right + 6 : this.left - 6;
      for (const v of ticks(...range, 6)) {
        if (!axis) this.add(`<path class="g" d="M${at(this.left)} ${at(this.y(v, range))}H${at(this.right)}"/>`);
        this.text(x, this.y(v, range) + 4, tick_text(v), axis ? '' : 'text-anchor="end"');
      }
      const middle = (this.top + this.bottom) / 2, far = axis ? width - 10 : 18;
      if (upright[axis]) this.text(far, middle, upright[axis], `text-anchor="middle" transform="rotate(-90 ${far} ${at(middle)})"`);
    });
    this.text((this.left + this.right) / 2, this.height - 8, across, 'text-anchor="middle"');
  }

  legend() {
    this.keys.forEach((row, k) => {
      const y = room.top + 20 + room.legend * k + 8;
      for (const { x, name } of row) {
        this.key(name, this.left + x, y - 4);
        this.text(this.left + x + 30, y, name.label);
      }
    });
  }

  svg() {
    this.add(`<rect width="${width}" height="${at(this.height)}" fill="#fff"/>`);
    this.text(this.left, room.top + 8, this.title, 'font-size="15" font-weight="600"');
    this.legend();
    this.background();
    this.axes(...this.axis_words());
    this.marks();
    this.add(`<g clip-path="url(#c)" fill="none" stroke-linejoin="round">`);
    this.curves();
    this.add('</g>');
    const box = `x="${at(this.left)}" y="${at(this.top)}" width="${at(this.right - this.left)}" height="${at(this.bottom - this.top)}"`;
    this.add(`<rect ${box} fill="none" stroke="#444"/>`);
    return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${at(this.height)}" viewBox="0 0 ${width} ${at(this.height)}" ` +
      `font-family="${font}" font-size="12" fill="#222"><title>${escaped(this.title)}</title>` +
      `<style>.g{stroke:#e3e6ea}</style><defs><clipPath id="c"><rect ${box}/></clipPath></defs>${this.parts.join('\n')}</svg>\n`;
  }
}

// Distributes the entries of a legend over rows that fit.
function in_rows(names) {
  const rows = [[]];
  let x = 0;
  for (const name of names) {
    const long = 44 + 6.4 * name.label.length;
    if (x + long > width - room.left - room.right && rows.at(-1).length) rows.push([]), (x = 0);
    rows.at(-1).push({ x, name });
    x += long;
  }
  return rows;
}
