// Tests of the list of runs that `sinew view FOLDER` serves: search, pictures, one run, a comparison. The
// program is the file in SINEW.
import assert from 'node:assert/strict';
import { mkdirSync, mkdtempSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { new_context, picture, runs } from './pages.mjs';
import { serve, watch } from './served.mjs';

const folder = mkdtempSync(join(tmpdir(), 'sinew-runs-'));
after(() => rmSync(folder, { recursive: true, force: true }));

// Runs of other tests, and one that cannot be read.
for (const name of ['walk-test-1', 'walk-test-2', 'one-joint', 'feedback']) {
  mkdirSync(join(folder, name));
  for (const file of ['log.mcap', 'resolved.toml', 'summary.json'])
    symlinkSync(join(runs, name, file), join(folder, name, file));
}
mkdirSync(join(folder, 'broken'));
writeFileSync(join(folder, 'broken', 'log.mcap'), 'nothing of a log');
writeFileSync(join(folder, 'broken', 'resolved.toml'), 'title = "<b>Broken & bad</b>"\n[');

const shown = (page) => page.locator('#list li:visible').evaluateAll((all) => all.map((li) => li.querySelector('h2').textContent));

test('runs are listed with picture, date and title, found, and compared', async () => {
  const run = await serve(['view', folder, '--no-open'], folder);
  await watch(run, async (page) => {
    const titles = await shown(page);
    assert.equal(titles.length, 5);
    assert.ok(titles.includes('Walking, test 1') && titles.includes('<b>Broken & bad</b>'), titles.join());
    for (const li of await page.locator('#list li').all()) {
      await li.scrollIntoViewIfNeeded();
      await page.waitForFunction((i) => i.complete && i.naturalWidth > 0, await li.locator('img:visible').elementHandle());
      assert.match(await li.textContent(), /20\d\d-\d\d-\d\d \d\d:\d\d/);
    }
    // Either theme has its own picture, which is not fetched again.
    const requests = [];
    page.on('request', (r) => requests.push(r.url()));
    const shown_pictures = () => page.locator('#list img:visible').evaluateAll((all) => all.map((i) => i.src));
    const light = await shown_pictures();
    await page.locator('#theme').click();
    const dark = await shown_pictures();
    assert.equal(dark.length, light.length);
    assert.ok(dark.some((src, i) => src !== light[i]));
    await page.evaluate(() => dispatchEvent(new Event('beforeprint')));
    assert.deepEqual(await shown_pictures(), light, 'a print is light');
    await page.evaluate(() => dispatchEvent(new Event('afterprint')));
    assert.deepEqual(await shown_pictures(), dark);
    await page.locator('#theme').click();
    assert.deepEqual(requests.filter((url) => url.startsWith('http')), []);
    await page.evaluate(() => scrollTo(0, 0));
    await picture(page, 'runs');

    await page.locator('#search').fill('leg walk-test-2');
    assert.deepEqual(await shown(page), ['Walking, test 2']);
    assert.equal(await page.locator('#found').textContent(), '1 of 5');
    await page.locator('#search').fill('');

    // A single run cannot be compared.
    assert.ok(await page.locator('#compare').isDisabled());
    const tick = (title) => page.locator('#list li', { has: page.locator('h2', { hasText: title }) }).locator('input').check();
    await tick('Walking, test 1');
    assert.ok(await page.locator('#compare').isDisabled());
    await tick('Walking, test 2');
    await page.locator('#compare').click();
    await page.waitForSelector('html[data-ready] #runs .run');
    assert.equal(await page.locator('#runs .run').count(), 2);
    await page.goBack();
    await page.waitForSelector('html[data-ready] #list');
    await page.locator('#list a', { hasText: 'Walking, test 1' }).click();
    await page.waitForSelector('html[data-ready] #plots');
    assert.equal(await page.locator('h1').textContent(), 'Walking, test 1');
  });
  for (const [width, colorScheme] of [[390, 'light'], [1440, 'dark']])
    await watch(run, async (page) => {
      assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= width);
      await picture(page, `runs-${width}-${colorScheme}`);
      // A print has the pictures of runs that were never in the window, too.
      await page.waitForFunction(() => [...document.querySelectorAll('#list img')].every((i) => i.naturalWidth > 0));
      if (width === 390) return;
      const pdf = await page.pdf({ format: 'A4' });
      assert.ok(pdf.length > 5000);
    }, { viewport: { width, height: 844 }, colorScheme });
  const status = (path) => fetch(run.url + path).then((r) => r.status);
  assert.equal(await status('compare/0'), 404);
  assert.equal(await status('compare/0,99'), 404);
  assert.equal(await status('compare/0,1,'), 404);
  assert.equal(await status('compare/0,1,2,3,4,0,1,2,3'), 404);
  assert.equal(await status('picture/99'), 404);
  assert.equal(await status('run/0%20'), 404);

  // A run that is added later is in the list after it is loaded again.
  mkdirSync(join(folder, 'later'));
  for (const file of ['log.mcap', 'resolved.toml', 'summary.json']) symlinkSync(join(runs, 'walk-test-1', file), join(folder, 'later', file));
  await watch(run, async (page) => assert.equal((await shown(page)).length, 6), {}, 'runs');
  run.child.kill('SIGINT');
  assert.equal((await run.ended).code, 0);
});

test('the next server of a folder uses the same port, and so the stored layout', async () => {
  const start = (cwd) => serve(['view', join(folder, 'walk-test-1'), '--no-open'], cwd);
  const stop = async ({ child, ended }) => {
    child.kill('SIGINT');
    assert.equal((await ended).code, 0);
  };
  const port_of = ({ url }) => new URL(url).port;
  const context = await new_context();
  const own = async (run, does) => {
    const page = await context.newPage();
    await page.goto(run.url);
    await page.waitForSelector('html[data-ready]');
    await does(page);
    await page.close();
  };
  try {
    const first = await start(folder);
    await own(first, async (page) => {
      const panel = page.locator('.panel:visible').filter({ has: page.locator('h3', { hasText: 'Joint stiffness' }) }).first();
      await panel.locator('button[aria-haspopup]').click();
      await page.getByRole('menuitem', { name: 'Hide this plot' }).click();
      assert.ok(await page.locator('#reset-layout').isVisible());
    });
    // While the port is in use, a second server takes a free one.
    const second = await start(folder);
    assert.notEqual(port_of(second), port_of(first));
    await stop(second);
    await stop(first);

    const again = await start(folder), elsewhere = await start(join(folder, 'walk-test-1'));
    assert.equal(port_of(again), port_of(first));
    assert.notEqual(again.url, first.url, 'a token of its own');
    assert.notEqual(port_of(elsewhere), port_of(first));
    await own(again, async (page) => {
      assert.ok(await page.locator('#reset-layout').isVisible());
      assert.equal(await page.locator('.panel:visible h3', { hasText: 'Joint stiffness' }).count(), 0);
    });
    await stop(again);
    await stop(elsewhere);
  } finally {
    await context.close();
  }
});
