// Tests of the pages of experiments/rig: feedback (two valves, a desired length), weights-60,
// sealed-cylinder, isometric and duty-sweep.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { drawing_of, picture, saved, seek, summary_of, vectors_of, with_page } from './pages.mjs';

for (const [name, at] of [['feedback', 7], ['weights-60', 20.2], ['sealed-cylinder', 12], ['isometric', 8.2]])
  test(`${name}: the stand is drawn and moves`, () => with_page(name, async (page) => {
    assert.equal(await page.locator('h1').textContent(), summary_of(name).title);
    await seek(page, 0);
    const start = await drawing_of(page);
    await seek(page, at);
    assert.notEqual(await drawing_of(page), start);
    assert.ok((await page.locator('#charts .chart').count()) > 0);
    await picture(page, name);
  }));

test('the drawing shows the length and the pressure of the log', () => with_page('weights-60', async (page) => {
  // Length, load and pressure are read from the text that is drawn.
  const drawn = await page.evaluate(() => {
    const words = [], { fillText } = CanvasRenderingContext2D.prototype;
    CanvasRenderingContext2D.prototype.fillText = function (text, ...rest) {
      words.push(text);
      return fillText.call(this, text, ...rest);
    };
    const { page } = window.sinew;
    page.seek(20.2);
    CanvasRenderingContext2D.prototype.fillText = fillText;
    const { stand } = window.sinew.run, { columns, index_at } = window.sinew;
    const at = (c) => columns[c].values[index_at(columns[c].time, 20.2)];
    return { words, length: at(stand.length), weight: at(stand.weight), pressure: at(stand.pressure) };
  });
  const number = (pattern) => {
    const found = drawn.words.map((w) => w.match(pattern)).find(Boolean);
    return Number(found[1].replace('−', '-'));
  };
  assert.ok(Math.abs(number(/^([\d.]+) mm /) - 1e3 * drawn.length) < 0.06, drawn.words.join('; '));
  assert.ok(Math.abs(number(/^load ([\d.]+) N/) - drawn.weight) < 0.06);
  const shown = await page.locator('.muscle .value').textContent();
  assert.ok(Math.abs(parseFloat(shown) - 1e-3 * drawn.pressure) < 0.6, shown);
}));

test('a chart finds the point under the cursor, in either unit, and zooms', () => with_page('isometric', async (page) => {
  const over = page.locator('#charts .u-over').first();
  await over.scrollIntoViewIfNeeded();
  const target = () => page.evaluate(() => {
    const chart = window.sinew.page.charts.list[0], c = chart.curves[0], i = c.x.length >> 1;
    return { left: chart.plot.valToPos(c.x[i], 'x'), top: chart.plot.valToPos(c.y[i], 'y'), x: c.x[i], y: c.y[i] };
  });
  for (const units of ['si', 'thesis']) {
    await page.locator(`#units-${units}`).click();
    const to = await target();
    await over.hover({ position: { x: to.left, y: to.top } });
    const words = await page.locator('#charts .value').first().textContent();
    const [y, x] = [...words.matchAll(/[\d.]+/g)].map(Number);
    assert.ok(Math.abs(y - to.y) < 0.02 * to.y && Math.abs(x - to.x) < 0.02 * to.x, words);
  }
  const before = await page.evaluate(() => window.sinew.page.charts.list[0].view.x);
  const box = await over.boundingBox();
  await page.mouse.move(box.x + 0.3 * box.width, box.y + 0.3 * box.height);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.5 * box.width, box.y + 0.6 * box.height, { steps: 4 });
  await page.mouse.up();
  const zoomed = await page.evaluate(() => window.sinew.page.charts.list[0].view.x);
  assert.ok(zoomed[1] - zoomed[0] < 0.25 * (before[1] - before[0]), `${zoomed}`);
  await over.dblclick();
  assert.deepEqual(await page.evaluate(() => window.sinew.page.charts.list[0].view.x), before);
}));

test('a sweep is charts over its duties, without a replay', () => with_page('duty-sweep', async (page) => {
  assert.equal(await page.locator('#play').isVisible(), false);
  const charts = await page.evaluate(() => window.sinew.run.charts.map((c) => [c.title, c.curves[0].x.length, c.curves[0].y]));
  assert.deepEqual(charts.map((c) => c[0]), ['Length', 'Ripple of the length', 'Pressure', 'Tension']);
  assert.ok(Math.abs(charts[0][2][39] - summary_of('duty-sweep').sweep['40'].length_m) < 1e-6);
}));

