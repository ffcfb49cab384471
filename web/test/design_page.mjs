// Tests of the page of a design: `design`, a joint by faces.sh.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { picture, with_page } from './pages.mjs';

test('a design shows its values with their units, its plots and all candidates', () => with_page('design', async (page) => {
  const run = await page.evaluate(() => window.sinew.run);
  assert.equal(run.format, 'sinew.design_page/1');
  const rows = await page.locator('#result tr[data-key]').evaluateAll((all) => all.map((row) => ({
    key: row.dataset.key, exact: row.dataset.value, shown: row.querySelector('.ours').textContent, unit: row.querySelector('.unit').textContent })));
  assert.deepEqual(rows.map((r) => r.key), run.values.map((v) => v.key));
  const arm = rows.find((r) => r.key === 'moment_arm_m');
  assert.equal(Number(arm.shown) * { m: 1, mm: 1e-3, in: 0.0254 }[arm.unit], Number(arm.exact));
  assert.equal(await page.locator('.chart').count(), run.charts.length);
  assert.equal(await page.locator('#tables tbody tr').count(), run.tables.reduce((n, t) => n + t.rows.length, 0));
  await picture(page, 'design');
}));

test('a design in other units, in the dark, on a phone, on paper', () => with_page('design', async (page) => {
  const shown = () => page.locator('tr[data-key="moment_arm_m"] .ours').textContent();
  await page.locator('#units-thesis').click();
  assert.equal(await shown(), '1');
  await page.locator('#theme').click();
  assert.ok((await page.evaluate(() => document.documentElement.scrollWidth - innerWidth)) <= 0);
  await picture(page, 'design-phone');
  assert.ok((await page.pdf({ format: 'A4' })).length > 20000);
}, { viewport: { width: 390, height: 844 } }));
