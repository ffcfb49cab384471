// Tests of the page that compares runs, with RUNS/compare/{two,same,six,stand,measured,long}.html:
// walk-test-1 and walk-test-2; a run and itself; three runs, twice each; weights-60 and weights-90; the
// lever of the bench and a recording with only the angle of another lever, aligned by correlation; and two
// runs of 10 min.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { drawing_of, picture, seek, summary_of, time_of, vectors_of, with_page } from './pages.mjs';

const opens_within = 5000, generous = 5;  // [ms] on an idle computer; factor for a busy one

const compared = (file, does, options) => with_page('compare', does, options, `${file}.html`);
const spec_of = (topic, difference = false) => `window.sinew.page.plots.panels.find((p) =>
  p.spec.lines[0].topic === '${topic}' && Boolean(p.spec.difference) === ${difference})`;

test('a comparison has a plot per channel and a line per run', () => compared('two', async (page) => {
  assert.equal(await page.locator('.run').count(), 2);
  const panels = await page.evaluate(() => window.sinew.page.plots.panels.filter((p) => !p.spec.difference)
    .map((p) => p.spec.lines.map((l) => [l.label, l.run, l.color, String(l.dash ?? '')])));
  assert.ok(panels.length > 60);
  for (const lines of panels) {
    assert.deepEqual(lines.map((l) => l[0]), ['A', 'B']);
    assert.notEqual(lines[0][2], lines[1][2], 'colors differ');
    assert.notEqual(lines[0][3], lines[1][3], 'dashes differ');
  }
  await picture(page, 'compare');
}));

test('the difference that is drawn is the one of the table, at its time', () => compared('two', async (page) => {
  const found = await page.evaluate(() => {
    const { data, page: { of_channel } } = window.sinew;
    return data.channels.filter((c) => c.differences[1].meet === 'together' && c.differences[1].samples).flatMap((c) => {
      const own = of_channel.get(`${c.topic} ${c.field}`), d = c.differences[1];
      if (!own?.differences[1]) return [];
      const { time, values } = own.differences[1];
      const numbers = values.filter((v) => v === v);
      const square = numbers.reduce((sum, v) => sum + v * v, 0);
      const there = time.findIndex((t) => Math.abs(t - d.at_s) < 6e-5);
      return [{ topic: c.topic, d, rms: Math.sqrt(square / numbers.length), there: values[there],
                largest: numbers.reduce((most, v) => Math.max(most, Math.abs(v)), 0) }];
    });
  });
  assert.ok(found.length > 50);
  for (const { topic, d, rms, there, largest } of found) {
    const exact = 1e-6 * Math.abs(d.largest);
    assert.ok(Math.abs(largest - Math.abs(d.largest)) <= exact, `${topic}: ${largest} for ${d.largest}`);
    assert.ok(Math.abs(there - d.largest) <= exact, `${topic}: ${there} at ${d.at_s} for ${d.largest}`);
    assert.ok(Math.abs(rms - d.rms) <= 1e-5 * d.rms, `${topic}: rms ${rms} for ${d.rms}`);
  }
}));

test('values and differences at the cursor are those of the samples', () => compared('two', async (page) => {
  await page.locator('#show-differences').click();
  const over = page.locator('.panel .u-over').first(), box = await over.boundingBox();
  for (const share of [0.2, 0.45]) {
    await page.mouse.move(box.x + share * box.width, box.y + 20);
    const { shown, apart, values, time } = await page.evaluate(() => {
      const { plots } = window.sinew.page;
      const [own, other] = [plots.panels[0], plots.panels[1]];
      const i = (c) => c.time.filter((t) => t <= plots.hovered).length - 1;
      return { shown: own.readouts.map((r) => r.value.textContent), apart: other.readouts[0].value.textContent,
               values: own.columns.map((c) => c.values[i(c)]), time: plots.hovered };
    });
    const [a, b, d] = [shown[0], ...shown[1].split(/ \(|\)/)].map((text) => Number(text.replace('−', '-').replace('=', '0')));
    assert.ok(Math.abs(a - values[0]) < 6e-4 && Math.abs(b - values[1]) < 6e-4, `${shown} at ${time}`);
    assert.ok(Math.abs(d - (values[1] - values[0])) < 6e-4, `${shown} at ${time}`);
    assert.ok(Math.abs(Number(apart.replace('−', '-')) - d) < 1e-6, `${apart} for ${d}`);
  }
  await page.mouse.move(box.x + 0.9 * box.width, box.y + 20);
  assert.equal(await page.locator('.panel .line .value').nth(1).textContent(), '–', 'that run is over');
}));

