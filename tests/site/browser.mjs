// browser.mjs SITE [PICTURES]   tests the docs site in a browser: serves it on this computer, types
// into its search, follows the first hit, and checks every formula. No other server may be
// contacted. Pictures of some pages are written to PICTURES.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { open_browser } from '../../web/test/chromium.mjs';

const [site, pictures] = process.argv.slice(2);
let server, url, browser;

before(async () => {
  server = spawn('python3', ['-u', '-m', 'http.server', '--bind', '127.0.0.1', '--directory', site, '0'],
    { stdio: ['ignore', 'pipe', 'ignore'] });
  url = await new Promise((found, wrong) => {
    server.stdout.on('data', (text) => {
      const port = /port (\d+)/.exec(text);
      if (port) found(`http://127.0.0.1:${port[1]}/`);
    });
    server.on('close', () => wrong(new Error('python3 -m http.server ended')));
  });
  browser = await open_browser();
});

after(async () => {
  await browser?.close();
  server?.kill();
});

// Opens a page, lets `does` happen, and checks that there was no error and no outside request. A
// page prepares its search when it is opened, which takes seconds: only with `search`.
async function visit(path, does, { search = false, ...options } = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, ...options });
  context.setDefaultTimeout(60000);
  const page = await context.newPage(), wrong = [];
  const nothing = { config: { lang: ['en'], separator: ' ', pipeline: [] }, docs: [] };
  if (!search) await page.route('**/search_index.json', (route) => route.fulfill({ json: nothing }));
  page.on('console', (m) => ['error', 'warning'].includes(m.type()) && wrong.push(m.text()));
  page.on('pageerror', (e) => wrong.push(e.message));
  page.on('requestfailed', (r) => r.failure().errorText !== 'net::ERR_ABORTED' && wrong.push(`failed: ${r.url()}`));
  page.on('request', (r) => r.url().startsWith(url) || r.url().startsWith('data:') || wrong.push(`asked for ${r.url()}`));
  try {
    await page.goto(url + path);
    await does(page);
    assert.deepEqual(wrong, []);
  } finally {
    await context.close();
  }
}

// Types into the search box of an open page and returns the target of the first hit: the first section
// of the first page, or that page where its own text is meant. The first search of a page waits until
// its index is made, which takes seconds, and more of them on a busy computer.
async function first_hit(page, words) {
  const items = page.locator('.md-search-result__item');
  const type = async (text) => {
    await page.fill('.md-search__input', text);
    await page.press('.md-search__input', 'End');  // the page reads its box when a key goes up
  };
  await page.click('.md-search__input');
  await type('');
  await items.first().waitFor({ state: 'detached' });
  await type(words);
  await items.first().waitFor({ timeout: 120000 });
  const section = items.first().locator('> a').nth(1);
  const link = (await section.count()) ? section : items.first().locator('> a').first();
  return link.getAttribute('href');
}

// Follows a hit. Returns the path of the page, the heading at the hit, and the text of the page.
async function follow(page, hit) {
  await page.goto(new URL(hit, url).href);
  return page.evaluate(() => {
    const at = location.hash ? document.getElementById(decodeURIComponent(location.hash.slice(1))) : null;
    let words = at;  // an anchor of Doxygen is empty, and before its heading
    while (words && (!words.textContent.trim() || words.className === 'theory')) words = words.nextElementSibling;
    return { path: location.pathname.slice(1), at: words?.textContent ?? '', text: document.body.textContent };
  });
}

