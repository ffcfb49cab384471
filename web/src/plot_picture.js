// A plot as a picture of its own: paths drawn from its data, axes with units, a legend, on white
// paper. The PNG is the same picture, three points for each of its units.
import { ticks } from './axis.js';
import { tick_text } from './units.js';

const width = 720, height = 400;
const room = { top: 16, right: 18, left: 66, bottom: 44, axis: 62, legend: 20 };
const sharpness = 3;
const font = "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif";

const escaped = (text) => String(text).replace(/[&<>"']/g, (c) => `&#${c.charCodeAt(0)};`);
const at = (v) => (Math.round(100 * v) / 100).toString();

// As on paper, whatever the screen's colors are.
function paper_colors() {
  const root = document.documentElement, before = root.dataset.theme;
  root.dataset.theme = 'light';
  const css = getComputedStyle(root), get = (name) => css.getPropertyValue(name).trim();
  const out = { lines: [0, 1, 2, 3, 4, 5, 6, 7].map((i) => get(`--line-${i}`)), stance: get('--stance'), fault: get('--fault'),
                bad: get('--bad'), mark: get('--mark') };
  if (before) root.dataset.theme = before;
  else delete root.dataset.theme;
  return out;
}

class Picture {
  constructor(panel) {
    this.panel = panel;
    this.plots = panel.plots;
    this.colors = paper_colors();
    this.parts = [];
    this.two = panel.units.length > 1;
    this.keys = this.legend_rows();
    this.left = room.left;
    this.right = width - (this.two ? room.axis : room.right);
    this.top = room.top + 20 + room.legend * this.keys.length;
    this.bottom = this.top + height - room.top - room.bottom - 20;
    this.height = this.bottom + room.bottom;
    [this.from, this.to] = this.plots.view;
    this.data = panel.slice(this.right - this.left);
    this.ranges = panel.units.slice(0, 2).map((unit, axis) => panel.range(axis, this.data));
  }

  add(text) {
    this.parts.push(text);
  }

  x = (t) => this.left + ((t - this.from) / (this.to - this.from)) * (this.right - this.left);
  y = (v, [low, high]) => this.bottom - ((v - low) / (high - low)) * (this.bottom - this.top);
  color = (i) => this.colors.lines[this.panel.spec.lines[i].color % this.colors.lines.length];

  text(x, y, words, more = '') {
    this.add(`<text x="${at(x)}" y="${at(y)}" ${more}>${escaped(words)}</text>`);
  }

  // Lines that are shown, in rows that fit.
  legend_rows() {
    const { spec, shown } = this.panel, rows = [[]];
    let x = 0;
    spec.lines.forEach((line, i) => {
      if (!shown[i]) return;
      const long = 44 + 6.4 * line.label.length;
      if (x + long > width - room.left - room.right && rows.at(-1).length) rows.push([]), (x = 0);
      rows.at(-1).push({ i, x, label: line.label });
      x += long;
    });
    return rows;
  }

  // --- parts ---

  background() {
    const stretch = (from, to, color) => {
      const a = Math.max(this.left, this.x(from)), b = Math.min(this.right, this.x(to));
      if (b > a) this.add(`<rect x="${at(a)}" y="${at(this.top)}" width="${at(b - a)}" height="${at(this.bottom - this.top)}" fill="${color}"/>`);
    };
    const { run } = this.plots;
    for (const s of run.phases.stretches) if (s.stance) stretch(s.from, s.to, this.colors.stance);
    for (const f of run.faults ?? []) stretch(f.from, f.to, this.colors.fault);
  }

  axes() {
    const labels = this.panel.units.map((u) => this.plots.units.of(u).label);
    for (const t of ticks(this.from, this.to, 8)) {
      this.add(`<path class="g" d="M${at(this.x(t))} ${at(this.top)}V${at(this.bottom)}"/>`);
      this.text(this.x(t), this.bottom + 16, String(t).replace('-', '−'), 'text-anchor="middle"');
    }
    this.ranges.forEach((range, axis) => {
      const x = axis ? this.right + 6 : this.left - 6;
      for (const v of ticks(...range, 6)) {
        if (!axis) this.add(`<path class="g" d="M${at(this.left)} ${at(this.y(v, range))}H${at(this.right)}"/>`);
        this.text(x, this.y(v, range) + 4, tick_text(v), axis ? '' : 'text-anchor="end"');
      }
      const middle = (this.top + this.bottom) / 2, far = axis ? width - 10 : 18;
      if (labels[axis]) this.text(far, middle, labels[axis], `text-anchor="middle" transform="rotate(-90 ${far} ${at(middle)})"`);
    });
    this.text((this.left + this.right) / 2, this.height - 8, 'time [s]', 'text-anchor="middle"');
  }

  marks() {
    for (const m of this.plots.marks?.in_view() ?? [])
      this.add(`<path d="M${at(this.x(m.from))} ${at(this.top)}V${at(this.bottom)}" stroke="${this.colors.mark}" stroke-dasharray="3 3"/>`);
    for (const f of this.plots.run.faults ?? [])
      for (const t of [f.from, f.to])
        if (t >= this.from && t <= this.to) this.add(`<path d="M${at(this.x(t))} ${at(this.top)}V${at(this.bottom)}" stroke="${this.colors.bad}"/>`);
  }

  stroke(i) {
    const line = this.panel.spec.lines[i], dash = line.dash ?? (line.style === 'dashed' ? [6, 4] : null);
    return `stroke="${this.color(i)}" stroke-width="${line.style === 'full' ? 1.6 : 1.3}"${dash ? ` stroke-dasharray="${dash.join(' ')}"` : ''}`;
  }

  path(i, range) {
    const [x, ...lines] = this.data, line = lines[i];
    let d = '', drawing = false;
    for (let k = 0; k < x.length; ++k) {
      if (line[k] === undefined) continue;
      if (line[k] === null) { drawing = false; continue; }
      d += `${drawing ? 'L' : 'M'}${at(this.x(x[k]))} ${at(this.y(line[k], range))}`;
      drawing = true;
    }
    return d;
  }

  curves() {
    this.add(`<g clip-path="url(#c)" fill="none" stroke-linejoin="round">`);
    this.panel.spec.lines.forEach((line, i) => {
      if (!this.panel.shown[i]) return;
      const range = this.ranges[this.panel.units.indexOf(this.panel.unit_of(i))] ?? this.ranges[0];
      this.add(`<path class="line" d="${this.path(i, range)}" ${this.stroke(i)}><title>${escaped(line.label)}</title></path>`);
    });
    this.add('</g>');
  }

  legend() {
    this.keys.forEach((row, k) => {
      const y = room.top + 20 + room.legend * k + 8;
      for (const { i, x, label } of row) {
        this.add(`<path d="M${at(this.left + x)} ${at(y - 4)}h24" ${this.stroke(i)} fill="none"/>`);
        this.text(this.left + x + 30, y, label);
      }
    });
  }

  svg() {
    this.add(`<rect width="${width}" height="${at(this.height)}" fill="#fff"/>`);
    this.text(this.left, room.top + 8, this.panel.spec.title, 'font-size="15" font-weight="600"');
    this.legend();
    this.background();
    this.axes();
    this.marks();
    this.curves();
    const box = `x="${at(this.left)}" y="${at(this.top)}" width="${at(this.right - this.left)}" height="${at(this.bottom - this.top)}"`;
    this.add(`<rect ${box} fill="none" stroke="#444"/>`);
    return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${at(this.height)}" viewBox="0 0 ${width} ${at(this.height)}" ` +
      `font-family="${font}" font-size="12" fill="#222"><title>${escaped(this.panel.spec.title)}</title>` +
      `<style>.g{stroke:#e3e6ea}</style><defs><clipPath id="c"><rect ${box}/></clipPath></defs>${this.parts.join('\n')}</svg>\n`;
  }
}

export const svg_of = (panel) => new Picture(panel).svg();

export async function png_of(panel) {
  const picture = new Picture(panel), image = new Image();
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(picture.svg())}`;
  await image.decode();
  const canvas = document.createElement('canvas');
  canvas.width = sharpness * width;
  canvas.height = Math.round(sharpness * picture.height);
  canvas.getContext('2d').drawImage(image, 0, 0, canvas.width, canvas.height);
  return new Promise((done, fail) => canvas.toBlob((b) => (b ? done(b) : fail(new Error('the browser makes no PNG of it'))), 'image/png'));
}

// "walk-test-1-joint-angles"
export const file_name = (run, panel) =>
  [run.name || run.title || 'run', panel.spec.title].join('-').toLowerCase().replace(/[^a-z0-9]+/g, '-').replace(/^-+|-+$/g, '').slice(0, 80);

export function save_as(name, blob) {
  const link = document.createElement('a'), url = URL.createObjectURL(blob);
  link.href = url;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}