test('a run is hidden and shown everywhere', () => compared('two', async (page) => {
  const foot = () => page.locator('#foot .chart canvas').first().evaluate((c) => c.toDataURL());
  const shown = () => page.evaluate(() => window.sinew.page.plots.panels.filter((p) => p.plot && !p.spec.difference)
    .map((p) => p.plot.series.slice(1).map((s) => s.show)));
  const both = await foot();
  await page.keyboard.press('2');
  assert.ok((await shown()).every(([a, b]) => a && !b));
  assert.equal(await page.locator('.run').nth(1).getAttribute('aria-pressed'), 'false');
  assert.notEqual(await foot(), both);
  await page.locator('.run').nth(1).click();
  assert.ok((await shown()).every(([a, b]) => a && b));
  assert.equal(await foot(), both);
}));

test('zoom and cursor are one for plots, plan and foot', () => compared('two', async (page) => {
  const foot = () => page.locator('#foot .chart canvas').first().evaluate((c) => c.toDataURL());
  const plan = () => page.locator('#plan').evaluate((c) => c.toDataURL());
  const before = [await foot(), await plan()];
  const box = await page.locator('.panel .u-over').first().boundingBox();
  await page.mouse.move(box.x + 0.2 * box.width, box.y + 30);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.4 * box.width, box.y + 40, { steps: 4 });
  await page.mouse.up();
  const { view, scales } = await page.evaluate(() => {
    const { plots } = window.sinew.page;
    return { view: plots.view, scales: plots.panels.filter((p) => p.visible && p.plot)
      .map((p) => [p.plot.scales.x.min, p.plot.scales.x.max]) };
  });
  for (const scale of scales) assert.deepEqual(scale, view);
  assert.notEqual(await foot(), before[0]);
  assert.notEqual(await plan(), before[1]);
  await page.evaluate(([from, to]) => window.sinew.page.seek(0.3 * from + 0.7 * to), view);
  await page.keyboard.press('+');
  await page.waitForTimeout(100);
  for (const { is, should } of await page.evaluate(() => {
    const { plots } = window.sinew.page;
    return plots.panels.filter((p) => p.visible && p.plot).map((p) => ({
      is: p.head.getBoundingClientRect().left + 1 - p.plot.over.getBoundingClientRect().left,
      should: p.plot.valToPos(plots.time, 'x') }));
  })) assert.ok(Math.abs(is - should) < 1, `${is} for ${should}`);
  await page.mouse.move(2, 2);
  await page.keyboard.press('0');
  await page.keyboard.press('Home');
  const clock = await page.locator('#clock').textContent();
  await page.keyboard.press('ArrowRight');
  assert.notEqual(await page.locator('#clock').textContent(), clock);
}));

// --- machines drawn over each other ---

// Counts pixels of the drawing whose color is close to a color of the page.
const pixels_like = (page, name) => page.evaluate((variable) => {
  const canvas = document.getElementById('scene');
  const probe = document.createElement('canvas').getContext('2d', { willReadFrequently: true });
  probe.canvas.width = canvas.width, probe.canvas.height = canvas.height;
  probe.drawImage(canvas, 0, 0);
  const found = probe.getImageData(0, 0, canvas.width, canvas.height).data;
  probe.fillStyle = getComputedStyle(document.documentElement).getPropertyValue(variable);
  probe.fillRect(0, 0, 1, 1);
  const [r, g, b] = probe.getImageData(0, 0, 1, 1).data;
  // A ghost is translucent, so only its hue is compared, not its lightness.
  const hue = (x, y, z) => Math.atan2(Math.sqrt(3) * (y - z), 2 * x - y - z);
  const wanted = hue(r, g, b);
  let count = 0;
  for (let i = 0; i < found.length; i += 4) {
    const [x, y, z, alpha] = found.slice(i, i + 4);
    const apart = Math.abs(Math.atan2(Math.sin(hue(x, y, z) - wanted), Math.cos(hue(x, y, z) - wanted)));
    if (alpha > 60 && Math.max(x, y, z) - Math.min(x, y, z) > 40 && apart < 0.15) ++count;
  }
  return count;
}, name);

