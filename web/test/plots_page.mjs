// Tests of the plots of a run: enlarging, combining channels, formulas, layouts that the browser stores,
// pictures of plots, marks of values that were set.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { picture, saved, seek, time_of, vectors_of, with_page } from './pages.mjs';

const panel = (page, title) => page.locator('.panel:visible').filter({ has: page.locator('h3', { hasText: title }) }).first();
const lines = (of) => of.locator('.line').evaluateAll((all) => all.map((b) => b.children[1].textContent));
const menu = async (page, of, item) => {
  await of.locator('button[aria-haspopup]').click();
  await page.getByRole('menuitem', { name: item, exact: true }).click();
};
const ready = (page) => page.waitForSelector('html[data-ready]');

test('a plot becomes as large as the window; Escape brings it back', () => with_page('walk-test-1', async (page) => {
  const angles = panel(page, 'Joint angles'), over = angles.locator('.u-over');
  const small = await over.boundingBox();
  await angles.locator('.enlarge').click();
  await page.waitForFunction(() => document.querySelector('dialog.enlarged[open] .u-over').clientHeight > 500);
  const large = await over.boundingBox();
  assert.ok(large.width > 1.8 * small.width && large.height > 5 * small.height, JSON.stringify(large));
  // It still plays and zooms.
  await page.mouse.move(large.x + 0.2 * large.width, large.y + 100);
  await page.mouse.down();
  await page.mouse.move(large.x + 0.4 * large.width, large.y + 150, { steps: 4 });
  await page.mouse.up();
  const view = await page.evaluate(() => window.sinew.page.plots.view);
  assert.ok(view[1] - view[0] < 4, String(view));
  await seek(page, view[0] + 1);
  await picture(page, 'enlarged');
  await page.keyboard.press('Escape');
  await page.waitForFunction(() => document.querySelector('.panel .u-over').clientHeight < 200);
  assert.deepEqual(await over.boundingBox(), small);
  assert.equal(await page.locator('dialog[open]').count(), 0);
  assert.equal(await page.locator('.panel').first().locator('h3').textContent().then((t) => t.startsWith('Joint angles')), true);
}));

test('channels are combined by dragging; a third unit is refused; the browser stores the layout', () => with_page('walk-test-1', async (page) => {
  const angles = panel(page, 'Joint angles');
  const before = await lines(angles);
  await panel(page, 'Joint torque').locator('.line').first().dragTo(angles.locator('.u-over'));
  assert.deepEqual(await lines(angles), [...before, 'Joint torque · hip']);
  assert.match(await angles.locator('.unit').textContent(), /^rad left, N m right$/);
  const axes = await page.evaluate(() => {
    const { plot, columns } = window.sinew.page.plots.panels[0];
    return { y2: [plot.scales.y2.min, plot.scales.y2.max], values: [Math.min(...columns.at(-1).values), Math.max(...columns.at(-1).values)] };
  });
  assert.ok(axes.y2[0] < axes.values[0] && axes.y2[1] > axes.values[1], JSON.stringify(axes));
  await picture(page, 'two-units');

  // A third unit; a whole plot onto another one; a channel between the plots.
  await panel(page, 'Joint stiffness').locator('h3').dragTo(angles.locator('.u-over'));
  assert.match(await page.locator('.toast').textContent(), /can have two units; these would be rad, N m, N m\/rad/);
  assert.equal((await lines(angles)).length, before.length + 1);
  await panel(page, 'Angle error').locator('h3').dragTo(panel(page, 'Joint torque').locator('.u-over'));
  assert.deepEqual((await lines(panel(page, 'Joint torque'))).slice(-2), ['Angle error · hip', 'Angle error · knee']);

  // The same from the list, by keyboard.
  await page.locator('#show-channels').click();
  await page.locator('#channels input').fill('tension knee flexor true');
  assert.equal(await page.locator('.channel-rows li').count(), 1);
  await page.locator('.channel-rows button').focus();
  await page.keyboard.press('Enter');
  await page.keyboard.press('Enter');  // a new plot
  const own = page.locator('.panel[data-group="Own"]');
  assert.deepEqual(await lines(own), ['knee flexor true']);
  assert.match(await own.locator('h3').textContent(), /^TensionN/);
  await menu(page, own, 'Move down');
  await menu(page, panel(page, 'Joint stiffness'), 'Hide this plot');

  await page.reload();
  await ready(page);
  assert.equal(await page.locator('.panel[data-group="Own"]').count(), 1);
  assert.deepEqual(await lines(panel(page, 'Joint angles')), [...before, 'Joint torque · hip']);
  assert.equal(await panel(page, 'Joint stiffness').count(), 0);
  assert.equal(await page.locator('.panel:visible').nth(1).getAttribute('data-group'), 'Own');
  await page.locator('#reset-layout').click();
  assert.deepEqual(await lines(panel(page, 'Joint angles')), before);
  assert.equal(await page.locator('.panel[data-group="Own"]').count(), 0);
  assert.equal(await panel(page, 'Joint stiffness').count(), 1);
  assert.equal(await page.locator('#reset-layout').isVisible(), false);
}));

