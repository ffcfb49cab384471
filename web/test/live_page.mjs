// Tests of the page of a run in progress, `sinew view --live`: watching, pausing, setting values, repeating.
// The program is the file in SINEW.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import http from 'node:http';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { drawing_of, new_context, picture, playheads } from './pages.mjs';
import { program, serve, watch } from './served.mjs';

const experiment = fileURLToPath(new URL('../../experiments/tune-in-air.toml', import.meta.url));
const folder = mkdtempSync(join(tmpdir(), 'sinew-live-'));
after(() => rmSync(folder, { recursive: true, force: true }));

const wait = (ms) => new Promise((done) => setTimeout(done, ms));

// Starts a run with its server; returns `url`, and `ended` with exit code and messages.
async function start(name, options = []) {
  const out = join(folder, name);
  return { out, ...(await serve(['view', '--live', experiment, '--no-open', '-o', out, ...options], folder)) };
}

const live = (page) => page.evaluate(() => ({ ...window.sinew.live.state, shown: window.sinew.page.player.time,
  known: window.sinew.live.time, frames: window.sinew.live.frames }));
const until = (page, what, argument) => page.waitForFunction(what, argument, { timeout: 30000 });

// Returns all samples of a log as text.
function samples(run) {
  const file = `${run}.csv`;
  execFileSync(program, ['export', run, '--csv', '-o', file, '--quiet']);
  return readFileSync(file, 'utf8');
}

test('a fault is shown while it is active', async () => {
  const set = ['--set', 'fault=[{ at = "0.5 s", for = "3 s", of = "knee_extensor.inlet", what = "stuck open" }]'];
  const run = await start('broken', [...set, '--paused']);
  await watch(run, async (page) => {
    assert.equal(await page.locator('#faults button').textContent(), 'knee_extensor.inlet stuck open, 0.50–3.50 s');
    await page.locator('#run-pause').click();
    await until(page, () => window.sinew.page.player.time > 0.7);
    assert.match(await page.locator('#clock .broken').textContent(), /knee_extensor\.inlet stuck open/);
    assert.equal(await page.locator('#faults button.now').count(), 1);
  });
  run.child.kill('SIGKILL');
});

test('a run is watched, paused and changed by hand; its file repeats it', async () => {
  const run = await start('steered');
  await watch(run, async (page) => {
    await until(page, () => window.sinew.live.time > 1);
    const before = await live(page);
    const still = await drawing_of(page);
    await until(page, ({ frames, shown }) => window.sinew.live.frames > frames + 2 && window.sinew.page.player.time > shown, before);
    const later = await live(page);
    assert.ok(later.shown <= later.known && later.known - later.shown < 2);
    assert.notEqual(await drawing_of(page), still);
    const heads = await playheads(page);
    assert.ok(heads.length > 2);
    await until(page, () => window.sinew.page.plots.panels[0].plot.data[0].at(-1) > 0.5);
    const [drawn, known] = await page.evaluate(() => [window.sinew.page.plots.panels[0].plot.data[0].at(-1), window.sinew.live.time]);
    assert.ok(drawn <= known, `plots have grown to ${drawn} s of ${known} s`);
    await picture(page, 'live');

    // A paused run does not advance.
    await page.locator('#run-pause').click();
    await until(page, () => window.sinew.live.state.paused);
    await wait(300);
    const stood = await live(page);
    await wait(400);
    assert.equal((await live(page)).known, stood.known);
    assert.equal(await page.locator('#live strong').textContent(), 'Paused');
    await page.locator('#run-pause').click();
    await until(page, (t) => window.sinew.live.time > t + 0.2, stood.known);

    // A slider, an exact value, a release.
    const hip = page.locator('.control[data-key="control.gains.hip.angle"]');
    assert.equal(await hip.locator('.release').isDisabled(), true);
    await hip.locator('input[type=range]').focus();
    for (let i = 0; i < 5; ++i) await page.keyboard.press('PageDown');
    await until(page, () => window.sinew.live.state.overridden.some(Boolean));
    const knee = page.locator('.control[data-key="control.stiffness.knee"]');
    await knee.locator('input[type=number]').fill('1.25');
    await page.keyboard.press('Enter');
    await until(page, () => window.sinew.live.state.values.includes(1.25));
    assert.match(await knee.getAttribute('class'), /by-hand/);
    await until(page, () => document.querySelectorAll('#changes button').length >= 2);
    assert.match((await page.locator('#changes button').allTextContents()).join(), /hip angle gain: .*knee desired stiffness: 1\.250 N m\/rad/);
    assert.ok((await page.locator('.panel:visible .mark-handle').count()) >= 2);
    await picture(page, 'live-by-hand');
    await hip.locator('.release').click();
    await until(page, () => window.sinew.live.state.overridden.filter(Boolean).length === 1);

    // A page that is opened later has all samples from the start.
    await watch(run, async (late) => {
      const first = await late.evaluate(() => window.sinew.live.growing.clocks[0].room[0]);
      assert.ok(first < 0.02, `from ${first} s on`);
    });

    // At the end the page becomes that of the finished run.
    await page.locator('#run-pace').selectOption('0');
    await until(page, () => !window.sinew?.live && document.documentElement.dataset.ready);
    assert.ok((await page.locator('#numbers tr[data-key]').count()) > 20);
    assert.ok((await page.locator('#parameters tr[data-key^="change["]').count()) >= 6);
    assert.ok((await page.locator('#changes button').count()) >= 3, 'marks as during the run, with the release');
  });
  run.child.kill('SIGINT');
  const { code, errors } = await run.ended;
  assert.equal(code, 0, errors);
  assert.match(errors, /kept in/);

  const again = join(folder, 'again');
  execFileSync(program, ['run', join(run.out, 'resolved.toml'), '-o', again, '--quiet', '--no-report']);
  assert.equal(samples(again), samples(run.out));
});