test('the other machine is drawn over the first one as a ghost in its color', () => compared('two', async (page) => {
  await seek(page, 3);
  const both = await drawing_of(page), ghost = await pixels_like(page, '--line-1');
  assert.ok(ghost > 500, `${ghost} pixels of the ghost`);
  await page.keyboard.press('2');
  assert.ok(await pixels_like(page, '--line-1') < 0.2 * ghost, 'hidden with its run');
  await page.keyboard.press('2');
  assert.equal(await drawing_of(page), both);
  await page.keyboard.press('1');
  assert.notEqual(await drawing_of(page), both, 'the first one is hidden too');
  await page.keyboard.press('1');
  await page.locator('#follow').click();
  assert.notEqual(await drawing_of(page), both, 'where they really were');
  assert.match(await page.locator('#machine-note').textContent(), /A in full; B over it as a ghost in its color/);
}));

test('a comparison plays as the page of a run does; plots and drawing show the same time', () => compared('two', async (page) => {
  await page.keyboard.press('Home');
  const from = await time_of(page), before = await drawing_of(page);
  await page.locator('#speed').selectOption('4');
  await page.locator('#play').click();
  await page.waitForFunction((t) => window.sinew.page.player.time > t + 0.5, from);
  assert.equal(await page.locator('#play').getAttribute('aria-label'), 'Pause');
  await page.keyboard.press(' ');
  assert.equal(await page.locator('#play').getAttribute('aria-label'), 'Play');
  assert.notEqual(await drawing_of(page), before);
  const [player, plots, slider, clock] = await page.evaluate(() => [window.sinew.page.player.time, window.sinew.page.plots.time,
    Number(document.getElementById('seek').value), parseFloat(document.getElementById('machine-clock').textContent)]);
  assert.equal(player, plots);
  assert.ok(Math.abs(player - slider) < 1e-6 && Math.abs(player - clock) < 0.006);
  await seek(page, 2.5);
  assert.ok(Math.abs((await page.evaluate(() => window.sinew.page.plots.time)) - 2.5) < 1e-9);
}));

test('a recording with only angles gives a ghost, and differences are shown under each plot', () => compared('measured', async (page) => {
  await seek(page, 3);
  assert.ok(await pixels_like(page, '--line-1') > 300, 'links and muscles of the angle');
  const { align, clock, runs } = await page.evaluate(() => window.sinew.data);
  assert.deepEqual([align, clock], ['correlation', 'fit']);
  const { alignment } = runs[1];
  assert.ok(Math.abs(alignment.rate) < 0.01 && Math.abs(alignment.shift_s) < 0.05 && alignment.correlation > 0.95);
  assert.match(await page.locator('#facts').textContent(), /B's clock shows [+−]0\.\d+ s ± 0\.\d+ s at A's 0 and runs .* % faster, r 0\.9\d+/);
  assert.equal(await page.locator('#show-differences').getAttribute('aria-pressed'), 'true');
  assert.ok(await page.locator('.panel.difference:visible').count() >= 1);
  const cells = await page.locator('#channels tr[data-key="/joint/lever/angle"] td').allTextContents();
  const [, rms, share, bias, most, , r] = cells;
  for (const [text, what] of [[rms, 'rms'], [share, 'share'], [bias, 'bias'], [most, 'largest'], [r, 'correlation']])
    assert.match(text, /\d/, `${what}: ${cells}`);
  await picture(page, 'compare-measured');
}));

test('test stands are drawn over each other', () => compared('stand', async (page) => {
  const end = await page.evaluate(() => window.sinew.page.whole[1]);
  await seek(page, 0.9 * end);
  const both = await drawing_of(page);
  await page.keyboard.press('2');
  assert.notEqual(await drawing_of(page), both);
}));