test('a formula is drawn in its unit, and its errors are shown', () => with_page('walk-test-1', async (page) => {
  const error = panel(page, 'Angle error');
  await menu(page, error, 'Add a formula…');
  const field = page.getByRole('textbox', { name: 'Formula' });
  await field.fill('/joint/hip/angel - /desired/joint/hip/angle');
  assert.match(await page.locator('.wrong').textContent(), /column 1: found "\/joint\/hip\/angel".*did you mean \/joint\/hip\/angle/);
  await page.keyboard.press('Enter');
  assert.equal(await page.locator('dialog[open]').count(), 1);
  await picture(page, 'formula');
  await field.fill('/desired/joint/hip/angle - /joint/hip/angle');
  assert.match(await page.locator('.sheet').textContent(), /Its unit is rad\./);
  await page.getByRole('textbox', { name: 'Name of the line' }).fill('by hand');
  await page.keyboard.press('Enter');
  assert.equal((await lines(error)).at(-1), 'by hand');
  // The log has the same values under another name, with the opposite sign.
  const apart = await page.evaluate(() => {
    const p = window.sinew.page.plots.panels.find((o) => o.spec.title === 'Angle error');
    const mine = p.columns.at(-1).values, logged = p.columns[0].values;
    return Math.max(...mine.map((v, i) => Math.min(Math.abs(v - logged[i]), Math.abs(v + logged[i]))));
  });
  assert.ok(apart < 1e-5, `${apart} rad apart`);
  // Letters typed into a dialog are not shortcuts.
  const at = await time_of(page);
  await menu(page, error, 'Add a formula…');
  await page.keyboard.type('f + 0 [ ]');
  assert.equal(await time_of(page), at);
  await page.keyboard.press('Escape');
}));

test('a plot is saved as vectors and as pixels, on white, with axes, units and legend', () => with_page('walk-test-1', async (page) => {
  const angles = panel(page, 'Joint angles');
  const { name, text } = await vectors_of(page, angles);
  assert.equal(name, 'walk-test-1-joint-angles.svg');
  for (const words of ['>Joint angles<', '>hip<', '>knee desired<', '>rad<', '>time [s]<', '#0072b2'])
    assert.ok(text.includes(words), words);
  const paths = [...text.matchAll(/class="line" d="([^"]*)"/g)].map((m) => m[1].split(/(?=[ML])/).length);
  assert.equal(paths.length, 4);
  assert.ok(paths.every((n) => n > 300), String(paths));
  const png = await saved(page, angles, 'PNG');
  assert.equal(png.bytes.subarray(1, 4).toString(), 'PNG');
  assert.equal(png.bytes.readUInt32BE(16), 2160);
}, { colorScheme: 'dark' }));

test('a browser without storage shows the page as usual', () => with_page('walk-test-1', async (page) => {
  await page.addInitScript(() => {
    Object.defineProperty(window, 'localStorage', { get() { throw new DOMException('refused', 'SecurityError'); } });
  });
  await page.reload();
  await ready(page);
  await panel(page, 'Joint torque').locator('.line').first().dragTo(panel(page, 'Joint angles').locator('.u-over'));
  assert.equal((await lines(panel(page, 'Joint angles'))).at(-1), 'Joint torque · hip');
}));

test('a plot without finite values is not shown, nor its group', () => with_page('one-joint', async (page) => {
  const titles = await page.evaluate(() => window.sinew.run.panels.map((p) => p.title));
  assert.ok(titles.length > 8 && !titles.includes('Foot position'), titles.join());
  assert.equal(await page.locator('#groups button', { hasText: 'Foot' }).count(), 0);
}));

test('values set during the run are marked and named in every plot', () => with_page('changed', async (page) => {
  const told = await page.locator('#changes button').allTextContents();
  assert.match(told[0], /^hip angle gain: .*\/count, 3\.00–3\.20 s$/);
  assert.deepEqual(told.slice(1), ['knee desired stiffness: 2.000 N m/rad, 5.00 s', "hip angle gain: back to the plan's value, 7.00 s"]);
  const shown = await page.evaluate(() => window.sinew.page.plots.panels.filter((p) => p.visible && p.plot && !p.root.hidden)
    .map((p) => p.plot.over.querySelectorAll('.mark-handle').length));
  assert.ok(shown.length > 3 && shown.every((n) => n === 3), String(shown));
  const handle = page.locator('.mark-handle').nth(1);
  assert.equal(await handle.locator('span').isVisible(), false);
  await handle.hover();
  assert.match(await handle.locator('span').textContent(), /knee desired stiffness: 2\.000 N m\/rad at 5\.00 s/);
  assert.ok(await handle.locator('span').isVisible());
  await picture(page, 'changed');
  await page.locator('#changes button').nth(1).click();
  assert.ok(Math.abs((await time_of(page)) - 5) < 1e-6);
  assert.match(await page.locator('#parameters').textContent(), /change\[0\]\.value/);
}));

for (const [name, options] of [['plots-phone', { viewport: { width: 390, height: 844 } }], ['plots-dark', { colorScheme: 'dark' }]])
  test(`the list of channels, a menu and a dialog fit: ${name}`, () => with_page('walk-test-1', async (page) => {
    const fits = async () => {
      const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
      assert.ok(wide <= 0, `${wide} px too wide`);
    };
    await page.locator('#show-channels').click();
    await fits();
    await page.locator('#show-channels').scrollIntoViewIfNeeded();
    await picture(page, name);
    await page.locator('.new-formula').click();
    await fits();
    await page.keyboard.press('Escape');
    await panel(page, 'Joint angles').locator('button[aria-haspopup]').click();
    await fits();
    await picture(page, `${name}-menu`);
  }, options));
