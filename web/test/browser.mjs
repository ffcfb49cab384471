// browser.mjs RUNS [PICTURES]   opens the pages in the folders of RUNS in a browser without network
// and does what a person would; exit code 1 if a test fails. Pictures are written into PICTURES.
// Each *_page.mjs has a browser of its own. Two files run at a time, since a page mostly waits, except
// those whose page has to keep up with the clock on the wall. What failed is printed last, because
// ./check shows the end of what a step prints.
import { spawn } from 'node:child_process';
import { readdirSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

const folder = fileURLToPath(new URL('.', import.meta.url));
const alone = ['live_page.mjs', 'run_page.mjs'];
const long = ['study_page.mjs', 'compare_page.mjs', 'references_page.mjs', 'plots_page.mjs'];
const short = readdirSync(folder).filter((name) => name.endsWith('_page.mjs') && ![...alone, ...long].includes(name));
const failed = [];

// Runs the tests of a file; prints those that passed in one piece, and keeps those that failed. If the
// file itself fails, all that it printed is kept.
const run = (name) => new Promise((done) => {
  const child = spawn(process.execPath, [folder + name, ...process.argv.slice(2)], { stdio: ['ignore', 'pipe', 'pipe'] });
  let printed = '', errors = '';
  child.stdout.setEncoding('utf8').on('data', (text) => { printed += text; });
  child.stderr.setEncoding('utf8').on('data', (text) => { errors += text; process.stderr.write(text); });
  child.on('close', (code) => {
    const tests = printed.split(/^(?=# Subtest: )/m), wrong = code === 0 ? [] : tests.filter((test) => /^not ok /m.test(test));
    if (code === 0 || wrong.length) process.stdout.write(tests.filter((test) => !wrong.includes(test)).join(''));
    if (code !== 0) failed.push(`# ${name}, exit code ${code}\n`, ...(wrong.length ? wrong : tests), errors);
    done();
  });
});
const run_in_turn = async (names) => {
  while (names.length) await run(names.shift());
};

await run_in_turn(alone);
const others = [...long, ...short];
await Promise.all([run_in_turn(others), run_in_turn(others)]);
process.stdout.write(failed.join(''));
if (failed.length) process.exitCode = 1;
