// Compares pages with reviewed screenshots, web/test/references/*.png.
//
//   SINEW_RENEW=yes ./check web      writes them again; review them before they are committed
//
// A reference has half the size of the screen. Means over blocks of 8 pixels are compared, so that letters
// may be a little bolder or lines softer in another browser, but a missing plot, an empty drawing or
// another pose is detected. The mutations at the end check both.
import assert from 'node:assert/strict';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { pictures, with_page } from './pages.mjs';

const folder = join(dirname(fileURLToPath(import.meta.url)), 'references');
const renew = Boolean(process.env.SINEW_RENEW);
const viewport = { width: 1200, height: 800 };
const block = 8;           // [px of the reference]
const off = 14;            // a block differs if its mean color differs by more than this, of 255
const most_off = 0.004;    // share of such blocks
const most_mean = 0.8;     // mean of the differences of all blocks, of 255

// Runs in a page. Returns a picture at half its size, as PNG.
async function halved(png) {
  const image = await createImageBitmap(await (await fetch(png)).blob());
  const sheet = document.createElement('canvas');
  sheet.width = image.width / 2, sheet.height = image.height / 2;
  const ctx = sheet.getContext('2d');
  ctx.imageSmoothingQuality = 'high';
  ctx.drawImage(image, 0, 0, sheet.width, sheet.height);
  return sheet.toDataURL('image/png');
}

// Runs in a page. Returns by how much two pictures of the same size differ, by blocks. A block may be moved
// by a pixel or two: it is compared with the most similar block nearby, in both directions.
async function difference([a, b, block, off]) {
  // Integral image of each color channel.
  const sums = async (png) => {
    const image = await createImageBitmap(await (await fetch(png)).blob());
    const sheet = document.createElement('canvas');
    const w = (sheet.width = image.width), h = (sheet.height = image.height), ctx = sheet.getContext('2d');
    ctx.drawImage(image, 0, 0);
    const { data } = ctx.getImageData(0, 0, w, h);
    const of = [0, 1, 2].map((c) => {
      const sum = new Float64Array((w + 1) * (h + 1));
      for (let y = 0; y < h; ++y)
        for (let x = 0; x < w; ++x)
          sum[(y + 1) * (w + 1) + x + 1] = data[4 * (y * w + x) + c] + sum[y * (w + 1) + x + 1] +
            sum[(y + 1) * (w + 1) + x] - sum[y * (w + 1) + x];
      return sum;
    });
    return { w, h, of };
  };
  const mean = (image, c, x, y) => {
    const { w, h, of: { [c]: sum } } = image;
    const from_x = Math.max(0, x), from_y = Math.max(0, y), to_x = Math.min(w, x + block), to_y = Math.min(h, y + block);
    const at = (px, py) => sum[py * (w + 1) + px];
    return (at(to_x, to_y) - at(from_x, to_y) - at(to_x, from_y) + at(from_x, from_y)) / ((to_x - from_x) * (to_y - from_y));
  };
  const [one, other] = [await sums(a), await sums(b)];
  if (one.w !== other.w || one.h !== other.h) return { mean: 255, off: 1, largest: 255 };
  const nearest = (from, to, x, y) => {
    const own = [0, 1, 2].map((c) => mean(from, c, x, y));
    let least = 255;
    for (let dy = -1; dy <= 1; ++dy)
      for (let dx = -2; dx <= 2; ++dx)
        least = Math.min(least, Math.max(...own.map((v, c) => Math.abs(v - mean(to, c, x + dx, y + dy)))));
    return least;
  };
  const all = [];
  for (let y = 0; y < one.h; y += block)
    for (let x = 0; x < one.w; x += block)
      all.push(Math.max(nearest(one, other, x, y), nearest(other, one, x, y)));
  return { mean: all.reduce((sum, d) => sum + d, 0) / all.length, off: all.filter((d) => d > off).length / all.length,
           largest: Math.max(...all) };
}

const data_url = (png) => `data:image/png;base64,${png.toString('base64')}`;

// Evaluates a function on an empty page, which may fetch data URLs; the tested pages may not.
async function on_a_sheet(page, does, argument) {
  const sheet = await page.context().newPage();
  try {
    return await sheet.evaluate(does, argument);
  } finally {
    await sheet.close();
  }
}

async function shot(page) {
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  await page.waitForTimeout(300);
  return on_a_sheet(page, halved, data_url(await page.screenshot()));
}

const against = async (page, now, name) =>
  on_a_sheet(page, difference, [now, data_url(readFileSync(join(folder, `${name}.png`))), block, off]);
const alike = (d) => d.mean <= most_mean && d.off <= most_off;
const in_words = (d) => `${(100 * d.off).toFixed(2)} % of the blocks differ, mean ${d.mean.toFixed(2)}, largest ${d.largest.toFixed(0)}`;

const seek = (page, t) => t !== undefined && page.evaluate((to) => window.sinew.page.seek(to), t);

const pages = [
  { name: 'walk-light', run: 'walk-test-1', at: 7.4 },
  { name: 'walk-dark', run: 'walk-test-1', at: 7.4, colorScheme: 'dark' },
  { name: 'stand', run: 'feedback', at: 7 },
  { name: 'fit', run: 'static' },
  { name: 'compare', run: 'compare', file: 'two.html' },
];

for (const { name, run, at, file, colorScheme = 'light' } of pages)
  test(`${name} looks as it did`, () => with_page(run, async (page) => {
    await seek(page, at);
    const now = await shot(page);
    const reference = join(folder, `${name}.png`);
    const bytes = Buffer.from(now.split(',')[1], 'base64');
    if (renew) return writeFileSync(reference, bytes);
    assert.ok(existsSync(reference), `no ${reference}; SINEW_RENEW=yes ./check web writes it`);
    const found = await against(page, now, name);
    if (alike(found)) return;
    const seen = join(pictures ?? dirname(process.argv[2]), `now-${name}.png`);
    writeFileSync(seen, bytes);
    assert.fail(`${in_words(found)}: compare ${seen} with ${reference}; if it is right: SINEW_RENEW=yes ./check web`);
  }, { viewport, colorScheme }, file));

// --- changes that must be detected, and changes that must not ---

const mutations = [
  ['another pose', false, (page) => page.evaluate(() => window.sinew.page.scene.draw(7.1))],
  ['an empty drawing', false, (page) => page.evaluate(() => {
    const { canvas } = window.sinew.page.scene;
    canvas.getContext('2d').clearRect(0, 0, canvas.width, canvas.height);
  })],
  ['a missing plot', false, (page) => page.locator('.panel canvas').nth(1).evaluate((c) => (c.style.visibility = 'hidden'))],
  ['a missing line', false, (page) => page.locator('.panel .line').first().click()],
  ['other colors', false, (page) => page.locator('#theme').click()],
  ['softer edges', true, (page) => page.addStyleTag({ content: 'main, header { transform: translate(.5px, .5px); }' })],
  ['letters drawn otherwise', true, (page) => page.addStyleTag({ content: 'body { text-rendering: geometricPrecision; }' })],
];

if (!renew)
  for (const [what, passes, change] of mutations)
    test(`${what} ${passes ? 'is' : 'is not'} taken for the walk as it looked`, () => with_page('walk-test-1', async (page) => {
      await seek(page, 7.4);
      await page.waitForTimeout(200);
      await change(page);
      const found = await against(page, await shot(page), 'walk-light');
      assert.equal(alike(found), passes, in_words(found));
      if (process.env.SINEW_VERBOSE) console.log(`# ${what}: ${in_words(found)}`);
    }, { viewport, colorScheme: 'light' }));
