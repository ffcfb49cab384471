// Common functions of tests of pages: a browser without network, checks for errors, and the operations of
// a user. browser.mjs runs the tests.
import assert from 'node:assert/strict';
import { mkdirSync, readFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { after, before } from 'node:test';
import { open_browser, open_page } from './chromium.mjs';

const [runs, pictures] = process.argv.slice(2).map((a) => resolve(a));
if (!runs) throw new Error('usage: browser.mjs RUNS [PICTURES]');
if (pictures) mkdirSync(pictures, { recursive: true });

let browser;
before(async () => (browser = await open_browser()));
after(() => browser.close());

export { runs, pictures };

// Returns a browser context for pages that have a server.
export const new_context = (options = {}) => browser.newContext({ viewport: { width: 1440, height: 900 }, ...options });

// Opens the page of a run, or another page in its folder, and closes it afterwards; fails if the page has
// caused an error.
export async function with_page(name, does, options, file = 'report.html') {
  const page = await open_page(browser, join(runs, name, file), options);
  try {
    await does(page);
    assert.deepEqual(page.wrong, []);
  } finally {
    await page.context().close();
  }
}
export const picture = async (page, name) => pictures && page.screenshot({ path: join(pictures, `${name}.png`) });
// Returns the picture that a menu saves. `of`: a plot, a chart or a view with a menu; `kind`: SVG or PNG.
export async function saved(page, of, kind) {
  await of.locator('button[aria-haspopup]').click();
  const [download] = await Promise.all([page.waitForEvent('download'),
    page.getByRole('menuitem', { name: `Save as ${kind}`, exact: true }).click()]);
  return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
}

// Returns a saved SVG as text, after checking that it is complete, on white, and has only paths and text.
export async function vectors_of(page, of) {
  const { name, bytes } = await saved(page, of, 'SVG'), text = bytes.toString('utf8');
  assert.match(name, /\.svg$/);
  assert.doesNotMatch(text, /<image|data:|<script|NaN|undefined/);
  assert.ok(text.includes('fill="#fff"'));
  assert.ok(await page.evaluate((t) => !new DOMParser().parseFromString(t, 'image/svg+xml').querySelector('parsererror'), text), 'well formed');
  if (pictures) {
    const sheet = await page.context().newPage();
    await sheet.setContent(text);
    await sheet.screenshot({ path: join(pictures, `saved-${name.replace('.svg', '')}.png`) });
    await sheet.close();
  }
  return { name, text };
}

export const summary_of = (name) => JSON.parse(readFileSync(join(runs, name, 'summary.json'), 'utf8'));

export const time_of = (page) => page.evaluate(() => window.sinew.page.player.time);
export const seek = (page, t) => page.locator('#seek').evaluate((slider, to) => {
  slider.value = to;
  slider.dispatchEvent(new Event('input', { bubbles: true }));
}, t);
// Returns the drawing as a string, to detect changes.
export const drawing_of = (page) => page.locator('#scene').evaluate((canvas) => canvas.toDataURL());
// Returns, for every visible plot, the position of its time cursor and where it should be.
export const playheads = (page) => page.evaluate(() =>
  window.sinew.page.plots.panels.filter((p) => p.visible && p.plot).map((p) => {
    const box = p.plot.over.getBoundingClientRect(), head = p.head.getBoundingClientRect();
    return { is: head.left + 1 - box.left, should: p.plot.valToPos(window.sinew.page.player.time, 'x') };
  }));
