// Tests of the page of an identification: `static`, from a published force map, and `static-left`, from
// recordings of which some samples are left out (recording.mjs).
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { picture, runs, saved, vectors_of, with_page } from './pages.mjs';

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
    .filter((c) => ['points', 'held out'].includes(c.style)).reduce((n, c) => n + c.y.filter(Number.isFinite).length, 0));
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
  const name = page.locator('.chart').first().locator('.line').first();
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

// --- bands, laws, left-out points, errors by part, further measurements ---

const charts_of = (page) => page.evaluate(() => window.sinew.page.parts[0].charts.list.map((chart) => ({
  curves: chart.curves.map((c) => ({ ...c, x: [...c.x], y: [...c.y], y_high: c.y_high && [...c.y_high] })) })));
const styled = (chart, style) => chart.curves.filter((c) => c.style === style);
const report_of = (page) => page.evaluate(() => window.sinew.run.parts[0].report);

for (const run of ['static', 'static-left'])
  test(`the law of ${run} has bands, one within the other, about its line`, () => with_page(run, async (page) => {
    const [fit, left] = await charts_of(page);
    for (const chart of [fit, left]) {
      const wide = styled(chart, 'band').filter((c) => c.label === '95 % band'), narrow = styled(chart, 'band').filter((c) => c.label === '68 % band');
      assert.ok(wide.length > 2 && wide.length === narrow.length);
      wide.forEach((w, k) => w.x.forEach((_, i) => {
        if (!Number.isFinite(w.y[i])) return;
        assert.ok(w.y[i] <= narrow[k].y[i] && narrow[k].y[i] < narrow[k].y_high[i] && narrow[k].y_high[i] <= w.y_high[i]);
      }));
    }
    const lines = styled(fit, 'line'), wide = styled(fit, 'band').filter((c) => c.label === '95 % band');
    assert.ok(lines.every((line) => line.bold));
    assert.equal(lines.length, wide.length);
    lines.forEach((line, k) => line.y.forEach((y, i) => assert.ok(Math.abs(wide[k].y[i] + wide[k].y_high[i] - 2 * y) < 1e-3 * Math.max(1, Math.abs(y)))));
    // They continue beyond the measured range and are wider there.
    const width = (k, i) => wide[k].y_high[i] - wide[k].y[i], n = wide[0].x.length;
    assert.ok(width(0, n - 1) >= width(0, n >> 1));
    assert.ok(wide[0].x[n - 1] > Math.max(...styled(fit, 'points')[0].x));
    for (const name of ['68 % band', '95 % band']) assert.equal(await page.locator('.chart').first().locator('.line', { hasText: name }).count(), 1);
  }));