test('watched by several, some of them slow, the log keeps its bytes', async () => {
  const run = await start('watched', ['--set', 'sequence.repeat=2', '--paused', '--pace', '4', '--once']);
  // A client that never reads.
  const deaf = http.request(`${run.url}live`, { headers: { connection: 'Upgrade', upgrade: 'websocket',
    origin: new URL(run.url).origin, 'sec-websocket-key': 'c2luZXcgaXMgd2F0Y2hlZA==', 'sec-websocket-version': 13 } });
  deaf.on('upgrade', (response, socket) => socket.pause());
  deaf.on('error', () => {});
  deaf.end();
  await watch(run, (page) => watch(run, async () => {
    await page.locator('#run-pause').click();
    await until(page, () => window.sinew.live.time > 0.5);
  }));
  const { code, errors } = await run.ended;
  deaf.destroy();
  assert.equal(code, 0, errors);
  const alone = join(folder, 'alone');
  execFileSync(program, ['run', experiment, '--set', 'sequence.repeat=2', '-o', alone, '--quiet', '--no-report']);
  const log = (of) => readFileSync(join(of, 'log.mcap'));
  assert.ok(log(alone).equals(log(run.out)));
});

test('after Ctrl-C the run is completed', async () => {
  const run = await start('stopped', ['--paused']);
  await wait(300);
  run.child.kill('SIGINT');
  const { code, errors } = await run.ended;
  assert.equal(code, 0, errors);
  const summary = JSON.parse(readFileSync(join(run.out, 'summary.json'), 'utf8'));
  assert.ok(summary.sequence_duration_s > 50);
});

test('recorded runs of every kind are served, and nothing else', async () => {
  const here = join(folder, 'here');
  for (const [name, file] of [['kick', 'kick.toml'], ['stand', 'rig/feedback.toml']])
    execFileSync(program, ['run', fileURLToPath(new URL(`../../experiments/${file}`, import.meta.url)), '-o',
      join(here, 'runs', name, '1'), '--quiet', '--no-report']);
  const run = await serve(['view', '--no-open'], here);  // the newest
  const { url } = run;
  for (const path of ['', 'run/0', 'run/1'])
    await watch({ url }, async (page) => assert.ok((await page.locator('.panel').count()) > 0, path), {}, path);
  const list = await ask(url, '/runs');
  assert.match(list.body, /"run":0,"folder":"runs\/stand\/1"[^]*"run":1,"folder":"runs\/kick\/1"/);
  for (const path of ['/run/2', '/run/-1', '/run/', '/run/0x', '/runs/kick/1/log.mcap', '/live'])
    assert.equal((await ask(url, path)).status, 404, path);
  assert.equal((await upgrade(url, new URL(url).origin)).status, 403);
  run.child.kill('SIGINT');
  assert.equal((await run.ended).code, 0);
});

