// Drawing context that produces SVG. It implements the part of a canvas context that the views of a study
// use, in coordinates of the page. An image becomes a rectangle for each run of equal pixels.
import { at, escaped } from './picture.js';

const anchors = { left: 'start', center: 'middle', right: 'end' };
const below = { top: 0.8, middle: 0.35, alphabetic: 0 };  // distance to the alphabetic baseline, in font sizes

export class SvgContext {
  constructor() {
    this.parts = [];
    this.d = '';
    this.dash = '';
    this.ruler = document.createElement('canvas').getContext('2d');
    Object.assign(this, { font: '11px sans-serif', fillStyle: '#000', strokeStyle: '#000', lineWidth: 1, globalAlpha: 1,
                          textAlign: 'left', textBaseline: 'alphabetic' });
  }

  // --- paths ---

  beginPath() { this.d = ''; }
  moveTo(x, y) { this.d += `M${at(x)} ${at(y)}`; }
  lineTo(x, y) { this.d += `L${at(x)} ${at(y)}`; }
  closePath() { this.d += 'Z'; }

  // Adds a full circle.
  arc(x, y, r) {
    this.d += `M${at(x + r)} ${at(y)}a${at(r)} ${at(r)} 0 1 1 ${at(-2 * r)} 0a${at(r)} ${at(r)} 0 1 1 ${at(2 * r)} 0Z`;
  }

  setLineDash(lengths) { this.dash = lengths.join(' '); }

  stroke() {
    const dash = this.dash ? ` stroke-dasharray="${this.dash}"` : '';
    if (this.d) this.parts.push(`<path d="${this.d}" fill="none" stroke="${this.strokeStyle}" stroke-width="${this.lineWidth}"${dash}${this.alpha()}/>`);
  }

  fill() {
    if (this.d) this.parts.push(`<path d="${this.d}" fill="${this.fillStyle}"${this.alpha()}/>`);
  }

  fillRect(x, y, w, h, paint = this.fillStyle, more = '') {
    this.parts.push(`<rect x="${at(x)}" y="${at(y)}" width="${at(w)}" height="${at(h)}" fill="${paint}"${this.alpha()}${more}/>`);
  }

  alpha() {
    return this.globalAlpha < 1 ? ` opacity="${this.globalAlpha}"` : '';
  }

  // --- words ---

  measureText(words) {
    this.ruler.font = this.font;
    return this.ruler.measureText(words);
  }

  fillText(words, x, y) { this.text(words, x, y, `fill="${this.fillStyle}"`); }

  strokeText(words, x, y) {
    this.text(words, x, y, `fill="none" stroke="${this.strokeStyle}" stroke-width="${this.lineWidth}" stroke-linejoin="round"`);
  }

  text(words, x, y, paint) {
    const size = parseFloat(this.font.match(/([\d.]+)px/)[1]), weight = this.font.match(/^(\d+) /);
    this.parts.push(`<text x="${at(x)}" y="${at(y + below[this.textBaseline] * size)}" font-size="${size}"` +
      `${weight ? ` font-weight="${weight[1]}"` : ''} text-anchor="${anchors[this.textAlign]}" ${paint}${this.alpha()}>${escaped(words)}</text>`);
  }

  // --- pixels ---

  drawImage(canvas, x, y, w, h) {
    const { width, height } = canvas, { data } = canvas.getContext('2d').getImageData(0, 0, width, height);
    const [wide, tall] = [w / width, h / height];
    const paint = (k) => (data[4 * k + 3] ? `rgb(${data[4 * k]},${data[4 * k + 1]},${data[4 * k + 2]})` : null);
    for (let row = 0; row < height; ++row)
      for (let from = 0, to; from < width; from = to) {
        const color = paint(row * width + from);
        for (to = from + 1; to < width && paint(row * width + to) === color;) ++to;
        if (!color) continue;
        // Rounds edges first, so that neighbours share them exactly.
        const [left, right] = [x + from * wide, x + to * wide].map((v) => Number(at(v)));
        const [top, bottom] = [y + row * tall, y + (row + 1) * tall].map((v) => Number(at(v)));
        this.fillRect(left, top, right - left, bottom - top, color, ' shape-rendering="crispEdges"');
      }
  }

  // Returns the SVG on white, with a title.
  svg(title, width, height, sans) {
    const head = 30, all = height + head;
    return `<svg xmlns="http://www.w3.org/2000/svg" width="${at(width)}" height="${at(all)}" viewBox="0 0 ${at(width)} ${at(all)}" ` +
      `font-family="${escaped(sans)}"><title>${escaped(title)}</title><rect width="${at(width)}" height="${at(all)}" fill="#fff"/>` +
      `<text x="8" y="20" font-size="15" font-weight="600" fill="#222">${escaped(title)}</text>` +
      `<g transform="translate(0 ${head})">${this.parts.join('\n')}</g></svg>\n`;
  }
}