test('a chart becomes as large as the window, and comes back', () => with_page('weights-60', async (page) => {
  const chart = page.locator('.chart').first(), over = chart.locator('.u-over');
  const small = await over.boundingBox();
  await chart.locator('.enlarge').click();
  await page.waitForFunction(() => document.querySelector('dialog.enlarged[open] .u-over').clientHeight > 500);
  const large = await page.locator('dialog.enlarged .u-over').boundingBox();
  assert.ok(large.width > 1.5 * small.width && large.height > 2 * small.height, JSON.stringify(large));
  await picture(page, 'chart-enlarged');
  await page.keyboard.press('Escape');
  await page.waitForFunction(() => document.querySelector('.chart .u-over').clientHeight < 300);
  const again = await over.boundingBox();
  assert.ok(Math.abs(again.width - small.width) < 1 && Math.abs(again.height - small.height) < 1, JSON.stringify(again));
}));

for (const colorScheme of ['light', 'dark'])
  test(`a chart is saved as vectors and as pixels, as it is zoomed, on white: ${colorScheme}`, () => with_page('isometric', async (page) => {
    await page.locator('#units-thesis').click();
    const chart = page.locator('.chart').first();
    const spec = await page.evaluate(() => {
      const [c] = window.sinew.page.charts.list;
      return { title: c.spec.title, x: c.axis_name(c.spec.x), y: c.axis_name(c.spec.y), named: c.named().map((n) => n.label),
               points: c.curves.filter((k) => k.style !== 'line').reduce((n, k) => n + k.x.filter((x, i) => Number.isFinite(x) && Number.isFinite(k.y[i])).length, 0),
               lines: c.curves.filter((k) => k.style === 'line').length, middle: (c.whole.x[0] + c.whole.x[1]) / 2 };
    });
    const { name, text } = await vectors_of(page, chart);
    assert.match(name, /^isometric-/);
    for (const words of [spec.title, spec.x, spec.y, ...spec.named]) assert.ok(text.includes(`>${words}<`), `${words} in ${text.slice(0, 900)}`);
    assert.match(spec.y, /\[(lbf|psi gauge|in)\]/);
    const count = (all, pattern) => [...all.matchAll(pattern)].length;
    assert.equal(count(text.split('clip-path=')[1], /<circle /g), spec.points);
    assert.equal(count(text, /class="line"/g), spec.lines);
    assert.ok(text.includes('#0072b2') || spec.points + spec.lines > 8, 'a color for paper');
    const png = await saved(page, chart, 'PNG');
    assert.equal(png.bytes.subarray(1, 4).toString(), 'PNG');
    assert.equal(png.bytes.readUInt32BE(16), 2160);

    // The picture shows the current zoom, without hidden curves.
    await page.evaluate((middle) => {
      const [c] = window.sinew.page.charts.list;
      c.set_view({ ...c.view, x: [c.view.x[0], middle] });
    }, spec.middle);
    const zoomed = (await vectors_of(page, chart)).text;
    assert.notEqual(zoomed, text);
    const key = chart.locator('.line').first();
    if (!(await key.count())) return;
    await key.click();
    assert.ok(!(await vectors_of(page, chart)).text.includes(`>${spec.named[0]}<`));
  }, { colorScheme }));

test('the menu of a chart fits on a phone, in the dark, and Escape closes it', () => with_page('isometric', async (page) => {
  const more = page.locator('.chart').first().locator('button[aria-haspopup]');
  await more.scrollIntoViewIfNeeded();
  await more.click();
  assert.deepEqual(await page.getByRole('menuitem').allTextContents(), ['Save as SVG', 'Save as PNG']);
  const box = await page.locator('.menu').boundingBox();
  assert.ok(box.x >= 0 && box.x + box.width <= 390, JSON.stringify(box));
  assert.ok((await page.evaluate(() => document.documentElement.scrollWidth - innerWidth)) <= 0);
  await picture(page, 'chart-phone-menu');
  await page.keyboard.press('Escape');
  assert.equal(await page.locator('.menu').count(), 0);
}, { viewport: { width: 390, height: 844 }, colorScheme: 'dark' }));