test('a band is drawn, and hidden by a click on its name', () => with_page('static', async (page) => {
  const chart = page.locator('.chart').first(), drawing = () => chart.locator('canvas').first().evaluate((c) => c.toDataURL());
  const before = await drawing();
  await chart.locator('.line', { hasText: '95 % band' }).click();
  await page.waitForTimeout(100);
  assert.notEqual(await drawing(), before);
  const { text } = await vectors_of(page, chart);
  assert.equal([...text.matchAll(/<path d="[^"]*Z" fill="#[0-9a-f]+" fill-opacity/g)].length, 1);
}));

test('every law has a stroke of its own, whatever its color', () => with_page('static', async (page) => {
  const report = await report_of(page), [fit] = await charts_of(page);
  const laws = new Map(styled(fit, 'other line').map((c) => [c.label, c]));
  const tried = report.models.filter((m) => !m.refused && m.model !== report.chosen);
  assert.deepEqual([...laws.keys()], tried.map((m) => m.model));
  assert.equal(new Set([...laws.values()].map((c) => String(c.dash))).size, laws.size);
  assert.ok([...laws.values()].every((c) => c.dash.length && c.hidden));

  // A law is shown and hidden from the legend, which has the same strokes as the chart.
  const names = page.locator('.chart').first().locator('.others .line');
  assert.equal(await names.count(), laws.size);
  const strokes = await names.evaluateAll((all) => all.map((b) => b.querySelector('path').getAttribute('stroke-dasharray')));
  assert.equal(new Set(strokes).size, laws.size);
  const drawing = () => page.locator('.chart canvas').first().evaluate((c) => c.toDataURL());
  const before = await drawing();
  await names.first().click();
  await page.waitForTimeout(100);
  assert.equal(await names.first().getAttribute('aria-pressed'), 'true');
  assert.notEqual(await drawing(), before);
  await names.first().click();
  await page.waitForTimeout(100);
  assert.equal(await drawing(), before);
}));

test('left-out points have a mark by their reason, a row and an explanation', () => with_page('static-left', async (page) => {
  const report = JSON.parse(readFileSync(join(runs, 'static-left', 'report.json'), 'utf8'));
  const [fit] = await charts_of(page), marks = styled(fit, 'left out');
  const reasons = report.left_out.map((o) => o.reason);
  assert.ok(reasons.includes('pressure still moving') && reasons.at(-1) === 'outlier');
  assert.deepEqual(marks.map((c) => c.label), report.left_out.map((o) => `left out: ${o.reason}`));
  assert.equal(new Set(marks.map((c) => c.mark ?? 0)).size, marks.length);
  assert.deepEqual(marks.map((c) => c.x.length), report.left_out.map((o) => o.shown));
  const rows = await page.locator('tr[data-reason]').evaluateAll((all) => all.map((r) => ({ ...r.dataset })));
  assert.deepEqual(rows.map((r) => [r.reason, Number(r.count), Number(r.shown)]), report.left_out.map((o) => [o.reason, o.count, o.shown]));

  const wrong = report.left_out.at(-1);
  assert.equal(wrong.count, 2);
  assert.match(wrong.rows.map((r) => r.why).join(), /ten times what the law has: a slipped decimal/);
  assert.match(wrong.rows.map((r) => r.why).join(), /as at 200 mm, another mount of these data/);
  assert.equal(await page.locator('tr.explained').count(), 2);
  // All marks are within the axes, also that of ten times the force.
  const inside = await page.evaluate(() => {
    const chart = window.sinew.page.parts[0].charts.list[0], [low, high] = chart.view.y;
    return chart.curves.filter((c) => c.style === 'left out').every((c) => c.y.every((y) => y > low && y < high));
  });
  assert.ok(inside);
  await picture(page, 'static-left');
}));

for (const run of ['static', 'static-left'])
  test(`errors of ${run} by part are those of all points`, () => with_page(run, async (page) => {
    const report = await report_of(page), held = report.held_out ?? { points: 0, rmse: 0 };
    const all = report.fit.points + held.points;
    const squares = report.fit.points * report.fit.rmse ** 2 + held.points * held.rmse ** 2;
    assert.ok(report.errors.length >= 2);
    for (const { by, parts } of report.errors) {
      const rows = await page.locator(`tr[data-by="${by}"]`).evaluateAll((rs) => rs.map((r) => Number(r.dataset.points)));
      assert.deepEqual(rows, parts.map((p) => p.points), by);
      assert.equal(rows.reduce((a, b) => a + b), all, by);
      const sum = parts.reduce((s, p) => s + p.points * p.rmse ** 2, 0);
      assert.ok(Math.abs(sum - squares) < 1e-9 * squares, by);
    }
    if (run === 'static-left') assert.deepEqual(report.errors.map((e) => e.by), ['length', 'pressure', 'branch']);
  }));

test('a page shows which values are pinned by the data, and what the data do not show', () => with_page('static', async (page) => {
  const report = await report_of(page);
  assert.deepEqual(report.not_pinned, report.parameters.filter((p) => (p.profile ? !p.pinned : p.at_bound)).map((p) => p.name));
  for (const p of report.parameters.filter((each) => each.profile)) {
    const row = await page.locator(`.fit tr[data-name="${p.name}"]`).textContent();
    assert.equal(row.includes('not pinned'), !p.pinned, p.name);
    assert.ok(p.profile[4].error === null || row.includes(p.profile[4].error >= 10 ? '> 10' : p.profile[4].error.toPrecision(3)), p.name);
  }
  assert.equal(await page.locator('.not-pinned').count(), report.not_pinned.length ? 1 : 0);
  assert.deepEqual(await page.locator('.unseen li').allTextContents(), report.does_not_show);
}));

test('a page shows what further measurements would improve, in the chosen units', () => with_page('static', async (page) => {
  const report = await report_of(page), [next] = report.further;
  assert.ok(next.mounts[0].after.rms_percent < next.before.rms_percent);
  assert.equal(await page.locator('tr[data-length]').count(), next.mounts.length);
  const words = () => page.locator('tr[data-length]').first().textContent();
  assert.match(await words(), /0\.246 m/);
  await page.locator('#units-thesis').click();
  assert.match(await words(), /9\.685 in/);
}));

test('the title of a fit is a sentence of words', () => with_page('static', async (page) => {
  assert.equal(await page.locator('h1').textContent(), 'Static law of the muscle bpa, identified from DMSP-10-250_force_map.csv');
}));

// Returns the contrast with the background as defined by WCAG. The lightest color of the palette, meant for
// broad strokes, has 2.8.
const contrast_of = (page, of) => page.evaluate((of) => {
  const lit = (color) => {
    const sheet = document.createElement('canvas').getContext('2d');
    sheet.fillStyle = color;
    sheet.fillRect(0, 0, 1, 1);
    const [r, g, b] = [...sheet.getImageData(0, 0, 1, 1).data].map((v) => (v / 255 <= 0.04045 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const { charts } = window.sinew.page.parts[0], chart = charts.list[0], paper = lit(charts.theme.paper);
  return chart.curves.filter((c) => of.includes(c.style)).map((c) => {
    const own = lit(chart.color_of(c));
    return (Math.max(own, paper) + 0.05) / (Math.min(own, paper) + 0.05);
  });
}, of);

for (const colorScheme of ['light', 'dark'])
  test(`strokes and marks are visible on a ${colorScheme} background`, () => with_page('static-left', async (page) => {
    for (const ratio of await contrast_of(page, ['left out', 'other line', 'line'])) assert.ok(ratio >= 2.7, `${ratio}`);
    await picture(page, `static-left-${colorScheme}`);
  }, { colorScheme }));

test('a printed fit has its tables and omits hidden curves', () => with_page('static-left', async (page) => {
  await page.emulateMedia({ media: 'print' });
  assert.ok(await page.locator('tr[data-reason]').first().isVisible());
  assert.equal(await page.locator('.others').first().isVisible(), false);
  assert.ok((await page.evaluate(() => document.documentElement.scrollWidth - innerWidth)) <= 0);
  assert.ok((await page.pdf({ format: 'A4' })).length > 30000);
}, { viewport: { width: 720, height: 900 } }));
