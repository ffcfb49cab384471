// animation.mjs REPORT FILE.gif [WIDTH HEIGHT]   writes one step of a walk as a looping animation: docs/pictures/walk.gif.
//
// It takes the step whose last pose is closest to its first one. The trolley stays in the middle, and a
// whole number of ground ticks fits into the step's distance, so that nothing jumps where the loop closes.
import { writeFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { open_browser, open_page } from './test/chromium.mjs';

const [report, file, width = '880', height = '470'] = process.argv.slice(2);
if (!file) throw new Error('usage: animation.mjs REPORT FILE.gif [WIDTH HEIGHT]');
const delay = 40;  // between frames [ms]

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

const browser = await open_browser();
const page = await open_page(browser, resolve(report), { colorScheme: 'light', deviceScaleFactor: 1 });
const loop = await page.evaluate(find_loop);
await page.evaluate((distance) => {
  const { scene } = window.sinew.page;
  scene.tick_step = distance / Math.max(1, Math.round(distance / (0.25 * scene.reach)));
}, loop.distance);
const count = Math.round((1000 * loop.period) / delay);
const times = Array.from({ length: count }, (_, i) => loop.from + (loop.period * i) / count);
const parts = await page.evaluate(({ size, times, delay }) => {
  window.sinew_film({ size, speed: 1, dark: false, still: false, bare: true });
  window.film.choose_palette(times.filter((t, i) => i % 8 === 0));
  return [...times.map((t) => window.film.gif_frame(t, delay)), window.film.gif_end()];
}, { size: [Number(width), Number(height)], times, delay });
await browser.close();

const gif = Buffer.concat(parts.map((part) => Buffer.from(part, 'base64')));
writeFileSync(file, gif);
console.log(`${file}: ${count} frames, ${(1e-6 * gif.length).toFixed(2)} MB, ${loop.period.toFixed(2)} s from ${loop.from.toFixed(2)} s, ` +
  `${((180 / Math.PI) * loop.apart).toFixed(1)} deg apart`);
