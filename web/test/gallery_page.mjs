// Tests of the page of figures: index.html of `sinew figures --thesis` in the folder thesis-figures.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { picture, runs, with_page } from './pages.mjs';

const with_gallery = (does, options) => with_page('thesis-figures', does, { own_folder: true, ...options }, 'index.html');
const index = () => JSON.parse(readFileSync(join(runs, 'thesis-figures', 'index.json'), 'utf8'));
const svg_of = (figure) => readFileSync(join(runs, 'thesis-figures', figure.svg), 'utf8');
const visible = (page) => page.locator('article:visible').evaluateAll((all) => all.map((a) => a.id));

test('the page of figures has every figure, its picture and its claims', () => with_gallery(async (page) => {
  const { figures, verdicts, classes } = index();
  assert.deepEqual(await visible(page), figures.map((f) => f.figure));
  for (const figure of figures) {
    const article = page.locator(`[id="${figure.figure}"]`);
    const image = article.locator('img');
    await image.scrollIntoViewIfNeeded();
    await page.waitForFunction((i) => i.complete, await image.elementHandle());
    assert.ok((await image.evaluate((i) => i.naturalWidth)) > 100, `${figure.figure}: no picture`);
    assert.equal(await article.locator('.claim').count(), figure.claims.length);
    assert.deepEqual(await article.locator('.verdict').allTextContents(), figure.claims.map((c) => c.verdict));
    assert.deepEqual(await article.locator('.class').allTextContents(), figure.claims.map((c) => c.class ?? ''));
  }
  // The table has verdicts by class; the last row is their sum.
  const tally = await page.locator('.tally tbody tr').evaluateAll((rows) => rows.map((r) =>
    [r.firstElementChild.textContent, ...[...r.querySelectorAll('td')].map((c) => Number(c.textContent))]));
  for (const [name, counts] of Object.entries(classes)) {
    const sum = Object.values(counts).reduce((a, b) => a + b, 0);
    assert.deepEqual(tally.find(([row]) => row === name) ?? null, sum ? [name, ...Object.values(counts), sum] : null);
  }
  const all = Object.values(verdicts);
  assert.deepEqual(tally.at(-1), ['all', ...all, all.reduce((a, b) => a + b, 0)]);
  await page.evaluate(() => scrollTo(0, 0));
  await picture(page, 'thesis-figures');
}));

test('a picture with a synthetic curve is labelled as synthetic', () => {
  const synthetic = index().figures.filter((f) => f.curves.some((c) => c.kind === 'synthetic'));
  assert.ok(synthetic.length > 10);
  for (const figure of synthetic) assert.match(svg_of(figure), /\(synthetic\)/, figure.figure);
});

test('figures that differ can be selected', () => with_gallery(async (page) => {
  await page.selectOption('#choice', 'differs');
  const wanted = index().figures.filter((f) => f.claims.some((c) => c.verdict.startsWith('differs'))).map((f) => f.figure);
  assert.ok(wanted.length > 0);
  assert.deepEqual(await visible(page), wanted);
  await page.selectOption('#choice', '');
  assert.equal((await visible(page)).length, index().figures.length);
}));

for (const [width, colorScheme] of [[1440, 'dark'], [390, 'light']])
  test(`nothing is wider than ${width} pixels`, () => with_gallery(async (page) => {
    assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= width);
    await picture(page, `thesis-figures-${width}`);
  }, { viewport: { width, height: 900 }, colorScheme }));
