// Drawing context that produces SVG. It implements the part of a canvas context that plots, charts and the
// views of a study use. An image becomes a rectangle for each run of equal pixels.

const anchors = { left: 'start', center: 'middle', right: 'end' };
const below = { top: 0.8, middle: 0.35, alphabetic: 0 };  // distance to the alphabetic baseline, in font sizes
const font = "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif";
const head = 30;  // height of the title [px]

const escaped = (text) => String(text).replace(/[&<>"']/g, (c) => `&#${c.charCodeAt(0)};`);
const at = (v) => (Math.round(100 * v) / 100).toString();

export class SvgContext {
  constructor() {
    this.parts = [];
    this.beginPath();
    this.dash = '';
    this.clips = 0;    // areas so far
    this.name = null;  // of the next line that is stroked
    Object.assign(this, { font: '11px sans-serif', fillStyle: '#000', strokeStyle: '#000', lineWidth: 1, globalAlpha: 1,
                          textAlign: 'left', textBaseline: 'alphabetic' });
  }

  // --- paths ---

  beginPath() {
    this.d = '';
    this.circle = null;    // the path, if it is one circle
    this.is_last = false;  // the last part is the fill of this path
  }

  moveTo(x, y) { this.d += `M${at(x)} ${at(y)}`; }
  lineTo(x, y) { this.d += `L${at(x)} ${at(y)}`; }
  closePath() { this.d += 'Z'; }
  rect(x, y, w, h) { this.d += `M${at(x)} ${at(y)}h${at(w)}v${at(h)}h${at(-w)}Z`; }

  // Adds a full circle.
  arc(x, y, r) {
    const start = `M${at(x + r)} ${at(y)}`, alone = !this.d || this.d === start;
    if (!this.d.endsWith(start)) this.d += start;
    this.d += `a${at(r)} ${at(r)} 0 1 1 ${at(-2 * r)} 0a${at(r)} ${at(r)} 0 1 1 ${at(2 * r)} 0Z`;
    if (alone) this.circle = { d: this.d, shape: `circle cx="${at(x)}" cy="${at(y)}" r="${at(r)}"` };
  }

  setLineDash(lengths) { this.dash = lengths.join(' '); }

  shape() { return this.circle?.d === this.d ? this.circle.shape : `path d="${this.d}"`; }

  // A path that was just filled gets its outline in the same element.
  stroke() {
    const dash = this.dash ? ` stroke-dasharray="${this.dash}"` : '', alpha = this.globalAlpha < 1 ? ` stroke-opacity="${this.globalAlpha}"` : '';
    const line = `stroke="${this.strokeStyle}" stroke-width="${at(this.lineWidth)}"${dash}${alpha}`;
    if (this.is_last) this.parts.push(this.parts.pop().replace('/>', ` ${line}/>`));
    else if (this.name !== null) this.parts.push(`<path class="line" d="${this.d}" fill="none" ${line}><title>${escaped(this.name)}</title></path>`);
    else if (this.d) this.parts.push(`<${this.shape()} fill="none" ${line}/>`);
    this.name = null;
    this.is_last = false;
  }

  fill() {
    if (!this.d) return;
    this.parts.push(`<${this.shape()} fill="${this.fillStyle}"${this.alpha()}/>`);
    this.is_last = true;
  }

  fillRect(x, y, w, h, paint = this.fillStyle, more = '') {
    this.parts.push(`<rect x="${at(x)}" y="${at(y)}" width="${at(w)}" height="${at(h)}" fill="${paint}"${this.alpha()}${more}/>`);
  }

  alpha() {
    return this.globalAlpha < 1 ? ` fill-opacity="${this.globalAlpha}"` : '';
  }

  // Draws only within the box what `does` draws.
  within({ left, right, top, bottom }, does) {
    const id = `c${++this.clips}`;
    this.parts.push(`<clipPath id="${id}"><rect x="${at(left)}" y="${at(top)}" width="${at(right - left)}" height="${at(bottom - top)}"/></clipPath>`,
      `<g clip-path="url(#${id})" stroke-linejoin="round">`);
    does();
    this.parts.push('</g>');
  }

  // --- words ---

  measureText(words) {
    this.ruler ??= document.createElement('canvas').getContext('2d');
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
  svg(title, width, height) {
    const all = at(height + head);
    return `<svg xmlns="http://www.w3.org/2000/svg" width="${at(width)}" height="${all}" viewBox="0 0 ${at(width)} ${all}" ` +
      `font-family="${font}"><title>${escaped(title)}</title><rect width="${at(width)}" height="${all}" fill="#fff"/>` +
      `<text x="8" y="20" font-size="15" font-weight="600" fill="#222">${escaped(title)}</text>` +
      `<g transform="translate(0 ${head})">${this.parts.join('\n')}</g></svg>\n`;
  }
}
