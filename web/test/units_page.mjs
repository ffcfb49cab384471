// Tests of the switch of units: every set changes axes, drawing, legend and tables, and the choice is stored.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { drawing_of, new_context, picture, runs, seek, with_page } from './pages.mjs';

const first_unit = (page) => page.locator('.panel h3 .unit').first().textContent();
const figure = (page, key) => page.locator(`#numbers tr[data-key="${key}"]`).evaluate((row) =>
  `${row.querySelector('.number').textContent} ${row.querySelector('.unit').textContent}`);
const most_on_axis = (page) => page.evaluate(() => Math.max(...window.sinew.page.plots.panels[0].plot.data[1].filter(Number.isFinite)));

test('a run in three sets of units', () => with_page('walk-test-1', async (page) => {
  assert.deepEqual(await page.locator('#units button').allTextContents(), ['SI', 'in · lbf · psi', 'mm · N · bar']);
  await seek(page, 3);
  const meters = await page.evaluate(() => window.sinew.run.summary.trolley.distance_m);
  const radians = await most_on_axis(page);
  const drawings = new Set();
  for (const [set, unit, distance, angle, legend] of [
    ['si', 'rad', `${meters.toFixed(3)} m`, 1, / kPa abs/],
    ['thesis', 'deg', `${(meters / 0.0254).toFixed(2)} in`, 180 / Math.PI, / psi gauge/],
    ['metric', 'deg', `${(1e3 * meters).toFixed(0)} mm`, 180 / Math.PI, /\.\d bar gauge/]]) {
    await page.locator(`#units-${set}`).click();
    assert.equal(await page.locator('#units [aria-pressed=true]').getAttribute('id'), `units-${set}`);
    assert.equal(await first_unit(page), unit);
    assert.equal(await figure(page, 'trolley.distance_m'), distance);
    assert.ok(Math.abs((await most_on_axis(page)) - radians * angle) < 1e-9 * angle);
    assert.match(await page.locator('#legend').textContent(), legend);
    drawings.add(await drawing_of(page));
    await picture(page, `units-${set}`);
  }
  assert.equal(drawings.size, 3, 'lengths and forces in the drawing have units too');
}));

test('the browser remembers the units, for pages that begin in the same', () => with_page('walk-test-1', async (page) => {
  await page.locator('#units-metric').click();
  await page.reload();
  assert.equal(await first_unit(page), 'deg');
  assert.equal(await page.locator('#units [aria-pressed=true]').textContent(), 'mm · N · bar');
}));

test('a page that is made with choices begins in them', async () => {
  const file = join(mkdtempSync(join(tmpdir(), 'sinew-units-')), 'own.html');
  execFileSync(process.env.SINEW, ['report', join(runs, 'walk-test-1'), '-o', file, '--quiet', '--units', 'metric,pressure=kPa gauge,length=cm']);
  const context = await new_context();
  const page = await context.newPage();
  await page.goto(`file://${file}`);
  await page.waitForFunction(() => window.sinew?.page);
  const meters = await page.evaluate(() => window.sinew.run.summary.trolley.distance_m);
  assert.equal(await page.locator('#units [aria-pressed=true]').textContent(), 'own');
  assert.equal(await figure(page, 'trolley.distance_m'), `${(100 * meters).toFixed(1)} cm`);
  assert.match(await page.locator('#legend').textContent(), / kPa gauge/);
  assert.equal(await page.locator('#units-own').getAttribute('title'), 'cm, ms, deg, N, kPa gauge');
  await page.locator('#units-si').click();
  assert.match(await page.locator('#legend').textContent(), / kPa abs/);
  await context.close();
});

test('the test stand has a ruler in every set, also on a phone', () => with_page('weights-60', async (page) => {
  const drawings = new Set();
  for (const set of ['si', 'thesis', 'metric']) {
    await page.locator(`#units-${set}`).click();
    drawings.add(await drawing_of(page));
  }
  assert.equal(drawings.size, 2, 'SI and metric have the same ruler');
  assert.ok((await page.evaluate(() => document.documentElement.scrollWidth - innerWidth)) <= 0);
  await picture(page, 'units-phone');
}, { viewport: { width: 390, height: 844 } }));
