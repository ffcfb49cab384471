// The page of an identification: `static`, of a map that somebody else measured.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { picture, saved, vectors_of, with_page } from './pages.mjs';

const number_of = (text) => Number(text.replaceAll('−', '-'));

test('an identification shows its model, its values and its points', () => with_page('static', async (page) => {
  const report = await page.evaluate(() => window.sinew.run.parts[0].report);
  assert.equal(await page.locator('.chosen b').textContent(), report.chosen);
  const rows = await page.locator('.fit tr[data-name]').evaluateAll((all) => all.map((row) => ({
    name: row.dataset.name, exact: Number(row.dataset.value), shown: row.querySelector('.ours').textContent,
    unit: row.querySelector('.unit').textContent })));
  assert.deepEqual(rows.map((r) => r.name), report.parameters.map((p) => p.name));
  for (const [i, r] of rows.entries()) {
    const p = report.parameters[i], size = r.unit === 'kPa' ? 1e3 : 1;
    assert.equal(r.exact, p.value);
    assert.ok(Math.abs(number_of(r.shown) * size - p.value) <= 0.06 * (p.high - p.low), `${r.name}: ${r.shown} for ${p.value}`);
  }
  const refused = report.models.filter((m) => m.refused).length;
  assert.equal(await page.locator('tr.refused').count(), refused);
  const points = await page.evaluate(() => window.sinew.page.parts[0].charts.list[0].curves
    .filter((c) => c.style !== 'line').reduce((n, c) => n + c.y.filter(Number.isFinite).length, 0));
  assert.equal(points, report.fit.points + report.held_out.points);
  await picture(page, 'static');
}));

test('an identification in other units, in the dark, on a phone, on paper', () => with_page('static', async (page) => {
  const value = () => page.locator('.fit tr[data-name="threshold"] .ours').textContent();
  const pascals = number_of(await value()) * 1e3;
  await page.locator('#units-thesis').click();
  assert.ok(Math.abs(number_of(await value()) * 6894.757 - pascals) < 0.02 * pascals);
  assert.match(await page.locator('.chart .u-over').first().evaluate(() => window.sinew.page.units.of('N').label), /lbf/);
  const light = await page.locator('.chart canvas').first().evaluate((c) => c.toDataURL());
  await page.locator('#theme').click();
  assert.notEqual(await page.locator('.chart canvas').first().evaluate((c) => c.toDataURL()), light);
  assert.ok((await page.evaluate(() => document.documentElement.scrollWidth - innerWidth)) <= 0);
  await picture(page, 'static-phone');
  assert.ok((await page.pdf({ format: 'A4' })).length > 30000);
}, { viewport: { width: 390, height: 844 } }));

test('a curve is shown and hidden by its name', () => with_page('static', async (page) => {
  const chart = () => page.locator('.chart canvas').first().evaluate((c) => c.toDataURL());
  const before = await chart();
  const name = page.locator('.chart').first().locator('.line').last();
  await name.click();
  assert.equal(await name.getAttribute('aria-pressed'), 'false');
  await page.waitForTimeout(100);
  assert.notEqual(await chart(), before);
}));

test('charts are saved with their rings, dots and lines, also when they are enlarged', () => with_page('static', async (page) => {
  const { text } = await vectors_of(page, page.locator('.chart').first());
  const { points, held } = await page.evaluate(() => {
    const { fit, held_out } = window.sinew.run.parts[0].report;
    return { points: fit.points, held: held_out.points };
  });
  const drawn = text.split('clip-path=')[1];
  assert.equal([...drawn.matchAll(/<circle [^>]*fill="#fff"/g)].length, held, 'rings');
  assert.equal([...drawn.matchAll(/<circle /g)].length, points + held);
  for (const words of ['>held out<', '>pressure [kPa gauge]<', '>force [N]<']) assert.ok(text.includes(words), words);
  const left = page.locator('.chart').nth(1);
  await left.locator('.enlarge').click();
  const png = await saved(page, page.locator('dialog.enlarged .chart'), 'PNG');
  assert.equal(png.bytes.readUInt32BE(16), 2160);
  assert.match(png.name, /-model-less-measured\.png$/);
}));
