// Common functions of tests of served pages: a program that serves, and a page that requests nothing else.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { resolve } from 'node:path';
import { after } from 'node:test';
import { new_context } from './pages.mjs';

if (!process.env.SINEW) throw new Error('SINEW is not set; expected the path of the program, as build/release/bin/sinew');
export const program = resolve(process.env.SINEW);

const children = [];
after(() => children.forEach((child) => child.kill('SIGKILL')));

// Starts the program, which prints its address; `ended` resolves to its exit code and messages.
export async function serve(words_of_line, cwd) {
  const child = spawn(program, words_of_line, { cwd });
  children.push(child);
  let words = '', errors = '';
  child.stderr.on('data', (text) => (errors += text));
  const ended = new Promise((done) => child.on('close', (code) => done({ code, errors })));
  const url = await new Promise((found, wrong) => {
    child.stdout.on('data', (text) => {
      words += text;
      if (words.includes('\n')) found(words.split('\n')[0]);
    });
    ended.then(({ errors: why }) => wrong(new Error(why)));
  });
  return { url, child, ended };
}

// Opens the served page, calls `does`, and checks that the page has caused no error.
export async function watch(run, does, options = {}, path = '') {
  const context = await new_context(options);
  const page = await context.newPage(), wrong = [];
  page.on('console', (m) => ['error', 'warning'].includes(m.type()) && wrong.push(m.text()));
  page.on('pageerror', (e) => wrong.push(e.message));
  page.on('request', (r) => !r.url().startsWith(run.url) && !r.url().startsWith('data:') && wrong.push(r.url()));
  try {
    await page.goto(run.url + path);
    await page.waitForSelector('html[data-ready]');
    await does(page);
    assert.deepEqual(wrong, []);
  } finally {
    await context.close();
  }
}