// The typed text, the page that the first hit must be on, and the heading at its place.
const searches = [
  ['effectiveness', /actuator|stiffness_8h/, /effectiveness/i],
  ['inlet', /./, /inlet/i],
  ['pressure', /./, /pressure/i],
  ['predict.dat', /./, /predict[._]dat/],
  ['AirNetwork::move_valves', /^reference\/cpp\/classsinew_1_1air_1_1AirNetwork\.html/, /move_valves/],
  ['stiffness_at_constant_pressure', /^reference\/cpp\/\w+_8h\.html/, /stiffness_at_constant_pressure/],
  ['sinew.Simulation.advance_to', /^reference\/python\/sinew\.html/, /advance_to/],
];
test('search finds', async (all) => {
  const hits = [];
  await visit('index.html', async (page) => {
    for (const [words] of searches) hits.push(await first_hit(page, words));
  }, { search: true });
  for (const [i, [words, where, what]] of searches.entries())
    await all.test(words, () =>
      visit('index.html', async (page) => {
        const { path, at, text } = await follow(page, hits[i]);
        assert.match(path, where);
        assert.match(at || text, what, `${path} has it where the hit leads`);
      }));
});

test('every formula is set', async () => {
  const has_some = (name) => name.endsWith('.html') && readFileSync(join(site, 'docs', name), 'utf8').includes('"arithmatex"');
  const folders = ['.', 'learn', 'how-to', 'theory', 'reference', 'evidence'];
  const names = folders.flatMap((folder) => readdirSync(join(site, 'docs', folder)).map((name) => join(folder, name)));
  const pages = names.filter(has_some);
  let count = 0;
  await visit(`docs/${pages[0]}`, async (page) => {
    for (const name of pages) {
      await page.goto(`${url}docs/${name}`);
      await page.waitForSelector('body[data-math]');
      const formulas = await page.locator('.arithmatex').count();
      const wrong = await page.locator('.katex-error').evaluateAll((all) => all.map((e) => `${e.title}: ${e.textContent}`));
      assert.deepEqual(wrong, [], `${name}: formulas that KaTeX does not know`);
      assert.equal(await page.locator('.arithmatex .katex').count() >= formulas, true);
      count += formulas;
    }
  });
  assert.ok(count > 500, `found ${count} formulas`);
  console.log(`# ${count} formulas`);
});

test('a theory page leads to the reference and back', () =>
  visit('docs/theory/actuator.html', async (page) => {
    await page.locator('article a:has(code:text-is("sliding_tension"))').first().click();
    assert.match(page.url(), /reference\/cpp\/\w+_8h\.html#/);
    await page.locator('.theory:has(+ h2:has-text("sliding_tension")) a:has-text("The braided actuator")').first().click();
    assert.match(page.url(), /docs\/theory\/actuator\.html/);
  }));

test('no page is wider than a telephone', async () => {
  for (const path of ['index.html', 'docs/theory/actuator.html', 'reference/cpp/files.html',
    'reference/cpp/classsinew_1_1air_1_1DrivenMuscle.html', 'reference/python/sinew.html'])
    await visit(path, async (page) => {
      const width = await page.evaluate(() => document.documentElement.scrollWidth);
      assert.ok(width <= 390, `${path}: ${width} px wide`);
    }, { viewport: { width: 390, height: 844 } });
});

if (pictures)
  test('pictures', async () => {
    const views = { light: {}, dark: { colorScheme: 'dark' }, narrow: { viewport: { width: 390, height: 844 } } };
    const pages = {
      front: 'index.html', theory: 'docs/theory/actuator.html#tension', cpp: 'reference/cpp/classsinew_1_1air_1_1DrivenMuscle.html',
      folders: 'reference/cpp/files.html', python: 'reference/python/sinew.html', source: 'source/python/sinew/identify.py.html#L42',
    };
    for (const [view, options] of Object.entries(views)) {
      for (const [name, path] of Object.entries(pages))
        await visit(path, async (page) => {
          await page.waitForTimeout(500);
          await page.screenshot({ path: join(pictures, `${name}-${view}.png`) });
        }, options);
      await visit('index.html', async (page) => {
        await page.click(view === 'narrow' ? 'label.md-header__button[for="__search"]' : '.md-search__input');
        await page.fill('.md-search__input', 'effectiveness');
        await page.locator('.md-search-result__item a').first().waitFor();
        await page.waitForTimeout(500);
        await page.screenshot({ path: join(pictures, `search-${view}.png`) });
      }, { ...options, search: true });
    }
  });