test('numbers are those of both summaries, in either unit', () => compared('two', async (page) => {
  const summaries = ['walk-test-1', 'walk-test-2'].map(summary_of);
  const at = (key, i) => key.split('.').reduce((node, part) => node?.[part], summaries[i]);
  const figures = await page.evaluate(() => window.sinew.data.figures);
  assert.ok(figures.length > 150);
  for (const f of figures) {
    assert.deepEqual(f.values, [at(f.key, 0) ?? null, at(f.key, 1) ?? null], f.key);
    if (f.values.includes(null)) continue;
    assert.equal(f.differences[1], f.values[1] - f.values[0], f.key);
  }
  const row = page.locator('#figures tr[data-key="trolley.distance_m"]');
  const cells = async () => (await row.locator('td').allTextContents()).slice(0, 5);
  const [a, b] = summaries.map((s) => s.trolley.distance_m);
  const near = (text, value) => Math.abs(parseFloat(text.replace('−', '-')) - value) < 6e-3 * Math.abs(value);
  for (const [button, size, unit] of [['#units-si', 1, 'm'], ['#units-thesis', 0.0254, 'in']]) {
    await page.locator(button).click();
    const [first, other, apart, relative, label] = await cells();
    assert.equal(label, unit);
    assert.ok(near(first, a / size) && near(other, b / size) && near(apart, (b - a) / size), `${first} ${other} ${apart}`);
    assert.ok(near(relative, (100 * (b - a)) / a) || Math.abs(parseFloat(relative.replace('−', '-')) - (100 * (b - a)) / a) < 0.5);
  }
  await page.locator('#figures input').fill('trolley distance');
  assert.ok((await page.locator('#figures tbody tr:visible').count()) < 6);
  assert.deepEqual(await page.locator('#parameters tbody th').allTextContents(),
    ['phase.swing.duration', 'phase.propulsion.duration']);
}));

for (const [file, options] of [['two', {}], ['measured', {}], ['two', { viewport: { width: 390, height: 844 } }]])
  test(`differences can be read from their axis: ${file}, ${options.viewport?.width ?? 1440} px`, () => compared(file, async (page) => {
    if (!(await page.evaluate(() => window.sinew.page.shows_differences))) await page.locator('#show-differences').click();
    for (const units of ['si', 'thesis', 'metric']) {
      const button = page.locator(`#units-${units}`);
      if (!(await button.count())) continue;
      await button.click();
      const axes = await page.evaluate(async () => {
        const panels = window.sinew.page.plots.panels.filter((p) => p.spec.difference && !p.root.hidden);
        for (const p of panels) p.visible = true, p.refresh();
        await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
        return panels.map((p) => {
          const { plot } = p, at = plot.axes[1]._splits, places = at.map((v) => plot.valToPos(v, 'y'));
          return { of: p.spec.lines[0].topic, at, close: Math.min(...places.slice(1).map((y, i) => Math.abs(y - places[i]))) };
        });
      });
      assert.ok(axes.length > (file === 'two' ? 5 : 0), `${axes.length} plots of differences`);
      for (const { of, at, close } of axes) {
        assert.ok(at.length >= 3, `${of}, ${units}: ${at}`);
        assert.ok(close >= 12.5, `${of}, ${units}: ${close} px between ${at}`);
      }
    }
    await page.evaluate(() => window.sinew.page.plots.panels.find((p) => p.spec.difference && !p.root.hidden).root.scrollIntoView({ block: 'center' }));
    await picture(page, `differences-${file}-${options.viewport?.width ?? 1440}`);
  }, options));

test('a channel of the table leads to its plot and time', () => compared('two', async (page) => {
  const row = page.locator('#channels tr[data-key="/true/joint/hip/angle"]');
  const at = await page.evaluate(() =>
    window.sinew.data.channels.find((c) => c.topic === '/true/joint/hip/angle').differences[1].at_s);
  await row.locator('button').click();
  await page.waitForFunction((plot) => eval(plot).visible && eval(plot).plot, spec_of('/true/joint/hip/angle value'));
  assert.ok(Math.abs((await page.evaluate(() => window.sinew.page.plots.time)) - at) < 1e-9);
}));