// --- permitted requests ---

// Sends a request. `path` is relative to the address with its token; if `bare`, relative to the host.
function ask(url, path, headers = {}, method = 'GET', bare = false) {
  return new Promise((done) => {
    const { hostname, port, pathname } = new URL(url);
    const whole = bare ? path : pathname.slice(0, -1) + path;
    const request = http.request({ hostname, port, path: whole, method, headers }, (response) => {
      let body = '';
      response.on('data', (text) => (body += text));
      response.on('end', () => done({ status: response.statusCode, body, headers: response.headers }));
    });
    request.on('upgrade', (response, socket) => (socket.destroy(), done({ status: 101 })));
    request.on('error', (e) => done({ status: 0, body: e.message }));
    request.end();
  });
}
const upgrade = (url, origin, more = {}) => ask(url, '/live', { connection: 'Upgrade', upgrade: 'websocket',
  ...(origin && { origin }), 'sec-websocket-key': 'c2luZXcgaXMgd2F0Y2hlZA==', 'sec-websocket-version': 13, ...more });

test('only its own page may watch; there are no files', async () => {
  const run = await start('guarded', ['--paused', '--set', 'sequence.repeat=1']);
  const { url } = run, { port, origin: own } = new URL(url);
  assert.match(url, /^http:\/\/127\.0\.0\.1:\d+\/[0-9a-f]{32}\/$/);
  const page = await ask(url, '/');
  assert.equal(page.status, 200);
  assert.equal(page.headers['cache-control'], 'no-store');
  assert.equal(page.headers['x-frame-options'], 'DENY');
  assert.equal((await ask(url, '/', { host: `localhost:${port}` })).status, 200);
  for (const host of ['evil.example', `evil.example:${port}`, '127.0.0.1', `127.0.0.1:${port}.evil.example`])
    assert.notEqual((await ask(url, '/', { host })).status, 200, host);
  for (const path of ['/../../etc/passwd', '//etc/passwd', '/report.html', '/live', '/%2e%2e/', '/run/0', `/${'a'.repeat(5000)}`])
    assert.equal((await ask(url, path)).status, 404, path);
  assert.equal((await ask(url, `/${'a'.repeat(20000)}`)).status === 200, false);
  for (const path of ['/', '/live', '/runs', `/${'0'.repeat(32)}/`]) {
    const refused = await ask(url, path, {}, 'GET', true);
    assert.equal(refused.status, 403, path);
    assert.match(refused.body, /lacks its token; open the whole one/);
  }
  assert.equal((await ask(url, '/', {}, 'POST')).status, 405);
  assert.equal((await upgrade(url, own)).status, 101);
  for (const origin of [null, 'http://evil.example', 'null', `https://127.0.0.1:${port}`, `${own}.evil.example`])
    assert.equal((await upgrade(url, origin)).status, 403, String(origin));
  assert.equal((await upgrade(url, own, { host: 'evil.example' })).status, 403);

  // Invalid requests get an error message, and the run continues.
  await send_invalid_requests(url);
  run.child.kill('SIGINT');
  assert.equal((await run.ended).code, 0);
});

async function send_invalid_requests(url) {
  const context = await new_context();
  const page = await context.newPage();
  await page.goto(`${url}nothing-here`);  // of the same origin, without a policy
  const answers = await page.evaluate(async (where) => {
    const socket = new WebSocket(where), got = [];
    await new Promise((open) => (socket.onopen = open));
    socket.onmessage = (m) => { const a = JSON.parse(m.data); if (a.error) got.push(a.error); };
    for (const text of ['', '[]', '{"do":"explode"}', '{"do":"set","key":"seed","value":3}', '\u0000', '['.repeat(1000)]) socket.send(text);
    for (let i = 0; i < 100 && got.length < 6; ++i) await new Promise((next) => setTimeout(next, 50));
    const closed = new Promise((done) => (socket.onclose = () => done(true)));
    socket.send('x'.repeat(100000));
    return { got, closed: await closed };
  }, `${url.replace('http', 'ws')}live`);
  assert.equal(answers.got.length, 6);
  assert.ok(answers.got.every((a) => /found .*; expected/.test(a)), answers.got.join('\n'));
  assert.equal(answers.closed, true);
  await context.close();
}
