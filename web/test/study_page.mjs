// Tests of the page of a study, with RUNS/study/{walk,pair}.html of the sweeps RUNS/study/{walk,other}.db and
// tuned.html of tuning.toml; of the page served while a study is in progress; and of a row that is run from
// the page. The program is the file in SINEW.
import assert from 'node:assert/strict';
import { execFileSync, spawn } from 'node:child_process';
import { mkdtempSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { picture, runs, saved, vectors_of, with_page } from './pages.mjs';
import { program, serve, watch } from './served.mjs';

const draws_within = 1500, generous = 5;  // 10,000 rows on an idle computer [ms]; factor for a busy one

const study = (file, does, options) => with_page('study', does, options, `${file}.html`);
const experiment = fileURLToPath(new URL('../../experiments/leg-in-air.toml', import.meta.url));
const folder = mkdtempSync(join(tmpdir(), 'sinew-study-'));
after(() => rmSync(folder, { recursive: true, force: true }));

// Returns the rows of a table of the program as objects.
function table(name) {
  const [head, ...lines] = readFileSync(join(runs, 'study', `${name}.csv`), 'utf8').trim().split('\n');
  const cells = (line) => [...line.matchAll(/("(?:[^"]|"")*"|[^,]*)(?:,|$)/g)].map((m) => m[1].replace(/^"|"$/g, ''));
  const headings = head.split(',');
  return lines.map((line) => Object.fromEntries(cells(line).slice(0, headings.length).map((c, i) => [headings[i], c])));
}
const gain = 'joint.hip.angle_gain [%/count]', speed = 'trolley.mean_speed [in/s]', error = 'joints.hip.tracking_rms [deg]';
const numbers = (page) => page.evaluate(() => window.sinew.page.filter.rows.map((r) => window.sinew.page.data.number[r]).sort((a, b) => a - b));
const drawn = (page, id) => page.locator(`#${id}-canvas`).evaluate((c) => c.toDataURL());
const settle = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
// Returns the speed in the result of a command of the page [in/s].
function speed_of(command, name) {
  const printed = execFileSync('sh', ['-c', `${command.replace(/^sinew/, program)} --json --quiet --no-report -o ${join(folder, name)}`], { encoding: 'utf8' });
  return JSON.parse(printed).trolley.mean_speed_m_per_s / 0.0254;
}
const axis = (page, heading) => page.locator('.axis-handle').and(page.locator(`[data-heading="${heading}"]`));

test('a study has every row of the table, and the role of each column', () => study('walk', async (page) => {
  const rows = table('walk');
  assert.equal(await page.locator('#count').textContent(), `${rows.length} rows`);
  const held = await page.evaluate(() => {
    const { data } = window.sinew.page;
    return { roles: Object.fromEntries(data.columns.map((c) => [c.heading, c.role])),
             cells: data.number.map((_, r) => data.columns.map((c) => c.texts[r])) };
  });
  assert.equal(held.roles[gain], 'parameter');
  assert.equal(held.roles['low_level.duty_rounding'], 'parameter');
  assert.equal(held.roles[speed], 'figure');
  assert.equal(held.roles.status, 'other');
  assert.deepEqual(held.cells, rows.map((r) => Object.values(r)));
  assert.match(await page.locator('#facts').textContent(), new RegExp(`${rows.length} of ${rows.length} points`));
  await picture(page, 'study');
}));

for (const colorScheme of ['light', 'dark'])
  test(`every view is saved on white and not changed on the page: ${colorScheme}`, () => study('walk', async (page) => {
    await settle(page);
    // Rows that a view shows: those with a value in both of its columns.
    const rows_in = (view) => page.evaluate((id) => {
      const { views, filter } = window.sinew.page;
      return (views.find((v) => v.root.id === id)?.chart.rows ?? filter.rows).length;
    }, view);
    for (const view of ['history', 'scatter', 'surface', 'parallel']) {
      const root = page.locator(`#${view}`), before = await drawn(page, view), rows = await rows_in(view);
      const { name, text } = await vectors_of(page, root);
      assert.equal(await drawn(page, view), before, view);
      assert.ok(rows > 90, `${view}: ${rows} rows`);
      const title = await root.locator('h2').textContent();
      assert.ok(text.includes(`<title>${title}</title>`) && name.includes(title.toLowerCase().replaceAll(' ', '-')), `${name}: ${title}`);
      const words = [...text.matchAll(/<text [^>]*>([^<]+)</g)].map((m) => m[1]);
      assert.ok(words.length > 6 && words.some((w) => /\d/.test(w)), words.join('; '));
      const lines = [...text.matchAll(/ d="([^"]+)"/g)].map((m) => m[1].split('M').length - 1).reduce((sum, n) => sum + n, 0) + text.split('<circle ').length - 1;
      const marks = view === 'surface' ? [...text.matchAll(/<rect [^>]*width="2" height="2"/g)].length : lines;
      assert.ok(marks >= rows, `${view}: ${marks} marks of ${rows} rows`);
    }
    const png = await saved(page, page.locator('#scatter'), 'PNG');
    const wide = await page.locator('#scatter-canvas').evaluate((c) => c.clientWidth);
    assert.ok(Math.abs(png.bytes.readUInt32BE(16) - 3 * wide) <= 3);
  }, { colorScheme }));

test('a range drawn on an axis filters every view, and a click removes it', () => study('walk', async (page) => {
  const rows = table('walk'), views = ['history', 'scatter', 'surface', 'parallel'];
  await settle(page);
  const before = await Promise.all(views.map((v) => drawn(page, v)));
  const handle = axis(page, gain), box = await handle.boundingBox();
  const x = box.x + box.width / 2;
  await page.mouse.move(x, box.y + 0.1 * box.height);
  await page.mouse.down();
  await page.mouse.move(x, box.y + 0.5 * box.height, { steps: 5 });
  await page.mouse.up();
  await settle(page);
  const range = await page.evaluate((h) => window.sinew.page.filter.ranges.get(window.sinew.page.data.by_heading.get(h)), gain);
  assert.ok(range[0] < range[1]);
  const wanted = rows.map((r, i) => [Number(r[gain]), i]).filter(([v]) => v >= range[0] && v <= range[1]).map(([, i]) => i);
  assert.ok(wanted.length > 5 && wanted.length < rows.length - 5, `${wanted.length} rows`);
  assert.deepEqual(await numbers(page), wanted);
  assert.equal(await page.locator('#count').textContent(), `${wanted.length} of ${rows.length} rows`);
  const later = await Promise.all(views.map((v) => drawn(page, v)));
  views.forEach((v, i) => assert.notEqual(later[i], before[i], v));
  assert.match(await page.locator('.turns span').textContent(), new RegExp(`of ${wanted.length}$`));
  await page.mouse.click(x, box.y + 0.3 * box.height);
  assert.equal((await numbers(page)).length, rows.length);
}));

test('the filter by keyboard, by words, by whole rows', () => study('walk', async (page) => {
  const rows = table('walk');
  await axis(page, gain).focus();
  for (let i = 0; i < 4; ++i) await page.keyboard.press('ArrowUp');
  const some = (await numbers(page)).length;
  assert.ok(some > 0 && some < rows.length);
  await page.keyboard.press('Shift+ArrowDown');
  assert.ok((await numbers(page)).length <= some);
  await page.keyboard.press('Delete');
  assert.equal((await numbers(page)).length, rows.length);
  await page.locator('#words').fill('truncate');
  assert.deepEqual(await numbers(page), rows.flatMap((r, i) => (Object.values(r).join(' ').includes('truncate') ? [i] : [])));
  await page.locator('#clear').click();
  await page.locator('#feasible').click();
  const whole = rows.flatMap((r, i) => (r[speed] ? [i] : []));
  assert.ok(whole.length < rows.length, 'one was refused');
  assert.deepEqual(await numbers(page), whole);
}));

test('the front has the rows that no other row dominates, in each of the four directions', () => study('walk', async (page) => {
  const rows = table('walk').map((r, i) => ({ i, x: Number(r[speed]), y: Number(r[error]), there: r[speed] !== '' && r[error] !== '' })).filter((r) => r.there);
  await page.locator('#scatter').getByLabel('x', { exact: true }).selectOption(speed);
  await page.locator('#scatter').getByLabel('y', { exact: true }).selectOption(error);
  for (let turn = 0; turn < 4; ++turn) {
    await page.locator('#scatter .direction').nth(turn % 2).click();
    await settle(page);
    const { front, less } = await page.evaluate(() => {
      const { data, views: [, scatter] } = window.sinew.page;
      return { front: scatter.front.map((r) => data.number[r]).sort((a, b) => a - b), less: [scatter.x.less, scatter.y.less] };
    });
    const good = (r) => [less[0] ? -r.x : r.x, less[1] ? -r.y : r.y];
    const beats = (a, b) => good(a).every((v, k) => v >= good(b)[k]) && good(a).some((v, k) => v > good(b)[k]);
    const wanted = rows.filter((r) => !rows.some((o) => beats(o, r))).map((r) => r.i);
    assert.deepEqual(front, wanted, `less is better: ${less}`);
    assert.match(await page.locator('#scatter .hint').textContent(), new RegExp(`^${wanted.length} ringed`));
  }
}));

test('a click chooses a row everywhere, and its command repeats it', () => study('walk', async (page) => {
  await settle(page);
  const mark = await page.evaluate(() => {
    const { chart } = window.sinew.page.views[1], box = chart.canvas.getBoundingClientRect();
    chart.canvas.scrollIntoView({ block: 'center' });
    const i = chart.rows.length >> 1, now = chart.canvas.getBoundingClientRect();
    return { row: chart.rows[i], x: now.left + chart.px[i], y: now.top + chart.py[i], was: box.top };
  });
  await page.mouse.click(mark.x, mark.y);
  const chosen = await page.evaluate(() => window.sinew.page.data.number[window.sinew.page.chosen]);
  assert.ok(chosen >= 0);
  const row = table('walk')[chosen];
  assert.equal(await page.locator('#chosen h2').textContent(), `Row ${chosen}`);
  assert.equal(await page.locator('#rows tr[aria-selected="true"]').getAttribute('data-row'), String(chosen));
  const command = await page.locator('.command').textContent();
  assert.ok(command.startsWith('sinew run ') && command.includes(`--set "joint.hip.angle_gain=${row[gain]} %/count"`), command);
  assert.ok(Math.abs(speed_of(command, 'again') - Number(row[speed])) <= 1e-8 * Math.abs(row[speed]));
  await page.locator('#chosen').getByLabel('Next row').click();
  assert.equal(await page.locator('#chosen h2').textContent(), `Row ${chosen + 1}`);
  await page.keyboard.press('ArrowLeft');
  assert.equal(await page.locator('#chosen h2').textContent(), `Row ${chosen}`);
  await page.keyboard.press('Escape');
  assert.equal(await page.locator('#chosen h2').textContent(), 'No row is chosen');
  assert.equal(await page.locator('#run-it').count(), 0, 'a file cannot run anything');
}));

test('the table is in the order of a column, those without a value last', () => study('walk', async (page) => {
  await page.locator('#rows thead button', { hasText: 'mean_speed' }).click();
  await page.locator('#rows thead button', { hasText: 'mean_speed' }).click();
  const order = await page.evaluate(() => window.sinew.page.table.sorted.map((r) => window.sinew.page.data.number[r]));
  const values = order.map((i) => table('walk')[i][speed]);
  const there = values.filter((v) => v !== '').map(Number);
  assert.deepEqual(there, [...there].sort((a, b) => b - a));
  assert.ok(values.slice(there.length).every((v) => v === ''));
  await page.locator('#rows tbody tr').first().click();
  assert.equal(await page.locator('#chosen h2').textContent(), `Row ${order[0]}`);
}));

test('two studies: a column of both is one, each is hidden and shown', () => study('pair', async (page) => {
  const [a, b] = [table('walk'), table('other')];
  assert.equal(await page.locator('#count').textContent(), `${a.length + b.length} rows`);
  const both = await page.evaluate((h) => window.sinew.page.data.columns.filter((c) => c.heading === h).length, gain);
  assert.equal(both, 1);
  await page.keyboard.press('1');
  assert.equal((await numbers(page)).length, b.length);
  assert.equal(await page.locator('.run').first().getAttribute('aria-pressed'), 'false');
  await page.locator('.run').first().click();
  assert.equal((await numbers(page)).length, a.length + b.length);
  await page.evaluate((row) => window.sinew.page.choose(row), a.length + 1);
  assert.equal(await page.locator('#chosen h2').textContent(), 'Row B1');
  await picture(page, 'study-pair');
}));

test('a tuning has its candidates by generation, its objectives, and infeasible candidates marked', () => study('tuned', async (page) => {
  const held = await page.evaluate(() => {
    const { data, views: [history, scatter] } = window.sinew.page;
    return { kinds: data.studies[0].kind, count: data.count, generations: [...new Set(data.generation)].sort((a, b) => a - b),
             feasible: data.feasible, violation: data.violation, by: history.by,
             goals: [scatter.x, scatter.y].map((c) => [c.heading, c.role, c.less]),
             front: scatter.front, passiveness: data.by_heading.get('passiveness worst [%]').values };
  });
  assert.equal(held.kinds, 'tune');
  assert.equal(held.count, 64);
  assert.deepEqual(held.generations, [0, 1, 2, 3]);
  assert.equal(held.by, 'generation');
  assert.deepEqual(held.goals, [[speed, 'objective', false], ['passiveness [%]', 'objective', false]]);
  held.feasible.forEach((is, i) => assert.equal(is, held.violation[i] === 0 && held.passiveness[i] >= 80, `candidate ${i}`));
  assert.ok(held.feasible.includes(true) && held.feasible.includes(false));
  assert.ok(held.front.length > 0 && held.front.every((r) => held.feasible[r]));
  await page.locator('#feasible').click();
  assert.equal((await numbers(page)).length, held.feasible.filter(Boolean).length);
  await page.evaluate((row) => window.sinew.page.choose(row), held.front[0]);
  assert.equal(await page.locator('#chosen h2').textContent(), `Candidate ${held.front[0]}`);
  assert.match(await page.locator('#importance .hint').textContent(), /chosen by a tuner/);
  await picture(page, 'study-tuned');

  const speeds = await Promise.all(['as it is', 'more drag'].map(async (name) => {
    const command = await page.locator(`.command[data-case="${name}"]`).textContent();
    assert.equal(command.includes("--set 'trolley.drag=1.2 lbf'") || command.includes('--set "trolley.drag=1.2 lbf"'), name === 'more drag', command);
    return speed_of(command, name.replaceAll(' ', '-'));
  }));
  const mean = await page.evaluate(([row, s]) => window.sinew.page.data.by_heading.get(s).values[row], [held.front[0], speed]);
  assert.ok(Math.abs((speeds[0] + 0.5 * speeds[1]) / 1.5 - mean) <= 1e-8 * mean, `${speeds} for ${mean}`);
}));

test('ten thousand rows are drawn in time', () => study('walk', async (page) => {
  const took = await page.evaluate(() => {
    const { page: p } = window.sinew, [s] = p.data.studies, rows = window.sinew.run.studies[0].rows;
    p.data.add(s, Array.from({ length: 10000 }, (_, i) => {
      const [, ok, generation, violation, cells] = rows[i % rows.length];
      return [i, ok, generation, violation, cells.map((c, k) => (s.own[k].number && c ? String(c * (1 + 1e-5 * i)) : c))];
    }));
    p.grown(true);
    p.draw();
    const whole = p.took;
    p.is_dragging = true;
    p.set_range(p.parameters[0], [p.parameters[0].low, p.parameters[0].high * 0.7]);
    p.draw();
    return { whole, dragged: p.took, rows: p.data.count };
  });
  assert.equal(took.rows, 10000);
  console.log(`# a study of 10,000 rows: drawn in ${took.whole.toFixed(0)} ms, while a range is dragged ${took.dragged.toFixed(0)} ms`);
  assert.ok(took.whole < generous * draws_within, `${took.whole} ms`);
  assert.ok(took.dragged < took.whole * 1.5 + 50, `${took.dragged} ms while dragging`);
}));

// Dragging along the first axis by touch selects a range and does not scroll; a tap removes it.
async function drag_by_touch(page) {
  const all = (await numbers(page)).length, handle = page.locator('.axis-handle').first(), box = await handle.boundingBox();
  const session = await page.context().newCDPSession(page), before = await page.evaluate(() => scrollY);
  const touch = (type, y) => session.send('Input.dispatchTouchEvent', { type, touchPoints: y === null ? [] : [{ x: box.x + box.width / 2, y: box.y + y }] });
  await touch('touchStart', 60);
  for (let y = 80; y <= 160; y += 20) await touch('touchMove', y);
  await touch('touchEnd', null);
  const some = (await numbers(page)).length;
  assert.ok(some > 0 && some < all, `${some} of ${all}`);
  assert.equal(await page.evaluate(() => scrollY), before);
  await handle.tap();
  assert.equal((await numbers(page)).length, all);
}

test('dark, on paper, on a phone', async () => {
  await study('walk', async (page) => {
    const light = await drawn(page, 'scatter');
    await page.locator('#theme').click();
    await settle(page);
    assert.notEqual(await drawn(page, 'scatter'), light);
    // The drawings are light before the browser prints, which draws no further frame.
    const print_begins = () => { dispatchEvent(new Event('beforeprint')); return document.getElementById('scatter-canvas').toDataURL(); };
    assert.equal(await page.evaluate(print_begins), light);
    await page.emulateMedia({ media: 'print' });
    assert.ok(await page.locator('#scatter-canvas').isVisible());
    assert.deepEqual(await Promise.all(['#words', '#feasible', '#chosen', '#ramp-colors'].map((id) => page.locator(id).isVisible())),
      [false, false, false, true], 'a print has the key of its colors, and no controls');
    // Bars and keys are backgrounds, which browsers leave out by default.
    assert.equal(await page.evaluate(() => getComputedStyle(document.querySelector('.shares .share')).printColorAdjust), 'exact');
  });
  await study('walk', async (page) => {
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    assert.ok(wide <= 390, `${wide} px`);
    await page.evaluate(() => window.sinew.page.choose(3));
    assert.match(await page.locator('.command').textContent(), /^sinew run /);
    await page.locator('#parallel').scrollIntoViewIfNeeded();
    await drag_by_touch(page);
    await picture(page, 'study-phone');
  }, { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
});

// --- studies in progress ---

// Starts a slow sweep that writes the study.
function sweep(file, more = []) {
  return spawn(program, ['sweep', experiment, '--vary', 'joint.hip.angle_gain=0.02:0.1:60 %/count', '--seeds', '3', '--threads', '1',
    '--set', 'sequence.repeat=12', '--report', 'joints.hip.tracking_rms_rad [deg], air_used_kg [g]', '--results', file, '-o', `${file}.csv`, '--quiet', ...more],
  { cwd: folder });
}
const ended = (child) => new Promise((done) => child.on('close', done));

test('a study in progress is watched; a row that is run again gives its numbers', async () => {
  const file = join(folder, 'grows.db'), child = sweep(file), end = ended(child);
  for (let i = 0; i < 600 && !readdirSync(folder).includes('grows.db-wal'); ++i) await new Promise((next) => setTimeout(next, 50));
  let served;
  for (let i = 0; i < 100 && !served; ++i)
    served = await serve(['view', file, '--no-open'], folder).catch(() => new Promise((next) => setTimeout(next, 100)));
  await watch(served, async (page) => {
    const count = () => page.evaluate(() => window.sinew.page.data.count);
    const first = await count();
    await page.waitForFunction((n) => window.sinew.page.data.count > n, first, { timeout: 60000 });
    assert.equal(await end, 0);
    await page.waitForFunction(() => window.sinew.page.data.count === 180, null, { timeout: 60000 });
    assert.match(await page.locator('#facts').textContent(), /180 of 180 points/);
    const asked = await page.evaluate(() => window.sinew.page.growing.known[0]);
    assert.equal(asked, 180, 'each row was sent once');

    await page.evaluate(() => window.sinew.page.choose(window.sinew.page.data.number.indexOf(100)));
    const [replay] = await Promise.all([page.context().waitForEvent('page'), page.locator('#run-it').click()]);
    await replay.waitForSelector('html[data-ready]', { timeout: 60000 });
    const { figure, scene } = await replay.evaluate(() => ({ figure: window.sinew.run.summary.joints.hip.tracking_rms_rad, scene: Boolean(document.getElementById('scene')) }));
    assert.ok(scene);
    const row = readFileSync(`${file}.csv`, 'utf8').trim().split('\n')[101].split(',');
    assert.ok(Math.abs((figure * 180) / Math.PI - Number(row[2])) <= 1e-8 * Number(row[2]), `${figure} for ${row}`);
    assert.deepEqual(readdirSync(join(folder, 'runs', 'leg-in-air')), ['1']);
    await replay.reload();
    assert.deepEqual(readdirSync(join(folder, 'runs', 'leg-in-air')), ['1'], 'it is run once');
  });
  served.child.kill('SIGINT');
  assert.equal((await served.ended).code, 0);
});

test('two studies are watched together; a row of the second is run', async () => {
  const files = ['one', 'two'].map((name) => join(folder, `${name}.db`)), rms = 'joints.hip.tracking_rms_rad';
  files.forEach((file, i) => execFileSync(program, ['sweep', experiment, '--vary', `joint.hip.angle_gain=0.02:0.0${4 + i}:${3 + i} %/count`,
    '--report', `${rms} [deg]`, '--results', file, '-o', `${file}.csv`, '--quiet'], { cwd: folder }));
  const served = await serve(['view', ...files, '--no-open'], folder);
  await watch(served, async (page) => {
    assert.equal(await page.locator('#count').textContent(), '7 rows');
    await page.waitForFunction(() => window.sinew.page.growing.replies >= 4, null, { timeout: 60000 });
    assert.deepEqual(await page.evaluate(() => window.sinew.page.growing.known), [3, 4]);
    assert.equal(await page.evaluate(() => window.sinew.page.data.count), 7, 'nothing comes twice');
    await page.evaluate(() => window.sinew.page.choose(3 + 3));
    assert.equal(await page.locator('#chosen h2').textContent(), 'Row B3');
    const [replay] = await Promise.all([page.context().waitForEvent('page'), page.locator('#run-it').click()]);
    await replay.waitForSelector('html[data-ready]', { timeout: 60000 });
    const ours = await replay.evaluate(() => (window.sinew.run.summary.joints.hip.tracking_rms_rad * 180) / Math.PI);
    const theirs = Number(readFileSync(`${files[1]}.csv`, 'utf8').trim().split('\n')[4].split(',')[1]);
    assert.ok(Math.abs(ours - theirs) <= 1e-8 * theirs, `${ours} for ${theirs}`);
  });
  served.child.kill('SIGINT');
  assert.equal((await served.ended).code, 0);
});