test('a run compared with itself is reported as equal', () => compared('same', async (page) => {
  const words = await page.locator('.chip').allTextContents();
  assert.match(words.join(' | '), /0 of \d+ numbers differ \| same parameters \| same samples in every channel/);
  assert.match(await page.locator('.panel .line .value').nth(1).textContent(), /\(=\)$/);
  assert.equal(await page.locator('#channels tbody tr:visible').count(), 0);
  await page.locator('#channels button', { hasText: 'Show equal ones' }).click();
  assert.ok((await page.locator('#channels tbody tr:visible').count()) > 90);
}));

test('the test stand has its charts, a curve per run', () => compared('stand', async (page) => {
  const charts = await page.evaluate(() => window.sinew.page.charts.list.map((c) => c.curves.map((k) =>
    [k.label, k.color, String(k.dash ?? ''), k.x.some(Number.isFinite), k.y.some(Number.isFinite)])));
  assert.ok(charts.length >= 1);
  for (const curves of charts) {
    assert.deepEqual([...new Set(curves.map((c) => c[0]))], ['A', 'B']);
    assert.ok(curves.every((c) => c[3] && c[4]));
    assert.notEqual(curves[0][1], curves.at(-1)[1]);
  }
  const { text } = await vectors_of(page, page.locator('.chart').first());
  for (const words of ['>A<', '>B<']) assert.ok(text.includes(words), words);
  await page.keyboard.press('2');
  const shown = await page.evaluate(() => window.sinew.page.charts.list.map((c) => [...c.shown]));
  for (const labels of shown) assert.deepEqual(labels, ['A']);
  assert.deepEqual(await page.locator('#parameters tbody th').allTextContents(), ['start.pressure']);
}));

test('dark, on paper and on a phone', async () => {
  await compared('two', async (page) => {
    await seek(page, 3);
    assert.ok(await pixels_like(page, '--line-1') > 500);
    await picture(page, 'compare-dark');
    assert.ok((await page.pdf({ format: 'A4', printBackground: true })).length > 100000);
  }, { colorScheme: 'dark' });
  await compared('two', async (page) => {
    const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    assert.ok(wide <= 0, `${wide} px too wide`);
  }, { viewport: { width: 390, height: 844 } });
});

// Chromium shrinks a whole print to the width of its widest element, until nothing can be read.
test('a print of six runs fits on paper, with each number of each run', async () => {
  for (const file of ['two', 'six']) for (const width of [702, 1031])  // A4 without margins, upright and across [px]
    await compared(file, async (page) => {
      await page.evaluate(() => dispatchEvent(new Event('beforeprint')));
      await page.emulateMedia({ media: 'print' });
      const { wide, numbers, lines } = await page.evaluate((width) => {
        const box = (e) => e.getBoundingClientRect(), shown = (e) => box(e).width > 0 && box(e).height > 0;
        const row = [...document.querySelectorAll('#channels tbody tr')].find((r) => !r.matches('.equal'));
        return {
          wide: [...document.querySelectorAll('body *')].filter((e) => shown(e) && (box(e).left < -1 || box(e).right > width + 1))
            .map((e) => `${e.tagName} ${e.className} of ${e.closest('[id]')?.id} to ${box(e).right}`),
          numbers: [...document.querySelectorAll('#figures tbody tr:not(.equal) td')].every((c) => !c.textContent || shown(c)),
          lines: new Set([...row.querySelectorAll('[data-pair]')].map((c) => Math.round(box(c).top))).size,
        };
      }, width);
      assert.deepEqual(wide, [], `${file}, ${width} px`);
      assert.ok(numbers);
      assert.equal(lines, file === 'two' ? 1 : 5, 'a line for each run compared with the first');
      await picture(page, `compare-${file}-print`);
    }, { viewport: { width, height: 1000 } });
});

test('two logs of ten minutes open at once', () => compared('long', async (page) => {
  assert.ok((await page.evaluate(() => Math.max(...window.sinew.data.samples.clocks))) >= 60000);
  const zoom = await page.evaluate(() => {
    const from = performance.now();
    for (let i = 0; i < 10; ++i) window.sinew.page.plots.zoom(10 * i, 10 * i + 300);
    return (performance.now() - from) / 10;
  });
  console.log(`# two of 10 min: open after ${page.took} ms, a zoom ${zoom.toFixed(1)} ms`);
  assert.ok(page.took < generous * opens_within, `${page.took} ms`);
}));
