// animation.mjs REPORT FILE.gif [WIDTH HEIGHT]   writes one step of a walk as a looping animation: docs/pictures/walk.gif.
//
// It takes the step whose last pose is closest to its first one. The trolley stays in the middle, and a
// whole number of ground ticks fits into the step's distance, so that nothing jumps where the loop closes.
import { writeFileSync } from 'node:fs';
import { resolve } from 'node:path';
import gifenc from 'gifenc';
import { open_browser, open_page } from './test/chromium.mjs';

const { GIFEncoder, applyPalette, quantize } = gifenc;
const [report, file, width = '880', height = '470'] = process.argv.slice(2);
if (!file) throw new Error('usage: animation.mjs REPORT FILE.gif [WIDTH HEIGHT]');
const delay = 40;  // between frames [ms]
const size = [Number(width), Number(height)];

// Runs in the page. Returns the start and period of the loop [s] and the distance the body moves in it [m].
function find_loop() {
  const { run, page: { scene } } = window.sinew;
  const starts = [];
  for (const s of run.phases.stretches) starts[s.step] ??= s.from;
  const headings = (t) => run.scene.frames.map((f, i) => scene.pose(i, t).heading);
  let best = null;
  for (let step = 1; step + 1 < starts.length; ++step) {
    const period = starts[step + 1] - starts[step];
    for (let t = starts[step]; t < starts[step + 1] && t + period < run.duration; t += 0.01) {
      const now = headings(t), then = headings(t + period);
      const apart = Math.hypot(...now.map((h, i) => h - then[i]));
      if (!best || apart < best.apart) best = { from: t, period, apart };
    }
  }
  if (!best) throw new Error('the run has fewer than three steps; expected a walk of at least three');
  best.distance = scene.pose(0, best.from + best.period).x - scene.pose(0, best.from).x;
  return best;
}

// Runs in the page. Returns the drawing at a time, on white, as base64 of RGBA.
function frame_at({ t, size: [w, h] }) {
  const { scene } = window.sinew.page;
  scene.draw(t);
  const sheet = new OffscreenCanvas(w, h), ctx = sheet.getContext('2d');
  ctx.fillStyle = '#ffffff';
  ctx.fillRect(0, 0, w, h);
  ctx.drawImage(scene.canvas, 0, 0);
  const bytes = ctx.getImageData(0, 0, w, h).data;
  let text = '';
  for (let i = 0; i < bytes.length; i += 32768) text += String.fromCharCode(...bytes.subarray(i, i + 32768));
  return btoa(text);
}

const browser = await open_browser();
const page = await open_page(browser, resolve(report), { colorScheme: 'light', deviceScaleFactor: 1 });
await page.locator('#scene').evaluate((canvas, [w, h]) => canvas.setAttribute('style', `width: ${w}px; height: ${h}px`), size);
const loop = await page.evaluate(find_loop);
await page.evaluate((distance) => {
  const { scene } = window.sinew.page;
  scene.tick_step = distance / Math.max(1, Math.round(distance / (0.25 * scene.reach)));
}, loop.distance);
const count = Math.round((1000 * loop.period) / delay), frames = [];
for (let i = 0; i < count; ++i) {
  const t = loop.from + (loop.period * i) / count;
  frames.push(new Uint8Array(Buffer.from(await page.evaluate(frame_at, { t, size }), 'base64')));
}
await browser.close();

// All frames share one palette; a pixel that does not change is transparent.
const sample = Buffer.concat(frames.filter((f, i) => i % 8 === 0));
const palette = quantize(new Uint8Array(sample), 255);
const through = palette.length;
palette.push([255, 255, 255]);
const gif = GIFEncoder();
let before = null;
for (const frame of frames) {
  const now = applyPalette(frame, palette.slice(0, through));
  const shown = before ? now.map((color, i) => (color === before[i] ? through : color)) : now;
  gif.writeFrame(shown, ...size, { palette: before ? undefined : palette, delay, transparent: Boolean(before),
                                   transparentIndex: through, dispose: 1, repeat: 0 });
  before = now;
}
gif.finish();
writeFileSync(file, gif.bytes());
console.log(`${file}: ${count} frames, ${(1e-6 * gif.bytes().length).toFixed(2)} MB, ${loop.period.toFixed(2)} s from ${loop.from.toFixed(2)} s, ` +
  `${((180 / Math.PI) * loop.apart).toFixed(1)} deg apart`);
